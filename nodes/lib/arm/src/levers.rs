//! How far the parts of a robot can move when its joints do.

use crate::{Drive, JointKind, Robot};

/// A joint on the way from the root to a link.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct PathJoint {
    joint: usize,
    /// Entry of the configuration.
    entry: usize,
    /// Speed per speed of the entry.
    factor: f64,
    /// Whether it slides: then every point moves alike.
    slides: bool,
    /// The link's origin is never farther from this joint's than this, metres.
    to_origin: f64,
}

/// For every link, the moving joints between the root and it.
#[derive(Debug, Clone, Default, PartialEq)]
pub(crate) struct Levers {
    paths: Vec<Vec<PathJoint>>,
}

impl Levers {
    pub fn new(robot: &Robot) -> Self {
        let mut paths: Vec<Vec<PathJoint>> = vec![Vec::new()];
        for (j, joint) in robot.joints.iter().enumerate() {
            let mut path = paths[joint.parent].clone();
            let slide = if joint.kind == JointKind::Prismatic { stroke(robot, j) } else { 0.0 };
            let farther = joint.parent_from_joint.translation.vector.norm() + slide;
            path.iter_mut().for_each(|before| before.to_origin += farther);
            let driven = match joint.drive {
                Drive::Fixed => None,
                Drive::Position(entry) => Some((entry, 1.0)),
                Drive::Mimic { leader, multiplier, .. } => Some((leader, multiplier.abs())),
            };
            path.extend(driven.map(|(entry, factor)| PathJoint {
                joint: j,
                entry,
                factor,
                slides: joint.kind == JointKind::Prismatic,
                to_origin: 0.0,
            }));
            paths.push(path);
        }
        Self { paths }
    }

    /// How many moving joints two links share, from the root on.
    pub fn n_shared(&self, a: usize, b: usize) -> usize {
        self.paths[a].iter().zip(&self.paths[b]).take_while(|(a, b)| a.joint == b.joint).count()
    }

    /// No point of a link that is within `extent` of its origin moves farther than this, metres, when the entries of the
    /// configuration change by `change`, as seen from the link that the first `from` joints carry.
    pub fn motion(&self, link: usize, from: usize, extent: f64, change: &[f64]) -> f64 {
        let far = |joint: &PathJoint| {
            let lever = if joint.slides { 1.0 } else { joint.to_origin + extent };
            change[joint.entry].abs() * joint.factor * lever
        };
        // A lever without end times no change is no motion.
        self.paths[link][from..].iter().filter(|joint| change[joint.entry] != 0.0).map(far).sum()
    }
}

/// The farthest a prismatic joint takes its child from where it is at 0, metres.
pub(crate) fn stroke(robot: &Robot, joint: usize) -> f64 {
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
