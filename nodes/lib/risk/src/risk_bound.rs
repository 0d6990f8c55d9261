//! Bounds with confidence 1 − δ on any risk measure of a loss or a return, from weighted or unweighted draws (method notes
//! section 2).

use crate::bound::{MAX_RHAT, chains_need, quantile_needs, settle};
use crate::empirical::Tail;
use crate::envelope::{LEVELS, distribution_shift, draws_for_shift, envelope};
use crate::error::{RiskError, check_level};
use crate::measure::Measure;
use crate::order_statistic::order_index;
use crate::sample::{Losses, Sample, WeightsReceipt};

/// A draw may pass the worst possible value by this share of it, for the rounding of whoever computed them.
const ROUNDING: f64 = 1e-9;

/// What there is to say about a risk measure.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum RiskOutcome {
    /// A bound that holds with confidence 1 − δ.
    Bound(RiskBound),
    /// The draws are worth too few independent ones: `receipt.ess` of `receipt.needed`.
    NotEnoughSamples(RiskReceipt),
    /// The chains disagree.
    NotMixed(RiskReceipt),
    /// The weights are too uneven to say anything: k̂ is above its limit. Draws from the posterior itself are needed.
    UnreliableWeights(RiskReceipt),
    /// No number of draws bounds this measure of a loss that may be arbitrarily large: its worst possible value is needed.
    Unbounded(RiskReceipt),
}

/// A bound and the receipt for it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RiskBound {
    /// The bound on the measure, in the unit of the draws: from above for losses, from below for returns.
    pub value: f64,
    /// What was computed on the way.
    pub receipt: RiskReceipt,
}

/// The figures a bound rests on, or fell short with.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RiskReceipt {
    /// Draws.
    pub n: usize,
    /// Effective sample size, at most n: at the quantile for the value at risk, else the smallest at a grid of quantiles.
    pub ess: f64,
    /// Rank-normalised split R̂ of the draws, or of their weights when that is larger.
    pub rhat: f64,
    /// Effective draws that a bound needs.
    pub needed: usize,
    /// The measure of the draws.
    pub point_estimate: f64,
    /// Mean of the draws.
    pub mean: f64,
    /// By how much probability the bound looks further into the tail than the estimate does.
    pub shift: f64,
    /// Of weighted draws.
    pub weights: Option<WeightsReceipt>,
}

impl RiskOutcome {
    /// The bound, if there is one.
    pub fn bound(&self) -> Option<f64> {
        match self {
            Self::Bound(bound) => Some(bound.value),
            _ => None,
        }
    }

    /// The figures behind it, whatever the outcome.
    pub fn receipt(&self) -> &RiskReceipt {
        match self {
            Self::Bound(bound) => &bound.receipt,
            Self::NotEnoughSamples(receipt)
            | Self::NotMixed(receipt)
            | Self::UnreliableWeights(receipt)
            | Self::Unbounded(receipt) => receipt,
        }
    }
}

/// Bound with confidence 1 − δ on `measure` of what `sample` holds draws of: an upper bound for losses
/// ([`Tail::Upper`]), a lower bound for returns ([`Tail::Lower`]).
///
/// The value at risk is bounded by an order statistic and needs no `worst`; without weights its bound is that of
/// [`crate::upper_bound`]. The other measures are bounded through a distribution that dominates the true one, with the
/// probability [`crate::distribution_shift`] put at `worst`, the worst value that can be: the largest possible loss, or the
/// smallest possible return. For the loss of a policy under rewards with ‖w‖₁ ≤ 1 it is exact: that loss is convex in w, so
/// its maximum is at one of the 2k vertices ±e_i, each an ordinary planning problem.
///
/// Effective draws needed: max(2 n_min, 100 a chain) for the value at risk; 100 a chain for the others, and for the
/// conditional value at risk so many more that its bound is less than `worst`.
///
/// # Errors
/// As [`crate::upper_bound`]; a parameter of the measure outside its range; as many weights as draws not given; `worst` not
/// finite, or a draw beyond it.
pub fn risk_bound(
    sample: &Sample<'_>,
    measure: Measure,
    delta: f64,
    worst: Option<f64>,
    tail: Tail,
) -> Result<RiskOutcome, RiskError> {
    let values = sample.as_losses(tail);
    let losses = Losses::new(&values, sample)?;
    measure.check()?;
    check_level("delta", delta)?;
    let outcome = match measure {
        Measure::ValueAtRisk { alpha } => by_order_statistic(&losses, sample.n_chains, alpha, delta)?,
        _ => {
            let worst = worst_loss(&losses, &values, worst, tail)?;
            by_envelope(&losses, sample.n_chains, &[measure], delta, worst)?[0]
        }
    };
    Ok(in_tail(outcome, tail))
}

/// [`risk_bound`] on several measures that hold together with confidence 1 − δ, all from one dominating distribution, in
/// the order given. A value at risk, too, is taken from it here, and is wider than alone.
///
/// # Errors
/// As [`risk_bound`].
pub fn risk_bounds(
    sample: &Sample<'_>,
    measures: &[Measure],
    delta: f64,
    worst: Option<f64>,
    tail: Tail,
) -> Result<Vec<RiskOutcome>, RiskError> {
    let values = sample.as_losses(tail);
    let losses = Losses::new(&values, sample)?;
    measures.iter().try_for_each(|measure| measure.check())?;
    check_level("delta", delta)?;
    let worst = worst_loss(&losses, &values, worst, tail)?;
    let outcomes = by_envelope(&losses, sample.n_chains, measures, delta, worst)?;
    Ok(outcomes.into_iter().map(|outcome| in_tail(outcome, tail)).collect())
}

