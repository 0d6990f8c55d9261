//! Parameters of the node.

use bus::{NodeSettings, ParameterSpec, Range};
use serde::{Deserialize, Serialize};

/// What a policy is judged by under an uncertain reward.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Objective {
    /// Its return.
    Robust,
    /// Its return above what the demonstrations return.
    Regret,
    /// What it loses against the best policy for each reward.
    Evd,
}

/// Parameters of `policy_optimizer`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Settings {
    /// Seed of the confidence interval; the policy itself draws nothing.
    pub seed: i64,
    /// What a policy is judged by.
    pub objective: Objective,
    /// The worst 1 − α of the rewards are the worst case.
    pub alpha: f64,
    /// Weight of the mean against the worst case, until somebody says otherwise on `risk_preference`.
    pub lambda: f64,
    /// λ of the frontier, evenly from 0 to 1.
    pub points: i64,
    /// Most draws that a policy is chosen by, evenly spread over the first half of each chain.
    pub n_draws: i64,
    /// Confidence of the interval around the worst case of the held-out draws.
    pub confidence: f64,
    /// Whether the policy is also sent to be bounded.
    pub judge: bool,
    /// Largest gap that is called optimal, as a share of the typical size of returns.
    pub tolerance: f64,
    /// Most rounds of column generation for one λ.
    pub max_rounds: i64,
    /// Most iterations of the linear-programming solver each time it is called.
    pub max_iterations: i64,
    /// Threads; the policies do not depend on it. 0: as many as there are cores.
    pub threads: i64,
    /// How often the newest policy is sent again, seconds.
    pub republish_period_s: f64,
}

impl Default for Settings {
    fn default() -> Self {
        Self {
            seed: 1,
            objective: Objective::Robust,
            alpha: 0.95,
            lambda: 0.5,
            points: 21,
            n_draws: 2000,
            confidence: 0.95,
            judge: true,
            tolerance: 1e-8,
            max_rounds: 5000,
            max_iterations: 200,
            threads: 0,
            republish_period_s: 2.0,
        }
    }
}

impl NodeSettings for Settings {
    const NODE: &'static str = "policy_optimizer";
    const ABOUT: &'static str =
        "Finds the policy that balances the mean return against the worst case, and what each balance buys";
    const PARAMETERS: &'static [ParameterSpec] = &[
        ParameterSpec {
            name: "seed",
            about: "seed of the confidence interval; the policy itself draws nothing",
            range: Range::Integer { min: 0, max: i64::MAX },
        },
        ParameterSpec {
            name: "objective",
            about: "what a policy is judged by: its return (robust), its return above the demonstrations' (regret; by its \
                    return until there is one), or what it loses against the best policy for each reward (evd)",
            range: Range::Choice(&["robust", "regret", "evd"]),
        },
        ParameterSpec {
            name: "alpha",
            about: "the worst 1 - alpha of the rewards that fit are the worst case",
            range: Range::Float { min: 0.0, max: 0.999 },
        },
        ParameterSpec {
            name: "lambda",
            about: "weight of the mean against the worst case, until somebody says otherwise on risk_preference",
            range: Range::Float { min: 0.0, max: 1.0 },
        },
        ParameterSpec {
            name: "points",
            about: "points of the frontier, evenly from lambda 0 to 1",
            range: Range::Integer { min: 2, max: 201 },
        },
        ParameterSpec {
            name: "n_draws",
            about: "most draws that a policy is chosen by, of the first half of each chain; the second half judges it",
            range: Range::Integer { min: 10, max: 100_000 },
        },
        ParameterSpec {
            name: "confidence",
            about: "confidence of the interval around the worst case of the held-out draws",
            range: Range::Float { min: 0.5, max: 0.999 },
        },
        ParameterSpec {
            name: "judge",
            about: "send the policy and the best for the mean reward on `policies`, to be bounded",
            range: Range::Any,
        },
        ParameterSpec {
            name: "tolerance",
            about: "largest gap that is called optimal, as a share of the typical size of returns",
            range: Range::Float { min: 1e-12, max: 0.1 },
        },
        ParameterSpec {
            name: "max_rounds",
            about: "most rounds of column generation for one lambda",
            range: Range::Integer { min: 1, max: 1_000_000 },
        },
        ParameterSpec {
            name: "max_iterations",
            about: "most iterations of the linear-programming solver each time it is called",
            range: Range::Integer { min: 1, max: 100_000 },
        },
        ParameterSpec {
            name: "threads",
            about: "threads; 0: as many as there are cores. The policies do not depend on it",
            range: Range::Integer { min: 0, max: 1024 },
        },
        ParameterSpec {
            name: "republish_period_s",
            about: "how often the newest policy is sent again, seconds",
            range: Range::Float { min: 0.1, max: 3600.0 },
        },
    ];

    fn seed(&self) -> u64 {
        self.seed.unsigned_abs()
    }
}

impl Settings {
    /// Threads to compute on.
    pub(crate) fn n_threads(&self) -> usize {
        match usize::try_from(self.threads) {
            Ok(threads) if threads > 0 => threads,
            _ => std::thread::available_parallelism().map_or(1, std::num::NonZero::get),
        }
    }

    /// How long and how exactly to look: in steps, so that answers are the same on every machine.
    pub(crate) fn solver(&self) -> robust::Settings {
        let steps = |n: i64| usize::try_from(n).unwrap_or(1).max(1);
        robust::Settings {
            tolerance: self.tolerance,
            max_rounds: steps(self.max_rounds),
            max_iterations: steps(self.max_iterations),
            ..robust::Settings::default()
        }
    }

    /// λ of the frontier, ascending.
    pub(crate) fn lambdas(&self) -> Vec<f64> {
        let last = (self.points - 1).max(1);
        (0..=last).map(|i| i as f64 / last as f64).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::Settings;

    #[test]
    fn the_table_of_parameters_matches_the_settings() {
        bus::testing::check_parameters::<Settings>();
    }

    #[test]
    fn the_frontier_goes_from_the_worst_case_to_the_mean() {
        let lambdas = Settings { points: 5, ..Settings::default() }.lambdas();
        assert_eq!(lambdas, [0.0, 0.25, 0.5, 0.75, 1.0]);
    }
}
