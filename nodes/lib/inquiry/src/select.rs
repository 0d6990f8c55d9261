//! From scores to a question: what it costs the person, what the robot could not do, and now and then one at random.

use mdp::random::{index, uniform};
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;

use crate::{Effort, InquiryError, Round, Strategy, scores};

/// Gains at or below this are rounding.
const NOTHING: f64 = 1e-12;

/// How to choose.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Selecting {
    /// By what.
    pub strategy: Strategy,
    /// Where the score is a gain it is divided by the seconds that the question takes; `None`: all take as long.
    pub effort: Option<Effort>,
    /// Share of questions in [0, 1) that are asked at random, whatever the strategy: a sample that is fair to the world, which
    /// shows a model that is wrong (see [`crate::HoldOut`]).
    pub hold_out_share: f64,
    /// Seed of everything random.
    pub seed: u64,
}

/// What to ask.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Selection {
    /// This question.
    Ask(Chosen),
    /// There is a question, but no answer to any would change anything: all draws agree on what matters.
    NothingToLearn,
    /// None of the questions could be carried out, or there is none.
    NothingFeasible,
}

/// A question with why it was chosen.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Chosen {
    /// Its place in the round.
    pub question: usize,
    /// Its score under the strategy.
    pub score: f64,
    /// Score per second of the person's time, where the score is a gain and the effort is known.
    pub per_second: Option<f64>,
    /// Whether it was drawn at random to be held out.
    pub is_hold_out: bool,
}

impl Selection {
    /// The question, if there is one.
    pub fn chosen(&self) -> Option<&Chosen> {
        match self {
            Self::Ask(chosen) => Some(chosen),
            Self::NothingToLearn | Self::NothingFeasible => None,
        }
    }
}

/// The question to ask at look number `look`. Of equals the first; a function of its arguments.
///
/// # Errors
/// Parts that do not fit together, a share outside [0, 1), times that are not positive.
pub fn select(round: &Round, selecting: &Selecting, look: u64) -> Result<Selection, InquiryError> {
    let scores = scores(round, &round.belief, selecting.strategy)?;
    select_by(round, &scores, selecting, look, &[])
}

/// The same with scores that are known, and without the questions `asked` already.
pub(crate) fn select_by(
    round: &Round,
    scores: &[f64],
    selecting: &Selecting,
    look: u64,
    asked: &[usize],
) -> Result<Selection, InquiryError> {
    let share = [selecting.hold_out_share];
    crate::error::check_numbers("hold-out share", &share, "at least 0 and below 1", |s| (0.0..1.0).contains(&s))?;
    if let Some(effort) = &selecting.effort {
        effort.check()?;
    }
    let feasible: Vec<usize> =
        (0..scores.len()).filter(|i| round.questions[*i].feasible && !asked.contains(i)).collect();
    if feasible.is_empty() {
        return Ok(Selection::NothingFeasible);
    }
    let mut rng = ChaCha8Rng::seed_from_u64(selecting.seed);
    rng.set_stream(look);
    let is_hold_out = uniform(&mut rng) < selecting.hold_out_share;
    let is_gain = selecting.strategy.is_gain();
    let per_second = |question: usize| {
        let effort = selecting.effort.filter(|_| is_gain)?;
        Some(scores[question] / effort.seconds(round.questions[question].kind))
    };
    let worth = |question: usize| per_second(question).unwrap_or(scores[question]);
    let question = if is_hold_out || selecting.strategy == Strategy::Random {
        feasible[index(feasible.len(), &mut rng)]
    } else {
        let best = feasible.iter().copied().fold(feasible[0], |best, i| if worth(i) > worth(best) { i } else { best });
        if scores[best] <= NOTHING {
            return Ok(Selection::NothingToLearn);
        }
        best
    };
    let (score, per_second) = (scores[question], per_second(question));
    Ok(Selection::Ask(Chosen { question, score, per_second, is_hold_out }))
}
