//! The mathematics on CSV and JSON files, without ROS: `apprentice infer`, `likelihood`, `bound`, `evaluate` and
//! `optimize`.
//!
//! Each command is a set of flags and a function that runs it: files in, one answer out, on standard output. The formats stand
//! in `README.md` beside this crate.

mod answer;
mod clock;
mod commands;
mod error;
mod evidence;
mod files;
mod judgement;
mod sampling;

pub use commands::{bound, evaluate, infer, likelihood, optimize};
pub use error::OfflineError;
