//! Messages of the standard package `rosgraph_msgs`.
//!
//! Generated: do not edit. To write it anew: `cargo run --release -p apprentice_msgs --example generate`.

use serde::{Deserialize, Serialize};

/// The message `rosgraph_msgs/msg/Clock`.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Clock {
    /// (`builtin_interfaces/Time`)
    pub clock: super::builtin_interfaces::Time,
}

impl crate::Message for Clock {
    const TYPE: &'static str = "rosgraph_msgs/msg/Clock";
}
