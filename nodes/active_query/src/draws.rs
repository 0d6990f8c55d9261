//! Which of a posterior's draws questions are chosen by and answers are held against, and how rational answers are under each.

use apprentice_msgs::msg::Posterior;

/// So many, at most: evenly spaced ones.
pub(crate) const SCORED: usize = 200;

/// Numbers of `n` evenly spaced draws among `n_draws`.
pub(crate) fn evenly_spaced(n: usize, n_draws: usize) -> Vec<usize> {
    (0..n).map(|i| i * n_draws / n).collect()
}

/// Their weights, row by row.
pub(crate) fn weights_of(posterior: &Posterior, chosen: &[usize]) -> Vec<f64> {
    let k = posterior.feature_names.len();
    chosen.iter().flat_map(|draw| &posterior.draws[draw * k..][..k]).map(|w| f64::from(*w)).collect()
}

/// How rational answers of a kind are by the posterior, for all draws or for each of those chosen, and their rate of wrong ones.
pub(crate) fn rationality(posterior: &Posterior, chosen: &[usize], kind: &str) -> (Vec<f64>, f64) {
    let of = posterior.rationalities.iter().find(|of| of.kind == kind);
    let usable = |beta: f64| if beta > 0.0 && beta.is_finite() { beta } else { 1.0 };
    let wrong_rate = of.map(|of| of.wrong_rate).filter(|rate| (0.0..1.0).contains(rate)).unwrap_or(0.0);
    let n_learned = posterior.learned_kinds.len();
    let betas = match posterior.learned_kinds.iter().position(|learned| learned == kind) {
        Some(at) => {
            let beta = |draw: &usize| posterior.learned_betas.get(draw * n_learned + at).copied().unwrap_or(f32::NAN);
            chosen.iter().map(|draw| usable(f64::from(beta(draw)))).collect()
        }
        None => vec![usable(of.map_or(f64::NAN, |of| of.mean))],
    };
    (betas, wrong_rate)
}

/// Pieces of evidence of a kind that are in force.
pub(crate) fn n_of(posterior: &Posterior, kind: &str) -> u64 {
    posterior.rationalities.iter().find(|of| of.kind == kind).map_or(0, |of| of.n)
}
