//! Pairs of links that are not tested against each other.

use crate::inverse::sampling_range;
use crate::scan::shorten;
use crate::{CollisionModel, Robot, Scratch};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use std::collections::BTreeSet;
use thiserror::Error;

/// Pairs of links, by index, that are left out although they could meet, or tested although they are neighbours. Links that
/// are joined by one moving joint (neighbours) are left out unless enabled; links of one rigid group always are.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Exclusions {
    disabled: BTreeSet<(usize, usize)>,
    enabled: BTreeSet<(usize, usize)>,
}

/// A list of pairs that names a link which is not there.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[error("the list of disabled collisions names the link '{link}', which the robot does not have")]
pub struct UnknownLink {
    /// The name.
    pub link: String,
}

/// How often pairs of links touch over random configurations.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Survey {
    /// Configurations drawn.
    pub n: usize,
    /// The tested pairs, smaller index first, with the number of configurations in which they touch.
    pub touches: Vec<((usize, usize), usize)>,
}

fn ordered(a: usize, b: usize) -> (usize, usize) {
    (a.min(b), a.max(b))
}

impl Exclusions {
    /// None: only neighbours are left out.
    pub fn none() -> Self {
        Self::default()
    }

    /// Whether a pair is left out by name, in either order.
    pub fn contains(&self, a: usize, b: usize) -> bool {
        self.disabled.contains(&ordered(a, b))
    }

    /// Whether a pair is tested even if its links are neighbours.
    pub fn is_enabled(&self, a: usize, b: usize) -> bool {
        self.enabled.contains(&ordered(a, b))
    }

    /// Number of pairs left out by name.
    pub fn len(&self) -> usize {
        self.disabled.len()
    }

    /// Whether no pair is.
    pub fn is_empty(&self) -> bool {
        self.disabled.is_empty()
    }

    /// Leaves a pair out.
    pub fn disable_pair(&mut self, a: usize, b: usize) {
        self.disabled.insert(ordered(a, b));
        self.enabled.remove(&ordered(a, b));
    }

    /// Tests a pair, neighbours or not.
    pub fn enable_pair(&mut self, a: usize, b: usize) {
        self.disabled.remove(&ordered(a, b));
        self.enabled.insert(ordered(a, b));
    }

    /// Leaves out pairs by name.
    ///
    /// # Errors
    /// A name that is no link.
    pub fn disable<'a>(
        mut self,
        robot: &Robot,
        pairs: impl IntoIterator<Item = (&'a str, &'a str)>,
    ) -> Result<Self, UnknownLink> {
        let find = |link: &str| robot.link_index(link).ok_or_else(|| UnknownLink { link: shorten(link) });
        for (a, b) in pairs {
            self.disable_pair(find(a)?, find(b)?);
        }
        Ok(self)
    }

    /// Leaves out the pairs that touch in every one of `n` configurations drawn uniformly within the limits: those are
    /// built that way. Pairs that touch in some are kept; so are pairs that touch in none, for a sample is no proof.
    pub fn always_touching(mut self, robot: &Robot, n: usize, seed: u64) -> Self {
        let survey = Survey::new(robot, &self, n, seed);
        survey.touches.iter().filter(|(_, times)| *times == n).for_each(|&((a, b), _)| self.disable_pair(a, b));
        self
    }

    /// Leaves out the pairs that touch in none of `n` such configurations as well. A sample is no proof: this trades a
    /// little safety for speed, as MoveIt's setup assistant does.
    pub fn never_touching(mut self, robot: &Robot, n: usize, seed: u64) -> Self {
        let survey = Survey::new(robot, &self, n, seed);
        survey.touches.iter().filter(|(_, times)| *times == 0).for_each(|&((a, b), _)| self.disable_pair(a, b));
        self
    }

    /// What a robot without a list of its own gets: the pairs that always touch, from 200 seeded configurations.
    pub fn derived(robot: &Robot, seed: u64) -> Self {
        Self::none().always_touching(robot, 200, seed)
    }
}

impl Survey {
    /// Counts over `n` configurations drawn uniformly within the limits (a joint without limits from one turn).
    pub fn new(robot: &Robot, exclusions: &Exclusions, n: usize, seed: u64) -> Self {
        let mut rng = ChaCha8Rng::seed_from_u64(seed);
        let model = CollisionModel::new(robot, exclusions);
        let mut scratch = Scratch::default();
        let mut poses = Vec::new();
        let mut touches: Vec<_> = model.link_pairs().map(|pair| (pair, 0)).collect();
        let mut q = robot.rest();
        for _ in 0..n {
            for (entry, q) in q.iter_mut().enumerate() {
                let (lower, upper) = sampling_range(robot, entry);
                *q = lower + (upper - lower) * rng.random::<f64>();
            }
            robot.link_poses(&q, &mut poses);
            model.count_touches(&poses, &mut scratch, &mut touches);
        }
        Self { n, touches }
    }
}
