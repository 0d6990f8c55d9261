//! Whether a robot in a given configuration touches itself, its surroundings, or touches them with what it holds.

use crate::solid::{ParryShape, to_parry, to_parry_pose};
use crate::world::{Held, Standing, World};
use crate::{Exclusions, Robot, Solid};
use nalgebra::{Isometry3, Vector3};
use parry3d_f64::math::Pose;
use parry3d_f64::query::{ClosestPoints, closest_points, distance, intersection_test};
use std::collections::BTreeSet;

/// The solids of a robot and the pairs of them that could meet.
#[derive(Debug, Clone)]
pub struct CollisionModel {
    parts: Vec<Part>,
    /// Parts of links that can move against each other and are not excluded.
    pairs: Vec<(usize, usize)>,
    /// Links that never move: obstacles may touch them (an arm stands on its table).
    still: Vec<bool>,
}

#[derive(Debug, Clone)]
struct Part {
    link: usize,
    shape: ParryShape,
    link_from_solid: Isometry3<f64>,
    solid_from_shape: Pose,
    radius: f64,
}

/// Two things nearer than they may be.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Contact<'a> {
    /// A link, or what is held.
    pub a: &'a str,
    /// Another link, or an obstacle.
    pub b: &'a str,
}

/// One thing to test, placed in the root frame.
struct Posed<'a> {
    shape: &'a ParryShape,
    pose: Pose,
    centre: Vector3<f64>,
    radius: f64,
}

impl CollisionModel {
    /// Collects the solids of a robot. Links of one rigid group, neighbours across a joint and excluded pairs are not tested.
    pub fn new(robot: &Robot, exclusions: &Exclusions) -> Self {
        let mut parts = Vec::new();
        for (link, owner) in robot.links.iter().enumerate() {
            for placed in &owner.solids {
                let (shape, solid_from_shape) = to_parry(&placed.solid);
                let radius = placed.solid.bounding_radius();
                parts.push(Part { link, shape, link_from_solid: placed.owner_from_solid, solid_from_shape, radius });
            }
        }
        let groups = robot.rigid_groups();
        let across: BTreeSet<(usize, usize)> =
            robot.joints.iter().map(|joint| (groups[joint.parent], groups[joint.child])).collect();
        let neighbours =
            |a: usize, b: usize| across.contains(&(groups[a], groups[b])) || across.contains(&(groups[b], groups[a]));
        let mut pairs = Vec::new();
        for i in 0..parts.len() {
            for j in i + 1..parts.len() {
                let (a, b) = (parts[i].link, parts[j].link);
                if groups[a] != groups[b] && !neighbours(a, b) && !exclusions.contains(a, b) {
                    pairs.push((i, j));
                }
            }
        }
        let still = groups.iter().map(|&group| group == 0).collect();
        Self { parts, pairs, still }
    }

    /// Number of pairs of the robot's own solids that are tested.
    pub fn n_pairs(&self) -> usize {
        self.pairs.len()
    }

