//! Messages of the standard package `action_msgs`.
//!
//! Generated: do not edit. To write it anew: `cargo run --release -p apprentice_msgs --example generate`.

use serde::{Deserialize, Serialize};

/// The message `action_msgs/msg/GoalInfo`.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct GoalInfo {
    /// (`unique_identifier_msgs/UUID`)
    pub goal_id: super::unique_identifier_msgs::UUID,
    /// (`builtin_interfaces/Time`)
    pub stamp: super::builtin_interfaces::Time,
}

impl crate::Message for GoalInfo {
    const TYPE: &'static str = "action_msgs/msg/GoalInfo";
}

/// The message `action_msgs/msg/GoalStatus`.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct GoalStatus {
    /// (`GoalInfo`)
    pub goal_info: super::action_msgs::GoalInfo,
    /// (`int8`)
    pub status: i8,
}

impl GoalStatus {
    /// The constant `STATUS_UNKNOWN`.
    pub const STATUS_UNKNOWN: i8 = 0;
    /// The constant `STATUS_ACCEPTED`.
    pub const STATUS_ACCEPTED: i8 = 1;
    /// The constant `STATUS_EXECUTING`.
    pub const STATUS_EXECUTING: i8 = 2;
    /// The constant `STATUS_CANCELING`.
    pub const STATUS_CANCELING: i8 = 3;
    /// The constant `STATUS_SUCCEEDED`.
    pub const STATUS_SUCCEEDED: i8 = 4;
    /// The constant `STATUS_CANCELED`.
    pub const STATUS_CANCELED: i8 = 5;
    /// The constant `STATUS_ABORTED`.
    pub const STATUS_ABORTED: i8 = 6;
}

impl crate::Message for GoalStatus {
    const TYPE: &'static str = "action_msgs/msg/GoalStatus";
}

/// The message `action_msgs/msg/GoalStatusArray`.
#[derive(Debug, Clone, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct GoalStatusArray {
    /// (`GoalStatus[]`)
    pub status_list: Vec<super::action_msgs::GoalStatus>,
}

impl crate::Message for GoalStatusArray {
    const TYPE: &'static str = "action_msgs/msg/GoalStatusArray";
}

/// The message `action_msgs/srv/CancelGoal_Request`.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct CancelGoalRequest {
    /// (`GoalInfo`)
    pub goal_info: super::action_msgs::GoalInfo,
}

impl crate::Message for CancelGoalRequest {
    const TYPE: &'static str = "action_msgs/srv/CancelGoal_Request";
}

/// The message `action_msgs/srv/CancelGoal_Response`.
#[derive(Debug, Clone, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct CancelGoalResponse {
    /// (`int8`)
    pub return_code: i8,
    /// (`GoalInfo[]`)
    pub goals_canceling: Vec<super::action_msgs::GoalInfo>,
}

impl CancelGoalResponse {
    /// The constant `ERROR_NONE`.
    pub const ERROR_NONE: i8 = 0;
    /// The constant `ERROR_REJECTED`.
    pub const ERROR_REJECTED: i8 = 1;
    /// The constant `ERROR_UNKNOWN_GOAL_ID`.
    pub const ERROR_UNKNOWN_GOAL_ID: i8 = 2;
    /// The constant `ERROR_GOAL_TERMINATED`.
    pub const ERROR_GOAL_TERMINATED: i8 = 3;
}

impl crate::Message for CancelGoalResponse {
    const TYPE: &'static str = "action_msgs/srv/CancelGoal_Response";
}

/// The service `action_msgs/srv/CancelGoal`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct CancelGoal;

impl crate::Service for CancelGoal {
    type Request = CancelGoalRequest;
    type Response = CancelGoalResponse;
    const TYPE: &'static str = "action_msgs/srv/CancelGoal";
}
