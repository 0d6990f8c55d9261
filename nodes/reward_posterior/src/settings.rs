//! Parameters of the node.

use bus::{NodeSettings, ParameterSpec, Range};
use posterior::Prior;
use serde::{Deserialize, Serialize};

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
