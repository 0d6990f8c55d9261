//! The recorder: subscribes to any topic on the graph without knowing its type, and writes a rosbag2 folder.
//!
//! [`RecorderNode`] decides what to record; [`Tape`] writes it, on a thread of its own when [`run`] wires them.

mod definitions;
mod keepsakes;
mod node;
mod run;
mod settings;
mod tape;
mod writing;

pub use definitions::Definitions;
pub use node::{Event, Output, RecorderNode};
pub use run::run;
pub use settings::{Compression, Settings};
pub use tape::{Tape, TapeError, TapeSettings};
