//! A robot arm: read from a URDF with its collision meshes, its kinematics, and what it collides with.
//!
//! Everything here is a function of its arguments: text and bytes in, poses and answers out; no clock, files or global
//! generator, and the same bits for the same seed on any number of threads. Lengths are metres, angles radians. `a_from_b` maps
//! coordinates of frame b to frame a. This is the only crate that names parry; it speaks nalgebra to the outside.
//!
//! # From a text to answers
//! 1. [`Robot::read`] takes the text and a function that finds the bytes of meshes (`robot_files` has one for folders);
//!    [`Robot::from_urdf`] is for robots made of primitives. What is odd but usable is in [`Robot::problems`]. A configuration `q` has one
//!    entry per driven joint, in the order of [`Robot::joint_names`]; joints that mimic follow.
//! 2. [`Chain::new`] picks the joints that move a tool link. [`Chain::tool_pose`] and [`Chain::linearise`] (pose and Jacobian) cost
//!    about a microsecond; [`Robot::link_poses`] gives all links.
//! 3. [`solve`] finds a configuration for a [`Goal`], [`solutions`] several, [`approach_posture`] uses what freedom is left.
//! 4. [`Exclusions`] says which pairs of links not to test: from an SRDF, or derived by sampling. [`CollisionModel::new`] prepares the rest.
//! 5. [`World`] holds obstacles and what is in the hand: [`World::hold`], [`World::put_down`], [`World::let_held_touch`].
//! 6. [`Checker`] answers for one thread: `is_free`, `first_contact`, `contacts`, `nearest`, `clearance` for one configuration, `sweep` for a straight way
//!    in joint space. Clone one for each thread: robot and model are shared, the room to work in is not, and after the first
//!    calls nothing is allocated.
//!
//! # What is promised
//! - A link's mesh is tested as its convex hull, or several convex pieces if asked for: never smaller than the mesh, so contacts may be
//!   reported where the mesh has a hollow, and none is missed on its surface.
//! - A way that [`Checker::sweep`] calls free is free, however thin an obstacle is; within [`SweepSettings::resolution`] of touching it
//!   may call a free way blocked.
//! - Whatever a text or mesh holds, reading it ends in bounded time and memory with a robot or an error that names line and remedy.

mod chain;
mod check;
mod checker;
mod collision;
mod convex;
mod decompose;
mod error;
mod exclusions;
mod goal;
mod hull;
mod inverse;
mod jacobian;
mod joints;
mod levers;
mod mesh;
mod oddities;
mod problem;
mod read;
mod robot;
mod rotation;
mod scan;
mod solid;
mod srdf;
mod stand_in;
mod surface;
mod sweep;
mod world;

pub use chain::{Chain, ChainError, MAX_CHAIN_JOINTS};
pub use checker::Checker;
pub use collision::{Body, CollisionModel, Contact, Scratch, solid_distance};
pub use error::UrdfError;
pub use exclusions::{Exclusions, Survey, UnknownLink};
pub use goal::{AxisGoal, Goal};
pub use hull::Hull;
pub use inverse::{IkOutcome, IkSettings, approach_posture, solutions, solve};
pub use jacobian::{JacobianColumn, manipulability};
pub use joints::NamedPositions;
pub use mesh::{MAX_MESH_BYTES, MAX_TRIANGLES, MAX_VERTICES, Mesh, MeshError, MeshFormat};
pub use nalgebra::{Isometry3, Point3, Translation3, UnitQuaternion, Vector3};
pub use problem::Problem;
pub use read::{MeshDetail, MeshUse, MissingMesh, ReadOptions};
pub use robot::{Drive, Joint, JointKind, Limits, Link, Placed, Robot};
pub use rotation::{about_axis, about_z, from_rpy};
pub use scan::{MAX_BYTES, MAX_DEPTH, MAX_ELEMENTS, MAX_LINKS, MAX_SOLIDS};
pub use solid::Solid;
pub use srdf::SrdfError;
pub use sweep::{Sweep, SweepSettings};
pub use world::{Obstacle, World};
