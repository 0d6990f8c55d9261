//! What the simulated arm needs to know of its URDF: the joints that move, and the root link.

use arm::{MissingMesh, ReadOptions, Robot, UrdfError};
use std::path::PathBuf;
use thiserror::Error;

/// The arm made for this project.
pub const BUILT_IN_URDF: &str = include_str!("../../../config/urdf/table_arm.urdf");

/// Why there is no robot.
#[derive(Debug, Error)]
pub enum RobotError {
    /// The file cannot be read.
    #[error("cannot read the URDF {path:?}: {source}; give an existing file, or an empty `urdf` for the arm built in")]
    Read {
        /// Which file.
        path: PathBuf,
        /// Why.
        source: std::io::Error,
    },
    /// The file is larger than any robot description.
    #[error("the URDF {path:?} has {got} bytes; at most {} are read", arm::MAX_BYTES)]
    Size {
        /// Which file.
        path: PathBuf,
        /// Got.
        got: u64,
    },
    /// The text describes no usable robot.
    #[error("the robot description is wrong: {0}")]
    Urdf(#[from] UrdfError),
    /// Something that a parameter names.
    #[error("the robot has no {what} '{name}'")]
    Missing {
        /// A link or a joint.
        what: &'static str,
        /// Its name.
        name: String,
    },
    /// As many positions as joints.
    #[error("start_positions has {got} entries; the robot has {expected} joints that move: {names}")]
    StartPositions {
        /// Got.
        got: usize,
        /// Needed.
        expected: usize,
        /// The joints.
        names: String,
    },
    /// A start position is outside its joint's limits.
    #[error("start_positions puts joint '{joint}' at {got}, outside its limits {lower} to {upper}")]
    OutsideLimits {
        /// The joint.
        joint: String,
        /// Got.
        got: f64,
        /// Limit.
        lower: f64,
        /// Limit.
        upper: f64,
    },
}

/// A joint that moves.
#[derive(Debug, Clone, PartialEq)]
pub struct JointModel {
    /// Unique.
    pub name: String,
    /// Smallest position, radians or metres.
    pub lower: f64,
    /// Largest position, radians or metres.
    pub upper: f64,
}

/// The simulated arm.
#[derive(Debug, Clone, PartialEq)]
pub struct RobotModel {
    /// The URDF's text, as published.
    pub urdf: String,
    /// Name of the root link.
    pub root: String,
    /// Joints that move, in the URDF's order.
    pub joints: Vec<JointModel>,
    /// Where they start, radians or metres.
    pub start: Vec<f64>,
}

impl RobotModel {
    /// Reads a robot description.
    ///
    /// # Errors
    /// When the text is no usable URDF, or the start positions do not fit its joints; an empty list fits always.
    pub fn new(urdf: String, start_positions: &[f64]) -> Result<Self, RobotError> {
        let robot = read(&urdf)?;
        let joints: Vec<JointModel> = (0..robot.dof())
            .map(|i| robot.driven_joint(i))
            .map(|joint| JointModel { name: joint.name.clone(), lower: joint.limits.lower, upper: joint.limits.upper })
            .collect();
        let start = if start_positions.is_empty() { robot.rest() } else { start_positions.to_vec() };
        if start.len() != joints.len() {
            return Err(RobotError::StartPositions {
                got: start.len(),
                expected: joints.len(),
                names: joints.iter().map(|joint| joint.name.as_str()).collect::<Vec<_>>().join(", "),
            });
        }
        for (joint, &got) in joints.iter().zip(&start) {
            if !(joint.lower..=joint.upper).contains(&got) {
                let (lower, upper) = (joint.lower, joint.upper);
                return Err(RobotError::OutsideLimits { joint: joint.name.clone(), got, lower, upper });
            }
        }
        let root = robot.links.first().map(|link| link.name.clone()).unwrap_or_default();
        Ok(Self { urdf, root, joints, start })
    }

    /// The robot with all its links.
    pub(crate) fn read(&self) -> Result<Robot, RobotError> {
        read(&self.urdf)
    }
}

fn read(urdf: &str) -> Result<Robot, RobotError> {
    // Collisions play no part, so no mesh is looked for.
    let mut no_mesh = |_: &str| Err("it is not needed".to_owned());
    let options = ReadOptions { missing: MissingMesh::Bound, ..ReadOptions::default() };
    Ok(Robot::read(urdf, &mut no_mesh, &options)?)
}
