//! A joint-trajectory follower: between its points the arm moves linearly, and never past a limit.

use crate::JointModel;
use apprentice_msgs::trajectory_msgs::JointTrajectory;
use thiserror::Error;

/// Longest trajectory that is followed.
const MAX_POINTS: usize = 100_000;

/// Why a trajectory is not followed.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum TrajectoryError {
    /// Too long.
    #[error("the trajectory has {got} points; at most {MAX_POINTS} are followed")]
    TooLong {
        /// Got.
        got: usize,
    },
    /// A joint the robot does not have.
    #[error("the trajectory moves '{joint}', which is no joint of this robot")]
    UnknownJoint {
        /// Its name.
        joint: String,
    },
    /// A joint is named twice.
    #[error("the trajectory names joint '{joint}' twice")]
    RepeatedJoint {
        /// Its name.
        joint: String,
    },
    /// A point without one position per named joint.
    #[error("point {point} has {got} positions for {expected} joints")]
    Positions {
        /// Counted from 0.
        point: usize,
        /// Got.
        got: usize,
        /// Needed.
        expected: usize,
    },
    /// A position is not a number or outside the limits.
    #[error("point {point} puts joint '{joint}' at {got}; its limits are {lower} to {upper}")]
    Limits {
        /// Counted from 0.
        point: usize,
        /// The joint.
        joint: String,
        /// Got.
        got: f64,
        /// Limit.
        lower: f64,
        /// Limit.
        upper: f64,
    },
    /// Points must follow each other in time.
    #[error("point {point} is at {got_s} s, not after the {previous_s} s before it")]
    Time {
        /// Counted from 0.
        point: usize,
        /// Got.
        got_s: f64,
        /// Of the point before, or 0.
        previous_s: f64,
    },
}

/// Where the arm is and where it goes.
#[derive(Debug, Clone)]
pub struct Follower {
    joints: Vec<JointModel>,
    /// Where a motion began or ended; one entry per joint.
    from: Vec<f64>,
    began_ns: i128,
    /// Nanoseconds after `began_ns`, and where every joint is then.
    points: Vec<(i128, Vec<f64>)>,
}

impl Follower {
    /// An arm at rest; `start` has one position per joint.
    pub fn new(joints: Vec<JointModel>, start: Vec<f64>) -> Self {
        debug_assert_eq!(joints.len(), start.len());
        Self { joints, from: start, began_ns: 0, points: Vec::new() }
    }

    /// The joints, in the order of every list of positions.
    pub fn joints(&self) -> &[JointModel] {
        &self.joints
    }

    /// Begins a motion from where the arm is now; joints that the trajectory does not name stay. An empty trajectory stops.
    ///
    /// # Errors
    /// When the trajectory does not fit the robot; the motion under way then goes on.
    pub fn follow(&mut self, now_ns: i128, trajectory: &JointTrajectory) -> Result<(), TrajectoryError> {
        let columns = self.columns(trajectory)?;
        let here = self.positions(now_ns);
        let mut points: Vec<(i128, Vec<f64>)> = Vec::with_capacity(trajectory.points.len());
        let mut previous_ns = -1;
        for (i, point) in trajectory.points.iter().enumerate() {
            if point.positions.len() != columns.len() {
                let (got, expected) = (point.positions.len(), columns.len());
                return Err(TrajectoryError::Positions { point: i, got, expected });
            }
            let at_ns = point.time_from_start.nanoseconds();
            if at_ns <= previous_ns {
                let previous_s = previous_ns.max(0) as f64 * 1e-9;
                return Err(TrajectoryError::Time { point: i, got_s: at_ns as f64 * 1e-9, previous_s });
            }
            previous_ns = at_ns;
            let mut q = here.clone();
            for (&column, &got) in columns.iter().zip(&point.positions) {
                let joint = &self.joints[column];
                if !got.is_finite() || got < joint.lower - 1e-9 || got > joint.upper + 1e-9 {
                    let (lower, upper) = (joint.lower, joint.upper);
                    return Err(TrajectoryError::Limits { point: i, joint: joint.name.clone(), got, lower, upper });
                }
                q[column] = got.clamp(joint.lower, joint.upper);
            }
            points.push((at_ns, q));
        }
        (self.from, self.began_ns, self.points) = (here, now_ns, points);
        Ok(())
    }

    /// Where every joint is, radians or metres.
    pub fn positions(&self, now_ns: i128) -> Vec<f64> {
        // Before the beginning: a clock that jumped back.
        let elapsed_ns = (now_ns - self.began_ns).max(0);
        let mut before = (0, &self.from);
        for (at_ns, q) in &self.points {
            if elapsed_ns < *at_ns {
                let share = (elapsed_ns - before.0) as f64 / (at_ns - before.0) as f64;
                return before.1.iter().zip(q).map(|(a, b)| a + share * (b - a)).collect();
            }
            before = (*at_ns, q);
        }
        before.1.clone()
    }

    /// Whether the arm is on its way.
    pub fn is_moving(&self, now_ns: i128) -> bool {
        self.points.last().is_some_and(|(at_ns, _)| now_ns - self.began_ns < *at_ns)
    }

    /// For every joint that the trajectory names, its place in the robot's list.
    fn columns(&self, trajectory: &JointTrajectory) -> Result<Vec<usize>, TrajectoryError> {
        if trajectory.points.len() > MAX_POINTS {
            return Err(TrajectoryError::TooLong { got: trajectory.points.len() });
        }
        let mut columns = Vec::new();
        for name in &trajectory.joint_names {
            let Some(column) = self.joints.iter().position(|joint| joint.name == *name) else {
                return Err(TrajectoryError::UnknownJoint { joint: name.chars().take(80).collect() });
            };
            if columns.contains(&column) {
                return Err(TrajectoryError::RepeatedJoint { joint: name.clone() });
            }
            columns.push(column);
        }
        Ok(columns)
    }
}