fn by_order_statistic(losses: &Losses<'_>, n_chains: usize, alpha: f64, delta: f64) -> Result<RiskOutcome, RiskError> {
    let distribution = &losses.distribution;
    let estimate = distribution.quantile(alpha);
    let choose = |ess: f64| {
        let effective = ess as usize;
        let level = order_index(effective, alpha, delta)? as f64 / effective as f64;
        Some((level, distribution.quantile(level)))
    };
    let (ess, chosen) = settle(losses.n(), estimate, |x| losses.effective_size_at(x), choose);
    let receipt = RiskReceipt {
        n: losses.n(),
        ess,
        rhat: losses.rhat()?,
        needed: quantile_needs(alpha, delta, n_chains),
        point_estimate: estimate,
        mean: distribution.mean(),
        shift: chosen.map_or(1.0, |(level, _)| level) - alpha,
        weights: losses.weights_receipt,
    };
    Ok(match (refusal(receipt), chosen) {
        (Some(outcome), _) => outcome,
        (None, Some((_, value))) => RiskOutcome::Bound(RiskBound { value, receipt }),
        (None, None) => RiskOutcome::NotEnoughSamples(receipt),
    })
}

fn by_envelope(
    losses: &Losses<'_>,
    n_chains: usize,
    measures: &[Measure],
    delta: f64,
    worst: Option<f64>,
) -> Result<Vec<RiskOutcome>, RiskError> {
    let distribution = &losses.distribution;
    // The level of one measure may lower the size for all: they share a distribution.
    let levels = measures.iter().filter_map(|measure| match measure {
        Measure::ValueAtRisk { alpha } | Measure::ConditionalValueAtRisk { alpha } => Some(*alpha),
        _ => None,
    });
    let ess = LEVELS
        .into_iter()
        .chain(levels)
        .map(|level| losses.effective_size_at(distribution.quantile(level)))
        .fold(losses.n() as f64, f64::min);
    let shift = distribution_shift(ess as usize, delta);
    let (rhat, mean) = (losses.rhat()?, distribution.mean());
    let worse = worst.map(|worst| envelope(distribution, shift, worst));
    let outcome = |&measure: &Measure| {
        let needed = match measure {
            Measure::ValueAtRisk { alpha } | Measure::ConditionalValueAtRisk { alpha } => {
                quantile_needs(alpha, delta, n_chains).max(draws_for_shift(1.0 - alpha, delta))
            }
            _ => chains_need(n_chains),
        };
        let point_estimate = measure.of_loss(distribution);
        let weights = losses.weights_receipt;
        let receipt = RiskReceipt { n: losses.n(), ess, rhat, needed, point_estimate, mean, shift, weights };
        match (&worse, refusal(receipt)) {
            (_, Some(outcome @ (RiskOutcome::NotMixed(_) | RiskOutcome::UnreliableWeights(_)))) => outcome,
            (None, _) => RiskOutcome::Unbounded(receipt),
            (_, Some(outcome)) => outcome,
            (Some(worse), None) => RiskOutcome::Bound(RiskBound { value: measure.of_loss(worse), receipt }),
        }
    };
    Ok(measures.iter().map(outcome).collect())
}

/// Why these figures give no bound; nothing when they do.
fn refusal(receipt: RiskReceipt) -> Option<RiskOutcome> {
    // Not the other way round: a k̂ that is not a number is no reason to go on.
    let trusted = receipt.weights.is_none_or(|weights| weights.khat <= weights.khat_limit);
    if !trusted {
        return Some(RiskOutcome::UnreliableWeights(receipt));
    }
    if receipt.rhat > MAX_RHAT {
        return Some(RiskOutcome::NotMixed(receipt));
    }
    (receipt.ess < receipt.needed as f64).then_some(RiskOutcome::NotEnoughSamples(receipt))
}

/// `worst` as a loss, when no draw is worse.
fn worst_loss(losses: &Losses<'_>, values: &[f64], worst: Option<f64>, tail: Tail) -> Result<Option<f64>, RiskError> {
    let Some(given) = worst else {
        return Ok(None);
    };
    if !given.is_finite() {
        return Err(RiskError::Parameter { name: "the worst possible value", got: given, expected: "finite" });
    }
    let sign = match tail {
        Tail::Upper => 1.0,
        Tail::Lower => -1.0,
    };
    let worst = sign * given;
    let limit = worst + ROUNDING * worst.abs().max(1.0);
    if losses.distribution.largest() <= limit {
        return Ok(Some(worst));
    }
    let index = values.iter().position(|&x| x > limit).expect("the largest draw is one of them");
    Err(RiskError::BeyondWorst { index, got: sign * values[index], worst: given })
}

/// The outcome for losses as that for what the sample holds.
fn in_tail(outcome: RiskOutcome, tail: Tail) -> RiskOutcome {
    if tail == Tail::Upper {
        return outcome;
    }
    let mirror =
        |receipt: RiskReceipt| RiskReceipt { point_estimate: -receipt.point_estimate, mean: -receipt.mean, ..receipt };
    match outcome {
        RiskOutcome::Bound(bound) => {
            RiskOutcome::Bound(RiskBound { value: -bound.value, receipt: mirror(bound.receipt) })
        }
        RiskOutcome::NotEnoughSamples(receipt) => RiskOutcome::NotEnoughSamples(mirror(receipt)),
        RiskOutcome::NotMixed(receipt) => RiskOutcome::NotMixed(mirror(receipt)),
        RiskOutcome::UnreliableWeights(receipt) => RiskOutcome::UnreliableWeights(mirror(receipt)),
        RiskOutcome::Unbounded(receipt) => RiskOutcome::Unbounded(mirror(receipt)),
    }
}
