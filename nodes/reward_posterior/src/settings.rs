//! Parameters of the node.

use bus::{NodeSettings, ParameterSpec, Range};
use serde::{Deserialize, Serialize};

/// Prior over the weights.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Prior {
    /// Uniform on ‖w‖₁ = 1.
    L1Sphere,
    /// Uniform on ‖w‖₂ = 1.
    L2Sphere,
}

impl Prior {
    /// As in parameters and messages.
    pub fn name(self) -> &'static str {
        match self {
            Self::L1Sphere => "l1_sphere",
            Self::L2Sphere => "l2_sphere",
        }
    }
}

/// Parameters of `reward_posterior`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Settings {
    /// Seed of the draws.
    pub seed: i64,
    /// Rationality β of a person who is sure.
    pub beta: f64,
    /// Factor on β for answers given as "fairly sure".
    pub fairly_factor: f64,
    /// Factor on β for answers given as "a guess".
    pub guess_factor: f64,
    /// Prior over the weights.
    pub prior: Prior,
    /// Draws over all chains.
    pub n_draws: i64,
    /// Chains.
    pub n_chains: i64,
    /// Iterations per chain spent on finding step size and scale, not kept.
    pub warmup: i64,
    /// Cells per axis of the grid on which the likelihood is normalised.
    pub grid_side: i64,
    /// Threads; the draws do not depend on it. 0: as many as there are cores.
    pub threads: i64,
    /// File of accepted evidence; empty: none is kept, and a restart begins anew.
    pub journal: String,
    /// How often the newest posterior and the evidence are sent again, seconds.
    pub republish_period_s: f64,
}

impl Default for Settings {
    fn default() -> Self {
        Self {
            seed: 1,
            beta: 100.0,
            fairly_factor: 0.5,
            guess_factor: 0.2,
            prior: Prior::L1Sphere,
            n_draws: 4000,
            n_chains: 4,
            warmup: 400,
            grid_side: 64,
            threads: 0,
            journal: String::new(),
            republish_period_s: 10.0,
        }
    }
}

impl NodeSettings for Settings {
    const NODE: &'static str = "reward_posterior";
    const ABOUT: &'static str = "Learns what a person wants: draws of the reward weights given all evidence in force";
    const PARAMETERS: &'static [ParameterSpec] = &[
        ParameterSpec { name: "seed", about: "seed of the draws", range: Range::Integer { min: 0, max: i64::MAX } },
        ParameterSpec {
            name: "beta",
            about: "rationality of a person who is sure: how sharply better placements are preferred",
            range: Range::Float { min: 0.001, max: 10_000.0 },
        },
        ParameterSpec {
            name: "fairly_factor",
            about: "factor on beta for answers given as fairly sure",
            range: Range::Float { min: 0.001, max: 1.0 },
        },
        ParameterSpec {
            name: "guess_factor",
            about: "factor on beta for answers given as a guess",
            range: Range::Float { min: 0.001, max: 1.0 },
        },
        ParameterSpec {
            name: "prior",
            about: "prior over the weights: uniform on the L1 or on the L2 sphere",
            range: Range::Choice(&["l1_sphere", "l2_sphere"]),
        },
        ParameterSpec {
            name: "n_draws",
            about: "draws over all chains; a multiple of n_chains",
            range: Range::Integer { min: 400, max: 1_000_000 },
        },
        ParameterSpec { name: "n_chains", about: "chains", range: Range::Integer { min: 4, max: 64 } },
        ParameterSpec {
            name: "warmup",
            about: "iterations per chain spent on finding step size and scale, not kept",
            range: Range::Integer { min: 100, max: 100_000 },
        },
        ParameterSpec {
            name: "grid_side",
            about: "cells per axis of the grid on which the likelihood is normalised",
            range: Range::Integer { min: 16, max: 256 },
        },
        ParameterSpec {
            name: "threads",
            about: "threads; 0: as many as there are cores. The draws do not depend on it",
            range: Range::Integer { min: 0, max: 1024 },
        },
        ParameterSpec {
            name: "journal",
            about: "file of accepted evidence, read at start; empty: none is kept, and a restart begins anew",
            range: Range::Any,
        },
        ParameterSpec {
            name: "republish_period_s",
            about: "how often the newest posterior and the evidence are sent again, seconds",
            range: Range::Float { min: 0.1, max: 3600.0 },
        },
    ];

    fn check(&self) -> Result<(), String> {
        if self.n_draws % self.n_chains == 0 {
            Ok(())
        } else {
            Err(format!("n_draws is {}, which n_chains = {} does not divide", self.n_draws, self.n_chains))
        }
    }

    fn seed(&self) -> u64 {
        self.seed.unsigned_abs()
    }
}

impl Settings {
    /// The sampler's part of the parameters.
    pub(crate) fn sampler(&self) -> posterior::Settings {
        let count = |n: i64| usize::try_from(n).unwrap_or(0);
        let cores = || std::thread::available_parallelism().map_or(1, std::num::NonZero::get);
        posterior::Settings {
            beta: self.beta,
            prior: match self.prior {
                Prior::L1Sphere => posterior::Prior::L1Sphere,
                Prior::L2Sphere => posterior::Prior::L2Sphere,
            },
            n_draws: count(self.n_draws),
            n_chains: count(self.n_chains),
            warmup: count(self.warmup),
            threads: if self.threads > 0 { count(self.threads) } else { cores() },
            grid_side: count(self.grid_side),
            confidence_factors: [1.0, self.fairly_factor, self.guess_factor],
        }
    }
}
