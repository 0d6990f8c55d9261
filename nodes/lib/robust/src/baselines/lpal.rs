//! Apprenticeship by linear programming (Syed, Bowling and Schapire 2008; dissertation section F.4): the policy that beats an
//! expert by most under the worst reward with ‖w‖₁ ≤ 1.
//!
//! The worst reward is one of the vertices e_j (and −e_j), so this is the robust problem with those as draws and the tail so
//! thin that it is the worst draw alone.

use mdp::{Mdp, Policy};

use crate::error::RobustError;
use crate::objective::Objective;
use crate::outcome::{Method, Outcome, SolverStatus};
use crate::problem::Problem;
use crate::settings::Settings;
use crate::solution::{Checks, Solution};

/// What is known of the signs of the weights.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Signs {
    /// Every feature is good: w ≥ 0 (eq. F.6). The margin is min_j (μ − μ_E)_j.
    Positive,
    /// Nothing. The margin is −‖μ − μ_E‖∞ (eq. F.17). As printed, the programs F.8, F.9 and F.18 force all features to the same
    /// difference from the expert's; meant is B ≥ ±(μ − μ_E)_j.
    Unknown,
}

/// The policy and how well it does.
#[derive(Debug, Clone, PartialEq)]
pub struct Lpal {
    /// What the policy is known to be.
    pub outcome: Outcome,
    /// π: stochastic, S × A; uniform in states that it never visits.
    pub policy: Policy,
    /// u, its discounted visits: S × A.
    pub occupancy: Vec<f64>,
    /// States that it never visits, ascending.
    pub unvisited: Vec<usize>,
    /// μ = Φᵀu: k numbers.
    pub feature_counts: Vec<f64>,
    /// B: return above the expert's under the worst reward.
    pub margin: f64,
    /// No policy has a larger margin.
    pub upper_bound: f64,
    /// Who found it.
    pub method: Method,
    /// What the solver said last.
    pub status: SolverStatus,
    /// How well the constraints hold.
    pub checks: Checks,
}

/// The policy of largest margin over `expert`, its feature counts μ̂_E (k numbers).
///
/// # Errors
/// Counts of the wrong number or not finite; settings out of range.
pub fn lpal(mdp: &Mdp, expert: &[f64], signs: Signs, settings: &Settings) -> Result<Lpal, RobustError> {
    let k = mdp.n_features();
    let signs: &[f64] = match signs {
        Signs::Positive => &[1.0],
        Signs::Unknown => &[1.0, -1.0],
    };
    let n = k * signs.len();
    let mut draws = vec![0.0; n * k];
    for (row, draw) in draws.chunks_mut(k).enumerate() {
        draw[row % k] = signs[row / k];
    }
    let problem = Problem::new(mdp, &draws, None, Objective::Regret { expert }, 1)?.with_uniform_rest();
    let solution = problem.solve(1.0 - 1.0 / n as f64, 0.0, settings)?;
    let Solution { outcome, policy, occupancy, unvisited, feature_counts, .. } = solution;
    let Solution { objective: margin, upper_bound, method, status, checks, .. } = solution;
    Ok(Lpal { outcome, policy, occupancy, unvisited, feature_counts, margin, upper_bound, method, status, checks })
}
