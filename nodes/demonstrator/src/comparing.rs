//! How a person says which of two is better.

use crate::{Noise, Settings};
use apprentice_msgs::msg::TrajectoryPreference;
use mdp::random::uniform;
use rand_chacha::ChaCha8Rng;

/// Values that differ relatively by no more than this are equal: what is left is rounding.
pub(crate) const TIE: f64 = 1e-9;

/// The habits of a person who compares.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Comparing {
    noise: Noise,
    beta: f64,
    mistake_rate: f64,
    cant_tell_rate: f64,
}

impl Comparing {
    /// Those that the settings describe.
    pub fn new(settings: &Settings) -> Self {
        Self {
            noise: settings.noise,
            beta: settings.beta,
            mistake_rate: settings.mistake_rate,
            cant_tell_rate: settings.cant_tell_rate,
        }
    }

    /// What is said, and whether it is that the second is better, whatever is said, when they are worth `first` and `second`.
    pub fn say(&self, [first, second]: [f64; 2], random: &mut ChaCha8Rng) -> (u8, bool) {
        let size: f64 = first.abs().max(second.abs());
        let mood = uniform(random);
        let chance = uniform(random);
        let mistaken = mood < self.mistake_rate;
        let unsure = !mistaken && mood < self.mistake_rate + self.cant_tell_rate;
        let answer = match () {
            () if unsure => TrajectoryPreference::CANT_TELL,
            () if !mistaken && self.noise == Noise::None && (first - second).abs() <= TIE * size => {
                TrajectoryPreference::EQUAL
            }
            () => TrajectoryPreference::RANKED,
        };
        let second_is_better = match self.noise {
            _ if mistaken => chance < 0.5,
            Noise::None => second > first,
            // P(second better) = 1 / (1 + exp(−β (second − first))).
            Noise::Boltzmann => chance < 1.0 / (1.0 + scene::exp(-self.beta * (second - first))),
        };
        (answer, second_is_better)
    }
}
