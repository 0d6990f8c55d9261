//! Recomputes a recorded session from its evidence and settings, and compares every bit with what was recorded.

mod command;
mod difference;
mod error;
mod policies;
mod recompute;
mod recording;
mod report;

pub use command::{Arguments, run};
pub use difference::{Difference, difference};
pub use error::ReplayError;
pub use recompute::{Lesson, Round, TableRound, recompute};
pub use recording::Recording;
pub use report::{Checked, Report, verify};
