//! Parameters of the node.

use bus::{NodeSettings, ParameterSpec, Range};
use likelihood::preferences::AnswerModel;
use posterior::{EvidenceKind, Rationality, Run, THREADS_RANGE};
use serde::{Deserialize, Serialize};

/// Prior over the weights.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Prior {
    /// Uniform on ‖w‖₁ = 1.
    L1Sphere,
    /// Uniform on ‖w‖₂ = 1.
    L2Sphere,
    /// Independent normal weights.
    Gaussian,
    /// Independent Laplace weights.
    Laplace,
}

impl Prior {
    /// As in parameters and messages.
    pub fn name(self) -> &'static str {
        match self {
            Self::L1Sphere => "l1_sphere",
            Self::L2Sphere => "l2_sphere",
            Self::Gaussian => "gaussian",
            Self::Laplace => "laplace",
        }
    }

    /// Whether `prior_scale` says how large weights are; on a sphere they have one size.
    pub fn has_scale(self) -> bool {
        matches!(self, Self::Gaussian | Self::Laplace)
    }
}

/// Parameters of `reward_posterior`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Settings {
    /// Seed of the draws.
    pub seed: i64,
    /// Rationality β of a person who is sure where something belongs.
    pub beta: f64,
    /// Prior standard deviation of ln `beta`; 0: `beta` is fixed.
    pub beta_log_sd: f64,
    /// Rationality β of demonstrated actions.
    pub beta_actions: f64,
    /// Prior standard deviation of ln `beta_actions`; 0: it is fixed.
    pub beta_actions_log_sd: f64,
    /// Rationality β of preferences.
    pub beta_preferences: f64,
    /// Prior standard deviation of ln `beta_preferences`; 0: it is fixed.
    pub beta_preferences_log_sd: f64,
    /// Rationality β of critiques.
    pub beta_critiques: f64,
    /// Prior standard deviation of ln `beta_critiques`; 0: it is fixed.
    pub beta_critiques_log_sd: f64,
    /// Rationality β of a learner's progress.
    pub beta_progress: f64,
    /// Prior standard deviation of ln `beta_progress`; 0: it is fixed.
    pub beta_progress_log_sd: f64,
    /// Share of demonstrated actions taken to be chosen at random.
    pub wrong_rate_actions: f64,
    /// Share of preferences taken to be given at random.
    pub wrong_rate_preferences: f64,
    /// Share of marked steps taken to be marked at random.
    pub wrong_rate_critiques: f64,
    /// Share of pairs of a learner's history taken to be in random order.
    pub wrong_rate_progress: f64,
    /// Difference of rational returns below which two trajectories seem about equal, nats.
    pub equal_threshold: f64,
    /// Probability of "can't tell" about two trajectories of equal return.
    pub cant_tell: f64,
    /// Factor on β for answers given as "fairly sure".
    pub fairly_factor: f64,
    /// Factor on β for answers given as "a guess".
    pub guess_factor: f64,
    /// Prior over the weights.
    pub prior: Prior,
    /// Size of the weights a priori, for priors that are not on a sphere.
    pub prior_scale: f64,
    /// Whether the worst of all ranked trajectories is known to have a return that is not negative.
    pub nonnegative_return: bool,
    /// Draws over all chains.
    pub n_draws: i64,
    /// Chains.
    pub n_chains: i64,
    /// Iterations per chain spent on finding step size and scale, not kept.
    pub warmup: i64,
    /// Cells per axis of the grid on which the likelihood of placements is normalised.
    pub grid_side: i64,
    /// Threads; the draws do not depend on it. 0: as many as there are cores.
    pub threads: i64,
    /// Draws re-weighted for a preview while the posterior is computed; 0: no previews.
    pub preview_draws: i64,
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
            beta_log_sd: 0.0,
            beta_actions: 10.0,
            beta_actions_log_sd: 0.0,
            beta_preferences: 1.0,
            beta_preferences_log_sd: 0.0,
            beta_critiques: 10.0,
            beta_critiques_log_sd: 0.0,
            beta_progress: 0.2,
            beta_progress_log_sd: 0.0,
            wrong_rate_actions: 0.0,
            wrong_rate_preferences: 0.0,
            wrong_rate_critiques: 0.0,
            wrong_rate_progress: 0.0,
            equal_threshold: 0.5,
            cant_tell: 0.1,
            fairly_factor: 0.5,
            guess_factor: 0.2,
            prior: Prior::L1Sphere,
            prior_scale: 1.0,
            nonnegative_return: false,
            n_draws: 4000,
            n_chains: 4,
            warmup: 400,
            grid_side: 64,
            threads: 0,
            preview_draws: 1000,
            journal: String::new(),
            republish_period_s: 10.0,
        }
    }
}

