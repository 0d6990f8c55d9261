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
}
