//! The mean of a series: what it is worth and how far off it may be.

use super::effective::{effective_size, mean, sample_variance};
use super::series::{Series, SeriesError, check, split};

/// [`Series::ess_mean`] of `draws`, `n_chains` equally long chains one after another, without sorting them first.
///
/// # Errors
/// As [`Series::new`].
pub fn ess_of_mean(draws: &[f64], n_chains: usize) -> Result<f64, SeriesError> {
    let per_chain = check(draws, n_chains)?;
    Ok(effective_size(&split(draws, per_chain), per_chain / 2))
}

impl Series<'_> {
    /// Mean of the draws.
    pub fn mean(&self) -> f64 {
        mean(self.draws())
    }

    /// Effective sample size of the mean: of the split draws themselves, so it says nothing when their variance is infinite.
    pub fn ess_mean(&self) -> f64 {
        effective_size(self.halves(), self.per_half())
    }

    /// Monte Carlo standard error of the mean, in the unit of the draws: standard deviation / √ESS.
    pub fn mcse_mean(&self) -> f64 {
        libm::sqrt(sample_variance(self.draws()) / self.ess_mean())
    }
}
