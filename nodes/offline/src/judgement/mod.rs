//! What draws of a loss or a return say about it: a bound, or why there is none, with the figures it rests on.

mod chains;
mod levels;

pub(crate) use chains::n_chains;
pub(crate) use levels::{LevelArguments, Levels, TailName};

use diagnostics::{MIN_DRAWS_PER_CHAIN, Series, Smoothed};
use risk::{
    Distribution, MAX_RHAT, Measure, Outcome, Receipt, RiskOutcome, RiskReceipt, Sample, Tail, WeightsReceipt,
    lower_bound, n_min, risk_bound, upper_bound,
};
use serde_json::{Value, json};

use crate::OfflineError;

/// Fewest chains a bound may rest on.
pub(crate) const MIN_CHAINS: usize = 4;
/// Fewest effective draws per chain a bound may rest on.
const MIN_ESS_PER_CHAIN: usize = 100;

/// Draws of one quantity.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Draws<'a> {
    /// Chains of equal length, one after another.
    pub(crate) values: &'a [f64],
    pub(crate) n_chains: usize,
    /// Importance weights.
    pub(crate) weights: Option<&'a Smoothed>,
    /// Which end is bad.
    pub(crate) tail: Tail,
}

/// What there is to say about them.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Judgement {
    pub(crate) outcome: &'static str,
    pub(crate) reason: String,
    pub(crate) bound: Option<f64>,
    /// 1-based index of the order statistic that is the bound, of an unweighted value at risk.
    pub(crate) index: Option<usize>,
    pub(crate) n: usize,
    /// `None` where too few draws or chains say nothing about mixing.
    pub(crate) ess: Option<f64>,
    pub(crate) rhat: Option<f64>,
    /// Effective draws that a bound needs.
    pub(crate) needed: usize,
    pub(crate) point_estimate: f64,
    /// Of the draws.
    pub(crate) cvar: f64,
    pub(crate) mean: f64,
    pub(crate) weights: Option<WeightsReceipt>,
}

/// Effective draws that a bound on a quantile needs.
pub(crate) fn quantile_needs(alpha: f64, delta: f64, n_chains: usize) -> usize {
    usize::max(2 * n_min(alpha, delta), MIN_ESS_PER_CHAIN * n_chains)
}

impl Draws<'_> {
    /// Bound on `measure` with confidence 1 − `delta`; `worst` is the worst value that can be, where that is known. The CVaR
    /// that is told with it is of level `alpha`.
    ///
    /// # Errors
    /// Draws that are not finite, do not divide into chains or lie beyond the worst value, levels outside (0, 1).
    pub(crate) fn judge(
        &self,
        measure: Measure,
        alpha: f64,
        delta: f64,
        worst: Option<f64>,
    ) -> Result<Judgement, OfflineError> {
        let distribution = match self.weights {
            None => Distribution::equal(self.values)?,
            Some(smoothed) => Distribution::weighted(self.values, &smoothed.weights())?,
        };
        let cvar = Measure::ConditionalValueAtRisk { alpha }.of(&distribution, self.tail)?;
        if self.n_chains < MIN_CHAINS || self.values.len() / self.n_chains < MIN_DRAWS_PER_CHAIN {
            return self.unjudged(measure, delta, &distribution, cvar);
        }
        let (values, n_chains) = (self.values, self.n_chains);
        match (measure, self.weights) {
            (Measure::ValueAtRisk { alpha }, None) => {
                let outcome = match self.tail {
                    Tail::Upper => upper_bound(values, n_chains, alpha, delta)?,
                    Tail::Lower => lower_bound(values, n_chains, alpha, delta)?,
                };
                Ok(of_quantile(&outcome))
            }
            _ => {
                let sample = Sample { values, n_chains, weights: self.weights };
                Ok(of_measure(&risk_bound(&sample, measure, delta, worst, self.tail)?, cvar))
            }
        }
    }

    /// What can be said without knowing whether the draws have mixed.
    fn unjudged(
        &self,
        measure: Measure,
        delta: f64,
        distribution: &Distribution,
        cvar: f64,
    ) -> Result<Judgement, OfflineError> {
        let (n, n_chains) = (self.values.len(), self.n_chains);
        let point_estimate = measure.of(distribution, self.tail)?;
        let needed = match measure {
            Measure::ValueAtRisk { alpha } | Measure::ConditionalValueAtRisk { alpha } => {
                quantile_needs(alpha, delta, n_chains.max(MIN_CHAINS))
            }
            _ => MIN_ESS_PER_CHAIN * n_chains.max(MIN_CHAINS),
        };
        let series = if n / n_chains < MIN_DRAWS_PER_CHAIN { None } else { Series::new(self.values, n_chains).ok() };
        let (outcome, reason) = match n < needed {
            true => {
                ("not_enough_samples", format!("there are {n} draws; a bound needs {needed} effective ones at least"))
            }
            false => {
                let reason =
                    format!("{} cannot show whether they agree; {MIN_CHAINS} are needed", counted(n_chains, "chain"));
                ("not_mixed", reason)
            }
        };
        Ok(Judgement {
            outcome,
            reason,
            bound: None,
            index: None,
            n,
            ess: series.as_ref().map(|series| series.ess_indicator(point_estimate).min(n as f64)),
            rhat: series.as_ref().map(Series::rhat),
            needed,
            point_estimate,
            cvar,
            mean: distribution.mean(),
            weights: None,
        })
    }
}

