//! The node that listens: it takes evidence of every kind, retractions and responses, keeps them in an append-only journal, and
//! publishes draws of the person's reward weights.

mod evidence;
mod inference;
mod journal;
mod message;
mod node;
mod piece;
mod preview;
mod receive;
mod run;
mod settings;
mod subject;
mod waiting;
mod weights;
mod work;

pub use evidence::Evidence;
pub use journal::{Entry, JournalError, MAGIC, read_journal};
pub use node::{Event, Output, RewardPosterior};
pub use run::run;
pub use settings::{Prior, Settings};
pub use work::{Due, Work, Worked};
