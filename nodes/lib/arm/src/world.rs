//! What is around the robot, and what it holds.

use crate::solid::{ParryShape, to_parry, to_parry_pose};
use crate::{Placed, Solid};
use nalgebra::Isometry3;
use parry3d_f64::math::Pose;

/// A named solid that stands still.
#[derive(Debug, Clone, PartialEq)]
pub struct Obstacle {
    /// For messages.
    pub name: String,
    /// What it is.
    pub solid: Solid,
    /// Pose of the solid's frame in the robot's root frame.
    pub root_from_solid: Isometry3<f64>,
}

/// Obstacles around a robot, and at most one thing in its hand.
#[derive(Debug, Clone, Default)]
pub struct World {
    pub(crate) obstacles: Vec<Standing>,
    pub(crate) held: Option<Held>,
}

#[derive(Debug, Clone)]
pub(crate) struct Standing {
    pub name: String,
    pub solid: Solid,
    pub solid_from_root: Isometry3<f64>,
    pub centre: nalgebra::Vector3<f64>,
    pub radius: f64,
    pub shape: ParryShape,
    pub pose: Pose,
}

#[derive(Debug, Clone)]
pub(crate) struct Held {
    pub name: String,
    pub link: usize,
    pub touched: Vec<bool>,
    pub placed: Placed,
    pub radius: f64,
    pub shape: ParryShape,
    pub solid_from_shape: Pose,
}

impl World {
    /// Nothing around, nothing held.
    pub fn new() -> Self {
        Self::default()
    }

    /// Adds an obstacle.
    pub fn add(&mut self, obstacle: Obstacle) {
        let (shape, solid_from_shape) = to_parry(&obstacle.solid);
        self.obstacles.push(Standing {
            solid_from_root: obstacle.root_from_solid.inverse(),
            centre: obstacle.root_from_solid.translation.vector,
            radius: obstacle.solid.bounding_radius(),
            pose: to_parry_pose(&obstacle.root_from_solid) * solid_from_shape,
            name: obstacle.name,
            solid: obstacle.solid,
            shape,
        });
    }

    /// Puts a thing into the hand: it moves with `link`, its pose in that link's frame is part of `placed`, and the links
    /// marked in `touched` (one entry per link of the robot) may touch it.
    pub fn hold(&mut self, name: &str, link: usize, placed: Placed, touched: Vec<bool>) {
        let (shape, solid_from_shape) = to_parry(&placed.solid);
        let radius = placed.solid.bounding_radius();
        self.held = Some(Held { name: name.into(), link, touched, placed, radius, shape, solid_from_shape });
    }

    /// Names of the obstacles, in the order they were added.
    pub fn obstacle_names(&self) -> impl Iterator<Item = &str> {
        self.obstacles.iter().map(|obstacle| obstacle.name.as_str())
    }
}