/// Allowed β of evidence other than placements. Wide: features summed over long trajectories are large.
const BETA: Range = Range::Float { min: 1e-6, max: 1e6 };
/// Allowed standard deviation of ln β.
const LOG_SD: Range = Range::Float { min: 0.0, max: 5.0 };
/// Allowed share of answers at random.
const WRONG_RATE: Range = Range::Float { min: 0.0, max: 0.9 };
/// Smallest standard deviation of ln β that is not zero.
const LEAST_LOG_SD: f64 = 1e-3;

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
            name: "beta_log_sd",
            about: "prior standard deviation of the logarithm of beta, which is learned then; 0: beta is fixed",
            range: LOG_SD,
        },
        ParameterSpec {
            name: "beta_actions",
            about: "rationality of demonstrated actions: how sharply actions of higher value are preferred",
            range: BETA,
        },
        ParameterSpec {
            name: "beta_actions_log_sd",
            about: "prior standard deviation of the logarithm of beta_actions; 0: it is fixed",
            range: LOG_SD,
        },
        ParameterSpec {
            name: "beta_preferences",
            about: "rationality of preferences: how sharply trajectories of higher return are preferred",
            range: BETA,
        },
        ParameterSpec {
            name: "beta_preferences_log_sd",
            about: "prior standard deviation of the logarithm of beta_preferences; 0: it is fixed",
            range: LOG_SD,
        },
        ParameterSpec {
            name: "beta_critiques",
            about: "rationality of critiques: how sharply actions are told good from bad",
            range: BETA,
        },
        ParameterSpec {
            name: "beta_critiques_log_sd",
            about: "prior standard deviation of the logarithm of beta_critiques; 0: it is fixed",
            range: LOG_SD,
        },
        ParameterSpec {
            name: "beta_progress",
            about: "how surely a learner's later attempt is the better one: small, since learners have setbacks",
            range: BETA,
        },
        ParameterSpec {
            name: "beta_progress_log_sd",
            about: "prior standard deviation of the logarithm of beta_progress; 0: it is fixed",
            range: LOG_SD,
        },
        ParameterSpec {
            name: "wrong_rate_actions",
            about: "share of demonstrated actions taken to be chosen at random",
            range: WRONG_RATE,
        },
        ParameterSpec {
            name: "wrong_rate_preferences",
            about: "share of preferences taken to be given at random",
            range: WRONG_RATE,
        },
        ParameterSpec {
            name: "wrong_rate_critiques",
            about: "share of marked steps taken to be marked at random",
            range: WRONG_RATE,
        },
        ParameterSpec {
            name: "wrong_rate_progress",
            about: "share of the pairs of a learner's history taken to be in random order",
            range: WRONG_RATE,
        },
        ParameterSpec {
            name: "equal_threshold",
            about: "difference of rational returns below which trajectories seem about equal, nats; 0: nobody says so",
            range: Range::Float { min: 0.0, max: 1e6 },
        },
        ParameterSpec {
            name: "cant_tell",
            about: "probability of 'can't tell' about trajectories of equal return; 0: nobody says so",
            range: Range::Float { min: 0.0, max: 0.9 },
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
            about: "prior over the weights: uniform on the L1 or on the L2 sphere, or independent weights",
            range: Range::Choice(&["l1_sphere", "l2_sphere", "gaussian", "laplace"]),
        },
        ParameterSpec {
            name: "prior_scale",
            about: "standard deviation of gaussian weights, mean size of laplace ones; of no account on a sphere",
            range: Range::Float { min: 1e-6, max: 1e6 },
        },
        ParameterSpec {
            name: "nonnegative_return",
            about: "whether the worst of all ranked trajectories is known to have a return that is not negative",
            range: Range::Any,
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
            about: "cells per axis of the grid on which the likelihood of placements is normalised",
            range: Range::Integer { min: 16, max: 256 },
        },
        ParameterSpec {
            name: "threads",
            about: "threads; 0: as many as there are cores. The draws do not depend on it",
            range: Range::Integer { min: 0, max: 1024 },
        },
        ParameterSpec {
            name: "preview_draws",
            about: "draws that are re-weighted for a preview while the posterior is computed; 0: no previews",
            range: Range::Integer { min: 0, max: 1_000_000 },
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
        if self.n_draws % self.n_chains != 0 {
            return Err(format!("n_draws is {}, which n_chains = {} does not divide", self.n_draws, self.n_chains));
        }
        let all = [
            ("beta_log_sd", self.beta_log_sd),
            ("beta_actions_log_sd", self.beta_actions_log_sd),
            ("beta_preferences_log_sd", self.beta_preferences_log_sd),
            ("beta_critiques_log_sd", self.beta_critiques_log_sd),
            ("beta_progress_log_sd", self.beta_progress_log_sd),
        ];
        match all.iter().find(|(_, log_sd)| *log_sd > 0.0 && *log_sd < LEAST_LOG_SD) {
            Some((name, got)) => {
                Err(format!("{name} is {got}; 0 fixes its beta, and {LEAST_LOG_SD} is the least that learns it"))
            }
            None => Ok(()),
        }
    }

    fn seed(&self) -> u64 {
        self.seed.unsigned_abs()
    }
}

