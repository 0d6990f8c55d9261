//! A question with all that is needed to judge it, and everything that can be asked at one time.

use crate::error::{check_length, check_numbers};
use crate::{Alternatives, Answers, Belief, InquiryError};

/// What kind of answer a person gives.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum QuestionKind {
    /// What would you do here? (Algorithm 5)
    Action,
    /// Which parts of this trajectory are good, which bad? (Algorithm 6)
    Critique,
    /// Where does it belong on this table? (section 8.2.4)
    Placement,
    /// Which of these two is better?
    Comparison,
}

/// How long a person takes to answer each kind of question, seconds.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Effort {
    /// An action.
    pub action_s: f64,
    /// A critique.
    pub critique_s: f64,
    /// A placement.
    pub placement_s: f64,
    /// A comparison.
    pub comparison_s: f64,
}

impl Default for Effort {
    /// Guesses for a person at a screen, to be replaced by what was measured.
    fn default() -> Self {
        Self { action_s: 4.0, critique_s: 15.0, placement_s: 8.0, comparison_s: 5.0 }
    }
}

impl Effort {
    /// Seconds that one question of a kind takes.
    pub fn seconds(&self, kind: QuestionKind) -> f64 {
        match kind {
            QuestionKind::Action => self.action_s,
            QuestionKind::Critique => self.critique_s,
            QuestionKind::Placement => self.placement_s,
            QuestionKind::Comparison => self.comparison_s,
        }
    }

    /// Refuses times that are none.
    ///
    /// # Errors
    /// A time that is not positive and finite.
    pub fn check(&self) -> Result<(), InquiryError> {
        let all = [self.action_s, self.critique_s, self.placement_s, self.comparison_s];
        check_numbers("seconds of a kind of question", &all, "positive and finite", |s| s > 0.0 && s.is_finite())
    }
}

/// Something that can be asked.
#[derive(Debug, Clone, PartialEq)]
pub struct Question {
    /// What kind of answer it wants.
    pub kind: QuestionKind,
    /// The situation it is about: a state, a table. A row of [`Losses`]. A comparison is about that of its first item.
    pub situation: usize,
    /// What a person may answer.
    pub answers: Answers,
    /// Whether the robot could do what it asks about: the state or table can be reached and shown.
    pub feasible: bool,
}

/// Losses of the current policy: one row of n draws per situation (eq. 8.2 for states, placement loss for tables).
#[derive(Debug, Clone, PartialEq)]
pub struct Losses {
    n_draws: usize,
    values: Vec<f64>,
}

impl Losses {
    /// `values` holds one row of n draws per situation.
    ///
    /// # Errors
    /// No draws, rows of another length, losses that are not finite.
    pub fn new(n_draws: usize, values: Vec<f64>) -> Result<Self, InquiryError> {
        if n_draws == 0 {
            return Err(InquiryError::Empty { what: "draws" });
        }
        check_length("losses", values.len(), values.len() / n_draws * n_draws)?;
        check_numbers("loss", &values, "finite", f64::is_finite)?;
        Ok(Self { n_draws, values })
    }

    /// Draws.
    pub fn n_draws(&self) -> usize {
        self.n_draws
    }

    /// Situations.
    pub fn n_situations(&self) -> usize {
        self.values.len() / self.n_draws
    }

    /// The losses in one situation, one a draw.
    ///
    /// # Panics
    /// When there is no such situation.
    pub fn of(&self, situation: usize) -> &[f64] {
        &self.values[situation * self.n_draws..][..self.n_draws]
    }
}

/// What there is to choose from at one time, for any world.
#[derive(Debug, Clone, PartialEq)]
pub struct Round {
    /// Weights of the draws.
    pub belief: Belief,
    /// Of the current policy.
    pub losses: Losses,
    /// What may be asked.
    pub questions: Vec<Question>,
    /// Policies that the robot could take up instead, the current one first; without them nothing looks ahead.
    pub alternatives: Option<Alternatives>,
}

impl Round {
    /// Leaves feasible what is and what the robot `could` carry out: reach the state, lay the table, show the trajectory.
    pub fn only_feasible(&mut self, could: impl Fn(&Question) -> bool) {
        for question in &mut self.questions {
            question.feasible = question.feasible && could(question);
        }
    }

    /// Refuses parts that are not about the same draws and situations.
    ///
    /// # Errors
    /// The first part that does not fit.
    pub fn check(&self) -> Result<(), InquiryError> {
        let n = self.belief.n();
        check_length("draws with losses", self.losses.n_draws(), n)?;
        if let Some(alternatives) = &self.alternatives {
            check_length("draws with alternatives", alternatives.n_draws(), n)?;
        }
        for question in &self.questions {
            check_length("draws with answers", question.answers.n_draws(), n)?;
            if question.situation >= self.losses.n_situations() {
                let (got, expected) = (self.losses.n_situations(), question.situation + 1);
                return Err(InquiryError::Length { what: "situations", got, expected });
            }
        }
        Ok(())
    }
}
