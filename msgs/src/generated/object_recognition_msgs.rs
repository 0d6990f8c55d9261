//! Messages of the standard package `object_recognition_msgs`.
//!
//! Generated: do not edit. To write it anew: `cargo run --release -p apprentice_msgs --example generate`.

use serde::{Deserialize, Serialize};

/// The message `object_recognition_msgs/msg/ObjectType`.
#[derive(Debug, Clone, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct ObjectType {
    /// (`string`)
    pub key: std::string::String,
    /// (`string`)
    pub db: std::string::String,
}

impl crate::Message for ObjectType {
    const TYPE: &'static str = "object_recognition_msgs/msg/ObjectType";
}
