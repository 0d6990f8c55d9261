//! Messages of the standard package `std_srvs`.
//!
//! Generated: do not edit. To write it anew: `cargo run --release -p apprentice_msgs --example generate`.

use serde::{Deserialize, Serialize};

/// The message `std_srvs/srv/Empty_Request`.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct EmptyRequest {
    /// Always 0; on the wire a message without members is one octet.
    #[serde(default)]
    pub structure_needs_at_least_one_member: u8,
}

impl crate::Message for EmptyRequest {
    const TYPE: &'static str = "std_srvs/srv/Empty_Request";
}

/// The message `std_srvs/srv/Empty_Response`.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct EmptyResponse {
    /// Always 0; on the wire a message without members is one octet.
    #[serde(default)]
    pub structure_needs_at_least_one_member: u8,
}

impl crate::Message for EmptyResponse {
    const TYPE: &'static str = "std_srvs/srv/Empty_Response";
}

/// The message `std_srvs/srv/SetBool_Request`.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct SetBoolRequest {
    /// (`bool`)
    pub data: bool,
}

impl crate::Message for SetBoolRequest {
    const TYPE: &'static str = "std_srvs/srv/SetBool_Request";
}

/// The message `std_srvs/srv/SetBool_Response`.
#[derive(Debug, Clone, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct SetBoolResponse {
    /// (`bool`)
    pub success: bool,
    /// (`string`)
    pub message: std::string::String,
}

impl crate::Message for SetBoolResponse {
    const TYPE: &'static str = "std_srvs/srv/SetBool_Response";
}

/// The message `std_srvs/srv/Trigger_Request`.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct TriggerRequest {
    /// Always 0; on the wire a message without members is one octet.
    #[serde(default)]
    pub structure_needs_at_least_one_member: u8,
}

impl crate::Message for TriggerRequest {
    const TYPE: &'static str = "std_srvs/srv/Trigger_Request";
}

/// The message `std_srvs/srv/Trigger_Response`.
#[derive(Debug, Clone, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct TriggerResponse {
    /// (`bool`)
    pub success: bool,
    /// (`string`)
    pub message: std::string::String,
}

impl crate::Message for TriggerResponse {
    const TYPE: &'static str = "std_srvs/srv/Trigger_Response";
}

/// The service `std_srvs/srv/Empty`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Empty;

impl crate::Service for Empty {
    type Request = EmptyRequest;
    type Response = EmptyResponse;
    const TYPE: &'static str = "std_srvs/srv/Empty";
}

/// The service `std_srvs/srv/SetBool`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct SetBool;

impl crate::Service for SetBool {
    type Request = SetBoolRequest;
    type Response = SetBoolResponse;
    const TYPE: &'static str = "std_srvs/srv/SetBool";
}

/// The service `std_srvs/srv/Trigger`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Trigger;

impl crate::Service for Trigger {
    type Request = TriggerRequest;
    type Response = TriggerResponse;
    const TYPE: &'static str = "std_srvs/srv/Trigger";
}
