//! ψ of a policy under every draw, in the order of the draws.

use mdp::Mdp;

use crate::error::{RobustError, check_length, check_numbers};
use crate::objective::Objective;
use crate::scenarios::{check_draws, offsets};

/// ψ of a policy with feature counts μ (k numbers) under each of N `draws` (N × k, row by row): N numbers. `threads` serve
/// [`Objective::Loss`].
///
/// # Errors
/// As [`crate::Problem::new`]; counts of the wrong number or not finite.
pub fn performance(
    mdp: &Mdp,
    draws: &[f64],
    objective: Objective<'_>,
    feature_counts: &[f64],
    threads: usize,
) -> Result<Vec<f64>, RobustError> {
    check_draws(mdp, draws, objective)?;
    check_length("feature counts", feature_counts.len(), mdp.n_features(), "one per feature")?;
    check_numbers("feature counts", feature_counts)?;
    let offsets = offsets(mdp, draws, objective, threads);
    let returns = draws.chunks(mdp.n_features()).map(|w| crate::scenarios::dot(w, feature_counts));
    Ok(returns.zip(offsets).map(|(value, offset)| value - offset).collect())
}
