//! The projection algorithm as the author runs it, down to the policy that it ends with.

use crate::harness::ReproductionError;
use mdp::{Mdp, Policy, Solver, feature_counts};

/// Distance to the expert's feature counts at which it ends.
const NEAR: f64 = 0.001;
/// Most steps.
const MOST_STEPS: usize = 5000;

/// Feature counts of the policy found last on the way from `start` to the feature counts of an `expert`.
///
/// Each step goes to the point of the whole line through μ̄ and the newest policy that is nearest to the expert (Abbeel and Ng
/// 2004, section 3.1), which may lie beyond the policy and so be no mixture any more. `mdp::projection` stays within.
pub fn last_by_printed_projection(mdp: &Mdp, expert: &[f64], start: &Policy) -> Result<Vec<f64>, ReproductionError> {
    let mut mean = feature_counts(mdp, start)?;
    let mut solver = Solver::new(mdp);
    let mut newest = mean.clone();
    for _ in 0..=MOST_STEPS {
        let to_expert: Vec<f64> = expert.iter().zip(&mean).map(|(e, m)| e - m).collect();
        if to_expert.iter().map(|x| x * x).sum::<f64>() < NEAR * NEAR {
            break;
        }
        newest.copy_from_slice(solver.solve(&to_expert).feature_counts());
        let along: Vec<f64> = newest.iter().zip(&mean).map(|(n, m)| n - m).collect();
        let length: f64 = along.iter().map(|x| x * x).sum();
        if length == 0.0 {
            break;
        }
        let share = along.iter().zip(&to_expert).map(|(a, e)| a * e).sum::<f64>() / length;
        for (m, a) in mean.iter_mut().zip(&along) {
            *m += share * a;
        }
    }
    Ok(newest)
}
