//! The optimal policy for one guess of the reward, and hill climbing from it.

use mdp::{Improvement, Mdp, Policy, Solver, improve_policy};

use crate::error::{RobustError, check_length, check_numbers};
use crate::planner::optimum;
use crate::problem::Problem;

/// A policy and its feature counts.
#[derive(Debug, Clone, PartialEq)]
pub struct Baseline {
    /// The policy.
    pub policy: Policy,
    /// μ: k numbers.
    pub feature_counts: Vec<f64>,
}

/// The optimal policy for `weights` (k numbers): the posterior's mean ([`Problem::mean_weights`]) or its most probable draw.
///
/// # Errors
/// Weights of the wrong number or not finite.
pub fn optimal_policy(mdp: &Mdp, weights: &[f64]) -> Result<Baseline, RobustError> {
    check_length("weights", weights.len(), mdp.n_features(), "one per feature")?;
    check_numbers("weights", weights)?;
    Ok(optimum(mdp, &mut Solver::new(mdp), weights, 0.0, |optimum| Baseline {
        policy: Policy::Deterministic(optimum.policy().to_vec()),
        feature_counts: optimum.feature_counts().to_vec(),
    }))
}

/// Hill climbing on VaR_α(ψ) from `start`, one action in one state at a time (dissertation section 4.5.5, where ψ is that of
/// [`crate::Objective::Loss`]), until no change makes it larger or `max_changes` were made. The objective of the result is
/// −VaR_α(ψ).
///
/// # Errors
/// α outside [0, 1); a start that is not a policy of the process.
pub fn climb_value_at_risk(
    mdp: &Mdp,
    problem: &Problem<'_>,
    start: &Policy,
    alpha: f64,
    max_changes: usize,
) -> Result<Improvement, RobustError> {
    problem.risk(start, alpha, 0.0)?;
    let loss = |counts: &[f64]| problem.risk_of(counts, alpha, 0.0).map_or(f64::INFINITY, |risk| -risk.value_at_risk);
    Ok(improve_policy(mdp, start, max_changes, loss)?)
}
