//! Messages of the standard package `tf2_msgs`.
//!
//! Generated: do not edit. To write it anew: `cargo run --release -p apprentice_msgs --example generate`.

use serde::{Deserialize, Serialize};

/// The message `tf2_msgs/msg/TFMessage`.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct TFMessage {
    /// (`geometry_msgs/TransformStamped[]`)
    pub transforms: Vec<super::geometry_msgs::TransformStamped>,
}

impl crate::Message for TFMessage {
    const TYPE: &'static str = "tf2_msgs/msg/TFMessage";
}
