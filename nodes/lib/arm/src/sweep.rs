//! Whether a robot can go straight from one configuration to another without coming too near to anything on the way.
//!
//! An interval of the way is proven free for two things when in its middle they are farther apart than both can move until its
//! ends. What is not proven is halved, breadth first, so that most collisions are found early. Nothing is stepped over:
//! a way that counts as free is free.

use crate::collision::{Body, CollisionModel, Contact, LinkPair, Scratch, pose_held};
use crate::convex::Posed;
use crate::{Robot, World};
use nalgebra::Isometry3;

/// What counts as near.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SweepSettings {
    /// Obstacles, and what is held, count as touched when nearer than this, metres; the robot's own links when they touch.
    pub margin: f64,
    /// What comes this near to that without being seen to reach it may count as touching too, metres; above 0.
    pub resolution: f64,
}

impl Default for SweepSettings {
    fn default() -> Self {
        Self { margin: 0.0, resolution: 2e-4 }
    }
}

/// How a way between two configurations is.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Sweep {
    /// Proven: nothing comes nearer than the margin.
    Free,
    /// Two things touch, or come nearer than margin and resolution together.
    Blocked {
        /// Where, as a share of the way.
        share: f64,
        /// What.
        contact: Contact,
    },
}

/// Intervals looked at before a way counts as blocked: it would graze something for its whole length.
const MOST_INTERVALS: usize = 20_000;

/// Two things that could meet.
#[derive(Debug, Clone, Copy)]
struct Item {
    what: What,
    /// How far they move against each other over the whole way at most, metres.
    motion: f64,
}

#[derive(Debug, Clone, Copy)]
enum What {
    Links(LinkPair),
    LinkAndPart(usize, usize),
    HeldAndLink(usize),
    HeldAndPart(usize),
}

/// Part of the way, and which items are open on it.
#[derive(Debug, Clone, Copy)]
struct Interval {
    middle: f64,
    half: f64,
    items: (usize, usize),
}

/// Room to work in.
#[derive(Debug, Clone, Default)]
pub(crate) struct SweepScratch {
    items: Vec<Item>,
    intervals: Vec<Interval>,
    change: Vec<f64>,
    at: Vec<f64>,
}

/// How two things stand in the middle of an interval.
enum Stand {
    /// Too far apart to meet on it.
    Apart,
    /// Not decided.
    Near,
    /// Nearer than they may be.
    Touching,
}

/// What one sweep works with.
pub(crate) struct Way<'a> {
    pub robot: &'a Robot,
    pub model: &'a CollisionModel,
    pub world: &'a World,
    pub settings: &'a SweepSettings,
}

