//! How the arm is to move.

use crate::{Choice, Gripper};

/// What a plan may assume of the arm and how careful it is to be.
#[derive(Debug, Clone, PartialEq)]
pub struct MotionSettings {
    /// Which place is taken, of those that the arm can reach.
    pub choice: Choice,
    /// The link whose origin is between the fingertips and whose z axis points out of the hand.
    pub tool_link: String,
    /// What takes hold of the target; without one the target stays in the hand.
    pub gripper: Option<Gripper>,
    /// Where the table's frame is in the robot's root frame, when no link of the robot has its name.
    pub table: Option<TablePose>,
    /// Things nearer than this count as touching, metres.
    pub margin_m: f64,
    /// Height above what it is put on at which the target is released, metres; a larger margin raises it.
    pub release_m: f64,
    /// How far above its place the target is brought before it is lowered, metres, where the arm reaches that high.
    pub approach_m: f64,
    /// How far below the target's top the fingers hold it, metres; at most half its height.
    pub grip_m: f64,
    /// Share of each joint's velocity limit that is used.
    pub speed: f64,
    /// Time from rest to that speed, seconds.
    pub acceleration_s: f64,
    /// Time between points of the trajectory, seconds.
    pub sample_s: f64,
    /// Samples after which the search for a way around obstacles ends.
    pub samples: usize,
    /// Of every random draw.
    pub seed: u64,
}

/// Where the origin of a table is, and how the table is turned about the vertical.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TablePose {
    /// In the robot's root frame, metres.
    pub position_m: [f64; 3],
    /// Radians.
    pub yaw_rad: f64,
}

impl Default for MotionSettings {
    fn default() -> Self {
        Self {
            choice: Choice::default(),
            tool_link: "tool0".into(),
            gripper: None,
            table: None,
            margin_m: 0.003,
            release_m: 0.006,
            approach_m: 0.12,
            grip_m: 0.03,
            speed: 0.6,
            acceleration_s: 0.4,
            sample_s: 0.05,
            samples: 600,
            seed: 1,
        }
    }
}

/// The target is released at least this far above the margin, metres.
pub(crate) const ABOVE_MARGIN_M: f64 = 0.003;
/// The target is brought at least this far above its place, metres.
pub(crate) const LEAST_APPROACH_M: f64 = 0.03;
/// The farthest the tool goes up between two solutions of the inverse kinematics, metres.
pub(crate) const TOOL_STEP_M: f64 = 0.005;
