//! Entropic risk: the certainty equivalent of an exponential disutility.

use crate::distribution::Distribution;

/// (1/θ) ln E exp(θX), θ > 0, without overflow for large θ or cancellation for small.
pub(super) fn entropic_risk(loss: &Distribution, aversion: f64) -> f64 {
    let (mean, largest) = (loss.mean(), loss.largest());
    if aversion * (largest - mean) < 1.0 {
        let growth: f64 = loss.points().map(|(x, mass)| mass * libm::expm1(aversion * (x - mean))).sum();
        return mean + libm::log1p(growth) / aversion;
    }
    let scaled: f64 = loss.points().map(|(x, mass)| mass * libm::exp(aversion * (x - largest))).sum();
    largest + libm::log(scaled) / aversion
}
