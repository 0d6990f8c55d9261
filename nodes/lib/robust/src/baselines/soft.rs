//! Policies of maximum causal entropy for given weights (Ziebart, Bagnell and Dey 2010): soft value iteration.
//!
//! V(s) = ln Σ_a exp(θᵀφ(s, a) + d Σ P(s′|s, a) V(s′)) and π(a|s) ∝ exp of the same. Where transitions are deterministic, that is
//! P(ξ) ∝ exp(θᵀΦ(ξ)) over trajectories (dissertation eq. F.5, θ = βw).

use mdp::{Mdp, MdpError, Policy, feature_counts};

use crate::scenarios::dot;

/// Most sweeps over all states for one fixed point.
const MAX_SWEEPS: usize = 200_000;
/// Changes of values below this share of the largest are rounding.
const ROUNDING: f64 = 1e-14;

/// What weights θ make of a process.
#[derive(Debug, Clone)]
pub(super) struct Soft {
    /// Mean of V over the initial distribution.
    pub(super) value: f64,
    /// Its gradient by θ, the feature counts expected: k numbers.
    pub(super) counts: Vec<f64>,
    /// π(a|s) at the first step: S × A.
    pub(super) policy: Vec<f64>,
    /// Whether values came to rest.
    pub(super) settled: bool,
}

/// Over `steps` steps, undiscounted; fewer where a terminal state is reached.
pub(super) fn over_steps(mdp: &Mdp, theta: &[f64], steps: usize) -> Soft {
    let (n, n_actions) = (mdp.n_states(), mdp.n_actions());
    let rewards = rewards(mdp, theta);
    let mut values = vec![0.0; n];
    let mut next = vec![0.0; n];
    // Policies of every step, the last one first.
    let mut policies = vec![0.0; steps * n * n_actions];
    for policy in policies.chunks_mut(n * n_actions) {
        back_up(mdp, &rewards, 1.0, &values, &mut next, policy);
        std::mem::swap(&mut values, &mut next);
    }
    let mut counts = vec![0.0; mdp.n_features()];
    let mut at = mdp.initial().to_vec();
    for policy in policies.chunks(n * n_actions).rev() {
        let mut then = vec![0.0; n];
        for (state, &mass) in at.iter().enumerate().filter(|(_, mass)| **mass > 0.0) {
            for action in 0..n_actions {
                let mass = mass * policy[state * n_actions + action];
                counts.iter_mut().zip(mdp.features(state, action)).for_each(|(sum, phi)| *sum += mass * phi);
                for (target, p) in mdp.successors(state, action) {
                    then[target] += mass * p;
                }
            }
        }
        at = then;
    }
    let policy = policies[(steps - 1) * n * n_actions..].to_vec();
    Soft { value: dot(mdp.initial(), &values), counts, policy, settled: true }
}

/// Without an end, discounted by γ. `values` are where the search starts and where it ended.
///
/// # Errors
/// A process whose feature counts cannot be computed.
pub(super) fn discounted(mdp: &Mdp, theta: &[f64], values: &mut Vec<f64>) -> Result<Soft, MdpError> {
    let rewards = rewards(mdp, theta);
    let mut policy = vec![0.0; mdp.n_states() * mdp.n_actions()];
    let mut next = vec![0.0; mdp.n_states()];
    values.resize(mdp.n_states(), 0.0);
    let mut settled = false;
    for _ in 0..MAX_SWEEPS {
        back_up(mdp, &rewards, mdp.gamma(), values, &mut next, &mut policy);
        let change = next.iter().zip(&*values).fold(0.0_f64, |most, (x, y)| most.max((x - y).abs()));
        let size = next.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
        std::mem::swap(values, &mut next);
        if change <= ROUNDING * size {
            settled = true;
            break;
        }
    }
    let value = dot(mdp.initial(), values);
    let counts = feature_counts(mdp, &Policy::Stochastic(normalised(&policy, mdp.n_actions())))?;
    Ok(Soft { value, counts, policy, settled })
}

/// θᵀφ(s, a): S × A.
fn rewards(mdp: &Mdp, theta: &[f64]) -> Vec<f64> {
    let rows = 0..mdp.n_states() * mdp.n_actions();
    rows.map(|row| dot(theta, mdp.features(row / mdp.n_actions(), row % mdp.n_actions()))).collect()
}

/// One step back from `values` to `next`, and what to do in it.
fn back_up(mdp: &Mdp, rewards: &[f64], discount: f64, values: &[f64], next: &mut [f64], policy: &mut [f64]) {
    let n_actions = mdp.n_actions();
    for (state, (next, policy)) in next.iter_mut().zip(policy.chunks_mut(n_actions)).enumerate() {
        for (action, q) in policy.iter_mut().enumerate() {
            let ahead: f64 = mdp.successors(state, action).map(|(target, p)| p * values[target]).sum();
            *q = rewards[state * n_actions + action] + discount * ahead;
        }
        let most = policy.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        policy.iter_mut().for_each(|q| *q = libm::exp(*q - most));
        let total: f64 = policy.iter().sum();
        policy.iter_mut().for_each(|p| *p /= total);
        // There is no choice in a terminal state, so that its A equal actions are one.
        let choices = if mdp.is_terminal(state) { n_actions as f64 } else { 1.0 };
        *next = most + libm::log(total / choices);
    }
}

/// Rows that sum to 1 once more.
fn normalised(policy: &[f64], n_actions: usize) -> Vec<f64> {
    policy.chunks(n_actions).flat_map(|row| row.iter().map(|p| p / row.iter().sum::<f64>())).collect()
}
