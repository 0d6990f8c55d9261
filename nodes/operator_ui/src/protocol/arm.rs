//! The arm as a page draws it. Lengths in metres, in the table's frame; poses are x, y, z and a unit quaternion x, y, z, w.

use super::ObjectView;
use serde::Serialize;

/// What the arm looks like.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ArmView {
    /// Another arm has another one.
    pub key: String,
    /// The solids of every link.
    pub links: Vec<Vec<PartView>>,
}

/// A solid of a link.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct PartView {
    /// Its pose in the link's frame.
    pub at: [f64; 7],
    /// What it is.
    #[serde(flatten)]
    pub shape: PartShape,
}

/// What a part is.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum PartShape {
    /// Sides.
    Box([f64; 3]),
    /// Radius and length, along z.
    Cylinder([f64; 2]),
    /// Radius.
    Sphere(f64),
    /// Radius and length of the straight part, along z.
    Capsule([f64; 2]),
    /// Convex.
    Mesh {
        /// x, y, z of each corner.
        points: Vec<f64>,
        /// Three corners each, counter-clockwise from outside.
        triangles: Vec<u32>,
    },
}

/// How the arm would carry out the plan.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ArmMotionView {
    /// Of the plan.
    pub revision: u64,
    /// From the start, ascending, seconds.
    pub times_s: Vec<f64>,
    /// For each time the poses of all links.
    pub poses: Vec<Vec<f64>>,
    /// The way of the hand: x, y, z for each point.
    pub way: Vec<f64>,
    /// The target where it will stand.
    pub target: Option<ObjectView>,
    /// The height it will stand at.
    pub target_z_m: f64,
}
