//! One quantity over all draws of all chains, checked and sorted once, and what can be asked of it.

use std::borrow::Cow;
use std::sync::OnceLock;

use super::effective::{effective_size, scale_reduction};
use super::indicator::indicator_size;
use super::rank::{NormalScores, folded, order};

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
    order: Vec<u32>,
    sorted: Vec<f64>,
    /// Half chains one after another; an odd chain loses its middle draw.
    halves: Cow<'a, [f64]>,
    per_half: usize,
    ranked: OnceLock<Ranked>,
}

/// What rank normalisation needs, made when it is first asked for.
#[derive(Debug, Clone)]
struct Ranked {
    table: NormalScores,
    /// Scores of the half chains.
    bulk: Vec<f64>,
}

impl<'a> Series<'a> {
    /// Checks and sorts `draws`, which hold `n_chains` chains of equal length one after another.
    pub fn new(draws: &'a [f64], n_chains: usize) -> Result<Self, SeriesError> {
        let per_chain = check(draws, n_chains)?;
        let order = order(draws);
        let sorted = order.iter().map(|&index| draws[index as usize]).collect();
        let halves = split(draws, per_chain);
        Ok(Self { draws, order, sorted, halves, per_half: per_chain / 2, ranked: OnceLock::new() })
    }

    /// All draws, ascending: the order statistics.
    pub fn sorted(&self) -> &[f64] {
        &self.sorted
    }

    /// The places of [`Self::sorted`] among the draws; equal draws in the order in which they stand.
    pub fn order(&self) -> &[u32] {
        &self.order
    }

    /// Number of draws.
    pub fn n(&self) -> usize {
        self.draws.len()
    }

    /// The draws, chains one after another.
    pub(super) fn draws(&self) -> &[f64] {
        self.draws
    }

    /// Half chains one after another, each of [`Self::per_half`] draws.
    pub(super) fn halves(&self) -> &[f64] {
        &self.halves
    }

    pub(super) fn per_half(&self) -> usize {
        self.per_half
    }

    /// Rank-normalised split R̂, the larger of the plain and the folded one; 1 when all draws are equal, ∞ when every
    /// chain is stuck at a place of its own.
    pub fn rhat(&self) -> f64 {
        let plain = scale_reduction(&self.ranked().bulk, self.per_half);
        let (ascending, order) = self.ordered_halves();
        let (distances, order) = folded(&ascending, &order);
        plain.max(scale_reduction(&self.ranked().table.of(&distances, &order), self.per_half))
    }

    /// Bulk effective sample size: of the rank-normalised draws.
    pub fn ess_bulk(&self) -> f64 {
        effective_size(&self.ranked().bulk, self.per_half)
    }

    /// Tail effective sample size: the smaller of those of the 5 % and the 95 % quantile.
    pub fn ess_tail(&self) -> f64 {
        self.ess_quantile(0.05).min(self.ess_quantile(0.95))
    }

    /// Effective sample size of the indicator I(x ≤ threshold); n when it is the same for all draws.
    pub fn ess_indicator(&self, threshold: f64) -> f64 {
        indicator_size(&self.halves, self.per_half, |x| x <= threshold)
    }

    fn ranked(&self) -> &Ranked {
        self.ranked.get_or_init(|| {
            let table = NormalScores::new(self.halves.len());
            let (ascending, order) = self.ordered_halves();
            let bulk = table.of(&ascending, &order);
            Ranked { table, bulk }
        })
    }

    /// [`Self::sorted`] and [`Self::order`] of the half chains: without the draws that splitting leaves out.
    fn ordered_halves(&self) -> (Cow<'_, [f64]>, Cow<'_, [u32]>) {
        if self.halves.len() == self.draws.len() {
            return (Cow::Borrowed(&self.sorted), Cow::Borrowed(&self.order));
        }
        let per_half = self.per_half as u32;
        let per_chain = 2 * per_half + 1;
        let kept = |index: u32| {
            let (chain, place) = (index / per_chain, index % per_chain);
            (place != per_half).then(|| 2 * per_half * chain + place - u32::from(place > per_half))
        };
        let order: Vec<u32> = self.order.iter().filter_map(|&index| kept(index)).collect();
        let ascending: Vec<f64> = order.iter().map(|&index| self.halves[index as usize]).collect();
        (Cow::Owned(ascending), Cow::Owned(order))
    }
}

/// Draws a chain, when `draws` are `n_chains` chains that can be judged.
pub(super) fn check(draws: &[f64], n_chains: usize) -> Result<usize, SeriesError> {
    let n = draws.len();
    if n_chains == 0 || !n.is_multiple_of(n_chains) {
        return Err(SeriesError::Ragged { n, n_chains });
    }
    let per_chain = n / n_chains;
    if per_chain < MIN_DRAWS_PER_CHAIN {
        return Err(SeriesError::TooShort { got: per_chain, needed: MIN_DRAWS_PER_CHAIN });
    }
    match draws.iter().position(|x| !x.is_finite()) {
        Some(index) => Err(SeriesError::NotFinite { index, value: draws[index] }),
        None => Ok(per_chain),
    }
}

/// Half chains of `per_chain / 2` draws one after another; an odd chain loses its middle draw.
pub(super) fn split(draws: &[f64], per_chain: usize) -> Cow<'_, [f64]> {
    let per_half = per_chain / 2;
    if per_chain.is_multiple_of(2) {
        return Cow::Borrowed(draws);
    }
    draws
        .chunks_exact(per_chain)
        .flat_map(|chain| chain[..per_half].iter().chain(&chain[per_chain - per_half..]))
        .copied()
        .collect()
}
