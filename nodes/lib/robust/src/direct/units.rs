//! Units in which a program counts, so that its numbers are near 1.

use crate::scenarios::Scenarios;

/// Sizes outside are those of nothing.
const SIZES: std::ops::Range<f64> = 1e-200..1e200;

/// Feature counts are μ_ref + s ∘ v, returns are counted in `unit` and σ is σ_ref + unit · τ.
#[derive(Debug, Clone)]
pub(super) struct Units {
    /// μ_ref: k numbers.
    pub(super) reference: Vec<f64>,
    /// s: k numbers above 0.
    pub(super) scale: Vec<f64>,
    /// σ_ref.
    pub(super) edge: f64,
    /// Unit of returns.
    pub(super) unit: f64,
    /// Discounted visits, in all, that count as 1.
    pub(super) visits: f64,
}

impl Units {
    /// Units for feature counts within about `spread` (k numbers) of `reference`, where the value at risk is `edge`, after
    /// `visits` visits.
    pub(super) fn new(
        scenarios: &Scenarios,
        reference: Vec<f64>,
        mut spread: Vec<f64>,
        edge: f64,
        visits: f64,
    ) -> Self {
        spread.iter_mut().filter(|s| !SIZES.contains(*s)).for_each(|s| *s = 1.0);
        let size = |i: usize| scenarios.draw(i).iter().zip(&spread).map(|(w, s)| (w * s).abs()).sum::<f64>();
        let unit: f64 = scenarios.masses.iter().enumerate().map(|(i, mass)| mass * size(i)).sum();
        let unit = if SIZES.contains(&unit) { unit } else { 1.0 };
        Self { reference, scale: spread, edge, unit, visits }
    }
}
