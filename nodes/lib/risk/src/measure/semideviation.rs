//! Mean plus upper semideviation: what exceeds the mean counts more.

use crate::distribution::Distribution;

/// E X + c E (X − E X)₊, c in [0, 1].
pub(super) fn mean_semideviation(loss: &Distribution, coefficient: f64) -> f64 {
    let mean = loss.mean();
    let above: f64 = loss.points().filter(|&(x, _)| x > mean).map(|(x, mass)| mass * (x - mean)).sum();
    mean + coefficient * above
}
