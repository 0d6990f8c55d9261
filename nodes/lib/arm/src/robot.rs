//! The model: links joined by joints into one tree, and where every link is for given joint positions.

use crate::read::{MeshUse, ReadOptions};
use crate::{Problem, Solid, UrdfError, check, rotation, scan};
use nalgebra::{Isometry3, Translation3, Unit, UnitQuaternion, Vector3};

/// A robot, its tree checked.
#[derive(Debug, Clone)]
pub struct Robot {
    /// From the `<robot>` element; may be empty.
    pub name: String,
    /// The root first, every link after its parent.
    pub links: Vec<Link>,
    /// `joints[i]` holds `links[i + 1]`.
    pub joints: Vec<Joint>,
    /// Names of the joints that can be driven, one per entry of a configuration.
    pub(crate) driven: Vec<usize>,
    /// What a person should look at, although it does not keep the robot from being used; in the order of the text.
    pub problems: Vec<Problem>,
}

/// A rigid part.
#[derive(Debug, Clone)]
pub struct Link {
    /// Unique.
    pub name: String,
    /// Where it stands in the text, from 1.
    pub line: usize,
    /// What it is for collisions.
    pub solids: Vec<Placed>,
    /// The collision meshes among them.
    pub meshes: Vec<MeshUse>,
}

/// A solid, fixed somewhere.
#[derive(Debug, Clone, PartialEq)]
pub struct Placed {
    /// The solid, in its own frame.
    pub solid: Solid,
    /// Pose of the solid's frame in the frame of its owner.
    pub owner_from_solid: Isometry3<f64>,
}

/// What holds a link to its parent.
#[derive(Debug, Clone)]
pub struct Joint {
    /// Unique.
    pub name: String,
    /// Where it stands in the text, from 1.
    pub line: usize,
    /// How it moves.
    pub kind: JointKind,
    /// Index of the parent link.
    pub parent: usize,
    /// Index of the child link.
    pub child: usize,
    /// Pose of the joint at position 0.
    pub parent_from_joint: Isometry3<f64>,
    /// Turned about or slid along, in the joint's frame.
    pub axis: Unit<Vector3<f64>>,
    /// Where and how fast it may go.
    pub limits: Limits,
    /// What sets its position.
    pub drive: Drive,
}

/// How a joint moves.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum JointKind {
    /// Turns within limits.
    Revolute,
    /// Turns without end.
    Continuous,
    /// Slides within limits.
    Prismatic,
    /// Does not move.
    Fixed,
}

/// Bounds of a joint: radians or metres, per second, and newton metres or newton. Infinite where there is none.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Limits {
    /// Smallest position.
    pub lower: f64,
    /// Largest position.
    pub upper: f64,
    /// Largest speed.
    pub velocity: f64,
    /// Largest torque or force.
    pub effort: f64,
}

/// What sets a joint's position.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Drive {
    /// Nothing: it is fixed.
    Fixed,
    /// This entry of the configuration.
    Position(usize),
    /// multiplier · leader's position + offset.
    Mimic {
        /// Entry of the configuration.
        leader: usize,
        /// Factor.
        multiplier: f64,
        /// Added.
        offset: f64,
    },
}

impl Robot {
    /// Reads a URDF whose collision shapes are primitives; one with collision meshes is refused.
    ///
    /// # Errors
    /// The first thing wrong with it: see [`UrdfError`].
    pub fn from_urdf(text: &str) -> Result<Self, UrdfError> {
        let mut none = |_: &str| Err("no place to look for meshes was given".to_owned());
        Self::read(text, &mut none, &ReadOptions::default())
    }

    /// Reads a URDF. `find_mesh` returns the bytes behind the `filename` of a mesh, or why there are none; it is asked once
    /// for each name.
    ///
    /// # Errors
    /// The first thing wrong with it: see [`UrdfError`].
    pub fn read(
        text: &str,
        find_mesh: &mut dyn FnMut(&str) -> Result<Vec<u8>, String>,
        options: &ReadOptions,
    ) -> Result<Self, UrdfError> {
        let scan = scan::scan(text)?;
        let parsed = urdf_rs::read_from_string(text)
            .map_err(|error| UrdfError::Format { problem: scan::shorten(&error.to_string()) })?;
        check::build(&parsed, &scan, find_mesh, options)
    }