impl Settings {
    /// The prior over the weights.
    pub(crate) fn prior(&self) -> posterior::Prior {
        match self.prior {
            Prior::L1Sphere => posterior::Prior::L1Sphere,
            Prior::L2Sphere => posterior::Prior::L2Sphere,
            Prior::Gaussian => posterior::Prior::Gaussian { scale: self.prior_scale },
            Prior::Laplace => posterior::Prior::Laplace { scale: self.prior_scale },
        }
    }

    /// How to sample.
    pub(crate) fn run(&self) -> Run {
        let cores = || std::thread::available_parallelism().map_or(1, std::num::NonZero::get);
        let threads = if self.threads > 0 { count(self.threads) } else { cores() };
        Run {
            n_draws: count(self.n_draws),
            n_chains: count(self.n_chains),
            warmup: count(self.warmup),
            threads: threads.min(*THREADS_RANGE.end()),
        }
    }

    /// β of one kind of evidence.
    pub(crate) fn rationality(&self, kind: EvidenceKind) -> Rationality {
        let (median, log_sd) = match kind {
            EvidenceKind::Placements => (self.beta, self.beta_log_sd),
            EvidenceKind::Actions => (self.beta_actions, self.beta_actions_log_sd),
            EvidenceKind::Preferences => (self.beta_preferences, self.beta_preferences_log_sd),
            EvidenceKind::Critiques => (self.beta_critiques, self.beta_critiques_log_sd),
            EvidenceKind::Progress => (self.beta_progress, self.beta_progress_log_sd),
        };
        if log_sd > 0.0 { Rationality::Learned { median, log_sd } } else { Rationality::Fixed(median) }
    }

    /// Share of answers of one kind taken to be given at random.
    pub(crate) fn wrong_rate(&self, kind: EvidenceKind) -> f64 {
        match kind {
            EvidenceKind::Placements => 0.0,
            EvidenceKind::Actions => self.wrong_rate_actions,
            EvidenceKind::Preferences => self.wrong_rate_preferences,
            EvidenceKind::Critiques => self.wrong_rate_critiques,
            EvidenceKind::Progress => self.wrong_rate_progress,
        }
    }

    /// How preferences come about.
    pub(crate) fn preferences(&self) -> AnswerModel {
        AnswerModel {
            equal_threshold: self.equal_threshold,
            cant_tell: self.cant_tell,
            wrong_rate: self.wrong_rate_preferences,
        }
    }

    /// How the order of a learner's attempts comes about.
    pub(crate) fn progress(&self) -> AnswerModel {
        AnswerModel { wrong_rate: self.wrong_rate_progress, ..AnswerModel::default() }
    }

    /// Factor on β for an answer that is sure, fairly sure, a guess.
    pub(crate) fn confidence_factors(&self) -> [f64; 3] {
        [1.0, self.fairly_factor, self.guess_factor]
    }

    /// Cells per axis of the grid on which the likelihood of placements is normalised.
    pub(crate) fn grid_side(&self) -> usize {
        count(self.grid_side)
    }

    /// Draws of a preview.
    pub(crate) fn preview_draws(&self) -> usize {
        count(self.preview_draws)
    }
}

fn count(n: i64) -> usize {
    usize::try_from(n).unwrap_or(0)
}
