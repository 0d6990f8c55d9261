//! Draws from the posterior and how far they can be trusted.

use crate::diagnostics::Series;

/// Draws of the weights, chains one after another.
#[derive(Debug, Clone, PartialEq)]
pub struct Draws {
    /// Chains.
    pub n_chains: usize,
    /// Draws per chain.
    pub per_chain: usize,
    /// Weights per draw.
    pub n_features: usize,
    /// Weights, row-major, one row per draw. These very numbers are what everything else is computed from.
    pub values: Vec<f32>,
    /// Log-likelihood of each draw (before rounding), nats relative to uniform placements.
    pub log_likelihood: Vec<f64>,
    /// The most likely weights on the prior's sphere, a function of the evidence alone; all equal and positive without
    /// demonstrations. Ties within half a thousandth of a nat go to the weights of smaller sum of squares.
    pub map_weights: Vec<f64>,
    /// Their log-likelihood.
    pub map_log_likelihood: f64,
    /// Mean probability with which proposals were accepted.
    pub acceptance: f64,
    /// Largest rank-normalised split R̂ over the weights and the log-likelihood.
    pub rhat_max: f64,
    /// Smallest bulk effective sample size over the weights and the log-likelihood.
    pub ess_bulk_min: f64,
    /// Smallest tail effective sample size over the weights and the log-likelihood.
    pub ess_tail_min: f64,
}

impl Draws {
    /// Draws over all chains.
    pub fn n(&self) -> usize {
        self.n_chains * self.per_chain
    }

    /// The weights of one draw, an index below [`Draws::n`].
    pub fn weights(&self, draw: usize) -> &[f32] {
        &self.values[draw * self.n_features..(draw + 1) * self.n_features]
    }

    /// All draws of one weight, an index below `n_features`.
    pub fn feature(&self, k: usize) -> Vec<f64> {
        self.values.iter().skip(k).step_by(self.n_features).map(|&w| f64::from(w)).collect()
    }

    /// Mean log-likelihood of the draws.
    pub fn log_likelihood_mean(&self) -> f64 {
        self.log_likelihood.iter().sum::<f64>() / self.log_likelihood.len() as f64
    }

    /// Fills in R̂ and the effective sample sizes.
    pub(crate) fn diagnose(&mut self) {
        let mut worst = (0.0_f64, f64::INFINITY, f64::INFINITY);
        let series = (0..self.n_features).map(|k| self.feature(k)).chain([self.log_likelihood.clone()]);
        for draws in series {
            let series = Series::new(&draws, self.n_chains).expect("chains are equally long, weights finite");
            worst.0 = worst.0.max(series.rhat());
            worst.1 = worst.1.min(series.ess_bulk());
            worst.2 = worst.2.min(series.ess_tail());
        }
        (self.rhat_max, self.ess_bulk_min, self.ess_tail_min) = worst;
    }
}
