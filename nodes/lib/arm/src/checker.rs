//! A robot with everything a planner asks of it, one for each thread.

use crate::collision::{Body, CollisionModel, Contact, Scratch};
use crate::sweep::{Sweep, SweepScratch, SweepSettings, Way};
use crate::{Robot, World};
use nalgebra::Isometry3;
use std::sync::Arc;

/// Answers questions about configurations. Copies share the robot and its model, and nothing is allocated after the first
/// few calls.
#[derive(Debug, Clone)]
pub struct Checker {
    robot: Arc<Robot>,
    model: Arc<CollisionModel>,
    poses: Vec<Isometry3<f64>>,
    scratch: Scratch,
    room: SweepScratch,
}

/// What is nowhere is not free.
const NOWHERE: Contact = Contact { a: Body::Link(0), b: Body::Link(0) };

fn is_finite(q: &[f64]) -> bool {
    q.iter().all(|v| v.is_finite())
}

impl Checker {
    /// A checker of a robot with its model.
    pub fn new(robot: Arc<Robot>, model: Arc<CollisionModel>) -> Self {
        let (poses, scratch, room) = (Vec::new(), Scratch::default(), SweepScratch::default());
        Self { robot, model, poses, scratch, room }
    }

    /// The robot.
    pub fn robot(&self) -> &Robot {
        &self.robot
    }

    /// Its solids and pairs.
    pub fn model(&self) -> &CollisionModel {
        &self.model
    }

    /// root_from_link of every link.
    pub fn poses(&mut self, q: &[f64]) -> &[Isometry3<f64>] {
        self.robot.link_poses(q, &mut self.poses);
        &self.poses
    }

    /// Whether nothing is nearer than `margin`: see [`CollisionModel::first_contact`].
    pub fn is_free(&mut self, q: &[f64], world: &World, margin: f64) -> bool {
        self.first_contact(q, world, margin).is_none()
    }

    /// See [`CollisionModel::first_contact`]. A configuration that is not finite is never free: its root counts as touching
    /// itself.
    pub fn first_contact(&mut self, q: &[f64], world: &World, margin: f64) -> Option<Contact> {
        if !is_finite(q) {
            return Some(NOWHERE);
        }
        self.robot.link_poses(q, &mut self.poses);
        self.model.first_contact(&self.poses, world, margin, &mut self.scratch)
    }

    /// See [`CollisionModel::contacts`].
    pub fn contacts(&mut self, q: &[f64], world: &World, margin: f64) -> Vec<Contact> {
        if !is_finite(q) {
            return vec![NOWHERE];
        }
        self.robot.link_poses(q, &mut self.poses);
        self.model.contacts(&self.poses, world, margin, &mut self.scratch)
    }

    /// See [`CollisionModel::nearest`].
    pub fn nearest(&mut self, q: &[f64], world: &World, limit: f64) -> Option<(Contact, f64)> {
        if !is_finite(q) {
            return Some((NOWHERE, 0.0));
        }
        self.robot.link_poses(q, &mut self.poses);
        self.model.nearest(&self.poses, world, limit, &mut self.scratch)
    }

    /// The smallest distance between any two things that are tested, metres: 0 when they touch, infinite when nothing is
    /// tested.
    pub fn clearance(&mut self, q: &[f64], world: &World) -> f64 {
        // No robot and table are farther apart than this.
        self.nearest(q, world, 1e6).map_or(f64::INFINITY, |(_, distance)| distance)
    }

    /// The straight way in joint space from one configuration to another.
    pub fn sweep(&mut self, from: &[f64], to: &[f64], world: &World, settings: &SweepSettings) -> Sweep {
        if !is_finite(from) || !is_finite(to) {
            return Sweep::Blocked { share: 0.0, contact: NOWHERE };
        }
        let way = Way { robot: &self.robot, model: &self.model, world, settings };
        way.sweep(from, to, &mut self.poses, &mut self.scratch, &mut self.room)
    }

    /// Whether that way is free.
    pub fn way_is_free(&mut self, from: &[f64], to: &[f64], world: &World, settings: &SweepSettings) -> bool {
        self.sweep(from, to, world, settings) == Sweep::Free
    }
}
