//! The player: publishes the messages of a bag, ours or others', as they were recorded.
//!
//! [`Schedule`] says when each message is due, [`PlayerNode`] which messages go out, and [`run`] does it on the graph.

mod node;
mod qos;
mod run;
mod schedule;
mod settings;

pub use node::{Event, Output, PlayerNode, Source, Summary};
pub use qos::replay_qos;
pub use run::run;
pub use schedule::Schedule;
pub use settings::Settings;
