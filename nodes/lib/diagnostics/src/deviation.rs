//! The standard deviation of a series: what it is worth and how far off it may be.

use super::effective::{effective_size, mean, sample_variance};
use super::series::Series;

impl Series<'_> {
    /// Standard deviation of all draws, n − 1 in the denominator.
    pub fn sd(&self) -> f64 {
        libm::sqrt(sample_variance(self.draws()))
    }

    /// Effective sample size of the standard deviation: of the squared distances from the mean of all draws.
    pub fn ess_sd(&self) -> f64 {
        effective_size(&squares(self.halves(), self.mean()), self.per_half())
    }

    /// Monte Carlo standard error of the standard deviation, in the unit of the draws: by the delta method from the
    /// variance of the squared distances; 0 when all draws are equal.
    pub fn mcse_sd(&self) -> f64 {
        let squares = squares(self.draws(), self.mean());
        let variance = mean(&squares);
        if sample_variance(self.draws()) == 0.0 {
            return 0.0;
        }
        let fourth = squares.iter().map(|s| s * s).sum::<f64>() / squares.len() as f64;
        libm::sqrt((fourth - variance * variance).max(0.0) / self.ess_sd() / variance / 4.0)
    }
}

fn squares(values: &[f64], centre: f64) -> Vec<f64> {
    values.iter().map(|x| (x - centre) * (x - centre)).collect()
}
