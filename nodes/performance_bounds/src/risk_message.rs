//! Bounds of the core as messages, or why there is none, in words.

use apprentice_msgs::msg::RiskBound;
use risk::RiskOutcome;

/// The message of a bound.
pub(crate) fn risk_message(outcome: &RiskOutcome) -> RiskBound {
    let facts = outcome.receipt();
    let (code, reason) = match outcome {
        RiskOutcome::Bound(_) => (RiskBound::BOUND, String::new()),
        RiskOutcome::NotEnoughSamples(_) => (
            RiskBound::NOT_ENOUGH_SAMPLES,
            format!(
                "no bound, because {:.0} effective draws are too few: it would take {}; raise n_draws of reward_posterior",
                facts.ess, facts.needed
            ),
        ),
        RiskOutcome::NotMixed(_) | RiskOutcome::UnreliableWeights(_) => (
            RiskBound::NOT_MIXED,
            format!(
                "no bound, because the chains disagree (R-hat {:.3}, at most {} is allowed); raise n_draws of reward_posterior",
                facts.rhat,
                risk::MAX_RHAT
            ),
        ),
        RiskOutcome::Unbounded(_) => (
            RiskBound::UNBOUNDED,
            "no bound, because under this prior weights may be arbitrarily large; a prior on a sphere gives one".into(),
        ),
    };
    RiskBound {
        outcome: code,
        reason,
        bound: outcome.bound().unwrap_or(f64::NAN),
        point_estimate: facts.point_estimate,
        mean: facts.mean,
        n: facts.n as u64,
        ess: facts.ess,
        rhat: facts.rhat,
        needed: facts.needed as u64,
        shift: facts.shift,
    }
}

/// Nothing could be judged, for a reason.
pub(crate) fn not_judged(reason: &str) -> RiskBound {
    RiskBound {
        outcome: RiskBound::NOT_JUDGED,
        reason: reason.to_owned(),
        bound: f64::NAN,
        point_estimate: f64::NAN,
        mean: f64::NAN,
        ess: f64::NAN,
        rhat: f64::NAN,
        shift: f64::NAN,
        ..RiskBound::default()
    }
}

/// A bound taken back, since the posterior as a whole has not mixed.
pub(crate) fn not_mixed(bound: RiskBound, reason: &str) -> RiskBound {
    if bound.outcome == RiskBound::NOT_JUDGED {
        return bound;
    }
    let reason = format!("no bound, because the chains disagree: {reason}");
    RiskBound { outcome: RiskBound::NOT_MIXED, reason, bound: f64::NAN, ..bound }
}
