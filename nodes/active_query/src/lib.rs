//! The node that asks: it proposes hypothetical tables, lets `performance_bounds` judge them, and asks about the one with
//! the largest bound, or another that [`Strategy`] chooses, until even the largest bound is below ε. In a lesson about a world
//! it asks what to do in a state, what is good in a way, or which of two is better, until the robot's policy loses little.

mod ahead;
mod asking;
mod node;
mod run;
mod settings;
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
pub use settings::{QuestionKind, Settings, Strategy};
pub use world_fit::fitted;
pub use world_lesson::{unjudged, world_lesson};
pub use world_question::{WorldInputs, questions_ahead, world_question};
