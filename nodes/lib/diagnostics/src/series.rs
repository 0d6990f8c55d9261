//! One quantity over all draws of all chains, checked and sorted once, and what can be asked of it.

use std::borrow::Cow;

use super::effective::{effective_size, mean, sample_variance, scale_reduction};
use super::rank::{folded, order, scores};

/// Fewer draws a chain than this say nothing about mixing.
pub const MIN_DRAWS_PER_CHAIN: usize = 4;

/// Why a series cannot be diagnosed.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum SeriesError {
    /// The draws do not divide into chains.
    #[error("{n} draws do not divide into {n_chains} chains of equal length")]
    Ragged {
        /// Draws given.
        n: usize,
        /// Chains asked for.
        n_chains: usize,
    },
    /// Chains too short to split.
    #[error("{got} draws per chain, but mixing can only be judged from {needed}")]
    TooShort {
        /// Draws per chain given.
        got: usize,
        /// The least.
        needed: usize,
    },
    /// A draw is NaN or infinite.
    #[error("draw {index} is {value}, not a finite number")]
    NotFinite {
        /// Its place in the slice.
        index: usize,
        /// Its value.
        value: f64,
    },
}

/// Draws of one quantity, chains one after another.
#[derive(Debug, Clone)]
pub struct Series<'a> {
    draws: &'a [f64],
    sorted: Vec<f64>,
    /// Half chains one after another; an odd chain loses its middle draw.
    halves: Cow<'a, [f64]>,
    order: Vec<u32>,
    per_half: usize,
}

impl<'a> Series<'a> {
    /// Checks and sorts `draws`, which hold `n_chains` chains of equal length one after another.
    pub fn new(draws: &'a [f64], n_chains: usize) -> Result<Self, SeriesError> {
        let n = draws.len();
        if n_chains == 0 || !n.is_multiple_of(n_chains) {
            return Err(SeriesError::Ragged { n, n_chains });
        }
        let per_chain = n / n_chains;
        if per_chain < MIN_DRAWS_PER_CHAIN {
            return Err(SeriesError::TooShort { got: per_chain, needed: MIN_DRAWS_PER_CHAIN });
        }
        if let Some(index) = draws.iter().position(|x| !x.is_finite()) {
            return Err(SeriesError::NotFinite { index, value: draws[index] });
        }
        let per_half = per_chain / 2;
        let halves = if per_chain.is_multiple_of(2) {
            Cow::Borrowed(draws)
        } else {
            let ends = |chain: &'a [f64]| chain[..per_half].iter().chain(&chain[per_chain - per_half..]);
            Cow::Owned(draws.chunks_exact(per_chain).flat_map(ends).copied().collect())
        };
        let order = order(&halves);
        let sorted = if per_chain.is_multiple_of(2) {
            order.iter().map(|&index| draws[index as usize]).collect()
        } else {
            let mut sorted = draws.to_vec();
            sorted.sort_unstable_by(f64::total_cmp);
            sorted
        };
        Ok(Self { draws, sorted, halves, order, per_half })
    }

    /// All draws, ascending: the order statistics.
    pub fn sorted(&self) -> &[f64] {
        &self.sorted
    }

    /// Number of draws.
    pub fn n(&self) -> usize {
        self.draws.len()
    }

    /// Mean of the draws.
    pub fn mean(&self) -> f64 {
        mean(self.draws)
    }

    /// Rank-normalised split R̂, the larger of the plain and the folded one; 1 when all draws are equal, ∞ when every
    /// chain is stuck at a place of its own.
    pub fn rhat(&self) -> f64 {
        let plain = scale_reduction(&scores(&self.halves, &self.order), self.per_half);
        let (distances, order) = folded(&self.halves, &self.order);
        plain.max(scale_reduction(&scores(&distances, &order), self.per_half))
    }

    /// Bulk effective sample size: of the rank-normalised draws.
    pub fn ess_bulk(&self) -> f64 {
        effective_size(&scores(&self.halves, &self.order), self.per_half)
    }

    /// Tail effective sample size: the smaller of those of the 5 % and the 95 % quantile.
    pub fn ess_tail(&self) -> f64 {
        self.ess_quantile(0.05).min(self.ess_quantile(0.95))
    }

    /// Effective sample size of the empirical quantile at a level in [0, 1] (linear between order statistics).
    pub fn ess_quantile(&self, level: f64) -> f64 {
        let position = level.clamp(0.0, 1.0) * (self.n() - 1) as f64;
        let below = position as usize;
        let above = (below + 1).min(self.n() - 1);
        let share = position - below as f64;
        self.ess_indicator(self.sorted[below] + share * (self.sorted[above] - self.sorted[below]))
    }

    /// Effective sample size of the indicator I(x ≤ threshold); n when it is the same for all draws.
    pub fn ess_indicator(&self, threshold: f64) -> f64 {
        let indicator: Vec<f64> = self.halves.iter().map(|&x| if x <= threshold { 1.0 } else { 0.0 }).collect();
        effective_size(&indicator, self.per_half)
    }

    /// Effective sample size of the mean.
    pub fn ess_mean(&self) -> f64 {
        effective_size(&self.halves, self.per_half)
    }

    /// Monte Carlo standard error of the mean.
    pub fn mcse_mean(&self) -> f64 {
        libm::sqrt(sample_variance(self.draws) / self.ess_mean())
    }
}
