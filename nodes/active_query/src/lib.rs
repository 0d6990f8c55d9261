//! The node that asks: it proposes hypothetical tables, lets `performance_bounds` judge them, and asks about the one with
//! the largest bound until even that is below ε.

mod node;
mod run;
mod settings;
mod words;

pub use node::{ActiveQuery, Event, Output};
pub use run::run;
pub use settings::Settings;
