//! Policy improvement by hill climbing (dissertation section 4.5.5): one action in one state at a time, whatever is to be
//! made small.

use crate::MdpError;
use crate::evaluate::{feature_counts, occupancy, successor_features};
use crate::linear::Chain;
use crate::model::Mdp;
use crate::policy::Policy;

/// Improvements below this share of the objective are rounding.
const ROUNDING: f64 = 1e-12;

/// Where hill climbing ended.
#[derive(Debug, Clone, PartialEq)]
pub struct Improvement {
    /// The policy no single change improves.
    pub policy: Policy,
    /// Its expected feature counts: k numbers.
    pub feature_counts: Vec<f64>,
    /// Its objective.
    pub objective: f64,
    /// Changes made to the start.
    pub n_changes: usize,
}

/// Changes `start` in the single state and to the single action that make `objective`, a function of expected feature
/// counts, smallest, again and again until no change makes it smaller or `max_changes` were made.
///
/// A change alters feature counts by a multiple of one vector, so each costs O(k) after one set of equations per policy.
/// In a stochastic policy a changed state becomes deterministic.
///
/// # Errors
/// A start that is not a policy of `mdp`; an objective that is NaN or infinite at the start.
pub fn improve_policy(
    mdp: &Mdp,
    start: &Policy,
    max_changes: usize,
    mut objective: impl FnMut(&[f64]) -> f64,
) -> Result<Improvement, MdpError> {
    let mut counts = feature_counts(mdp, start)?;
    let mut best = objective(&counts);
    if !best.is_finite() {
        return Err(MdpError::NotFinite { name: "objective of the start", index: 0, got: best });
    }
    let mut policy = start.clone();
    let mut n_changes = 0;
    while n_changes < max_changes {
        let mut step: Option<(usize, usize, f64)> = None;
        for_each_change(mdp, &policy, &counts, |state, action, changed| {
            let value = objective(changed);
            if value < step.map_or(best, |(_, _, value)| value) - ROUNDING * best.abs() {
                step = Some((state, action, value));
            }
        })?;
        let Some((state, action, _)) = step else { break };
        let changed = policy.with_action(mdp.n_actions(), state, action);
        let exact = feature_counts(mdp, &changed)?;
        let value = objective(&exact);
        // What looked better by rounding alone would be changed to and fro for ever.
        if value >= best {
            break;
        }
        (policy, counts, best) = (changed, exact, value);
        n_changes += 1;
    }
    Ok(Improvement { policy, feature_counts: counts, objective: best, n_changes })
}

/// Calls `f` with every state that is ever visited, every other action and the feature counts after that change.
fn for_each_change(
    mdp: &Mdp,
    policy: &Policy,
    counts: &[f64],
    mut f: impl FnMut(usize, usize, &[f64]),
) -> Result<(), MdpError> {
    let (n, n_actions, k) = (mdp.n_states(), mdp.n_actions(), mdp.n_features());
    let psi = successor_features(mdp, policy)?;
    let visits = occupancy(mdp, policy)?;
    let chain = Chain::new(mdp, policy, 1);
    let mut changed = vec![0.0; k];
    for state in 0..n {
        let visits: f64 = visits[state * n_actions..][..n_actions].iter().sum();
        if visits <= 0.0 {
            continue;
        }
        // Expected visits of this state from every other one.
        let mut column = vec![0.0; n];
        column[state] = 1.0;
        chain.solve(&mut column, 1)?;
        for action in 0..n_actions {
            if policy.probability(n_actions, state, action) == 1.0 {
                continue;
            }
            // ψ(s, a) − Ψ(s) is gained at each visit; after it, the state is visited again that much more or less often.
            let mut again = 1.0 - column[state];
            changed.copy_from_slice(mdp.features(state, action));
            for (target, p) in mdp.successors(state, action) {
                let weight = mdp.gamma() * p;
                again += weight * column[target];
                for (sum, psi) in changed.iter_mut().zip(&psi[target * k..][..k]) {
                    *sum += weight * psi;
                }
            }
            let scale = visits / (1.0 - again);
            for ((changed, psi), count) in changed.iter_mut().zip(&psi[state * k..][..k]).zip(counts) {
                *changed = count + scale * (*changed - psi);
            }
            f(state, action, &changed);
        }
    }
    Ok(())
}
