//! The node that asks: it proposes hypothetical tables, lets `performance_bounds` judge them, and asks about the one with
//! the largest bound, or another that [`Strategy`] chooses, until even the largest bound is below ε: where something belongs, or in
//! which of two places. In a lesson about a world
//! it asks what to do in a state, what is good in a way, or which of two is better, until the robot's policy loses little.

mod ahead;
mod draws;
mod fit;
mod fit_words;
mod node;
mod question_id;
mod reach;
mod run;
mod settings;
mod table_draws;
mod table_fit;
mod table_lesson;
mod table_question;
mod tables;
mod wishes;
mod words;
mod world_draws;
mod world_fit;
mod world_lesson;
mod world_question;
mod world_rests;
mod world_subjects;
mod world_words;
mod worlds;

pub use node::{ActiveQuery, Event, Output};
pub use run::run;
pub use settings::{QuestionKind, Settings, Strategy, TableQuestionKind};
pub use world_fit::fitted;
pub use world_lesson::{unjudged, world_lesson};
pub use world_question::{WorldInputs, questions_ahead, world_question};
