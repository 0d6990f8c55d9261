//! Messages of the standard package `unique_identifier_msgs`.
//!
//! Generated: do not edit. To write it anew: `cargo run --release -p apprentice_msgs --example generate`.

use serde::{Deserialize, Serialize};

/// The message `unique_identifier_msgs/msg/UUID`.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct UUID {
    /// (`uint8[16]`)
    pub uuid: [u8; 16],
}

impl crate::Message for UUID {
    const TYPE: &'static str = "unique_identifier_msgs/msg/UUID";
}
