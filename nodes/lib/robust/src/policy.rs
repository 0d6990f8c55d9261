//! From visits to a policy and to feature counts.

use mdp::Mdp;

/// π(a|s) = u(s, a) / Σ u(s, ·) of S × A visits, S × A; those below `noise` of their state's visits count as none. Where
/// hardly any visit is made, as a share of all, the policy takes `otherwise`, one action per state, or any action equally
/// often.
pub(crate) fn policy_of(occupancy: &[f64], n_actions: usize, otherwise: Option<&[u32]>, noise: f64) -> Vec<f64> {
    let all: f64 = occupancy.iter().sum();
    let mut policy = vec![0.0; occupancy.len()];
    for (state, (policy, visits)) in policy.chunks_mut(n_actions).zip(occupancy.chunks(n_actions)).enumerate() {
        let total: f64 = visits.iter().sum();
        if total <= UNVISITED * all {
            match otherwise {
                Some(actions) => policy[actions[state] as usize] = 1.0,
                None => policy.fill(1.0 / n_actions as f64),
            }
            continue;
        }
        let counts = |u: f64| if u > noise * total { u } else { 0.0 };
        let kept: f64 = visits.iter().map(|u| counts(*u)).sum();
        policy.iter_mut().zip(visits).for_each(|(p, u)| *p = counts(*u) / kept);
    }
    policy
}

/// Visits of a state up to this share of all visits are none.
pub(crate) const UNVISITED: f64 = 1e-12;

/// Φᵀu: k numbers.
pub(crate) fn counts_of(mdp: &Mdp, occupancy: &[f64]) -> Vec<f64> {
    let mut counts = vec![0.0; mdp.n_features()];
    for (row, u) in occupancy.iter().enumerate().filter(|(_, u)| **u != 0.0) {
        let phi = mdp.features(row / mdp.n_actions(), row % mdp.n_actions());
        counts.iter_mut().zip(phi).for_each(|(sum, phi)| *sum += u * phi);
    }
    counts
}
