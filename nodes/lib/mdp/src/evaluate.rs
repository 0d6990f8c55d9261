//! What a given policy is worth: successor features, discounted visits, feature counts and values.

use crate::MdpError;
use crate::error::check_weights;
use crate::linear::Chain;
use crate::model::Mdp;
use crate::policy::Policy;

/// Successor features Ψ(s) = E[Σ_t γᵗ φ(s_t, a_t) | s_0 = s, π]: S × k, row by row. They solve Ψ = φ_π + γ P_π Ψ.
///
/// # Errors
/// A policy that is not one of `mdp`; a horizon too long for so large a process.
pub fn successor_features(mdp: &Mdp, policy: &Policy) -> Result<Vec<f64>, MdpError> {
    policy.check(mdp)?;
    let k = mdp.n_features();
    let mut psi = vec![0.0; mdp.n_states() * k];
    for (state, row) in psi.chunks_mut(k).enumerate() {
        policy.for_each_action(mdp.n_actions(), state, |action, p| {
            for (sum, phi) in row.iter_mut().zip(mdp.features(state, action)) {
                *sum += p * phi;
            }
        });
    }
    Chain::new(mdp, policy, k).solve(&mut psi, k)?;
    Ok(psi)
}

/// Discounted visits u(s, a) = E[Σ_t γᵗ I(s_t = s, a_t = a)] over the initial distribution: S × A, row by row. Without
/// terminal states they sum to 1 / (1 − γ).
///
/// # Errors
/// A policy that is not one of `mdp`.
pub fn occupancy(mdp: &Mdp, policy: &Policy) -> Result<Vec<f64>, MdpError> {
    let n_actions = mdp.n_actions();
    let visits = state_visits(mdp, policy)?;
    let mut occupancy = vec![0.0; mdp.n_states() * n_actions];
    for (state, (row, visits)) in occupancy.chunks_mut(n_actions).zip(visits).enumerate() {
        policy.for_each_action(n_actions, state, |action, p| row[action] = p * visits);
    }
    Ok(occupancy)
}

/// Discounted visits E[Σ_t γᵗ I(s_t = s)] over the initial distribution: S numbers.
///
/// # Errors
/// A policy that is not one of `mdp`.
pub(crate) fn state_visits(mdp: &Mdp, policy: &Policy) -> Result<Vec<f64>, MdpError> {
    policy.check(mdp)?;
    let mut visits = mdp.initial().to_vec();
    Chain::new(mdp, policy, 1).visits(&mut visits);
    Ok(visits)
}

/// Expected feature counts Φ(π) = E[Σ_t γᵗ φ(s_t, a_t)] over the initial distribution (dissertation eq. 3.2): k numbers.
///
/// # Errors
/// A policy that is not one of `mdp`.
pub fn feature_counts(mdp: &Mdp, policy: &Policy) -> Result<Vec<f64>, MdpError> {
    let occupancy = occupancy(mdp, policy)?;
    let mut counts = vec![0.0; mdp.n_features()];
    for (state, row) in occupancy.chunks(mdp.n_actions()).enumerate() {
        for (action, visits) in row.iter().enumerate().filter(|(_, visits)| **visits != 0.0) {
            for (count, phi) in counts.iter_mut().zip(mdp.features(state, action)) {
                *count += visits * phi;
            }
        }
    }
    Ok(counts)
}

/// V^π(s) = E[Σ_t γᵗ wᵀφ(s_t, a_t) | s_0 = s, π]: S numbers.
///
/// # Errors
/// A policy that is not one of `mdp`; weights of the wrong number or not finite; a horizon too long for so large a process.
pub fn values(mdp: &Mdp, policy: &Policy, w: &[f64]) -> Result<Vec<f64>, MdpError> {
    policy.check(mdp)?;
    check_weights(w, mdp.n_features())?;
    let mut values = vec![0.0; mdp.n_states()];
    for (state, value) in values.iter_mut().enumerate() {
        policy.for_each_action(mdp.n_actions(), state, |action, p| {
            let reward: f64 = mdp.features(state, action).iter().zip(w).map(|(phi, w)| phi * w).sum();
            *value += p * reward;
        });
    }
    Chain::new(mdp, policy, 1).solve(&mut values, 1)?;
    Ok(values)
}
