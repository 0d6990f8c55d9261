//! Messages of the standard package `shape_msgs`.
//!
//! Generated: do not edit. To write it anew: `cargo run --release -p apprentice_msgs --example generate`.

use serde::{Deserialize, Serialize};

/// The message `shape_msgs/msg/Mesh`.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct Mesh {
    /// (`MeshTriangle[]`)
    pub triangles: Vec<super::shape_msgs::MeshTriangle>,
    /// (`geometry_msgs/Point[]`)
    pub vertices: Vec<super::geometry_msgs::Point>,
}

impl crate::Message for Mesh {
    const TYPE: &'static str = "shape_msgs/msg/Mesh";
}

/// The message `shape_msgs/msg/MeshTriangle`.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct MeshTriangle {
    /// (`uint32[3]`)
    pub vertex_indices: [u32; 3],
}

impl crate::Message for MeshTriangle {
    const TYPE: &'static str = "shape_msgs/msg/MeshTriangle";
}

/// The message `shape_msgs/msg/Plane`.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub struct Plane {
    /// (`float64[4]`)
    pub coef: [f64; 4],
}

impl crate::Message for Plane {
    const TYPE: &'static str = "shape_msgs/msg/Plane";
}

/// The message `shape_msgs/msg/SolidPrimitive`.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct SolidPrimitive {
    /// (`uint8`)
    pub r#type: u8,
    /// (`float64[<=3]`)
    #[serde(deserialize_with = "crate::bounded::at_most::<_, _, 3>")]
    pub dimensions: Vec<f64>,
    /// (`geometry_msgs/Polygon`)
    pub polygon: super::geometry_msgs::Polygon,
}

impl SolidPrimitive {
    /// The constant `BOX`.
    pub const BOX: u8 = 1;
    /// The constant `SPHERE`.
    pub const SPHERE: u8 = 2;
    /// The constant `CYLINDER`.
    pub const CYLINDER: u8 = 3;
    /// The constant `CONE`.
    pub const CONE: u8 = 4;
    /// The constant `PRISM`.
    pub const PRISM: u8 = 5;
    /// The constant `BOX_X`.
    pub const BOX_X: u8 = 0;
    /// The constant `BOX_Y`.
    pub const BOX_Y: u8 = 1;
    /// The constant `BOX_Z`.
    pub const BOX_Z: u8 = 2;
    /// The constant `SPHERE_RADIUS`.
    pub const SPHERE_RADIUS: u8 = 0;
    /// The constant `CYLINDER_HEIGHT`.
    pub const CYLINDER_HEIGHT: u8 = 0;
    /// The constant `CYLINDER_RADIUS`.
    pub const CYLINDER_RADIUS: u8 = 1;
    /// The constant `CONE_HEIGHT`.
    pub const CONE_HEIGHT: u8 = 0;
    /// The constant `CONE_RADIUS`.
    pub const CONE_RADIUS: u8 = 1;
    /// The constant `PRISM_HEIGHT`.
    pub const PRISM_HEIGHT: u8 = 0;
}

impl crate::Message for SolidPrimitive {
    const TYPE: &'static str = "shape_msgs/msg/SolidPrimitive";
}
