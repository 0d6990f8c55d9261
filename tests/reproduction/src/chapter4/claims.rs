//! That bounds hold as often as they promise.

use super::{ALPHAS, BoundKind, Judged, accuracy};
use crate::harness::{Claim, least_successes};

/// The claim that the bounds on the value at risk at every level α hold at least as often as α says, in every column, within what
/// so many replicates can tell.
pub fn at_least_alpha(claim: &str, columns: &[Vec<Judged>], make: fn(String, bool, String) -> Claim) -> Claim {
    let mut held = true;
    let mut found = Vec::new();
    for (i, alpha) in ALPHAS.into_iter().enumerate() {
        let accuracies: Vec<_> = columns.iter().map(|judged| accuracy(judged, BoundKind::ValueAtRisk(i))).collect();
        held &= accuracies
            .iter()
            .all(|accuracy| (accuracy.mean * accuracy.n as f64).round() as usize >= least_successes(accuracy.n, alpha));
        let least = accuracies.iter().map(|accuracy| accuracy.mean).fold(f64::INFINITY, f64::min);
        let n = columns.first().map_or(0, Vec::len);
        found.push(format!("{alpha:.2}: least {least:.3}, at least {} of {n} must hold", least_successes(n, alpha)));
    }
    make(claim.to_owned(), held, found.join("; "))
}
