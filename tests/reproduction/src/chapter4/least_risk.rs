//! The policy with the least risk under a posterior, among all or among a few: what a bound on the loss is good for.

use crate::harness::sum_in_order;
use mdp::{Mdp, Solver};
use risk::Tail;

/// Steps of the descent; the risk changes by less than a thousandth of itself after half as many.
const STEPS: usize = 200;

/// Feature counts of the mixture of policies whose α-value at risk over `draws` (row-major) is smallest along a descent of its
/// conditional value at risk, which is convex in Φ.
///
/// Frank–Wolfe: the conditional value at risk of V*_w − wᵀΦ falls fastest towards the policy that is optimal under the mean of the
/// weights in the tail. A mixture chooses one of its policies at the start, and has the mean of their feature counts.
pub fn least_risk_counts(mdp: &Mdp, draws: &[f64], alpha: f64) -> Vec<f64> {
    let k = mdp.n_features();
    let best_values = optimal_values(mdp, draws);
    let n = best_values.len();
    let n_tail = (((1.0 - alpha) * n as f64) as usize).clamp(1, n);
    let mut solver = Solver::new(mdp);
    let mut counts = solver.solve(&mean(draws, k, 0..n)).feature_counts().to_vec();
    let mut best = (f64::INFINITY, counts.clone());
    let mut order: Vec<usize> = (0..n).collect();
    for step in 0..STEPS {
        let losses = losses(&best_values, draws, &counts);
        // Equal losses in the order of the draws.
        order.sort_unstable_by(|&a, &b| losses[b].total_cmp(&losses[a]).then(a.cmp(&b)));
        let value_at_risk = losses[order[n_tail - 1]];
        if value_at_risk < best.0 {
            best = (value_at_risk, counts.clone());
        }
        let towards = solver.solve(&mean(draws, k, order[..n_tail].iter().copied())).feature_counts();
        let share = 1.0 / (step as f64 + 2.0);
        for (count, towards) in counts.iter_mut().zip(towards) {
            *count += share * (towards - *count);
        }
    }
    best.1
}

/// Of `candidates`, feature counts of policies, those with the smallest α-value at risk over `draws`; the first of equals.
pub fn safest_counts<'a>(mdp: &Mdp, draws: &[f64], alpha: f64, candidates: &'a [Vec<f64>]) -> &'a [f64] {
    let best_values = optimal_values(mdp, draws);
    let mut best: Option<(f64, &[f64])> = None;
    for counts in candidates {
        let mut losses = losses(&best_values, draws, counts);
        losses.sort_unstable_by(f64::total_cmp);
        let value_at_risk = risk::value_at_risk(&losses, alpha, Tail::Upper).unwrap_or(f64::INFINITY);
        if best.is_none_or(|(least, _)| value_at_risk < least) {
            best = Some((value_at_risk, counts));
        }
    }
    best.expect("there is a policy to choose").1
}

/// V*_w of every draw.
pub fn optimal_values(mdp: &Mdp, draws: &[f64]) -> Vec<f64> {
    let mut solver = Solver::new(mdp);
    draws.chunks_exact(mdp.n_features()).map(|w| solver.solve(w).value()).collect()
}

/// V*_w − wᵀΦ of every draw.
fn losses(best_values: &[f64], draws: &[f64], counts: &[f64]) -> Vec<f64> {
    let of = |(value, w): (&f64, &[f64])| value - w.iter().zip(counts).fold(0.0, |sum, (w, phi)| sum + w * phi);
    best_values.iter().zip(draws.chunks_exact(counts.len())).map(of).collect()
}

/// Mean weights of some draws.
fn mean(draws: &[f64], k: usize, which: impl Iterator<Item = usize> + Clone) -> Vec<f64> {
    let n = which.clone().count() as f64;
    let of = |j: usize| sum_in_order(&which.clone().map(|i| draws[i * k + j]).collect::<Vec<f64>>()) / n;
    (0..k).map(of).collect()
}
