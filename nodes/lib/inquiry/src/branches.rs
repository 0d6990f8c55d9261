//! What may be believed once open questions are answered, one belief for every combination of answers: so that several questions can
//! be chosen together, or the next one while the person thinks. Questions that would tell the same are not asked twice, and expected
//! scores that are information add up to the joint information (chain rule).

use crate::select::select_by;
use crate::strategy::scores;
use crate::{Answers, Belief, InquiryError, Round, Selecting, Selection};

/// Beliefs with the probability that answers lead there; the probabilities sum to 1.
#[derive(Debug, Clone, PartialEq)]
pub struct Branches {
    of: Vec<(f64, Belief)>,
}

impl Branches {
    /// Nothing is asked: what is believed now.
    pub fn now(belief: Belief) -> Self {
        Self { of: vec![(1.0, belief)] }
    }

    /// Every branch continued by every answer to one more question. At most `most` are kept, the most probable ones, as if no
    /// other answers could come.
    pub fn after(&self, answers: &Answers, most: usize) -> Self {
        let mut next: Vec<(f64, Belief)> = Vec::new();
        for (probability, belief) in &self.of {
            answers.for_each(|_, p| {
                let of_answer = belief.mean(p);
                if let Some(after) = belief.after(p).filter(|_| of_answer > 0.0) {
                    next.push((probability * of_answer, after));
                }
            });
            // Few at any time; the sort is stable, so equals stay in order.
            next.sort_by(|a, b| b.0.total_cmp(&a.0));
            next.truncate(most.max(1));
        }
        let total: f64 = next.iter().map(|branch| branch.0).sum();
        next.iter_mut().for_each(|branch| branch.0 /= total);
        if next.is_empty() { self.clone() } else { Self { of: next } }
    }

    /// The question to ask at look number `look`, by its expected score once the answers to those that are open are in, and none
    /// of those `asked`. With nothing open it is what [`crate::select`] gives.
    ///
    /// # Errors
    /// As [`crate::select`].
    pub fn select(
        &self,
        round: &Round,
        selecting: &Selecting,
        look: u64,
        asked: &[usize],
    ) -> Result<Selection, InquiryError> {
        let mut expected = vec![0.0; round.questions.len()];
        for (probability, belief) in &self.of {
            for (sum, score) in expected.iter_mut().zip(scores(round, belief, selecting.strategy)?) {
                *sum += probability * score;
            }
        }
        select_by(round, &expected, selecting, look, asked)
    }
}
