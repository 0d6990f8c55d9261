//! A robot arm: read from a URDF, its kinematics, and what it collides with.
//!
//! Everything here is a function of its arguments: text in, poses and answers out; no clock, files or global generator.
//! Lengths are metres, angles radians. `a_from_b` maps coordinates of frame b to frame a.
//! This is the only crate that names parry; it speaks nalgebra to the outside.

mod chain;
mod check;
mod collision;
mod error;
mod exclusions;
mod inverse;
mod jacobian;
mod robot;
mod rotation;
mod scan;
mod solid;
mod world;

pub use chain::{Chain, ChainError, MAX_CHAIN_JOINTS};
pub use collision::{CollisionModel, Contact, solid_distance};
pub use error::UrdfError;
pub use exclusions::{ExclusionError, Exclusions};
pub use inverse::{AxisGoal, IkOutcome, IkSettings, solve};
pub use jacobian::{JacobianColumn, jacobian};
pub use nalgebra::{Isometry3, Point3, Translation3, UnitQuaternion, Vector3};
pub use robot::{Drive, Joint, JointKind, Limits, Link, Placed, Robot};
pub use rotation::{about_axis, about_z, from_rpy};
pub use scan::{MAX_BYTES, MAX_DEPTH, MAX_ELEMENTS, MAX_LINKS, MAX_SOLIDS};
pub use solid::Solid;
pub use world::{Obstacle, World};
