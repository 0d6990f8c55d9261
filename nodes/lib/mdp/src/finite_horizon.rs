//! Finite horizons, discounted or not: optimal policies by backward induction, values and feature counts.
//!
//! Return = Σ_t γᵗ wᵀφ(s_t, a_t) over t = 0 … T − 1. A terminal state's features count once, as everywhere.

use crate::error::{MdpError, check_weights};
use crate::limits::MAX_NUMBERS;
use crate::model::Mdp;
use crate::policy::Policy;

/// Actions whose values differ by less than this share of the largest possible value tie.
const TIE: f64 = 1e-11;

/// An optimal policy for every step, and what it is worth.
#[derive(Debug, Clone, PartialEq)]
pub struct FiniteOptimum {
    n_states: usize,
    /// T × S.
    actions: Vec<u32>,
    /// T × S.
    values: Vec<f64>,
    feature_counts: Vec<f64>,
}

impl FiniteOptimum {
    /// Steps T.
    pub fn horizon(&self) -> usize {
        self.actions.len() / self.n_states
    }

    /// The optimal action in `state` at `step` (from 0); the first of those that tie.
    pub fn action(&self, step: usize, state: usize) -> usize {
        self.actions[step * self.n_states + state] as usize
    }

    /// The optimal return from `step` (from 0) on, discounted to that step.
    pub fn state_value(&self, step: usize, state: usize) -> f64 {
        self.values[step * self.n_states + state]
    }

    /// Expected feature counts over the initial distribution: k numbers.
    pub fn feature_counts(&self) -> &[f64] {
        &self.feature_counts
    }
}

/// The optimal policy over `horizon` steps under weights `w`, discounted by `discount` in [0, 1] instead of the discount
/// factor of `mdp`.
///
/// # Errors
/// Weights of the wrong number or not finite; a discount out of range; a horizon of 0, or too long to write down.
pub fn finite_optimum(mdp: &Mdp, w: &[f64], horizon: usize, discount: f64) -> Result<FiniteOptimum, MdpError> {
    check_weights(w, mdp.n_features())?;
    check_horizon(horizon, discount)?;
    let n = mdp.n_states();
    let numbers = n as u128 * horizon as u128;
    if numbers > MAX_NUMBERS as u128 {
        return Err(MdpError::TooLarge { name: "n_states × horizon", got: numbers, most: MAX_NUMBERS });
    }
    let rewards = reward_table(mdp, w);
    let largest = rewards.iter().fold(0.0_f64, |most, reward| most.max(reward.abs()));
    let mut actions = vec![0; n * horizon];
    let mut values = vec![0.0; n * horizon];
    let mut q = vec![0.0; mdp.n_actions()];
    for step in (0..horizon).rev() {
        let (now, later) = values[step * n..].split_at_mut(n);
        let tie = TIE * largest * (horizon - step) as f64;
        for state in 0..n {
            for (action, q) in q.iter_mut().enumerate() {
                *q = rewards[state * mdp.n_actions() + action];
                if step + 1 < horizon {
                    *q += discount * mdp.successors(state, action).map(|(target, p)| p * later[target]).sum::<f64>();
                }
            }
            let best = q.iter().copied().fold(f64::NEG_INFINITY, f64::max);
            now[state] = best;
            actions[step * n + state] = q.iter().position(|q| *q >= best - tie).unwrap_or(0) as u32;
        }
    }
    let action = |step: usize, state: usize, f: &mut dyn FnMut(usize, f64)| f(actions[step * n + state] as usize, 1.0);
    let feature_counts = counts(mdp, horizon, discount, action);
    Ok(FiniteOptimum { n_states: n, actions, values, feature_counts })
}

/// V(s) of a policy, the same at each of `horizon` steps: S numbers.
///
/// # Errors
/// A policy that is not one of `mdp`; weights of the wrong number or not finite; a discount out of range; a horizon of 0.
pub fn finite_values(
    mdp: &Mdp,
    policy: &Policy,
    w: &[f64],
    horizon: usize,
    discount: f64,
) -> Result<Vec<f64>, MdpError> {
    policy.check(mdp)?;
    check_weights(w, mdp.n_features())?;
    check_horizon(horizon, discount)?;
    let rewards = reward_table(mdp, w);
    let mut later = vec![0.0; mdp.n_states()];
    let mut now = later.clone();
    for _ in 0..horizon {
        for (state, now) in now.iter_mut().enumerate() {
            *now = 0.0;
            policy.for_each_action(mdp.n_actions(), state, |action, share| {
                let next: f64 = mdp.successors(state, action).map(|(target, p)| p * later[target]).sum();
                *now += share * (rewards[state * mdp.n_actions() + action] + discount * next);
            });
        }
        std::mem::swap(&mut now, &mut later);
    }
    Ok(later)
}

/// Expected feature counts over the initial distribution of a policy, the same at each of `horizon` steps: k numbers.
///
/// # Errors
/// A policy that is not one of `mdp`; a discount out of range; a horizon of 0.
pub fn finite_feature_counts(mdp: &Mdp, policy: &Policy, horizon: usize, discount: f64) -> Result<Vec<f64>, MdpError> {
    policy.check(mdp)?;
    check_horizon(horizon, discount)?;
    Ok(counts(mdp, horizon, discount, |_, state, f| policy.for_each_action(mdp.n_actions(), state, f)))
}

fn check_horizon(horizon: usize, discount: f64) -> Result<(), MdpError> {
    if horizon == 0 {
        return Err(MdpError::Zero { name: "horizon" });
    }
    if !(0.0..=1.0).contains(&discount) {
        return Err(MdpError::Discount { got: discount });
    }
    Ok(())
}

/// wᵀφ(s, a): S × A.
fn reward_table(mdp: &Mdp, w: &[f64]) -> Vec<f64> {
    let reward = |state, action| mdp.features(state, action).iter().zip(w).map(|(phi, w)| phi * w).sum::<f64>();
    (0..mdp.n_states()).flat_map(|state| (0..mdp.n_actions()).map(move |action| reward(state, action))).collect()
}

/// Follows the distribution of states forwards; `actions` calls back with each action of a step and state and its share.
fn counts(
    mdp: &Mdp,
    horizon: usize,
    discount: f64,
    actions: impl Fn(usize, usize, &mut dyn FnMut(usize, f64)),
) -> Vec<f64> {
    let mut counts = vec![0.0; mdp.n_features()];
    let mut here = mdp.initial().to_vec();
    let mut next = vec![0.0; mdp.n_states()];
    for step in 0..horizon {
        next.fill(0.0);
        for (state, &mass) in here.iter().enumerate().filter(|(_, mass)| **mass > 0.0) {
            actions(step, state, &mut |action, share| {
                for (count, phi) in counts.iter_mut().zip(mdp.features(state, action)) {
                    *count += mass * share * phi;
                }
                for (target, p) in mdp.successors(state, action) {
                    next[target] += discount * mass * share * p;
                }
            });
        }
        std::mem::swap(&mut here, &mut next);
    }
    counts
}