impl Way<'_> {
    pub fn sweep(
        &self,
        from: &[f64],
        to: &[f64],
        poses: &mut Vec<Isometry3<f64>>,
        scratch: &mut Scratch,
        room: &mut SweepScratch,
    ) -> Sweep {
        room.change.clear();
        room.change.extend(from.iter().zip(to).map(|(a, b)| (b - a).abs()));
        room.items.clear();
        self.collect(&room.change, &mut room.items);
        room.intervals.clear();
        room.intervals.push(Interval { middle: 0.5, half: 0.5, items: (0, room.items.len()) });
        let mut next = 0;
        while let Some(&interval) = room.intervals.get(next) {
            next += 1;
            room.at.clear();
            room.at.extend(from.iter().zip(to).map(|(a, b)| a + (b - a) * interval.middle));
            self.robot.link_poses(&room.at, poses);
            self.model.place(poses, scratch);
            let first = room.items.len();
            for i in interval.items.0..interval.items.1 {
                let item = room.items[i];
                let blocked = Sweep::Blocked { share: interval.middle, contact: self.contact(&item.what) };
                match self.stand(&item, interval.half, poses, scratch) {
                    Stand::Apart => {}
                    Stand::Touching => return blocked,
                    Stand::Near if item.motion * interval.half <= self.settings.resolution => return blocked,
                    Stand::Near if next > MOST_INTERVALS => return blocked,
                    Stand::Near => room.items.push(item),
                }
            }
            let items = (first, room.items.len());
            if items.0 < items.1 {
                let half = 0.5 * interval.half;
                for middle in [interval.middle - half, interval.middle + half] {
                    room.intervals.push(Interval { middle, half, items });
                }
            }
        }
        Sweep::Free
    }

    /// Everything that could meet.
    fn collect(&self, change: &[f64], items: &mut Vec<Item>) {
        let Self { model, world, .. } = self;
        let moves = |link: usize, from: usize| model.levers.motion(link, from, model.extent(link), change);
        items.extend(model.pairs.iter().map(|&pair| Item {
            what: What::Links(pair),
            motion: moves(pair.a, pair.n_shared) + moves(pair.b, pair.n_shared),
        }));
        let links = (0..self.robot.links.len()).filter(|&link| model.has_solids(link));
        for link in links.clone().filter(|&link| !model.still[link]) {
            let motion = moves(link, 0);
            items.extend((0..world.parts().len()).map(|part| Item { what: What::LinkAndPart(link, part), motion }));
        }
        let Some(held) = world.held() else { return };
        let extent = held.extent();
        let held_moves = |from: usize| model.levers.motion(held.link, from, extent, change);
        for link in links.filter(|&link| !held.may_touch_link(link)) {
            let shared = model.levers.n_shared(held.link, link);
            items.push(Item { what: What::HeldAndLink(link), motion: held_moves(shared) + moves(link, shared) });
        }
        let motion = held_moves(0);
        let parts = world.parts().iter().enumerate();
        let apart = parts.filter(|(_, part)| !held.may_touch(&world.obstacles()[part.obstacle].name));
        items.extend(apart.map(|(part, _)| Item { what: What::HeldAndPart(part), motion }));
    }

    fn contact(&self, what: &What) -> Contact {
        let obstacle = |part: usize| Body::Obstacle(self.world.parts()[part].obstacle);
        match *what {
            What::Links(pair) => Contact { a: Body::Link(pair.a), b: Body::Link(pair.b) },
            What::LinkAndPart(link, part) => Contact { a: Body::Link(link), b: obstacle(part) },
            What::HeldAndLink(link) => Contact { a: Body::Held, b: Body::Link(link) },
            What::HeldAndPart(part) => Contact { a: Body::Held, b: obstacle(part) },
        }
    }

    fn stand(&self, item: &Item, half: f64, poses: &[Isometry3<f64>], scratch: &Scratch) -> Stand {
        let Self { model, world, .. } = self;
        let margin = if matches!(item.what, What::Links(_)) { 0.0 } else { self.settings.margin };
        let limit = margin + item.motion * half;
        let within = |limit: f64| match item.what {
            What::Links(pair) => model.links_within(&pair, scratch, limit),
            What::LinkAndPart(link, part) => {
                let standing = &world.parts()[part];
                let near =
                    |solid: &Posed| standing.may_be_within(solid, limit) && solid.is_within(&standing.posed(), limit);
                model.parts_of(link, scratch).any(|solid| near(&solid))
            }
            What::HeldAndLink(link) => world.held().is_some_and(|held| {
                let thing = |solid| pose_held(held, solid, poses);
                held.parts
                    .iter()
                    .any(|solid| model.parts_of(link, scratch).any(|part| thing(solid).is_within(&part, limit)))
            }),
            What::HeldAndPart(part) => world.held().is_some_and(|held| {
                let standing = &world.parts()[part];
                held.parts
                    .iter()
                    .map(|solid| pose_held(held, solid, poses))
                    .any(|thing| standing.may_be_within(&thing, limit) && thing.is_within(&standing.posed(), limit))
            }),
        };
        if !within(limit) {
            Stand::Apart
        } else if limit == margin || within(margin) {
            Stand::Touching
        } else {
            Stand::Near
        }
    }
}
