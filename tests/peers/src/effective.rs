//! Effective sample sizes over all weights and the log-likelihood.

use diagnostics::{Series, SeriesError};
use serde::{Deserialize, Serialize};

/// Rank-normalised bulk effective sample sizes of one set of chains.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Effective {
    /// Smallest over the weights and the log-likelihood.
    pub ess_bulk_min: f64,
    /// Their median.
    pub ess_bulk_median: f64,
    /// That of the log-likelihood.
    pub ess_bulk_log_likelihood: f64,
    /// Tail effective sample size of the log-likelihood.
    pub ess_tail_log_likelihood: f64,
    /// Largest rank-normalised split R̂.
    pub rhat_max: f64,
}

/// Judges draws of `n_features` weights (row-major, chains one after another) and of the log-likelihood, with the work that
/// `posterior::draw` spends on its own diagnostics.
pub fn judge(
    values: &[f64],
    n_features: usize,
    log_likelihood: &[f64],
    n_chains: usize,
) -> Result<Effective, SeriesError> {
    let mut bulk = Vec::with_capacity(n_features + 1);
    let (mut rhat_max, mut tail) = (0.0_f64, 0.0);
    for feature in 0..=n_features {
        let draws: Vec<f64> = if feature < n_features {
            values.iter().skip(feature).step_by(n_features).copied().collect()
        } else {
            log_likelihood.to_vec()
        };
        let series = Series::new(&draws, n_chains)?;
        rhat_max = rhat_max.max(series.rhat());
        bulk.push(series.ess_bulk());
        tail = series.ess_tail();
    }
    let ess_bulk_log_likelihood = bulk[n_features];
    bulk.sort_unstable_by(f64::total_cmp);
    Ok(Effective {
        ess_bulk_min: bulk[0],
        ess_bulk_median: bulk[bulk.len() / 2],
        ess_bulk_log_likelihood,
        ess_tail_log_likelihood: tail,
        rhat_max,
    })
}

/// Mean of a chain set with its standard error, by the effective sample size of the mean.
pub fn mean_and_error(draws: &[f64], n_chains: usize) -> Result<(f64, f64), SeriesError> {
    let series = Series::new(draws, n_chains)?;
    Ok((series.mean(), series.mcse_mean()))
}
