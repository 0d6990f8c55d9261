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
    /// When the target comes into the hand, and when it leaves it, seconds.
    pub held_s: [f64; 2],
    /// Where the target stands before that; none: it is in the hand.
    pub pick: Option<[f64; 7]>,
    /// The target where it will stand.
    pub target: Option<ObjectView>,
    /// The height it will stand at.
    pub target_z_m: f64,
}

/// What the arm is doing about a plan, or how that came out.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct CarryingView {
    /// Of the plan.
    pub revision: u64,
    /// "approaching", "grasping", "moving", "releasing" or "retreating".
    pub stage: &'static str,
    /// Of the whole, 0 to 1.
    pub progress: f64,
    /// Whether it is over.
    pub over: bool,
    /// Whether the target stands where it should.
    pub done: bool,
    /// Once it is over: why it ended.
    pub reason: String,
}
