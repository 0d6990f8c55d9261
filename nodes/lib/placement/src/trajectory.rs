//! When which joint is where.

use crate::manipulator::Manipulator;

pub use motion::TrajectoryPoint;

/// A timed motion of the joints that move the tool.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Trajectory {
    /// One per entry of every point.
    pub joint_names: Vec<String>,
    /// In order of time, from rest to rest.
    pub points: Vec<TrajectoryPoint>,
}

impl Trajectory {
    pub(crate) fn new(manipulator: &Manipulator, timed: motion::Trajectory) -> Self {
        Self { joint_names: manipulator.joint_names(), points: timed.points }
    }

    /// Seconds from start to end.
    pub fn seconds(&self) -> f64 {
        self.points.last().map_or(0.0, |point| point.time_from_start_s)
    }

    /// The same after another motion of the same joints, which ends where this one starts.
    pub(crate) fn after(self, first: &motion::Trajectory) -> Self {
        let mut all = first.clone();
        all.append(&motion::Trajectory { points: self.points }, 0.0);
        Self { joint_names: self.joint_names, points: all.points }
    }
}
