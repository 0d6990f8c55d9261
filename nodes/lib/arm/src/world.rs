//! What is around the robot, and what it holds.

use crate::convex::{Convex, Posed, to_parry};
use crate::{Placed, Solid};
use nalgebra::Isometry3;
use parry3d_f64::bounding_volume::Aabb;
use parry3d_f64::math::{Pose, Vector};
use parry3d_f64::partitioning::Bvh;

/// A named solid that stands still.
#[derive(Debug, Clone, PartialEq)]
pub struct Obstacle {
    /// For messages, and to remove it by.
    pub name: String,
    /// What it is.
    pub solid: Solid,
    /// Pose of the solid's frame in the robot's root frame.
    pub root_from_solid: Isometry3<f64>,
}

/// Obstacles around a robot, and at most one thing in its hand. Copies are cheap next to a plan: meshes are shared.
#[derive(Debug, Clone, Default)]
pub struct World {
    obstacles: Vec<Obstacle>,
    /// The convex parts of all obstacles.
    parts: Vec<Standing>,
    /// Over the boxes around the parts.
    tree: Bvh,
    held: Option<Held>,
}

#[derive(Debug, Clone)]
pub(crate) struct Standing {
    pub obstacle: usize,
    solid: Convex,
    pose: Pose,
    middle: Vector,
}

impl Standing {
    pub fn posed(&self) -> Posed<'_> {
        Posed { solid: &self.solid, pose: self.pose, middle: self.middle }
    }

    /// Whether spheres and the solid itself leave it open that something is nearer than `limit`.
    pub fn may_be_within(&self, other: &Posed, limit: f64) -> bool {
        let at = self.pose.inverse_transform_point(other.middle);
        self.solid.distance_to_point(at) <= other.solid.radius + limit
    }
}

#[derive(Debug, Clone)]
pub(crate) struct Held {
    name: String,
    pub link: usize,
    /// Links that it may touch.
    touched: Vec<bool>,
    placed: Placed,
    pub parts: Vec<Convex>,
    pub link_from_parts: Pose,
    /// Obstacles that it may touch: what it stands on while it is lifted.
    allowed: Vec<String>,
}

impl Held {
    /// Distance from the holding link's origin within which all of it is, metres.
    pub fn extent(&self) -> f64 {
        let far = |solid: &Convex| self.link_from_parts.transform_point(solid.middle).length() + solid.radius;
        self.parts.iter().map(far).fold(0.0, f64::max)
    }

    pub fn may_touch_link(&self, link: usize) -> bool {
        self.touched.get(link).copied().unwrap_or(false)
    }

    pub fn may_touch(&self, obstacle: &str) -> bool {
        self.allowed.iter().any(|name| name == obstacle)
    }
}

impl World {
    /// Nothing around, nothing held.
    pub fn new() -> Self {
        Self::default()
    }

    /// Adds an obstacle.
    pub fn add(&mut self, obstacle: Obstacle) {
        let pose = to_parry(&obstacle.root_from_solid);
        let first = self.parts.len();
        for solid in Convex::parts(&obstacle.solid) {
            let middle = pose.transform_point(solid.middle);
            self.parts.push(Standing { obstacle: self.obstacles.len(), solid, pose, middle });
        }
        self.obstacles.push(obstacle);
        for (i, part) in self.parts.iter().enumerate().skip(first) {
            self.tree.insert(part.solid.bounds(&part.pose), i as u32);
        }
    }

    /// Takes away every obstacle of a name, and returns whether there was one.
    pub fn remove(&mut self, name: &str) -> bool {
        let kept: Vec<Obstacle> = self.obstacles.iter().filter(|obstacle| obstacle.name != name).cloned().collect();
        let had = kept.len() < self.obstacles.len();
        if had {
            self.obstacles.clear();
            self.parts.clear();
            self.tree = Bvh::new();
            kept.into_iter().for_each(|obstacle| self.add(obstacle));
        }
        had
    }

    /// Puts a thing into the hand: it moves with `link`, its pose in that link's frame is part of `placed`, and the links
    /// marked in `touched` (one entry per link of the robot) may touch it.
    pub fn hold(&mut self, name: &str, link: usize, placed: Placed, touched: Vec<bool>) {
        let parts = Convex::parts(&placed.solid);
        let link_from_parts = to_parry(&placed.owner_from_solid);
        self.held =
            Some(Held { name: name.into(), link, touched, placed, parts, link_from_parts, allowed: Vec::new() });
    }

    /// Lets what is held touch the obstacles of a name: what it stands on while it is lifted. Without effect on an empty
    /// hand, and forgotten when something else is held.
    pub fn let_held_touch(&mut self, name: &str) {
        if let Some(held) = &mut self.held {
            held.allowed.push(name.to_owned());
        }
    }

    /// Takes the thing out of the hand and leaves it as an obstacle where it is, the pose of the holding link being
    /// `root_from_link`. Nothing happens when the hand is empty.
    pub fn put_down(&mut self, root_from_link: &Isometry3<f64>) {
        if let Some(held) = self.held.take() {
            let root_from_solid = root_from_link * held.placed.owner_from_solid;
            self.add(Obstacle { name: held.name, solid: held.placed.solid, root_from_solid });
        }
    }

    /// Empties the hand; what was in it is gone.
    pub fn let_go(&mut self) {
        self.held = None;
    }

    /// The obstacles, in the order they were added.
    pub fn obstacles(&self) -> &[Obstacle] {
        &self.obstacles
    }

    /// Names of the obstacles, in the order they were added.
    pub fn obstacle_names(&self) -> impl Iterator<Item = &str> {
        self.obstacles.iter().map(|obstacle| obstacle.name.as_str())
    }

    /// Name of what is held.
    pub fn held_name(&self) -> Option<&str> {
        self.held.as_ref().map(|held| held.name.as_str())
    }

    pub(crate) fn held(&self) -> Option<&Held> {
        self.held.as_ref()
    }

    pub(crate) fn parts(&self) -> &[Standing] {
        &self.parts
    }

    /// Indices of the parts whose boxes are nearer to a solid's than `limit`, in no order that matters.
    pub(crate) fn near(&self, solid: &Posed, limit: f64) -> impl Iterator<Item = usize> {
        let query = bounds(solid, limit);
        self.tree
            .leaves(move |node| {
                let (low, high) = (node.mins(), node.maxs());
                query.mins.cmple(high).all() && low.cmple(query.maxs).all()
            })
            .map(|leaf| leaf as usize)
    }
}

/// The box around the sphere of a solid, and a margin.
fn bounds(solid: &Posed, margin: f64) -> Aabb {
    let half = Vector::splat(solid.solid.radius + margin);
    Aabb::new(solid.middle - half, solid.middle + half)
}
