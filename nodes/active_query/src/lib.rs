//! The node that asks: it proposes hypothetical tables, lets `performance_bounds` judge them, and asks about the one with
//! the largest bound, or another that [`Strategy`] chooses, until even the largest bound is below ε. In a lesson about a world
//! it says whether the robot is taught.

mod asking;
mod node;
mod run;
mod settings;
mod words;
mod world_lesson;

pub use node::{ActiveQuery, Event, Output};
pub use run::run;
pub use settings::{Settings, Strategy};
pub use world_lesson::world_lesson;
