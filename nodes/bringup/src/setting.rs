//! `apprentice setting`: a whole table, one thing after another. Each is a lesson of its own, with a reward, a posterior, a bound
//! and a bag of its own; what it ends with stands on the table of the next.

mod course;
mod error;
mod flags;
mod lessons;
mod run;
mod settings;

pub use course::{Course, Lesson, Outcome};
pub use error::SettingError;
pub use flags::Flags;
pub use run::run;
pub use settings::Settings;
