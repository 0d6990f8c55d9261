//! Services of this package.
//!
//! Generated: do not edit. To write it anew: `cargo run --release -p apprentice_msgs --example generate`.

use serde::{Deserialize, Serialize};

/// Pauses or resumes a running replay.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct SetPausedRequest {
    /// (`bool`)
    pub paused: bool,
}

impl crate::Message for SetPausedRequest {
    const TYPE: &'static str = "apprentice_msgs/srv/SetPaused_Request";
}

/// The message `apprentice_msgs/srv/SetPaused_Response`.
#[derive(Debug, Clone, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct SetPausedResponse {
    /// (`bool`)
    pub paused: bool,
    /// (`string`)
    pub message: std::string::String,
}

impl crate::Message for SetPausedResponse {
    const TYPE: &'static str = "apprentice_msgs/srv/SetPaused_Response";
}

/// The service `apprentice_msgs/srv/SetPaused`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct SetPaused;

impl crate::Service for SetPaused {
    type Request = SetPausedRequest;
    type Response = SetPausedResponse;
    const TYPE: &'static str = "apprentice_msgs/srv/SetPaused";
}
