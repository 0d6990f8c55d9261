//! Messages of the standard package `diagnostic_msgs`.
//!
//! Generated: do not edit. To write it anew: `cargo run --release -p apprentice_msgs --example generate`.

use serde::{Deserialize, Serialize};

/// The message `diagnostic_msgs/msg/DiagnosticArray`.
#[derive(Debug, Clone, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct DiagnosticArray {
    /// (`std_msgs/Header`)
    pub header: super::std_msgs::Header,
    /// (`DiagnosticStatus[]`)
    pub status: Vec<super::diagnostic_msgs::DiagnosticStatus>,
}

impl crate::Message for DiagnosticArray {
    const TYPE: &'static str = "diagnostic_msgs/msg/DiagnosticArray";
}

/// The message `diagnostic_msgs/msg/DiagnosticStatus`.
#[derive(Debug, Clone, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct DiagnosticStatus {
    /// (`byte`)
    pub level: u8,
    /// (`string`)
    pub name: std::string::String,
    /// (`string`)
    pub message: std::string::String,
    /// (`string`)
    pub hardware_id: std::string::String,
    /// (`KeyValue[]`)
    pub values: Vec<super::diagnostic_msgs::KeyValue>,
}

impl DiagnosticStatus {
    /// The constant `OK`.
    pub const OK: u8 = 0;
    /// The constant `WARN`.
    pub const WARN: u8 = 1;
    /// The constant `ERROR`.
    pub const ERROR: u8 = 2;
    /// The constant `STALE`.
    pub const STALE: u8 = 3;
}

impl crate::Message for DiagnosticStatus {
    const TYPE: &'static str = "diagnostic_msgs/msg/DiagnosticStatus";
}

/// The message `diagnostic_msgs/msg/KeyValue`.
#[derive(Debug, Clone, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct KeyValue {
    /// (`string`)
    pub key: std::string::String,
    /// (`string`)
    pub value: std::string::String,
}

impl crate::Message for KeyValue {
    const TYPE: &'static str = "diagnostic_msgs/msg/KeyValue";
}
