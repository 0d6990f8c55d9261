//! The joints that move one link, the tool.

use crate::levers::stroke;
use crate::{Drive, JacobianColumn, JointKind, Robot, rotation};
use nalgebra::{Isometry3, Unit, Vector3};
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
    /// For each entry, how far the tool's origin moves at most, metres per radian or per metre.
    pub levers: Vec<f64>,
    /// The joints that move on the way from the root to the tool.
    segments: Vec<Segment>,
    /// From the last of them to the tool.
    last_from_tool: Isometry3<f64>,
    /// The tool's origin is never farther from the first moving joint than this, metres.
    pub(crate) reach: f64,
}

/// A moving joint and what is fixed before it.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Segment {
    /// Index of the joint.
    joint: usize,
    /// From the frame after the moving joint before it (or the root) to its own at position 0.
    before: Isometry3<f64>,
    axis: Unit<Vector3<f64>>,
    slides: bool,
    /// Entry of the configuration, and its place in the chain's.
    entry: usize,
    place: usize,
    /// Position = factor · entry + offset.
    factor: f64,
    offset: f64,
}

impl Segment {
    /// What its motion adds to `before`.
    fn motion(&self, q: &[f64]) -> Isometry3<f64> {
        let position = self.factor * q[self.entry] + self.offset;
        if self.slides {
            Isometry3::translation(self.axis.x * position, self.axis.y * position, self.axis.z * position)
        } else {
            Isometry3::from_parts(nalgebra::Translation3::identity(), rotation::about_axis(&self.axis, position))
        }
    }
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
        let mut segments: Vec<Segment> = Vec::new();
        let mut reach = 0.0;
        let mut reach_before = Vec::new();
        let mut fixed = Isometry3::identity();
        for j in path {
            let joint = &robot.joints[j];
            fixed *= joint.parent_from_joint;
            if !segments.is_empty() {
                reach += joint.parent_from_joint.translation.vector.norm();
            }
            let (entry, factor, offset) = match joint.drive {
                Drive::Fixed => continue,
                Drive::Position(entry) => (entry, 1.0, 0.0),
                Drive::Mimic { leader, multiplier, offset } => (leader, multiplier, offset),
            };
            let slides = joint.kind == JointKind::Prismatic;
            if slides {
                reach += stroke(robot, j);
            }
            let place = entries.iter().position(|&e| e == entry).unwrap_or_else(|| {
                entries.push(entry);
                entries.len() - 1
            });
            segments.push(Segment { joint: j, before: fixed, axis: joint.axis, slides, entry, place, factor, offset });
            fixed = Isometry3::identity();
            reach_before.push(reach);
        }
        if segments.is_empty() {
            return Err(ChainError::Rigid { name: tool.into() });
        }
        if entries.len() > MAX_CHAIN_JOINTS {
            return Err(ChainError::TooLong { name: tool.into(), got: entries.len() });
        }
        let mut levers = vec![0.0; entries.len()];
        for (segment, before) in segments.iter().zip(&reach_before) {
            levers[segment.place] += segment.factor.abs() * if segment.slides { 1.0 } else { reach - before };
        }
        Ok(Self { tool: link, entries, levers, segments, last_from_tool: fixed, reach })
    }

    /// Names of its joints.
    pub fn joint_names<'a>(&'a self, robot: &'a Robot) -> impl Iterator<Item = &'a str> {
        self.entries.iter().map(|&entry| robot.driven_joint(entry).name.as_str())
    }

    /// Which links the chain's last joint carries: the wrist, the gripper and the tool. One entry per link.
    pub fn hand(&self, robot: &Robot) -> Vec<bool> {
        let last = self.segments.last().expect("a chain has a moving joint").joint;
        let mut carried = vec![false; robot.links.len()];
        carried[robot.joints[last].child] = true;
        for joint in &robot.joints {
            carried[joint.child] |= carried[joint.parent];
        }
        carried
    }

    /// The same joints moving another point that is fixed to the tool: what was said of the tool's origin and axes is then said of
    /// those of `tool_from_point`. [`Chain::tool`] stays the link.
    pub fn moving_point(&self, tool_from_point: &Isometry3<f64>) -> Self {
        let mut chain = self.clone();
        let farther = tool_from_point.translation.vector.norm();
        chain.last_from_tool *= tool_from_point;
        chain.reach += farther;
        let turns = |place: usize| self.segments.iter().filter(move |s| s.place == place && !s.slides);
        for (place, lever) in chain.levers.iter_mut().enumerate() {
            *lever += turns(place).map(|segment| segment.factor.abs() * farther).sum::<f64>();
        }
        chain
    }

    /// root_from_tool, from a configuration of the whole robot.
    pub fn tool_pose(&self, q: &[f64]) -> Isometry3<f64> {
        let moved = self.segments.iter().fold(Isometry3::identity(), |pose, s| pose * s.before * s.motion(q));
        moved * self.last_from_tool
    }

    /// The origin of its first moving joint in the root frame: nothing moves it.
    pub fn base(&self) -> Vector3<f64> {
        self.segments.first().map_or_else(Vector3::zeros, |segment| segment.before.translation.vector)
    }

    /// root_from_tool and the geometric Jacobian of the tool, one column per entry of the chain. Joints that mimic add to the
    /// column of their leader.
    pub fn linearise(&self, q: &[f64], columns: &mut Vec<JacobianColumn>) -> Isometry3<f64> {
        let mut axes = [(Vector3::zeros(), Vector3::zeros()); 2 * MAX_CHAIN_JOINTS];
        let mut more = Vec::new();
        let mut pose = Isometry3::identity();
        for (i, segment) in self.segments.iter().enumerate() {
            pose = pose * segment.before * segment.motion(q);
            // The motion leaves its own axis and origin where they are, so the moved frame will do for revolute joints.
            let axis = (pose.rotation * (segment.axis.into_inner() * segment.factor), pose.translation.vector);
            match axes.get_mut(i) {
                Some(room) => *room = axis,
                None => more.push(axis),
            }
        }
        pose *= self.last_from_tool;
        columns.clear();
        columns.resize(self.entries.len(), JacobianColumn::default());
        for (segment, (axis, origin)) in self.segments.iter().zip(axes.iter().chain(&more)) {
            let column = &mut columns[segment.place];
            if segment.slides {
                column.linear += axis;
            } else {
                column.linear += axis.cross(&(pose.translation.vector - origin));
                column.angular += axis;
            }
        }
        pose
    }
}

fn no_link(robot: &Robot, name: &str) -> ChainError {
    let is_leaf = |link: usize| robot.joints.iter().all(|joint| joint.parent != link);
    let leaves: Vec<&str> =
        (0..robot.links.len()).filter(|&l| is_leaf(l)).map(|l| robot.links[l].name.as_str()).take(8).collect();
    ChainError::NoLink { name: crate::scan::shorten(name), leaves: crate::scan::shorten(&leaves.join(", ")) }
}
