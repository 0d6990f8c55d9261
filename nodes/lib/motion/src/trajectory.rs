//! Where the joints are when.

/// A timed motion of all joints of a space.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Trajectory {
    /// In order of time.
    pub points: Vec<TrajectoryPoint>,
}

/// The joints at one time.
#[derive(Debug, Clone, PartialEq)]
pub struct TrajectoryPoint {
    /// Radians or metres.
    pub positions: Vec<f64>,
    /// Per s.
    pub velocities: Vec<f64>,
    /// Per s².
    pub accelerations: Vec<f64>,
    /// Seconds since the start.
    pub time_from_start_s: f64,
}

impl Trajectory {
    /// Seconds from start to end.
    pub fn seconds(&self) -> f64 {
        self.points.last().map_or(0.0, |point| point.time_from_start_s)
    }

    /// Appends a motion that starts where this one ends, after a rest; its first point is dropped for the last one here.
    pub fn append(&mut self, next: &Self, rest_s: f64) {
        let start_s = self.seconds() + rest_s;
        let skip = usize::from(!self.points.is_empty() && rest_s == 0.0);
        let later = next
            .points
            .iter()
            .skip(skip)
            .map(|point| TrajectoryPoint { time_from_start_s: start_s + point.time_from_start_s, ..point.clone() });
        self.points.extend(later);
    }
}
