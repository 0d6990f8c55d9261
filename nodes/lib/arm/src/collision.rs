//! Whether a robot in a given configuration touches itself, its surroundings, or touches them with what it holds.

use crate::convex::{Convex, Posed, to_parry};
use crate::levers::Levers;
use crate::world::{Held, World};
use crate::{Exclusions, Robot, Solid, solid};
use nalgebra::{Isometry3, Vector3};
use parry3d_f64::math::{Pose, Vector};
use std::collections::BTreeSet;
use std::ops::{ControlFlow, Range};

/// The solids of a robot and the pairs of its links that could meet. It does not change: share it between threads.
#[derive(Debug, Clone)]
pub struct CollisionModel {
    /// In the order of the links.
    parts: Vec<Part>,
    /// Which parts are those of a link.
    of_link: Vec<Range<usize>>,
    spheres: Vec<Sphere>,
    pub(crate) pairs: Vec<LinkPair>,
    /// Links that never move: obstacles may touch them (an arm stands on its table).
    pub(crate) still: Vec<bool>,
    pub(crate) levers: Levers,
}

#[derive(Debug, Clone)]
struct Part {
    link: usize,
    solid: Convex,
    link_from_solid: Pose,
}

/// Around all solids of a link, in its frame; radius below 0 when there are none.
#[derive(Debug, Clone, Copy)]
struct Sphere {
    middle: Vector,
    radius: f64,
}

/// Two links that can move against each other and are not excluded; both have solids.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct LinkPair {
    pub a: usize,
    pub b: usize,
    /// Moving joints that carry both.
    pub n_shared: usize,
}

/// Something that can touch or be touched.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Body {
    /// A link, by index.
    Link(usize),
    /// What is held.
    Held,
    /// An obstacle, by its place in [`World::obstacles`].
    Obstacle(usize),
}

impl Body {
    /// Its name.
    pub fn name<'a>(self, robot: &'a Robot, world: &'a World) -> &'a str {
        match self {
            Self::Link(link) => &robot.links[link].name,
            Self::Held => world.held_name().unwrap_or("nothing"),
            Self::Obstacle(obstacle) => &world.obstacles()[obstacle].name,
        }
    }
}

/// Two things nearer than they may be.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub struct Contact {
    /// A link, or what is held.
    pub a: Body,
    /// Another link, or an obstacle.
    pub b: Body,
}

/// Room to work in, one for each thread: after the first call nothing is allocated.
#[derive(Debug, Clone, Default)]
pub struct Scratch {
    /// Of every part: its pose and the middle of its sphere.
    parts: Vec<(Pose, Vector)>,
    /// Middles of the links' spheres.
    links: Vec<Vector>,
}

impl CollisionModel {
    /// Collects the solids of a robot. Links of one rigid group, excluded pairs, and neighbours across a joint that are not
    /// enabled are not tested.
    pub fn new(robot: &Robot, exclusions: &Exclusions) -> Self {
        let mut parts = Vec::new();
        let mut of_link = Vec::new();
        let mut spheres = Vec::new();
        for (link, owner) in robot.links.iter().enumerate() {
            let first = parts.len();
            for placed in &owner.solids {
                let link_from_solid = to_parry(&placed.owner_from_solid);
                let solids = Convex::parts(&placed.solid).into_iter();
                parts.extend(solids.map(|solid| Part { link, solid, link_from_solid }));
            }
            of_link.push(first..parts.len());
            spheres.push(sphere(&parts[first..]));
        }
        let groups = robot.rigid_groups();
        let across: BTreeSet<(usize, usize)> =
            robot.joints.iter().map(|joint| (groups[joint.parent], groups[joint.child])).collect();
        let neighbours =
            |a: usize, b: usize| across.contains(&(groups[a], groups[b])) || across.contains(&(groups[b], groups[a]));
        let levers = Levers::new(robot);
        let mut pairs = Vec::new();
        let solid: Vec<usize> = (0..robot.links.len()).filter(|&link| !of_link[link].is_empty()).collect();
        for (i, &a) in solid.iter().enumerate() {
            for &b in &solid[i + 1..] {
                let tested = !neighbours(a, b) || exclusions.is_enabled(a, b);
                if groups[a] != groups[b] && tested && !exclusions.contains(a, b) {
                    pairs.push(LinkPair { a, b, n_shared: levers.n_shared(a, b) });
                }
            }
        }
        let still = groups.iter().map(|&group| group == 0).collect();
        Self { parts, of_link, spheres, pairs, still, levers }
    }

    /// Number of pairs of links that are tested.
    pub fn n_pairs(&self) -> usize {
        self.pairs.len()
    }

