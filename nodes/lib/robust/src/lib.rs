//! Robust policies from an uncertain reward (dissertation chapter 7 and appendix F).
//!
//! A [`Problem`] is a process, posterior draws of its reward weights and an [`Objective`] ψ. [`Problem::solve`] finds the policy
//! that maximises (1 − λ) CVaR_α(ψ) + λ E(return); [`Problem::frontier`] does for many λ. The answer is either the optimum, which
//! is proved by a bound that comes from planning and not from the solver that found it, or an [`Outcome`] that says what is
//! missing. Baselines: [`lpal`], [`max_entropy`], [`optimal_policy`], [`climb_value_at_risk`].

mod baselines;
mod candidate;
mod columns;
mod demonstrations;
mod direct;
mod error;
mod level;
mod objective;
mod out_of_sample;
mod outcome;
mod performance;
mod planner;
mod policy;
mod problem;
mod reachable;
mod scenarios;
mod settings;
mod solution;
mod tail;
mod value;
mod vertex;

pub use baselines::{
    Baseline, Convergence, Horizon, Lpal, MaxEntropy, MaxEntropySettings, Signs, WeightNorm, climb_value_at_risk, lpal,
    max_entropy, optimal_policy,
};
pub use demonstrations::expert_feature_counts;
pub use error::RobustError;
pub use objective::Objective;
pub use out_of_sample::{Bootstrap, OutOfSample, out_of_sample};
pub use outcome::{Method, Outcome, SolverStatus};
pub use performance::performance;
pub use problem::{MAX_POINTS, Problem, Risk};
pub use scenarios::{MAX_NUMBERS, WEIGHT_TOLERANCE};
pub use settings::{AUTOMATIC_ROUNDS, AUTOMATIC_STATES, MethodChoice, Settings};
pub use solution::{Checks, Solution};