fn of_quantile(outcome: &Outcome) -> Judgement {
    let receipt = outcome.receipt();
    let (word, reason) = match outcome {
        Outcome::Bound(_) => ("bound", enough(receipt.ess, receipt.rhat)),
        Outcome::NotEnoughSamples(Receipt { n, ess, needed, .. }) => ("not_enough_samples", too_few(*n, *ess, *needed)),
        Outcome::NotMixed(Receipt { rhat, .. }) => ("not_mixed", disagree(*rhat)),
    };
    Judgement {
        outcome: word,
        reason,
        bound: outcome.bound(),
        index: match outcome {
            Outcome::Bound(bound) => Some(bound.index),
            _ => None,
        },
        n: receipt.n,
        ess: Some(receipt.ess),
        rhat: Some(receipt.rhat),
        needed: receipt.needed,
        point_estimate: receipt.point_estimate,
        cvar: receipt.cvar,
        mean: receipt.mean,
        weights: None,
    }
}

fn of_measure(outcome: &RiskOutcome, cvar: f64) -> Judgement {
    let RiskReceipt { n, ess, rhat, needed, .. } = *outcome.receipt();
    let (word, reason) = match outcome {
        RiskOutcome::Bound(_) => ("bound", enough(ess, rhat)),
        RiskOutcome::NotEnoughSamples(_) => ("not_enough_samples", too_few(n, ess, needed)),
        RiskOutcome::NotMixed(_) => ("not_mixed", disagree(rhat)),
        RiskOutcome::UnreliableWeights(receipt) => {
            let (khat, limit) =
                receipt.weights.map_or((f64::NAN, f64::NAN), |weights| (weights.khat, weights.khat_limit));
            let reason = format!("the weights are too uneven: Pareto k-hat is {khat:.2}, at most {limit:.2} is wanted");
            ("unreliable_weights", reason)
        }
        RiskOutcome::Unbounded(_) => {
            let reason = "no number of draws bounds this measure unless the worst possible value is known: see --worst";
            ("unbounded", reason.to_owned())
        }
    };
    Judgement {
        outcome: word,
        reason,
        bound: outcome.bound(),
        index: None,
        n,
        ess: Some(ess),
        rhat: Some(rhat),
        needed,
        point_estimate: outcome.receipt().point_estimate,
        cvar,
        mean: outcome.receipt().mean,
        weights: outcome.receipt().weights,
    }
}

fn enough(ess: f64, rhat: f64) -> String {
    format!("the chains agree (R-hat {rhat:.4}) and the draws are worth {ess:.0} independent ones")
}

fn too_few(n: usize, ess: f64, needed: usize) -> String {
    // In proportion, rounded up to hundreds.
    let more = (n as f64 * needed as f64 / ess.max(1.0) / 100.0).ceil() * 100.0;
    format!("the {n} draws are worth {ess:.0} independent ones, {needed} are needed: about {more:.0} draws like these")
}

fn disagree(rhat: f64) -> String {
    format!("the chains disagree: R-hat is {rhat:.4}, at most {MAX_RHAT} is wanted; let them run longer")
}

/// `1 chain`, `3 chains`.
pub(crate) fn counted(n: usize, what: &str) -> String {
    format!("{n} {what}{}", if n == 1 { "" } else { "s" })
}

impl Judgement {
    pub(crate) fn json(&self) -> Value {
        json!({
            "outcome": self.outcome,
            "reason": self.reason,
            "bound": self.bound,
            "n": self.n,
            "ess": self.ess,
            "rhat": self.rhat,
            "index": self.index,
            "needed": self.needed,
            "point_estimate": self.point_estimate,
            "cvar": self.cvar,
            "mean": self.mean,
            "weights": self.weights.map(|weights| json!({
                "effective_size": weights.effective_size, "khat": weights.khat, "khat_limit": weights.khat_limit,
            })),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::{Draws, quantile_needs};
    use risk::{Measure, Tail};

    fn ramp(n: usize) -> Vec<f64> {
        // A permutation without order, so that chains agree and draws look independent.
        (0..n).map(|i| ((i * 7919 + 13) % n) as f64).collect()
    }

    #[test]
    fn too_few_or_too_lonely_draws_are_an_answer() {
        let values = ramp(1000);
        let judge = |n, n_chains| {
            let draws = Draws { values: &values[..n], n_chains, weights: None, tail: Tail::Upper };
            draws.judge(Measure::ValueAtRisk { alpha: 0.95 }, 0.95, 0.05, None).expect("an answer")
        };
        assert_eq!((judge(1, 1).outcome, judge(1, 1).point_estimate), ("not_enough_samples", values[0]));
        assert_eq!(judge(8, 4).outcome, "not_enough_samples");
        assert_eq!((judge(8, 4).ess, judge(8, 4).needed), (None, 400));
        let alone = judge(1000, 1);
        assert_eq!(alone.outcome, "not_mixed");
        assert!(alone.reason.starts_with("1 chain cannot show"), "{}", alone.reason);
        assert!(alone.rhat.is_some() && alone.bound.is_none());
        assert_eq!(judge(1000, 4).outcome, "bound");
    }

    #[test]
    fn the_needs_are_those_of_the_bound() {
        let values = ramp(100);
        for (alpha, delta) in [(0.95, 0.05), (0.99, 0.05), (0.999, 0.01), (0.5, 0.5)] {
            let outcome = risk::upper_bound(&values, 4, alpha, delta).expect("an outcome");
            assert_eq!(outcome.receipt().needed, quantile_needs(alpha, delta, 4));
        }
    }
}
