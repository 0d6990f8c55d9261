//! Conditional value at risk of a weighted distribution.

use crate::distribution::Distribution;

/// VaR_α + E (X − VaR_α)₊ / (1 − α) (Rockafellar and Uryasev 2002, theorem 10): the mean of the worst share 1 − α, the value
/// at its edge counted in part.
pub(super) fn conditional_value_at_risk(loss: &Distribution, alpha: f64) -> f64 {
    let edge = loss.quantile(alpha);
    let excess: f64 = loss.points().filter(|&(x, _)| x > edge).map(|(x, mass)| mass * (x - edge)).sum();
    // Rounding of a share near 0 must not lead past the largest value.
    (edge + excess / (1.0 - alpha)).min(loss.largest())
}
