//! The person's hidden reward and habits, as ROS parameters.

use bus::{NodeSettings, ParameterSpec, Range};
use serde::{Deserialize, Serialize};

/// How a placement is chosen from the rewards.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Noise {
    /// Always the best one.
    #[default]
    None,
    /// A free grid cell with probability proportional to exp(β·R); in a world an action to exp(β·Q), a walk to exp(β·return).
    Boltzmann,
}

/// Parameters of the demonstrator.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Settings {
    /// Seeds noise and ids.
    pub seed: i64,
    /// Who answers.
    pub source: String,
    /// Names of the features with a reward: object ids, or names of the fixed centres such as "table centre".
    pub reward_names: Vec<String>,
    /// Weights of those features, in the same order; every other feature has weight 0.
    pub reward_weights: Vec<f64>,
    /// How a placement is chosen.
    pub noise: Noise,
    /// β of the Boltzmann choice.
    pub beta: f64,
    /// Share of answers that are a free cell drawn uniformly.
    pub mistake_rate: f64,
    /// Share of answers that are "can't tell".
    pub cant_tell_rate: f64,
    /// Share of answers that are "skip".
    pub skip_rate: f64,
    /// Most walks the person shows in a world.
    pub shows: i64,
    /// Steps of each.
    pub show_steps: i64,
    /// Most pairs of walks the person compares in a world.
    pub compares: i64,
    /// Steps of each of the two.
    pub compare_steps: i64,
    /// Time between seeing a question and answering it, seconds.
    pub response_delay_s: f64,
    /// An answer without a receipt is sent again after this time, seconds.
    pub republish_period_s: f64,
}

impl Default for Settings {
    fn default() -> Self {
        Self {
            seed: 1,
            source: "simulated_person".to_owned(),
            reward_names: vec!["table centre".to_owned()],
            reward_weights: vec![1.0],
            noise: Noise::None,
            beta: 100.0,
            mistake_rate: 0.0,
            cant_tell_rate: 0.0,
            skip_rate: 0.0,
            shows: 0,
            show_steps: 20,
            compares: 0,
            compare_steps: 20,
            response_delay_s: 0.0,
            republish_period_s: 1.0,
        }
    }
}

const PIECES: Range = Range::Integer { min: 0, max: 10_000 };
const STEPS: Range = Range::Integer { min: 1, max: 10_000 };
const RATE: Range = Range::Float { min: 0.0, max: 1.0 };

impl NodeSettings for Settings {
    const NODE: &'static str = "demonstrator";
    const ABOUT: &'static str =
        "A simulated person with a hidden reward, who answers every question and shows what to do in a world.";
    const PARAMETERS: &'static [ParameterSpec] = &[
        ParameterSpec {
            name: "seed",
            about: "seeds the person's noise and the ids of the answers",
            range: Range::Integer { min: 0, max: i64::MAX },
        },
        ParameterSpec { name: "source", about: "who answers; part of every answer", range: Range::Any },
        ParameterSpec {
            name: "reward_names",
            about: "features with a reward: object ids, fixed centres such as 'table centre', or features of a world",
            range: Range::Any,
        },
        ParameterSpec {
            name: "reward_weights",
            about: "weights of those features, in the same order; all others have weight 0",
            range: Range::Float { min: -1e6, max: 1e6 },
        },
        ParameterSpec {
            name: "noise",
            about: "how a placement, an action or a walk is chosen: always the best one, or proportional to exp(beta * reward)",
            range: Range::Choice(&["none", "boltzmann"]),
        },
        ParameterSpec {
            name: "beta",
            about: "rationality of the Boltzmann choice",
            range: Range::Float { min: 0.0, max: 1e6 },
        },
        ParameterSpec {
            name: "mistake_rate",
            about: "share of answers that are any free place, any action, any order",
            range: RATE,
        },
        ParameterSpec { name: "cant_tell_rate", about: "share of answers that are 'can't tell'", range: RATE },
        ParameterSpec { name: "skip_rate", about: "share of answers that are 'skip'", range: RATE },
        ParameterSpec {
            name: "shows",
            about: "most walks the person shows in a world, one after another while the lesson goes on",
            range: PIECES,
        },
        ParameterSpec { name: "show_steps", about: "steps of each walk", range: STEPS },
        ParameterSpec {
            name: "compares",
            about: "most pairs of walks the person compares in a world; walks and pairs take turns",
            range: PIECES,
        },
        ParameterSpec { name: "compare_steps", about: "steps of each walk of a pair", range: STEPS },
        ParameterSpec {
            name: "response_delay_s",
            about: "time between seeing a question, or being heard in a world, and the next answer, seconds",
            range: Range::Float { min: 0.0, max: 3600.0 },
        },
        ParameterSpec {
            name: "republish_period_s",
            about: "an answer without a receipt is sent again after this time, seconds",
            range: Range::Float { min: 0.05, max: 60.0 },
        },
    ];

    fn check(&self) -> Result<(), String> {
        let (names, weights) = (self.reward_names.len(), self.reward_weights.len());
        if names != weights {
            return Err(format!("reward_names has {names} entries and reward_weights {weights}; they must be as many"));
        }
        if let Some(name) = self
            .reward_names
            .iter()
            .enumerate()
            .find_map(|(i, name)| self.reward_names[..i].contains(name).then_some(name))
        {
            return Err(format!("reward_names holds '{name}' twice; give each feature one weight"));
        }
        if self.source.is_empty() || self.source.len() > 64 {
            return Err(format!("source has {} bytes; it must have 1 to 64", self.source.len()));
        }
        let rates = self.skip_rate + self.cant_tell_rate + self.mistake_rate;
        if rates > 1.0 {
            return Err(format!("skip_rate + cant_tell_rate + mistake_rate is {rates}; it must be at most 1"));
        }
        Ok(())
    }

    fn seed(&self) -> u64 {
        self.seed.unsigned_abs()
    }
}

#[cfg(test)]
mod tests {
    use super::Settings;

    #[test]
    fn the_table_of_parameters_matches_the_settings() {
        bus::testing::check_parameters::<Settings>();
    }
}
