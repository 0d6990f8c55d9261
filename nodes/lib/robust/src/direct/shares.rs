//! From the solver's multipliers to a distribution over draws.

use super::active::Active;
use crate::level::Level;
use crate::scenarios::Scenarios;

/// The distribution q over all N draws, with q_i ≤ p_i / (1 − α), that the `duals` of the active draws stand for. What rounding
/// leaves of it goes to the draws lowest in `values`: any such q bounds the objective of every policy.
pub(super) fn tail_shares(
    scenarios: &Scenarios,
    active: &Active,
    level: Level,
    duals: &[f64],
    values: &[f64],
) -> Vec<f64> {
    if level.is_neutral() {
        return scenarios.masses.clone();
    }
    let held = |i: usize| level.held(scenarios.masses[i]);
    let mut shares = vec![0.0; scenarios.n()];
    let total: f64 = active.draws.iter().zip(duals).map(|(_, dual)| dual.max(0.0)).sum();
    for (&i, dual) in active.draws.iter().zip(duals).filter(|(_, dual)| **dual > 0.0) {
        shares[i as usize] = (dual / total).min(held(i as usize));
    }
    let mut missing = 1.0 - shares.iter().sum::<f64>();
    let mut order: Vec<usize> = (0..shares.len()).collect();
    order.sort_unstable_by(|&i, &j| values[i].total_cmp(&values[j]).then(i.cmp(&j)));
    for i in order {
        if missing <= 0.0 {
            break;
        }
        let added = missing.min(held(i) - shares[i]).max(0.0);
        shares[i] += added;
        missing -= added;
    }
    shares
}
