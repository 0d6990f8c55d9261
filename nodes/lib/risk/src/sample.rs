//! Posterior draws of a loss, weighted or not, and how many independent ones they are worth at a threshold.

use diagnostics::{Series, Smoothed, ess_of_mean, khat_threshold};

use crate::bound::MIN_CHAINS;
use crate::distribution::Distribution;
use crate::empirical::Tail;
use crate::error::{RiskError, check_finite, check_length};

/// Draws of a loss or a return from a posterior.
#[derive(Debug, Clone, Copy)]
pub struct Sample<'a> {
    /// The draws, chains of equal length one after another. Repeats count: never thin or de-duplicate first.
    pub values: &'a [f64],
    /// Chains.
    pub n_chains: usize,
    /// Weights of the draws, when they come from another posterior than the one that is asked about.
    pub weights: Option<&'a Smoothed>,
}

/// How far the weights of a sample can be trusted.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct WeightsReceipt {
    /// (ΣW)²/ΣW².
    pub effective_size: f64,
    /// Pareto k̂.
    pub khat: f64,
    /// The largest k̂ with which there is a bound.
    pub khat_limit: f64,
}

/// A sample as losses, checked and sorted.
pub(crate) struct Losses<'a> {
    values: &'a [f64],
    n_chains: usize,
    series: Series<'a>,
    pub(crate) distribution: Distribution,
    weights: Option<Vec<f64>>,
    pub(crate) weights_receipt: Option<WeightsReceipt>,
}

impl Sample<'_> {
    /// The draws as losses: returns change their sign.
    pub(crate) fn as_losses(&self, tail: Tail) -> Vec<f64> {
        match tail {
            Tail::Upper => self.values.to_vec(),
            Tail::Lower => self.values.iter().map(|x| -x).collect(),
        }
    }
}

impl<'a> Losses<'a> {
    /// `values` are the draws of `sample` as losses.
    pub(crate) fn new(values: &'a [f64], sample: &Sample<'_>) -> Result<Self, RiskError> {
        let n_chains = sample.n_chains;
        if n_chains < MIN_CHAINS {
            return Err(RiskError::TooFewChains { got: n_chains });
        }
        let series = Series::new(values, n_chains)?;
        let n = series.n();
        let (distribution, weights, weights_receipt) = match sample.weights {
            None => (Distribution::equal_sorted(series.sorted().to_vec())?, None, None),
            Some(smoothed) => {
                let weights = smoothed.weights();
                let receipt = WeightsReceipt {
                    effective_size: smoothed.effective_size,
                    khat: smoothed.khat,
                    khat_limit: khat_threshold(n),
                };
                check_length("weights", weights.len(), n)?;
                check_finite("weight", &weights)?;
                let points = series.order().iter().map(|&i| (values[i as usize], weights[i as usize])).collect();
                (Distribution::weighted_sorted(points)?, Some(weights), Some(receipt))
            }
        };
        Ok(Self { values, n_chains, series, distribution, weights, weights_receipt })
    }

    pub(crate) fn n(&self) -> usize {
        self.series.n()
    }

    /// Rank-normalised split R̂ of the losses, or that of their weights when it is larger: chains that agree about a loss
    /// but not about where the weight lies have not mixed.
    pub(crate) fn rhat(&self) -> Result<f64, RiskError> {
        let of_weights = match &self.weights {
            None => 1.0,
            Some(weights) => Series::new(weights, self.n_chains)?.rhat(),
        };
        Ok(self.series.rhat().max(of_weights))
    }

    /// How many independent draws know P(X ≤ `threshold`) as well as these do; at most n.
    ///
    /// Without weights that is the ESS of the indicator. With weights it is p(1 − p) over the variance of the weighted
    /// share p̂, which is Σ W_i (I_i − p̂) to first order: the autocorrelation of the chains is in its ESS, the loss by
    /// weighting in its variance. It is never more than (ΣW)²/ΣW².
    pub(crate) fn effective_size_at(&self, threshold: f64) -> f64 {
        let n = self.n() as f64;
        let (Some(weights), Some(receipt)) = (&self.weights, &self.weights_receipt) else {
            return self.series.ess_indicator(threshold).min(n);
        };
        let indicator = |x: f64| if x <= threshold { 1.0 } else { 0.0 };
        let share: f64 = self.values.iter().zip(weights).map(|(&x, w)| w * indicator(x)).sum();
        let errors: Vec<f64> = self.values.iter().zip(weights).map(|(&x, w)| n * w * (indicator(x) - share)).collect();
        let variance = errors.iter().map(|e| e * e).sum::<f64>() / n;
        let most = receipt.effective_size.min(n);
        if share <= 0.0 || share >= 1.0 || variance == 0.0 {
            return most;
        }
        let ess = ess_of_mean(&errors, self.n_chains).expect("as many errors as losses, which were checked");
        (share * (1.0 - share) / variance * ess).min(most)
    }
}
