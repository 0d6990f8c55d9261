//! How a person answers "which is better?" given the difference of the two returns.

use super::{PreferenceError, Verdict};

/// Largest threshold of "about equal", in nats.
const MAX_EQUAL_THRESHOLD: f64 = 1e6;

/// How answers come about. [`AnswerModel::default`] is Bradley–Terry (eq. 6.4).
///
/// With d the rational difference of the returns, s the logistic function and t, τ, ε the three numbers below: a person cannot
/// tell with probability 4 τ s(d) s(−d); one who can says "more" with probability s(d − t), "less" with s(−d − t) and "about
/// equal" with (e^{2t} − 1) s(d − t) s(−d − t) (Bıyık et al. 2019); and a share ε of all answers is a random click on any of the
/// answers offered.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct AnswerModel {
    /// t ≥ 0, the difference in nats below which two items seem about equal; 0: "about equal" was not offered.
    pub equal_threshold: f64,
    /// τ in [0, 1), the largest probability of "can't tell", which it has at d = 0; 0: "can't tell" was not offered.
    pub cant_tell: f64,
    /// ε in [0, 1), the share of random clicks.
    pub wrong_rate: f64,
}

/// Probabilities of the four answers about a pair; they sum to 1.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct AnswerProbabilities {
    /// The second of the pair is better.
    pub more: f64,
    /// The first of the pair is better.
    pub less: f64,
    /// They are about equal.
    pub equal: f64,
    /// The person cannot tell.
    pub cant_tell: f64,
}

impl AnswerModel {
    /// Answers a person may give: two, and each that is offered besides.
    pub fn n_offered(&self) -> usize {
        2 + usize::from(self.equal_threshold > 0.0) + usize::from(self.cant_tell > 0.0)
    }

    /// Probabilities of the answers at `difference` = factor × ⟨θ, Φ_more − Φ_less⟩.
    pub fn probabilities(&self, difference: f64) -> AnswerProbabilities {
        let t = self.equal_threshold;
        let cannot_tell = 4.0 * self.cant_tell * logistic(difference) * logistic(-difference);
        let (above, below) = (logistic(difference - t), logistic(-difference - t));
        // (e^{2t} − 1) s(d − t) s(−d − t), without the factor that overflows.
        let equal = -libm::expm1(-2.0 * t) * logistic(t - difference) * logistic(t + difference);
        let click = self.wrong_rate / self.n_offered() as f64;
        let mixed = |probability: f64, offered: bool| {
            if offered { (1.0 - self.wrong_rate) * probability + click } else { 0.0 }
        };
        AnswerProbabilities {
            more: mixed((1.0 - cannot_tell) * above, true),
            less: mixed((1.0 - cannot_tell) * below, true),
            equal: mixed((1.0 - cannot_tell) * equal, t > 0.0),
            cant_tell: mixed(cannot_tell, self.cant_tell > 0.0),
        }
    }

    /// Whether this is plain Bradley–Terry.
    pub(super) fn is_plain(&self) -> bool {
        *self == Self::default()
    }

    pub(super) fn check(&self) -> Result<(), PreferenceError> {
        let share = "at least 0 and below 1";
        let refuse = |parameter, got, expected| Err(PreferenceError::Model { parameter, got, expected });
        if !(0.0..=MAX_EQUAL_THRESHOLD).contains(&self.equal_threshold) {
            return refuse("equal_threshold", self.equal_threshold, "at least 0 and at most 1e6");
        }
        if !(0.0..1.0).contains(&self.cant_tell) {
            return refuse("cant_tell", self.cant_tell, share);
        }
        if !(0.0..1.0).contains(&self.wrong_rate) {
            return refuse("wrong_rate", self.wrong_rate, share);
        }
        Ok(())
    }

    /// An answer that was not offered has probability zero under every reward.
    pub(super) fn check_offered(&self, answer: usize, verdict: Verdict) -> Result<(), PreferenceError> {
        let (parameter, value) = match verdict {
            Verdict::Strict => return Ok(()),
            Verdict::Equal => ("equal_threshold", self.equal_threshold),
            Verdict::CantTell => ("cant_tell", self.cant_tell),
        };
        if value > 0.0 { Ok(()) } else { Err(PreferenceError::NotOffered { answer, verdict, parameter }) }
    }
}

fn logistic(x: f64) -> f64 {
    let e = libm::exp(-x.abs());
    if x > 0.0 { 1.0 / (1.0 + e) } else { e / (1.0 + e) }
}
