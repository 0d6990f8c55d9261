//! Answers to random questions, held against what was expected of them: a guard against a wrong model.

use crate::{Answers, Belief, InquiryError};

/// Share of answers that the model itself expects to be surprises.
pub const SURPRISING: f64 = 0.1;

/// Answers that are asked for, at most, to confirm a model.
pub const MAX_MISSING: u32 = 1000;

/// How often answers to random questions were a surprise. Under the right model at most [`SURPRISING`] of them are.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct HoldOut {
    /// Random questions that were answered.
    pub n: u64,
    /// Of those, how many answers were surprises.
    pub surprises: u64,
}

impl HoldOut {
    /// Takes in the answer to a random question; `belief` and `answers` are those of the time before it was given. Whether it
    /// was a surprise.
    ///
    /// # Errors
    /// Parts about other draws; no such answer.
    pub fn add(&mut self, answers: &Answers, belief: &Belief, given: usize) -> Result<bool, InquiryError> {
        let is_surprise = is_surprise(answers, belief, given)?;
        self.n += 1;
        self.surprises += u64::from(is_surprise);
        Ok(is_surprise)
    }

    /// Interval of the true share of surprises with the given confidence (Clopper and Pearson 1934): never too narrow.
    ///
    /// # Errors
    /// A confidence outside (0, 1).
    pub fn interval(&self, confidence: f64) -> Result<[f64; 2], InquiryError> {
        clopper_pearson(self.surprises, self.n, confidence)
    }

    /// How many more answers, none of them a surprise, would show with confidence 1 − δ that the true share of surprises is at
    /// most `most`; 0 when these do. Where that would take more than [`MAX_MISSING`] it is that many.
    ///
    /// # Errors
    /// δ outside (0, 1); a share outside (0, 1].
    pub fn missing(&self, most: f64, delta: f64) -> Result<u32, InquiryError> {
        check_level("delta", delta)?;
        crate::error::check_numbers("most surprises", &[most], "above 0 and at most 1", |x| x > 0.0 && x <= 1.0)?;
        if most == 1.0 {
            return Ok(0);
        }
        // So few surprises or fewer must be improbable where the share is as large as that.
        let shown = |more: u32| risk::cdf(self.surprises, self.n + u64::from(more), most) <= delta;
        Ok((0..MAX_MISSING).find(|&more| shown(more)).unwrap_or(MAX_MISSING))
    }

    /// Whether surprises are so many that the model cannot be right, at the error probability `delta`.
    ///
    /// # Errors
    /// δ outside (0, 1).
    pub fn refutes(&self, delta: f64) -> Result<bool, InquiryError> {
        check_level("delta", delta)?;
        Ok(lower(self.surprises, self.n, delta) > SURPRISING)
    }
}

/// Whether the answer lies outside the smallest set of answers that has probability at least 1 − [`SURPRISING`]. Answers as
/// probable as one in the set are in it.
///
/// # Errors
/// Parts about other draws; no such answer.
pub fn is_surprise(answers: &Answers, belief: &Belief, given: usize) -> Result<bool, InquiryError> {
    crate::error::check_length("draws with answers", answers.n_draws(), belief.n())?;
    let of_given = belief.mean(&answers.likelihood(given)?);
    let mut more_probable = 0.0;
    answers.for_each(|_, p| {
        let probability = belief.mean(p);
        if probability > of_given * (1.0 + 1e-12) {
            more_probable += probability;
        }
    });
    Ok(more_probable >= 1.0 - SURPRISING)
}

/// Interval of a probability from `successes` in `n` trials with the given confidence, both tails alike: [0, 1] without trials.
///
/// # Errors
/// A confidence outside (0, 1).
pub fn clopper_pearson(successes: u64, n: u64, confidence: f64) -> Result<[f64; 2], InquiryError> {
    check_level("confidence", confidence)?;
    let tail = 0.5 * (1.0 - confidence);
    let successes = successes.min(n);
    Ok([lower(successes, n, tail), 1.0 - lower(n - successes, n, tail)])
}

