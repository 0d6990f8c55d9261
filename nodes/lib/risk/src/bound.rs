//! The bound to ship: an order statistic of autocorrelated draws, chosen as if there were only as many as they are worth
//! (method notes section 2; dissertation eq. 4.19 with its index corrected).

use diagnostics::Series;

use crate::empirical::{Tail, cvar, value_at_risk};
use crate::error::{RiskError, check_level};
use crate::order_statistic::{ceil_rank, n_min, order_index};

/// No bound is given above this rank-normalised split R̂.
pub const MAX_RHAT: f64 = 1.01;
/// Fewest chains a bound may rest on.
pub(crate) const MIN_CHAINS: usize = 4;
/// Fewest effective draws per chain a bound may rest on.
const MIN_ESS_PER_CHAIN: usize = 100;

/// What there is to say about an α-quantile.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Outcome {
    /// A bound that holds with confidence 1 − δ.
    Bound(Bound),
    /// The draws are worth too few independent ones.
    NotEnoughSamples(Receipt),
    /// The chains disagree.
    NotMixed(Receipt),
}

/// A bound and the receipt for it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Bound {
    /// The bound on the α-quantile, in the unit of the losses.
    pub value: f64,
    /// 1-based index of the order statistic that is the bound, among all n ascending draws.
    pub index: usize,
    /// What was computed on the way.
    pub receipt: Receipt,
}

/// The figures a bound rests on, or fell short with.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Receipt {
    /// Draws.
    pub n: usize,
    /// Effective sample size S of the tail indicator, at most n.
    pub ess: f64,
    /// Rank-normalised split R̂ of the losses.
    pub rhat: f64,
    /// Effective draws a bound needs: max(2 · n_min, 100 · chains).
    pub needed: usize,
    /// Empirical α-quantile.
    pub point_estimate: f64,
    /// Empirical conditional value at risk.
    pub cvar: f64,
    /// Mean.
    pub mean: f64,
}

impl Outcome {
    /// The bound, if there is one.
    pub fn bound(&self) -> Option<f64> {
        match self {
            Self::Bound(bound) => Some(bound.value),
            Self::NotEnoughSamples(_) | Self::NotMixed(_) => None,
        }
    }

    /// The figures behind it, whatever the outcome.
    pub fn receipt(&self) -> &Receipt {
        match self {
            Self::Bound(bound) => &bound.receipt,
            Self::NotEnoughSamples(receipt) | Self::NotMixed(receipt) => receipt,
        }
    }
}

/// Upper bound, with confidence 1 − δ, on the α-quantile of a loss of which `losses` are draws, `n_chains` equally long
/// chains one after another. Repeats count: never thin or de-duplicate first.
///
/// Draws that are all equal carry no sign of bad mixing: R̂ = 1, S = n, and the bound is that value.
///
/// # Errors
/// Ragged or too few chains, chains of fewer than 4 draws, losses that are not finite, levels outside (0, 1).
pub fn upper_bound(losses: &[f64], n_chains: usize, alpha: f64, delta: f64) -> Result<Outcome, RiskError> {
    check_level("alpha", alpha)?;
    check_level("delta", delta)?;
    if n_chains < MIN_CHAINS {
        return Err(RiskError::TooFewChains { got: n_chains });
    }
    let series = Series::new(losses, n_chains)?;
    let (n, sorted) = (series.n(), series.sorted());
    let estimate = value_at_risk(sorted, alpha, Tail::Upper).expect("a series is not empty");
    let (ess, chosen) = settle(n, estimate, |x| series.ess_indicator(x), |ess| choose(sorted, ess, alpha, delta));
    let receipt = Receipt {
        n,
        ess,
        rhat: series.rhat(),
        needed: quantile_needs(alpha, delta, n_chains),
        point_estimate: estimate,
        cvar: cvar(sorted, alpha, Tail::Upper).expect("a series is not empty"),
        mean: series.mean(),
    };
    if receipt.rhat > MAX_RHAT {
        return Ok(Outcome::NotMixed(receipt));
    }
    Ok(match chosen {
        Some((index, value)) if ess >= receipt.needed as f64 => Outcome::Bound(Bound { value, index, receipt }),
        _ => Outcome::NotEnoughSamples(receipt),
    })
}

/// Lower bound, with confidence 1 − δ, on the (1 − α)-quantile of a return of which `returns` are draws; otherwise as
/// [`upper_bound`]. `point_estimate` and `cvar` are those of the lower tail.
///
/// # Errors
/// As [`upper_bound`].
pub fn lower_bound(returns: &[f64], n_chains: usize, alpha: f64, delta: f64) -> Result<Outcome, RiskError> {
    let losses: Vec<f64> = returns.iter().map(|x| -x).collect();
    let mirror = |receipt: Receipt| Receipt {
        point_estimate: -receipt.point_estimate,
        cvar: -receipt.cvar,
        mean: -receipt.mean,
        ..receipt
    };
    Ok(match upper_bound(&losses, n_chains, alpha, delta)? {
        Outcome::Bound(bound) => Outcome::Bound(Bound {
            value: -bound.value,
            index: returns.len() + 1 - bound.index,
            receipt: mirror(bound.receipt),
        }),
        Outcome::NotEnoughSamples(receipt) => Outcome::NotEnoughSamples(mirror(receipt)),
        Outcome::NotMixed(receipt) => Outcome::NotMixed(mirror(receipt)),
    })
}

/// Effective draws that a bound on an α-quantile needs: max(2 · n_min, 100 · chains).
pub(crate) fn quantile_needs(alpha: f64, delta: f64, n_chains: usize) -> usize {
    usize::max(2 * n_min(alpha, delta), chains_need(n_chains))
}

/// Effective draws that any bound from that many chains needs.
pub(crate) fn chains_need(n_chains: usize) -> usize {
    MIN_ESS_PER_CHAIN * n_chains
}

/// Effective sample size, at most `n`, and what `choose` makes of it: first with the size at the estimate, then once more
/// with that at the value chosen if it is smaller.
pub(crate) fn settle<T: Copy>(
    n: usize,
    estimate: f64,
    ess_at: impl Fn(f64) -> f64,
    choose: impl Fn(f64) -> Option<(T, f64)>,
) -> (f64, Option<(T, f64)>) {
    let ess = ess_at(estimate).min(n as f64);
    let chosen = choose(ess);
    match chosen.map(|(_, value)| ess_at(value)) {
        Some(again) if again < ess => (again, choose(again)),
        _ => (ess, chosen),
    }
}

/// 1-based index among all draws, and value, of the order statistic that bounds when the draws are worth `ess`.
fn choose(sorted: &[f64], ess: f64, alpha: f64, delta: f64) -> Option<(usize, f64)> {
    let effective = ess as usize;
    let j = order_index(effective, alpha, delta)?;
    let n = sorted.len();
    let k = ceil_rank(n as f64 * j as f64 / effective as f64).min(n);
    Some((k, sorted[k - 1]))
}