    /// Number of joints that can be driven: the length of a configuration.
    pub fn dof(&self) -> usize {
        self.driven.len()
    }

    /// The joint behind entry `i` of a configuration.
    pub fn driven_joint(&self, i: usize) -> &Joint {
        &self.joints[self.driven[i]]
    }

    /// Names of the joints that can be driven, in the order of a configuration.
    pub fn joint_names(&self) -> impl Iterator<Item = &str> {
        self.driven.iter().map(|&j| self.joints[j].name.as_str())
    }

    /// The position nearest 0 within the limits, for every joint.
    pub fn rest(&self) -> Vec<f64> {
        self.driven.iter().map(|&j| 0.0_f64.clamp(self.joints[j].limits.lower, self.joints[j].limits.upper)).collect()
    }

    /// Index of a link.
    pub fn link_index(&self, name: &str) -> Option<usize> {
        self.links.iter().position(|link| link.name == name)
    }

    /// The joint that holds a link; `None` for the root.
    pub fn holder(&self, link: usize) -> Option<&Joint> {
        link.checked_sub(1).map(|joint| &self.joints[joint])
    }

    /// Forward kinematics: `poses[l]` becomes root_from_link of every link. `q` has [`Robot::dof`] entries.
    pub fn link_poses(&self, q: &[f64], poses: &mut Vec<Isometry3<f64>>) {
        assert_eq!(q.len(), self.dof(), "one position per joint that can be driven");
        poses.clear();
        poses.push(Isometry3::identity());
        for joint in &self.joints {
            let pose = poses[joint.parent] * joint.parent_from_joint * joint.motion(joint.position(q));
            poses.push(pose);
        }
    }

    /// root_from_link when no driven joint lies between them.
    pub fn fixed_pose(&self, link: usize) -> Option<Isometry3<f64>> {
        let mut pose = Isometry3::identity();
        let mut at = link;
        while let Some(joint) = self.holder(at) {
            if joint.kind != JointKind::Fixed {
                return None;
            }
            pose = joint.parent_from_joint * pose;
            at = joint.parent;
        }
        Some(pose)
    }

    /// For every link, the first link of the rigid group it belongs to (links joined by fixed joints).
    pub fn rigid_groups(&self) -> Vec<usize> {
        let mut groups = vec![0];
        for joint in &self.joints {
            groups.push(if joint.kind == JointKind::Fixed { groups[joint.parent] } else { joint.child });
        }
        groups
    }

    /// Whether each position lies within its limits, to within 1e-9.
    pub fn within_limits(&self, q: &[f64]) -> bool {
        q.len() == self.dof()
            && self.driven.iter().zip(q).all(|(&j, &v)| {
                let limits = &self.joints[j].limits;
                v >= limits.lower - 1e-9 && v <= limits.upper + 1e-9
            })
    }
}

impl Joint {
    /// Its position in a configuration.
    pub fn position(&self, q: &[f64]) -> f64 {
        match self.drive {
            Drive::Fixed => 0.0,
            Drive::Position(i) => q[i],
            Drive::Mimic { leader, multiplier, offset } => multiplier * q[leader] + offset,
        }
    }

    /// How far a position moves the child from where it is at 0.
    pub fn motion(&self, position: f64) -> Isometry3<f64> {
        match self.kind {
            JointKind::Fixed => Isometry3::identity(),
            JointKind::Revolute | JointKind::Continuous => {
                Isometry3::from_parts(Translation3::identity(), rotation::about_axis(&self.axis, position))
            }
            JointKind::Prismatic => {
                Isometry3::from_parts(Translation3::from(self.axis.into_inner() * position), UnitQuaternion::identity())
            }
        }
    }
}
