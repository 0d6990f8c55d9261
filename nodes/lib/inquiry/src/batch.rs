//! Several questions at once, and the next one for every possible answer, so that the person never waits.

use crate::select::select_under;
use crate::{Belief, Branches, Chosen, InquiryError, Round, Selecting, Selection};

/// Combinations of answers that are followed, at most: the most probable ones.
const MAX_BRANCHES: usize = 64;

/// At most `n` questions worth asking together. The first is the one [`crate::select`] gives; each further one is chosen by its
/// expected score once the answers to those before it are in, over the 64 most probable combinations of answers. So
/// questions that would tell the same are not asked twice, and scores that are information add up to the joint information
/// (chain rule). No question comes twice.
///
/// # Errors
/// As [`crate::select`].
pub fn batch(round: &Round, selecting: &Selecting, look: u64, n: usize) -> Result<Vec<Chosen>, InquiryError> {
    let mut chosen: Vec<Chosen> = Vec::new();
    let mut asked: Vec<usize> = Vec::new();
    let mut branches = Branches::now(round.belief.clone());
    while chosen.len() < n {
        // Every question of a batch draws its own lot.
        let lot = look.wrapping_add((chosen.len() as u64) << 32);
        let Selection::Ask(next) = branches.select(round, selecting, lot, &asked)? else { break };
        asked.push(next.question);
        chosen.push(next);
        if chosen.len() < n {
            branches = branches.after(&round.questions[next.question].answers, MAX_BRANCHES);
        }
    }
    Ok(chosen)
}

/// The next question for an answer that may come.
#[derive(Debug, Clone, PartialEq)]
pub struct Prefetched {
    /// The answer.
    pub answer: usize,
    /// How probable it is now.
    pub probability: f64,
    /// What to ask then.
    pub selection: Selection,
}

/// What to ask after every answer to `question` that is at least as probable as `least`, answers ascending: to be at hand while the
/// person thinks. Draws are re-weighted; the losses stay those of the current policy, so the question is to be chosen anew
/// when the new draws come before it is shown.
///
/// # Errors
/// As [`crate::select`]; no such question.
pub fn prefetch(
    round: &Round,
    selecting: &Selecting,
    look: u64,
    question: usize,
    least: f64,
) -> Result<Vec<Prefetched>, InquiryError> {
    let Some(open) = round.questions.get(question) else {
        let (got, expected) = (round.questions.len(), question + 1);
        return Err(InquiryError::Length { what: "questions", got, expected });
    };
    let mut probable: Vec<(usize, f64, Belief)> = Vec::new();
    open.answers.for_each(|answer, p| {
        let probability = round.belief.mean(p);
        if let Some(after) = round.belief.after(p).filter(|_| probability >= least) {
            probable.push((answer, probability, after));
        }
    });
    let next = |(answer, probability, belief): (usize, f64, Belief)| {
        let selection = select_under(round, &belief, selecting, look.wrapping_add(1), &[question])?;
        Ok(Prefetched { answer, probability, selection })
    };
    probable.into_iter().map(next).collect()
}
