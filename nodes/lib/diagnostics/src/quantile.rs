//! A quantile of a series: what it is worth and how far off it may be.

use super::beta::beta_quantile;
use super::series::Series;

/// Φ(−1), to the digits with which the reference implementations write it.
const ONE_SIGMA_BELOW: f64 = 0.158_655_3;

impl Series<'_> {
    /// Empirical quantile at a level in [0, 1], linear between order statistics.
    pub fn quantile(&self, level: f64) -> f64 {
        let sorted = self.sorted();
        let position = level.clamp(0.0, 1.0) * (self.n() - 1) as f64;
        let below = position as usize;
        let above = (below + 1).min(self.n() - 1);
        let share = position - below as f64;
        sorted[below] + share * (sorted[above] - sorted[below])
    }

    /// Effective sample size of the empirical quantile at a level in [0, 1].
    pub fn ess_quantile(&self, level: f64) -> f64 {
        self.ess_indicator(self.quantile(level))
    }

    /// Monte Carlo standard error of the empirical quantile at a level in [0, 1], in the unit of the draws: half the
    /// distance between the order statistics one standard error of the level below and above it (Vehtari et al. 2021,
    /// section 4.4).
    pub fn mcse_quantile(&self, level: f64) -> f64 {
        let (level, last, n) = (level.clamp(0.0, 1.0), (self.n() - 1) as f64, self.n() as f64);
        let ess = self.ess_quantile(level);
        let (a, b) = (ess * level + 1.0, ess * (1.0 - level) + 1.0);
        let index = |p: f64| n * beta_quantile(p, a, b) - 1.0;
        let below = libm::floor(index(ONE_SIGMA_BELOW).max(0.0)) as usize;
        let above = libm::ceil(index(1.0 - ONE_SIGMA_BELOW).min(last)) as usize;
        (self.sorted()[above] - self.sorted()[below]) / 2.0
    }
}
