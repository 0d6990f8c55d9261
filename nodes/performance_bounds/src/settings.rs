//! Parameters of the node.

use bus::{NodeSettings, ParameterSpec, Range};
use serde::{Deserialize, Serialize};

/// Parameters of `performance_bounds`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Settings {
    /// Named in the receipt; the bounds themselves draw nothing.
    pub seed: i64,
    /// The quantile of the loss that is bounded.
    pub alpha: f64,
    /// The bounds on placements of a whole session hold together with probability at least 1 − δ, and so do those on policies.
    pub delta: f64,
    /// Threads; the bounds do not depend on it. 0: as many as there are cores.
    pub threads: i64,
    /// How often the newest bounds are sent again, seconds.
    pub republish_period_s: f64,
}

impl Default for Settings {
    fn default() -> Self {
        Self { seed: 1, alpha: 0.95, delta: 0.05, threads: 0, republish_period_s: 2.0 }
    }
}

impl NodeSettings for Settings {
    const NODE: &'static str = "performance_bounds";
    const ABOUT: &'static str = "Bounds the placement error of the robot and the return and loss of policies with high confidence, or says why it cannot";
    const PARAMETERS: &'static [ParameterSpec] = &[
        ParameterSpec {
            name: "seed",
            about: "seed of the session, named in the receipt",
            range: Range::Integer { min: 0, max: i64::MAX },
        },
        ParameterSpec {
            name: "alpha",
            about: "the quantile of the loss that is bounded (value at risk); of a return, the quantile 1 - alpha",
            range: Range::Float { min: 0.5, max: 0.999 },
        },
        ParameterSpec {
            name: "delta",
            about: "the bounds on placements of a whole session hold together with probability at least 1 - delta, and so do those on policies",
            range: Range::Float { min: 1e-6, max: 0.5 },
        },
        ParameterSpec {
            name: "threads",
            about: "threads; 0: as many as there are cores. The bounds do not depend on it",
            range: Range::Integer { min: 0, max: 1024 },
        },
        ParameterSpec {
            name: "republish_period_s",
            about: "how often the newest bounds are sent again, seconds",
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
}
