//! Pairs of links that are not tested against each other.

use crate::inverse::sampling_range;
use crate::scan::shorten;
use crate::{CollisionModel, Robot};
use quick_xml::Reader;
use quick_xml::events::Event;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use std::collections::BTreeSet;
use thiserror::Error;

/// A set of pairs of links, by index.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Exclusions {
    pairs: BTreeSet<(usize, usize)>,
}

/// Why a list of pairs cannot be used.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
pub enum ExclusionError {
    /// No such link.
    #[error("the list of disabled collisions names the link '{link}', which the robot does not have")]
    UnknownLink {
        /// The name.
        link: String,
    },
    /// Not well-formed, or too large.
    #[error("the semantic robot description (SRDF) cannot be read: {problem}")]
    Srdf {
        /// What is wrong.
        problem: String,
    },
}

impl Exclusions {
    /// None: only neighbours are left out.
    pub fn none() -> Self {
        Self::default()
    }

    /// Whether a pair is in the set, in either order.
    pub fn contains(&self, a: usize, b: usize) -> bool {
        self.pairs.contains(&(a.min(b), a.max(b)))
    }

    /// Number of pairs.
    pub fn len(&self) -> usize {
        self.pairs.len()
    }

    /// Whether there is none.
    pub fn is_empty(&self) -> bool {
        self.pairs.is_empty()
    }

    /// Adds pairs by name.
    ///
    /// # Errors
    /// A name that is no link.
    pub fn disable<'a>(
        mut self,
        robot: &Robot,
        pairs: impl IntoIterator<Item = (&'a str, &'a str)>,
    ) -> Result<Self, ExclusionError> {
        let find =
            |link: &str| robot.link_index(link).ok_or_else(|| ExclusionError::UnknownLink { link: shorten(link) });
        for (a, b) in pairs {
            let (a, b) = (find(a)?, find(b)?);
            self.pairs.insert((a.min(b), a.max(b)));
        }
        Ok(self)
    }

    /// Adds the `<disable_collisions link1 link2>` pairs of an SRDF text.
    ///
    /// # Errors
    /// Text that is not well-formed or larger than [`crate::MAX_BYTES`], or a name that is no link.
    pub fn disable_srdf(self, robot: &Robot, text: &str) -> Result<Self, ExclusionError> {
        let srdf = |problem: String| ExclusionError::Srdf { problem: shorten(&problem) };
        if text.len() > crate::MAX_BYTES {
            return Err(srdf(format!("{} bytes; at most {} are read", text.len(), crate::MAX_BYTES)));
        }
        let mut pairs: Vec<(String, String)> = Vec::new();
        let mut reader = Reader::from_str(text);
        loop {
            let start = match reader.read_event().map_err(|error| srdf(error.to_string()))? {
                Event::Eof => break,
                Event::Start(start) | Event::Empty(start) if start.name().as_ref() == b"disable_collisions" => start,
                _ => continue,
            };
            let value = |key: &str| {
                let found = start.try_get_attribute(key).map_err(|error| srdf(error.to_string()))?;
                let found = found.ok_or_else(|| srdf(format!("a <disable_collisions> lacks '{key}'")))?;
                found.unescape_value().map(|v| v.into_owned()).map_err(|error| srdf(error.to_string()))
            };
            pairs.push((value("link1")?, value("link2")?));
        }
        self.disable(robot, pairs.iter().map(|(a, b)| (a.as_str(), b.as_str())))
    }

    /// Adds the pairs that touch in every one of `n` configurations drawn uniformly within the limits: those are built
    /// that way. Pairs that touch in some are kept; so are pairs that touch in none, for a sample is no proof.
    pub fn always_touching(mut self, robot: &Robot, n: usize, seed: u64) -> Self {
        let mut rng = ChaCha8Rng::seed_from_u64(seed);
        let model = CollisionModel::new(robot, &self);
        let mut always: Option<BTreeSet<(usize, usize)>> = None;
        let mut poses = Vec::new();
        for _ in 0..n {
            let q: Vec<f64> = (0..robot.dof())
                .map(|entry| {
                    let (lower, upper) = sampling_range(robot, entry);
                    lower + (upper - lower) * rng.random::<f64>()
                })
                .collect();
            robot.link_poses(&q, &mut poses);
            let kept = model.touching_links(&poses, always.as_ref());
            if kept.is_empty() {
                return self;
            }
            always = Some(kept);
        }
        self.pairs.extend(always.unwrap_or_default());
        self
    }

    /// What a robot without a list of its own gets: the pairs that always touch, from 200 seeded configurations.
    pub fn derived(robot: &Robot, seed: u64) -> Self {
        Self::none().always_touching(robot, 200, seed)
    }
}
