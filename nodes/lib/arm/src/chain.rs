//! The joints that move one link, the tool.

use crate::{Drive, JointKind, Robot};
use thiserror::Error;

/// Longest chain of driven joints.
pub const MAX_CHAIN_JOINTS: usize = 16;

/// The driven joints between the root and a tool link.
#[derive(Debug, Clone, PartialEq)]
pub struct Chain {
    /// Index of the tool link.
    pub tool: usize,
    /// Entries of the configuration that move the tool, from the root outwards, each once.
    pub entries: Vec<usize>,
    /// Joints that move on the way from the root to the tool: (joint, position in `entries`, factor on its speed).
    pub(crate) moves: Vec<(usize, usize, f64)>,
    /// For each entry, how far the tool's origin moves at most, metres per radian or per metre.
    pub levers: Vec<f64>,
    /// The tool's origin is never farther from the first moving joint than this, metres.
    pub(crate) reach: f64,
}

/// Why a link cannot be a tool.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum ChainError {
    /// No such link.
    #[error("the robot has no link '{name}'; its last links are: {leaves}")]
    NoLink {
        /// Asked for.
        name: String,
        /// Some of the links without children.
        leaves: String,
    },
    /// It stands still.
    #[error("no joint moves the link '{name}'; name the tool at the end of the arm")]
    Rigid {
        /// The link.
        name: String,
    },
    /// Beyond [`MAX_CHAIN_JOINTS`].
    #[error("{got} joints move the link '{name}'; at most {MAX_CHAIN_JOINTS} are supported")]
    TooLong {
        /// The link.
        name: String,
        /// Got.
        got: usize,
    },
}

impl Chain {
    /// The chain from the root to a link.
    ///
    /// # Errors
    /// No such link, nothing moves it, or too many joints do.
    pub fn new(robot: &Robot, tool: &str) -> Result<Self, ChainError> {
        let link = robot.link_index(tool).ok_or_else(|| no_link(robot, tool))?;
        let mut path = Vec::new();
        let mut at = link;
        while let Some(joint) = robot.holder(at) {
            path.push(at - 1);
            at = joint.parent;
        }
        path.reverse();
        let mut entries: Vec<usize> = Vec::new();
        let mut moves = Vec::new();
        let mut reach = 0.0;
        let mut reach_before = Vec::new();
        for j in path {
            let joint = &robot.joints[j];
            let (entry, factor) = match joint.drive {
                Drive::Fixed => {
                    reach += if moves.is_empty() { 0.0 } else { joint.parent_from_joint.translation.vector.norm() };
                    continue;
                }
                Drive::Position(entry) => (entry, 1.0),
                Drive::Mimic { leader, multiplier, .. } => (leader, multiplier),
            };
            if !moves.is_empty() {
                reach += joint.parent_from_joint.translation.vector.norm();
            }
            if joint.kind == JointKind::Prismatic {
                reach += stroke(robot, j);
            }
            let place = entries.iter().position(|&e| e == entry).unwrap_or_else(|| {
                entries.push(entry);
                entries.len() - 1
            });
            moves.push((j, place, factor));
            reach_before.push(reach);
        }
        if moves.is_empty() {
            return Err(ChainError::Rigid { name: tool.into() });
        }
        if entries.len() > MAX_CHAIN_JOINTS {
            return Err(ChainError::TooLong { name: tool.into(), got: entries.len() });
        }
        let mut levers = vec![0.0; entries.len()];
        for (&(j, place, factor), before) in moves.iter().zip(&reach_before) {
            let slides = robot.joints[j].kind == JointKind::Prismatic;
            levers[place] += factor.abs() * if slides { 1.0 } else { reach - before };
        }
        Ok(Self { tool: link, entries, levers, moves, reach })
    }

    /// Names of its joints.
    pub fn joint_names<'a>(&'a self, robot: &'a Robot) -> impl Iterator<Item = &'a str> {
        self.entries.iter().map(|&entry| robot.driven_joint(entry).name.as_str())
    }

    /// Which links the chain's last joint carries: the wrist, the gripper and the tool. One entry per link.
    pub fn hand(&self, robot: &Robot) -> Vec<bool> {
        let &(last, ..) = self.moves.last().expect("a chain has a moving joint");
        let mut carried = vec![false; robot.links.len()];
        carried[robot.joints[last].child] = true;
        for joint in &robot.joints {
            carried[joint.child] |= carried[joint.parent];
        }
        carried
    }
}

/// The farthest a prismatic joint takes its child from where it is at 0, metres.
fn stroke(robot: &Robot, joint: usize) -> f64 {
    let joint = &robot.joints[joint];
    let far = |entry: usize, multiplier: f64, offset: f64| {
        let limits = robot.driven_joint(entry).limits;
        (multiplier * limits.lower + offset).abs().max((multiplier * limits.upper + offset).abs())
    };
    match joint.drive {
        Drive::Fixed => 0.0,
        Drive::Position(entry) => far(entry, 1.0, 0.0),
        Drive::Mimic { leader, multiplier, offset } => far(leader, multiplier, offset),
    }
}

fn no_link(robot: &Robot, name: &str) -> ChainError {
    let is_leaf = |link: usize| robot.joints.iter().all(|joint| joint.parent != link);
    let leaves: Vec<&str> =
        (0..robot.links.len()).filter(|&l| is_leaf(l)).map(|l| robot.links[l].name.as_str()).take(8).collect();
    ChainError::NoLink { name: crate::scan::shorten(name), leaves: crate::scan::shorten(&leaves.join(", ")) }
}