/// Largest p with P(X ≥ successes; n, p) ≤ tail: below it so many successes are that improbable.
fn lower(successes: u64, n: u64, tail: f64) -> f64 {
    if successes == 0 {
        return 0.0;
    }
    let (mut low, mut high) = (0.0_f64, 1.0_f64);
    // Halved until the two ends are neighbours.
    for _ in 0..200 {
        let middle = 0.5 * (low + high);
        if middle <= low || middle >= high {
            break;
        }
        // P(X ≥ k; n, p) = P(X' ≤ n − k; n, 1 − p), which keeps its digits where it is small.
        if risk::cdf(n - successes, n, 1.0 - middle) <= tail { low = middle } else { high = middle }
    }
    low
}

fn check_level(what: &'static str, level: f64) -> Result<(), InquiryError> {
    crate::error::check_numbers(what, &[level], "strictly between 0 and 1", |x| x > 0.0 && x < 1.0)
}

#[cfg(test)]
mod tests {
    use super::{HoldOut, clopper_pearson, is_surprise};
    use crate::{Answers, Belief};

    #[test]
    fn intervals_are_those_of_the_tables() {
        // Closed forms at the ends; the rest from the beta quantiles of standard tables.
        let [low, high] = clopper_pearson(0, 10, 0.95).expect("a level");
        assert!(low == 0.0 && (high - (1.0 - 0.025_f64.powf(0.1))).abs() < 1e-12);
        let [low, high] = clopper_pearson(10, 10, 0.95).expect("a level");
        assert!(high == 1.0 && (low - 0.025_f64.powf(0.1)).abs() < 1e-12);
        let [low, high] = clopper_pearson(2, 10, 0.95).expect("a level");
        assert!((low - 0.025_210_7).abs() < 1e-6 && (high - 0.556_095_5).abs() < 1e-6, "{low} {high}");
        let [low, high] = clopper_pearson(13, 100, 0.95).expect("a level");
        assert!((low - 0.071_073).abs() < 1e-5 && (high - 0.212_041).abs() < 1e-5, "{low} {high}");
        assert_eq!(clopper_pearson(0, 0, 0.9).expect("a level"), [0.0, 1.0]);
        assert!(clopper_pearson(1, 2, 1.0).is_err());
    }

    /// By definition: at the lower end so many or more have exactly the probability of the tail.
    #[test]
    fn ends_have_the_probability_of_the_tails() {
        for (k, n) in [(1, 7), (3, 20), (40, 200)] {
            let [low, high] = clopper_pearson(k, n, 0.9).expect("a level");
            assert!((1.0 - risk::cdf(k - 1, n, low) - 0.05).abs() < 1e-9);
            assert!((risk::cdf(k, n, high) - 0.05).abs() < 1e-9);
        }
    }

    #[test]
    fn what_the_model_hardly_allows_is_a_surprise() {
        let answers = Answers::table(2, vec![0.6, 0.6, 0.35, 0.35, 0.05, 0.05]).expect("answers");
        let belief = Belief::equal(2).expect("draws");
        let surprises: Vec<bool> = (0..3).map(|a| is_surprise(&answers, &belief, a).expect("fits")).collect();
        assert_eq!(surprises, [false, false, true]);
        // Ten equally probable answers: none is a surprise.
        let even = Answers::table(1, vec![0.1; 10]).expect("answers");
        let one = Belief::equal(1).expect("a draw");
        assert!((0..10).all(|a| !is_surprise(&even, &one, a).expect("fits")));

        let mut held_out = HoldOut::default();
        for given in [0, 0, 2, 2, 1, 2] {
            held_out.add(&answers, &belief, given).expect("fits");
        }
        assert_eq!(held_out, HoldOut { n: 6, surprises: 3 });
        // P(X ≥ 3; 6, .1) = .01585.
        assert!(held_out.refutes(0.016).expect("a level") && !held_out.refutes(0.015).expect("a level"));
        assert!(!HoldOut::default().refutes(0.5).expect("a level"));
        let missing = |n, surprises, most| HoldOut { n, surprises }.missing(most, 0.05).expect("a level");
        // 1 − .05^(1/n) ≤ .1 from n = 29 on.
        assert_eq!((missing(0, 0, 0.1), missing(28, 0, 0.1), missing(29, 0, 0.1)), (29, 1, 0));
        assert_eq!((missing(0, 0, 1.0), missing(9, 9, 1e-6)), (0, super::MAX_MISSING));
    }
}
