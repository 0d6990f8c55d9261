//! The node that listens: it takes demonstrations, retractions and responses, keeps them in an append-only journal, and
//! publishes draws of the person's reward weights.

mod evidence;
mod journal;
mod node;
mod receive;
mod run;
mod settings;

pub use evidence::Evidence;
pub use journal::{Entry, JournalError, MAGIC, read_journal};
pub use node::{Event, Output, RewardPosterior, replay_records};
pub use run::run;
pub use settings::{Prior, Settings};
