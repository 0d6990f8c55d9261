//! What to ask next (dissertation chapter 8): the question that removes most of the risk, and when to stop asking.
//!
//! Everything works on posterior draws and their weights, whatever the world: a [`Round`] holds the loss of the current policy
//! in each situation under each draw, and for every question how probable each answer is under each draw. [`tabular`]
//! makes them for decision processes, [`table`] for tables. New evidence is weighed by re-weighting the draws; no chain is run.
//!
//! ```
//! use inquiry::{Answers, Belief, Losses, Question, QuestionKind, Round, Selecting, Selection, Strategy, select};
//!
//! // Two draws. Under the first the current policy loses .3, and a person would say the first of two answers with .9.
//! let answers = Answers::table(2, vec![0.9, 0.2, 0.1, 0.8])?;
//! let round = Round {
//!     belief: Belief::equal(2)?,
//!     losses: Losses::new(2, vec![0.3, 0.0])?,
//!     questions: vec![Question { kind: QuestionKind::Action, situation: 0, answers, feasible: true }],
//!     alternatives: None,
//! };
//! let strategy = Strategy::RiskInformation { epsilon: 0.1 };
//! let selecting = Selecting { strategy, effort: None, hold_out_share: 0.1, seed: 1 };
//! assert!(matches!(select(&round, &selecting, 1)?, Selection::Ask(chosen) if chosen.question == 0));
//! # Ok::<(), inquiry::InquiryError>(())
//! ```

mod action_entropy;
mod answers;
mod belief;
mod branches;
mod candidates;
mod choice;
mod drawn;
mod error;
mod hold_out;
mod information;
mod look_ahead;
mod prediction;
mod predictive;
mod question;
mod select;
mod stopping;
mod strategy;
pub mod table;
pub mod tabular;
mod value_at_risk;

pub use action_entropy::action_entropy;
pub use answers::{Answers, MAX_STEPS};
pub use belief::Belief;
pub use branches::Branches;
pub use candidates::candidates;
pub use choice::{Choice, Judged, choose};
pub use drawn::DrawnOptima;
pub use error::InquiryError;
pub use hold_out::{HoldOut, MAX_MISSING, SURPRISING, clopper_pearson, is_surprise};
pub use information::{class_information, reward_information, risk_information};
pub use look_ahead::{Alternatives, Objective, expected_drop};
pub use prediction::{Prediction, PredictionMethod, predict};
pub use predictive::{Answered, PredictiveCheck, predictive_check};
pub use question::{Effort, Losses, Question, QuestionKind, Round};
pub use select::{Chosen, Selecting, Selection, select};
pub use stopping::{Look, LookLevels, Obstacle, Standing, StoppingRule};
pub use strategy::{Strategy, scores};
pub use value_at_risk::values_at_risk;
