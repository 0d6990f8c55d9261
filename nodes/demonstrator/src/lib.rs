//! A simulated person with a hidden reward, who answers every question about where the target belongs and which of two
//! places is better, and in a world shows
//! what to do and which of two ways is better, and answers what is asked about it.
//!
//! An answer is a function of the seed and the question's id alone, so a person who is killed and comes back says the
//! same again under the same id, and counting once is the receiver's easy job.

mod comparing;
mod identity;
mod node;
mod person;
mod run;
mod settings;
mod teacher;
mod teaching;
mod true_error;
mod world_answers;

pub use identity::answer_id;
pub use node::{DemonstratorNode, Event, MAX_PENDING, Output};
pub use person::{Answer, Comparison, GRID_SIDE, Person, PersonError};
pub use run::run;
pub use settings::{Noise, Settings};
pub use teacher::{Piece, Teacher};
pub use true_error::true_error_m;