    /// Number of convex parts of all links.
    pub fn n_parts(&self) -> usize {
        self.parts.len()
    }

    /// The pairs of links that are tested, by index, smaller first.
    pub fn link_pairs(&self) -> impl Iterator<Item = (usize, usize)> {
        self.pairs.iter().map(|pair| (pair.a, pair.b))
    }

    /// The first two things found that are nearer than `margin` metres (0: that touch), or `None`. The robot's own links,
    /// built close together as fingers are, count when they touch. `poses` are those of [`Robot::link_poses`]. Looked for in this
    /// order: the robot with itself, with obstacles, then what it holds.
    pub fn first_contact(
        &self,
        poses: &[Isometry3<f64>],
        world: &World,
        margin: f64,
        scratch: &mut Scratch,
    ) -> Option<Contact> {
        self.place(poses, scratch);
        let mut found = None;
        let _ = self.visit(poses, world, scratch, (0.0, margin), &mut |contact, a, b, limit| {
            if a.is_within(b, limit) {
                found = Some(contact);
                return ControlFlow::Break(());
            }
            ControlFlow::Continue(())
        });
        found
    }

    /// Every two things that are nearer than they may be, as in [`CollisionModel::first_contact`], sorted.
    pub fn contacts(
        &self,
        poses: &[Isometry3<f64>],
        world: &World,
        margin: f64,
        scratch: &mut Scratch,
    ) -> Vec<Contact> {
        self.place(poses, scratch);
        let mut found = BTreeSet::new();
        let _ = self.visit(poses, world, scratch, (0.0, margin), &mut |contact, a, b, limit| {
            if !found.contains(&contact) && a.is_within(b, limit) {
                found.insert(contact);
            }
            ControlFlow::Continue(())
        });
        found.into_iter().collect()
    }

    /// The two tested things nearest to each other and their distance, metres, 0 when they touch; `None` when nothing is
    /// nearer than `limit`.
    pub fn nearest(
        &self,
        poses: &[Isometry3<f64>],
        world: &World,
        limit: f64,
        scratch: &mut Scratch,
    ) -> Option<(Contact, f64)> {
        self.place(poses, scratch);
        let mut best = None;
        let mut least = limit;
        let _ = self.visit(poses, world, scratch, (limit, limit), &mut |contact, a, b, _| {
            if let Some(distance) = a.distance_within(b, least)
                && (distance < least || best.is_none())
            {
                least = distance;
                best = Some((contact, distance));
            }
            if least > 0.0 { ControlFlow::Continue(()) } else { ControlFlow::Break(()) }
        });
        best
    }

    /// Adds one to the pairs of links that touch, the pairs being those of [`CollisionModel::link_pairs`] in order.
    pub(crate) fn count_touches(
        &self,
        poses: &[Isometry3<f64>],
        scratch: &mut Scratch,
        touches: &mut [((usize, usize), usize)],
    ) {
        self.place(poses, scratch);
        for (pair, (_, n)) in self.pairs.iter().zip(touches) {
            *n += usize::from(self.links_within(pair, scratch, 0.0));
        }
    }

    /// Puts all parts where the links are.
    pub(crate) fn place(&self, poses: &[Isometry3<f64>], scratch: &mut Scratch) {
        scratch.parts.clear();
        scratch.links.clear();
        for ((pose, sphere), range) in poses.iter().zip(&self.spheres).zip(&self.of_link) {
            let root_from_link = to_parry(pose);
            scratch.links.push(root_from_link.transform_point(sphere.middle));
            for part in &self.parts[range.clone()] {
                let pose = root_from_link * part.link_from_solid;
                scratch.parts.push((pose, pose.transform_point(part.solid.middle)));
            }
        }
    }

