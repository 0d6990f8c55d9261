//! A thing that stands on the table or is to be placed there.

use crate::Point;
use serde::{Deserialize, Serialize};

/// The solid that stands for an object in geometry.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Shape {
    /// Upright cylinder.
    Cylinder {
        /// Radius, metres.
        radius_m: f64,
        /// Height, metres.
        height_m: f64,
    },
    /// Upright box.
    Box {
        /// Extent along the object's own x, metres.
        width_m: f64,
        /// Extent along the object's own y, metres.
        depth_m: f64,
        /// Height, metres.
        height_m: f64,
    },
}

impl Shape {
    /// Height above the table, metres.
    pub fn height_m(&self) -> f64 {
        match *self {
            Self::Cylinder { height_m, .. } | Self::Box { height_m, .. } => height_m,
        }
    }

    /// Radius of the smallest circle about the centre that holds the footprint, metres.
    pub fn bounding_radius_m(&self) -> f64 {
        match *self {
            Self::Cylinder { radius_m, .. } => radius_m,
            Self::Box { width_m, depth_m, .. } => 0.5 * (width_m * width_m + depth_m * depth_m).sqrt(),
        }
    }

    /// The extents, metres; the check of a scene wants each of them positive and finite.
    pub fn extents_m(&self) -> [f64; 3] {
        match *self {
            Self::Cylinder { radius_m, height_m } => [2.0 * radius_m, 2.0 * radius_m, height_m],
            Self::Box { width_m, depth_m, height_m } => [width_m, depth_m, height_m],
        }
    }
}

/// One thing: on the table, or the target that is to be placed.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Object {
    /// Unique within a scene.
    pub id: String,
    /// What people call it.
    pub label: String,
    /// The solid that stands for it.
    pub shape: Shape,
    /// Centre of its footprint, metres in the table's frame.
    pub position_m: Point,
    /// Rotation about the vertical, radians.
    pub yaw_rad: f64,
    /// Other things may stand on it (a bowl for a spoon).
    pub supports: bool,
}

impl Object {
    /// Distance from a point to the footprint, metres; zero inside.
    pub fn distance_m(&self, at_m: Point) -> f64 {
        match self.shape {
            Shape::Cylinder { radius_m, .. } => (self.position_m.distance(at_m) - radius_m).max(0.0),
            Shape::Box { width_m, depth_m, .. } => {
                let (sin, cos) = libm::sincos(self.yaw_rad);
                let (dx, dy) = (at_m.x - self.position_m.x, at_m.y - self.position_m.y);
                let own = Point::new(cos * dx + sin * dy, cos * dy - sin * dx);
                let outside =
                    Point::new((own.x.abs() - 0.5 * width_m).max(0.0), (own.y.abs() - 0.5 * depth_m).max(0.0));
                outside.distance(Point::default())
            }
        }
    }
}
