//! Messages of the standard package `builtin_interfaces`.
//!
//! Generated: do not edit. To write it anew: `cargo run --release -p apprentice_msgs --example generate`.

use serde::{Deserialize, Serialize};

/// The message `builtin_interfaces/msg/Duration`.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Duration {
    /// (`int32`)
    pub sec: i32,
    /// (`uint32`)
    pub nanosec: u32,
}

impl crate::Message for Duration {
    const TYPE: &'static str = "builtin_interfaces/msg/Duration";
}

/// The message `builtin_interfaces/msg/Time`.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Time {
    /// (`int32`)
    pub sec: i32,
    /// (`uint32`)
    pub nanosec: u32,
}

impl crate::Message for Time {
    const TYPE: &'static str = "builtin_interfaces/msg/Time";
}
