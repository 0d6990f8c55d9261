//! The person: a reward over placements, and the way of choosing from it.

use crate::comparing::Comparing;
use crate::identity::generator;
use crate::{Noise, Settings};
use bus::NodeSettings;
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::Rng;
use scene::{Field, Grid, Point, Rbf, Scene, SceneError, best_placement};
use std::collections::BTreeMap;
use thiserror::Error;

/// The person looks at the table as a grid of this many cells a side.
pub const GRID_SIDE: usize = 64;

/// What a person says to "where does it belong?".
#[derive(Debug, Clone, PartialEq)]
pub enum Answer {
    /// There; metres in the scene's frame.
    Place(Point),
    /// Ask something else.
    Skip,
    /// No opinion.
    CantTell {
        /// Why, in words; may be empty.
        reason: &'static str,
    },
}

/// What a person says to "which of these two places is better?".
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Comparison {
    /// An answer of a [`TrajectoryPreference`](apprentice_msgs::msg::TrajectoryPreference).
    Said {
        /// Which.
        answer: u8,
        /// Whether the second is the better one, whatever is said.
        second_is_better: bool,
    },
    /// Ask something else.
    Skip,
}

/// Why a person cannot even look at a scene.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum PersonError {
    /// The scene breaks the rules of scenes.
    #[error(transparent)]
    Scene(#[from] SceneError),
}

/// A simulated person.
#[derive(Debug, Clone, PartialEq)]
pub struct Person {
    source: String,
    seed: u64,
    weights: BTreeMap<String, f64>,
    noise: Noise,
    beta: f64,
    skip_rate: f64,
    cant_tell_rate: f64,
    mistake_rate: f64,
    comparing: Comparing,
}

impl Person {
    /// The person that the settings describe.
    pub fn new(settings: &Settings) -> Self {
        let weights = settings.reward_names.iter().cloned().zip(settings.reward_weights.iter().copied());
        Self {
            source: settings.source.clone(),
            seed: settings.seed(),
            weights: weights.collect(),
            noise: settings.noise,
            beta: settings.beta,
            skip_rate: settings.skip_rate,
            cant_tell_rate: settings.cant_tell_rate,
            mistake_rate: settings.mistake_rate,
            comparing: Comparing::new(settings),
        }
    }

    /// Weights of a scene's features, in the order of [`Rbf::names`].
    pub fn weights(&self, scene: &Scene) -> Vec<f64> {
        Rbf::names(scene).iter().map(|name| self.weights.get(name).copied().unwrap_or(0.0)).collect()
    }

    /// Features with a reward that a scene does not have.
    pub fn unknown_features(&self, scene: &Scene) -> Vec<&str> {
        let names = Rbf::names(scene);
        self.weights.keys().map(String::as_str).filter(|name| !names.iter().any(|known| known == name)).collect()
    }

    /// The answer to a question: a function of the settings, the question's id and its scene.
    ///
    /// # Errors
    /// When the scene breaks the rules of scenes.
    pub fn answer(&self, query_id: &str, scene: &Scene) -> Result<Answer, PersonError> {
        scene.check()?;
        let mut random = generator(&self.source, query_id, self.seed);
        let mood = uniform(&mut random);
        if mood < self.skip_rate {
            return Ok(Answer::Skip);
        }
        if mood < self.skip_rate + self.cant_tell_rate {
            return Ok(Answer::CantTell { reason: "" });
        }
        let mistaken = mood < self.skip_rate + self.cant_tell_rate + self.mistake_rate;
        let rbf = Rbf::new(scene);
        let field = Field::new(&rbf, &Grid::midpoints(GRID_SIDE), Some(scene));
        let w = self.weights(scene);
        let mut rewards = Vec::new();
        let place = if mistaken {
            boltzmann(&field, &w, 0.0, &mut random)
        } else if self.noise == Noise::Boltzmann {
            boltzmann(&field, &w, self.beta, &mut random)
        } else {
            best_placement(scene, &rbf, &field, &w, &mut rewards).map(|best| best.at)
        };
        Ok(match place {
            Some(at) => Answer::Place(scene.metres(at)),
            None => Answer::CantTell { reason: "there is no free place on this table" },
        })
    }

    /// Which of two places on a table, in metres, is better: a function of the settings, the question's id, its scene and the places.
    ///
    /// # Errors
    /// When the scene breaks the rules of scenes.
    pub fn compare(&self, query_id: &str, scene: &Scene, places_m: [Point; 2]) -> Result<Comparison, PersonError> {
        scene.check()?;
        let mut random = generator(&self.source, query_id, self.seed);
        if uniform(&mut random) < self.skip_rate {
            return Ok(Comparison::Skip);
        }
        let (rbf, w) = (Rbf::new(scene), self.weights(scene));
        let worth = places_m.map(|at_m| rbf.reward(&w, scene.normalised(at_m)));
        let (answer, second_is_better) = self.comparing.say(worth, &mut random);
        Ok(Comparison::Said { answer, second_is_better })
    }
}

/// A uniform number in [0, 1) from the top 53 bits of the next word.
fn uniform(random: &mut ChaCha8Rng) -> f64 {
    (random.next_u64() >> 11) as f64 / (1_u64 << 53) as f64
}

/// A free grid point with probability proportional to exp(β·R); normalised coordinates, `None` when no point is free.
fn boltzmann(field: &Field, w: &[f64], beta: f64, random: &mut ChaCha8Rng) -> Option<Point> {
    let mut mass = vec![0.0; field.grid().n()];
    field.rewards(w, &mut mass);
    let free = || field.free().iter();
    let top = mass.iter().zip(free()).filter(|&(_, &free)| free).map(|(r, _)| *r).reduce(f64::max)?;
    let mut total = 0.0;
    for (mass, &free) in mass.iter_mut().zip(free()) {
        *mass = if free { scene::exp(beta * (*mass - top)) } else { 0.0 };
        total += *mass;
    }
    let mut left = uniform(random) * total;
    let mut chosen = None;
    for (i, _) in free().enumerate().filter(|&(_, &free)| free) {
        chosen = Some(i);
        left -= mass[i];
        if left < 0.0 {
            break;
        }
    }
    chosen.map(|i| field.grid().at(i))
}
