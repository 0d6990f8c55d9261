//! Which of several policies to prefer: by what each is worth for certain, not by what it promises.

use std::cmp::Ordering;

use diagnostics::Smoothed;

use crate::empirical::Tail;
use crate::error::RiskError;
use crate::measure::Measure;
use crate::risk_bound::{RiskOutcome, risk_bound};
use crate::sample::Sample;
use crate::spending::ErrorBudget;
use crate::warning::{Warning, warnings};

/// Policies, the best first.
#[derive(Debug, Clone, PartialEq)]
pub struct Ranking {
    /// Those with a bound by their bounds, then those without one by their values at risk; ties by mean, then as given.
    pub policies: Vec<RankedPolicy>,
    /// δ of each bound: the allowed one shared equally, so that all bounds hold together.
    pub delta_each: f64,
}

/// A policy in a [`Ranking`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RankedPolicy {
    /// Its place in the list given.
    pub policy: usize,
    /// Mean over the draws.
    pub mean: f64,
    /// Point estimate of the α-quantile of its loss, or the (1 − α)-quantile of its return.
    pub value_at_risk: f64,
    /// Bound on that quantile, or why there is none.
    pub outcome: RiskOutcome,
    /// Share of the draws, by weight, under which it is the best policy of all; equally good ones share a draw equally.
    pub probability_best: f64,
    /// Set when its mean is high and its bound is low, as where a policy exploits what the posterior does not know.
    pub warning: Option<Warning>,
}

/// Ranks policies by bounds on the values at risk of their losses ([`Tail::Upper`]) or returns ([`Tail::Lower`]).
///
/// `policies[p][i]` is the loss or return of policy p under draw i of one posterior: `n_chains` chains one after another,
/// the same draws for all. `weights`, if any, are those of the draws.
///
/// # Errors
/// No policies, policies with unequal numbers of draws, and as [`risk_bound`].
pub fn rank_policies(
    policies: &[&[f64]],
    n_chains: usize,
    weights: Option<&Smoothed>,
    alpha: f64,
    delta: f64,
    tail: Tail,
) -> Result<Ranking, RiskError> {
    let first = policies.first().ok_or(RiskError::Empty { what: "policies" })?;
    for (policy, draws) in policies.iter().enumerate() {
        if draws.len() != first.len() {
            return Err(RiskError::PolicyLength { policy, got: draws.len(), expected: first.len() });
        }
        if let Some(index) = draws.iter().position(|x| !x.is_finite()) {
            return Err(RiskError::PolicyDraw { policy, index, value: draws[index] });
        }
    }
    let delta_each = ErrorBudget::new(delta)?.shared_by(policies.len()).delta();
    let measure = Measure::ValueAtRisk { alpha };
    let outcomes = policies
        .iter()
        .map(|values| risk_bound(&Sample { values, n_chains, weights }, measure, delta_each, None, tail))
        .collect::<Result<Vec<_>, _>>()?;

    let sign = match tail {
        Tail::Upper => -1.0,
        Tail::Lower => 1.0,
    };
    let all_bounded = outcomes.iter().all(|outcome| outcome.bound().is_some());
    let floor = |outcome: &RiskOutcome| {
        sign * outcome.bound().filter(|_| all_bounded).unwrap_or(outcome.receipt().point_estimate)
    };
    let means: Vec<f64> = outcomes.iter().map(|outcome| sign * outcome.receipt().mean).collect();
    let warnings = warnings(&means, &outcomes.iter().map(floor).collect::<Vec<_>>());
    let probabilities = probabilities_best(policies, weights, sign);

    let mut ranked: Vec<RankedPolicy> = outcomes
        .into_iter()
        .zip(warnings)
        .zip(probabilities)
        .enumerate()
        .map(|(policy, ((outcome, warning), probability_best))| {
            let receipt = outcome.receipt();
            let (mean, value_at_risk) = (receipt.mean, receipt.point_estimate);
            RankedPolicy { policy, mean, value_at_risk, outcome, probability_best, warning }
        })
        .collect();
    ranked.sort_by(|a, b| better_first(a, b, sign));
    Ok(Ranking { policies: ranked, delta_each })
}

/// Order of two policies; `sign` makes larger better.
fn better_first(a: &RankedPolicy, b: &RankedPolicy, sign: f64) -> Ordering {
    let descending = |a: f64, b: f64| (sign * b).total_cmp(&(sign * a));
    match (a.outcome.bound(), b.outcome.bound()) {
        (Some(a), Some(b)) => descending(a, b),
        (Some(_), None) => Ordering::Less,
        (None, Some(_)) => Ordering::Greater,
        (None, None) => descending(a.value_at_risk, b.value_at_risk),
    }
    .then(descending(a.mean, b.mean))
    .then(a.policy.cmp(&b.policy))
}

/// Share of the draws under which each policy is the best.
fn probabilities_best(policies: &[&[f64]], weights: Option<&Smoothed>, sign: f64) -> Vec<f64> {
    let n = policies[0].len();
    let weights = weights.map_or_else(|| vec![1.0 / n as f64; n], Smoothed::weights);
    let mut probabilities = vec![0.0; policies.len()];
    for (draw, weight) in weights.into_iter().enumerate() {
        let best = policies.iter().map(|draws| sign * draws[draw]).fold(f64::NEG_INFINITY, f64::max);
        let is_best = |draws: &&&[f64]| sign * draws[draw] == best;
        let share = weight / policies.iter().filter(is_best).count() as f64;
        for (probability, _) in probabilities.iter_mut().zip(policies).filter(|(_, draws)| is_best(draws)) {
            *probability += share;
        }
    }
    probabilities
}