    /// The first two things nearer than `margin` metres (0: that touch), or `None`. The robot's own links, built close
    /// together as fingers are, count when they touch. `poses` are those of [`Robot::link_poses`]. The order is fixed: the robot with itself, with obstacles, then what it holds.
    pub fn first_contact<'a>(
        &self,
        robot: &'a Robot,
        poses: &[Isometry3<f64>],
        world: &'a World,
        margin: f64,
    ) -> Option<Contact<'a>> {
        let posed = self.pose_parts(poses);
        let name = |part: usize| robot.links[self.parts[part].link].name.as_str();
        if let Some(&(i, j)) = self.pairs.iter().find(|&&(i, j)| meet(&posed[i], &posed[j], 0.0)) {
            return Some(Contact { a: name(i), b: name(j) });
        }
        for (i, part) in posed.iter().enumerate().filter(|(i, _)| !self.still[self.parts[*i].link]) {
            if let Some(obstacle) = world.obstacles.iter().find(|obstacle| meet_obstacle(part, obstacle, margin)) {
                return Some(Contact { a: name(i), b: &obstacle.name });
            }
        }
        let held = world.held.as_ref()?;
        let thing = pose_held(held, poses);
        let touched = |i: usize| held.touched.get(self.parts[i].link).copied().unwrap_or(false);
        if let Some(i) = (0..posed.len()).find(|&i| !touched(i) && meet(&thing, &posed[i], margin)) {
            return Some(Contact { a: &held.name, b: name(i) });
        }
        let obstacle = world.obstacles.iter().find(|obstacle| meet_obstacle(&thing, obstacle, margin))?;
        Some(Contact { a: &held.name, b: &obstacle.name })
    }

    /// The smallest distance between any two things that are tested, metres; 0 when they touch, infinite when nothing is
    /// tested.
    pub fn clearance(&self, poses: &[Isometry3<f64>], world: &World) -> f64 {
        let posed = self.pose_parts(poses);
        let mut least = f64::INFINITY;
        for &(i, j) in &self.pairs {
            least = least.min(gap(&posed[i], &posed[j]));
        }
        for (i, part) in posed.iter().enumerate().filter(|(i, _)| !self.still[self.parts[*i].link]) {
            debug_assert!(i < self.parts.len());
            for obstacle in &world.obstacles {
                least = least.min(gap(part, &pose_obstacle(obstacle)));
            }
        }
        if let Some(held) = &world.held {
            let thing = pose_held(held, poses);
            for (i, part) in posed.iter().enumerate() {
                if !held.touched.get(self.parts[i].link).copied().unwrap_or(false) {
                    least = least.min(gap(&thing, part));
                }
            }
            for obstacle in &world.obstacles {
                least = least.min(gap(&thing, &pose_obstacle(obstacle)));
            }
        }
        least
    }

    /// Whether nothing is nearer than `margin`: [`CollisionModel::first_contact`] without the names.
    pub fn is_free(&self, robot: &Robot, poses: &[Isometry3<f64>], world: &World, margin: f64) -> bool {
        self.first_contact(robot, poses, world, margin).is_none()
    }

    /// The tested pairs of links that touch, smaller index first; only those in `among`, when given.
    pub(crate) fn touching_links(
        &self,
        poses: &[Isometry3<f64>],
        among: Option<&BTreeSet<(usize, usize)>>,
    ) -> BTreeSet<(usize, usize)> {
        let posed = self.pose_parts(poses);
        let links = |&(i, j): &(usize, usize)| (self.parts[i].link, self.parts[j].link);
        let asked = self.pairs.iter().filter(|pair| among.is_none_or(|among| among.contains(&links(pair))));
        asked.filter(|&&(i, j)| meet(&posed[i], &posed[j], 0.0)).map(links).collect()
    }

    fn pose_parts(&self, poses: &[Isometry3<f64>]) -> Vec<Posed<'_>> {
        self.parts
            .iter()
            .map(|part| {
                let root_from_solid = poses[part.link] * part.link_from_solid;
                Posed {
                    shape: &part.shape,
                    pose: to_parry_pose(&root_from_solid) * part.solid_from_shape,
                    centre: root_from_solid.translation.vector,
                    radius: part.radius,
                }
            })
            .collect()
    }
}

fn pose_held<'a>(held: &'a Held, poses: &[Isometry3<f64>]) -> Posed<'a> {
    let root_from_solid = poses[held.link] * held.placed.owner_from_solid;
    Posed {
        shape: &held.shape,
        pose: to_parry_pose(&root_from_solid) * held.solid_from_shape,
        centre: root_from_solid.translation.vector,
        radius: held.radius,
    }
}

fn pose_obstacle(obstacle: &Standing) -> Posed<'_> {
    Posed { shape: &obstacle.shape, pose: obstacle.pose, centre: obstacle.centre, radius: obstacle.radius }
}

/// Whether two things are nearer than a margin; bounding spheres first.
fn meet(a: &Posed, b: &Posed, margin: f64) -> bool {
    let far = a.radius + b.radius + margin;
    if (a.centre - b.centre).norm_squared() > far * far {
        return false;
    }
    let (shape_a, shape_b) = (a.shape.as_shape(), b.shape.as_shape());
    if margin > 0.0 {
        let found = closest_points(&a.pose, shape_a, &b.pose, shape_b, margin);
        !matches!(found.expect("parry supports every pair of these shapes"), ClosestPoints::Disjoint)
    } else {
        intersection_test(&a.pose, shape_a, &b.pose, shape_b)
            .expect("parry supports every pair of these shapes")
            .intersecting
    }
}

fn meet_obstacle(part: &Posed, obstacle: &Standing, margin: f64) -> bool {
    let centre = obstacle.solid_from_root * nalgebra::Point3::from(part.centre);
    obstacle.solid.distance_to_point(&centre.coords) <= part.radius + margin
        && meet(part, &pose_obstacle(obstacle), margin)
}

fn gap(a: &Posed, b: &Posed) -> f64 {
    distance(&a.pose, a.shape.as_shape(), &b.pose, b.shape.as_shape())
        .expect("parry supports every pair of these shapes")
        .distance
        .max(0.0)
}

/// Distance between two solids in one frame, metres; 0 when they touch or overlap.
pub fn solid_distance(a: &Solid, frame_from_a: &Isometry3<f64>, b: &Solid, frame_from_b: &Isometry3<f64>) -> f64 {
    let ((shape_a, solid_from_a), (shape_b, solid_from_b)) = (to_parry(a), to_parry(b));
    let (pose_a, pose_b) = (to_parry_pose(frame_from_a) * solid_from_a, to_parry_pose(frame_from_b) * solid_from_b);
    distance(&pose_a, shape_a.as_shape(), &pose_b, shape_b.as_shape())
        .expect("parry supports every pair of these shapes")
        .distance
        .max(0.0)
}