    fn posed<'a>(&'a self, part: usize, scratch: &Scratch) -> Posed<'a> {
        let (pose, middle) = scratch.parts[part];
        Posed { solid: &self.parts[part].solid, pose, middle }
    }

    /// The parts of a link, placed.
    pub(crate) fn parts_of<'a>(&'a self, link: usize, scratch: &'a Scratch) -> impl Iterator<Item = Posed<'a>> {
        self.of_link[link].clone().map(|part| self.posed(part, scratch))
    }

    /// Distance from a link's origin within which all of it is.
    pub(crate) fn extent(&self, link: usize) -> f64 {
        self.spheres[link].middle.length() + self.spheres[link].radius.max(0.0)
    }

    pub(crate) fn has_solids(&self, link: usize) -> bool {
        !self.of_link[link].is_empty()
    }

    /// Whether the spheres of two links leave it open that they are nearer than `limit`.
    fn links_may_be_within(&self, pair: &LinkPair, scratch: &Scratch, limit: f64) -> bool {
        let far = self.spheres[pair.a].radius + self.spheres[pair.b].radius + limit;
        (scratch.links[pair.a] - scratch.links[pair.b]).length_squared() <= far * far
    }

    /// Whether two links are nearer than a limit.
    pub(crate) fn links_within(&self, pair: &LinkPair, scratch: &Scratch, limit: f64) -> bool {
        self.links_may_be_within(pair, scratch, limit)
            && self.parts_of(pair.a, scratch).any(|a| self.parts_of(pair.b, scratch).any(|b| a.is_within(&b, limit)))
    }

    /// Calls `visit` with every two convex parts that may be nearer than a limit (the robot's own, all others), with the
    /// limit that goes for them, until it breaks.
    fn visit(
        &self,
        poses: &[Isometry3<f64>],
        world: &World,
        scratch: &Scratch,
        (own, margin): (f64, f64),
        visit: &mut impl FnMut(Contact, &Posed, &Posed, f64) -> ControlFlow<()>,
    ) -> ControlFlow<()> {
        for pair in self.pairs.iter().filter(|pair| self.links_may_be_within(pair, scratch, own)) {
            let contact = Contact { a: Body::Link(pair.a), b: Body::Link(pair.b) };
            for a in self.parts_of(pair.a, scratch) {
                for b in self.parts_of(pair.b, scratch).filter(|b| a.may_be_within(b, own)) {
                    visit(contact, &a, &b, own)?;
                }
            }
        }
        for (i, part) in self.parts.iter().enumerate().filter(|(_, part)| !self.still[part.link]) {
            let posed = self.posed(i, scratch);
            for near in world.near(&posed, margin) {
                let standing = &world.parts()[near];
                if standing.may_be_within(&posed, margin) {
                    let contact = Contact { a: Body::Link(part.link), b: Body::Obstacle(standing.obstacle) };
                    visit(contact, &posed, &standing.posed(), margin)?;
                }
            }
        }
        let Some(held) = world.held() else { return ControlFlow::Continue(()) };
        for solid in &held.parts {
            let thing = pose_held(held, solid, poses);
            for (i, part) in self.parts.iter().enumerate().filter(|(_, part)| !held.may_touch_link(part.link)) {
                let posed = self.posed(i, scratch);
                if thing.may_be_within(&posed, margin) {
                    visit(Contact { a: Body::Held, b: Body::Link(part.link) }, &thing, &posed, margin)?;
                }
            }
            for near in world.near(&thing, margin) {
                let standing = &world.parts()[near];
                if standing.may_be_within(&thing, margin) && !held.may_touch(&world.obstacles()[standing.obstacle].name)
                {
                    let contact = Contact { a: Body::Held, b: Body::Obstacle(standing.obstacle) };
                    visit(contact, &thing, &standing.posed(), margin)?;
                }
            }
        }
        ControlFlow::Continue(())
    }
}

fn sphere(parts: &[Part]) -> Sphere {
    let middles = parts.iter().map(|part| {
        let at = part.link_from_solid.transform_point(part.solid.middle);
        Vector3::new(at.x, at.y, at.z)
    });
    let nothing = Sphere { middle: Vector::ZERO, radius: -1.0 };
    if parts.is_empty() {
        return nothing;
    }
    let (middle, _) = solid::sphere_around(middles);
    let middle = Vector::new(middle.x, middle.y, middle.z);
    let far =
        |part: &Part| (part.link_from_solid.transform_point(part.solid.middle) - middle).length() + part.solid.radius;
    Sphere { middle, radius: (1.0 + 1e-12) * parts.iter().map(far).fold(0.0, f64::max) }
}

/// A part of what is held, where the holding link is.
pub(crate) fn pose_held<'a>(held: &Held, solid: &'a Convex, poses: &[Isometry3<f64>]) -> Posed<'a> {
    Posed::new(solid, to_parry(&poses[held.link]) * held.link_from_parts)
}

/// Distance between two solids in one frame, metres; 0 when they touch or overlap.
pub fn solid_distance(a: &Solid, frame_from_a: &Isometry3<f64>, b: &Solid, frame_from_b: &Isometry3<f64>) -> f64 {
    let (pose_a, pose_b) = (to_parry(frame_from_a), to_parry(frame_from_b));
    let mut least = f64::INFINITY;
    for a in Convex::parts(a) {
        for b in Convex::parts(b) {
            let found = Posed::new(&a, pose_a).distance_within(&Posed::new(&b, pose_b), f64::MAX);
            least = least.min(found.unwrap_or(f64::INFINITY));
        }
    }
    least
}
