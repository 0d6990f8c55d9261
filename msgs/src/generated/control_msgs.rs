//! Messages of the standard package `control_msgs`.
//!
//! Generated: do not edit. To write it anew: `cargo run --release -p apprentice_msgs --example generate`.

use serde::{Deserialize, Serialize};

/// The message `control_msgs/action/FollowJointTrajectory_Goal`.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct FollowJointTrajectoryGoal {
    /// (`trajectory_msgs/JointTrajectory`)
    pub trajectory: super::trajectory_msgs::JointTrajectory,
    /// (`trajectory_msgs/MultiDOFJointTrajectory`)
    pub multi_dof_trajectory: super::trajectory_msgs::MultiDOFJointTrajectory,
    /// (`JointTolerance[]`)
    pub path_tolerance: Vec<super::control_msgs::JointTolerance>,
    /// (`JointComponentTolerance[]`)
    pub component_path_tolerance: Vec<super::control_msgs::JointComponentTolerance>,
    /// (`JointTolerance[]`)
    pub goal_tolerance: Vec<super::control_msgs::JointTolerance>,
    /// (`JointComponentTolerance[]`)
    pub component_goal_tolerance: Vec<super::control_msgs::JointComponentTolerance>,
    /// (`builtin_interfaces/Duration`)
    pub goal_time_tolerance: super::builtin_interfaces::Duration,
}

impl crate::Message for FollowJointTrajectoryGoal {
    const TYPE: &'static str = "control_msgs/action/FollowJointTrajectory_Goal";
}

/// The message `control_msgs/action/FollowJointTrajectory_Result`.
#[derive(Debug, Clone, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct FollowJointTrajectoryResult {
    /// (`int32`)
    pub error_code: i32,
    /// (`string`)
    pub error_string: std::string::String,
}

impl FollowJointTrajectoryResult {
    /// The constant `SUCCESSFUL`.
    pub const SUCCESSFUL: i32 = 0;
    /// The constant `INVALID_GOAL`.
    pub const INVALID_GOAL: i32 = -1;
    /// The constant `INVALID_JOINTS`.
    pub const INVALID_JOINTS: i32 = -2;
    /// The constant `OLD_HEADER_TIMESTAMP`.
    pub const OLD_HEADER_TIMESTAMP: i32 = -3;
    /// The constant `PATH_TOLERANCE_VIOLATED`.
    pub const PATH_TOLERANCE_VIOLATED: i32 = -4;
    /// The constant `GOAL_TOLERANCE_VIOLATED`.
    pub const GOAL_TOLERANCE_VIOLATED: i32 = -5;
}

impl crate::Message for FollowJointTrajectoryResult {
    const TYPE: &'static str = "control_msgs/action/FollowJointTrajectory_Result";
}

/// The message `control_msgs/action/FollowJointTrajectory_Feedback`.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct FollowJointTrajectoryFeedback {
    /// (`std_msgs/Header`)
    pub header: super::std_msgs::Header,
    /// (`string[]`)
    pub joint_names: Vec<std::string::String>,
    /// (`trajectory_msgs/JointTrajectoryPoint`)
    pub desired: super::trajectory_msgs::JointTrajectoryPoint,
    /// (`trajectory_msgs/JointTrajectoryPoint`)
    pub actual: super::trajectory_msgs::JointTrajectoryPoint,
    /// (`trajectory_msgs/JointTrajectoryPoint`)
    pub error: super::trajectory_msgs::JointTrajectoryPoint,
    /// (`string[]`)
    pub multi_dof_joint_names: Vec<std::string::String>,
    /// (`trajectory_msgs/MultiDOFJointTrajectoryPoint`)
    pub multi_dof_desired: super::trajectory_msgs::MultiDOFJointTrajectoryPoint,
    /// (`trajectory_msgs/MultiDOFJointTrajectoryPoint`)
    pub multi_dof_actual: super::trajectory_msgs::MultiDOFJointTrajectoryPoint,
    /// (`trajectory_msgs/MultiDOFJointTrajectoryPoint`)
    pub multi_dof_error: super::trajectory_msgs::MultiDOFJointTrajectoryPoint,
}

impl crate::Message for FollowJointTrajectoryFeedback {
    const TYPE: &'static str = "control_msgs/action/FollowJointTrajectory_Feedback";
}

/// The message `control_msgs/action/FollowJointTrajectory_SendGoal_Request`.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct FollowJointTrajectorySendGoalRequest {
    /// (`unique_identifier_msgs/UUID`)
    pub goal_id: super::unique_identifier_msgs::UUID,
    /// (`control_msgs/FollowJointTrajectory_Goal`)
    pub goal: super::control_msgs::FollowJointTrajectoryGoal,
}

impl crate::Message for FollowJointTrajectorySendGoalRequest {
    const TYPE: &'static str = "control_msgs/action/FollowJointTrajectory_SendGoal_Request";
}

/// The message `control_msgs/action/FollowJointTrajectory_SendGoal_Response`.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct FollowJointTrajectorySendGoalResponse {
    /// (`bool`)
    pub accepted: bool,
    /// (`builtin_interfaces/Time`)
    pub stamp: super::builtin_interfaces::Time,
}

impl crate::Message for FollowJointTrajectorySendGoalResponse {
    const TYPE: &'static str = "control_msgs/action/FollowJointTrajectory_SendGoal_Response";
}

/// The message `control_msgs/action/FollowJointTrajectory_GetResult_Request`.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct FollowJointTrajectoryGetResultRequest {
    /// (`unique_identifier_msgs/UUID`)
    pub goal_id: super::unique_identifier_msgs::UUID,
}

impl crate::Message for FollowJointTrajectoryGetResultRequest {
    const TYPE: &'static str = "control_msgs/action/FollowJointTrajectory_GetResult_Request";
}

/// The message `control_msgs/action/FollowJointTrajectory_GetResult_Response`.
#[derive(Debug, Clone, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct FollowJointTrajectoryGetResultResponse {
    /// (`int8`)
    pub status: i8,
    /// (`control_msgs/FollowJointTrajectory_Result`)
    pub result: super::control_msgs::FollowJointTrajectoryResult,
}

impl crate::Message for FollowJointTrajectoryGetResultResponse {
    const TYPE: &'static str = "control_msgs/action/FollowJointTrajectory_GetResult_Response";
}

/// The message `control_msgs/action/FollowJointTrajectory_FeedbackMessage`.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct FollowJointTrajectoryFeedbackMessage {
    /// (`unique_identifier_msgs/UUID`)
    pub goal_id: super::unique_identifier_msgs::UUID,
    /// (`control_msgs/FollowJointTrajectory_Feedback`)
    pub feedback: super::control_msgs::FollowJointTrajectoryFeedback,
}

impl crate::Message for FollowJointTrajectoryFeedbackMessage {
    const TYPE: &'static str = "control_msgs/action/FollowJointTrajectory_FeedbackMessage";
}

/// The message `control_msgs/action/GripperCommand_Goal`.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub struct GripperCommandGoal {
    /// (`GripperCommand`)
    pub command: super::control_msgs::GripperCommand,
}

impl crate::Message for GripperCommandGoal {
    const TYPE: &'static str = "control_msgs/action/GripperCommand_Goal";
}

/// The message `control_msgs/action/GripperCommand_Result`.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub struct GripperCommandResult {
    /// (`float64`)
    pub position: f64,
    /// (`float64`)
    pub effort: f64,
    /// (`bool`)
    pub stalled: bool,
    /// (`bool`)
    pub reached_goal: bool,
}

impl crate::Message for GripperCommandResult {
    const TYPE: &'static str = "control_msgs/action/GripperCommand_Result";
}

/// The message `control_msgs/action/GripperCommand_Feedback`.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub struct GripperCommandFeedback {
    /// (`float64`)
    pub position: f64,
    /// (`float64`)
    pub effort: f64,
    /// (`bool`)
    pub stalled: bool,
    /// (`bool`)
    pub reached_goal: bool,
}

impl crate::Message for GripperCommandFeedback {
    const TYPE: &'static str = "control_msgs/action/GripperCommand_Feedback";
}

/// The message `control_msgs/action/GripperCommand_SendGoal_Request`.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub struct GripperCommandSendGoalRequest {
    /// (`unique_identifier_msgs/UUID`)
    pub goal_id: super::unique_identifier_msgs::UUID,
    /// (`control_msgs/GripperCommand_Goal`)
    pub goal: super::control_msgs::GripperCommandGoal,
}

impl crate::Message for GripperCommandSendGoalRequest {
    const TYPE: &'static str = "control_msgs/action/GripperCommand_SendGoal_Request";
}

/// The message `control_msgs/action/GripperCommand_SendGoal_Response`.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct GripperCommandSendGoalResponse {
    /// (`bool`)
    pub accepted: bool,
    /// (`builtin_interfaces/Time`)
    pub stamp: super::builtin_interfaces::Time,
}

impl crate::Message for GripperCommandSendGoalResponse {
    const TYPE: &'static str = "control_msgs/action/GripperCommand_SendGoal_Response";
}

/// The message `control_msgs/action/GripperCommand_GetResult_Request`.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct GripperCommandGetResultRequest {
    /// (`unique_identifier_msgs/UUID`)
    pub goal_id: super::unique_identifier_msgs::UUID,
}

impl crate::Message for GripperCommandGetResultRequest {
    const TYPE: &'static str = "control_msgs/action/GripperCommand_GetResult_Request";
}

/// The message `control_msgs/action/GripperCommand_GetResult_Response`.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub struct GripperCommandGetResultResponse {
    /// (`int8`)
    pub status: i8,
    /// (`control_msgs/GripperCommand_Result`)
    pub result: super::control_msgs::GripperCommandResult,
}

impl crate::Message for GripperCommandGetResultResponse {
    const TYPE: &'static str = "control_msgs/action/GripperCommand_GetResult_Response";
}

/// The message `control_msgs/action/GripperCommand_FeedbackMessage`.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub struct GripperCommandFeedbackMessage {
    /// (`unique_identifier_msgs/UUID`)
    pub goal_id: super::unique_identifier_msgs::UUID,
    /// (`control_msgs/GripperCommand_Feedback`)
    pub feedback: super::control_msgs::GripperCommandFeedback,
}

impl crate::Message for GripperCommandFeedbackMessage {
    const TYPE: &'static str = "control_msgs/action/GripperCommand_FeedbackMessage";
}

/// The message `control_msgs/msg/GripperCommand`.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub struct GripperCommand {
    /// (`float64`)
    pub position: f64,
    /// (`float64`)
    pub max_effort: f64,
}

impl crate::Message for GripperCommand {
    const TYPE: &'static str = "control_msgs/msg/GripperCommand";
}

/// The message `control_msgs/msg/JointComponentTolerance`.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct JointComponentTolerance {
    /// (`string`)
    pub joint_name: std::string::String,
    /// (`uint16`)
    pub component: u16,
    /// (`float64`)
    pub position: f64,
    /// (`float64`)
    pub velocity: f64,
    /// (`float64`)
    pub acceleration: f64,
}

impl JointComponentTolerance {
    /// The constant `X_AXIS`.
    pub const X_AXIS: u16 = 1;
    /// The constant `Y_AXIS`.
    pub const Y_AXIS: u16 = 2;
    /// The constant `Z_AXIS`.
    pub const Z_AXIS: u16 = 3;
    /// The constant `TRANSLATION`.
    pub const TRANSLATION: u16 = 4;
    /// The constant `ROTATION`.
    pub const ROTATION: u16 = 5;
}

impl crate::Message for JointComponentTolerance {
    const TYPE: &'static str = "control_msgs/msg/JointComponentTolerance";
}

/// The message `control_msgs/msg/JointTolerance`.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct JointTolerance {
    /// (`string`)
    pub name: std::string::String,
    /// (`float64`)
    pub position: f64,
    /// (`float64`)
    pub velocity: f64,
    /// (`float64`)
    pub acceleration: f64,
}

impl crate::Message for JointTolerance {
    const TYPE: &'static str = "control_msgs/msg/JointTolerance";
}

/// The service `control_msgs/action/FollowJointTrajectory_SendGoal`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct FollowJointTrajectorySendGoal;

impl crate::Service for FollowJointTrajectorySendGoal {
    type Request = FollowJointTrajectorySendGoalRequest;
    type Response = FollowJointTrajectorySendGoalResponse;
    const TYPE: &'static str = "control_msgs/action/FollowJointTrajectory_SendGoal";
}

/// The service `control_msgs/action/FollowJointTrajectory_GetResult`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct FollowJointTrajectoryGetResult;

impl crate::Service for FollowJointTrajectoryGetResult {
    type Request = FollowJointTrajectoryGetResultRequest;
    type Response = FollowJointTrajectoryGetResultResponse;
    const TYPE: &'static str = "control_msgs/action/FollowJointTrajectory_GetResult";
}

/// The service `control_msgs/action/GripperCommand_SendGoal`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct GripperCommandSendGoal;

impl crate::Service for GripperCommandSendGoal {
    type Request = GripperCommandSendGoalRequest;
    type Response = GripperCommandSendGoalResponse;
    const TYPE: &'static str = "control_msgs/action/GripperCommand_SendGoal";
}

/// The service `control_msgs/action/GripperCommand_GetResult`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct GripperCommandGetResult;

impl crate::Service for GripperCommandGetResult {
    type Request = GripperCommandGetResultRequest;
    type Response = GripperCommandGetResultResponse;
    const TYPE: &'static str = "control_msgs/action/GripperCommand_GetResult";
}

/// The action `control_msgs/action/FollowJointTrajectory`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct FollowJointTrajectory;

impl crate::Action for FollowJointTrajectory {
    type Goal = FollowJointTrajectoryGoal;
    type Result = FollowJointTrajectoryResult;
    type Feedback = FollowJointTrajectoryFeedback;
    type SendGoal = FollowJointTrajectorySendGoal;
    type GetResult = FollowJointTrajectoryGetResult;
    type FeedbackMessage = FollowJointTrajectoryFeedbackMessage;
    const TYPE: &'static str = "control_msgs/action/FollowJointTrajectory";

    fn goal_request(goal_id: super::unique_identifier_msgs::UUID, goal: FollowJointTrajectoryGoal) -> FollowJointTrajectorySendGoalRequest {
        FollowJointTrajectorySendGoalRequest { goal_id, goal }
    }

    fn goal_of(request: FollowJointTrajectorySendGoalRequest) -> (super::unique_identifier_msgs::UUID, FollowJointTrajectoryGoal) {
        (request.goal_id, request.goal)
    }

    fn goal_response(accepted: bool, stamp: super::builtin_interfaces::Time) -> FollowJointTrajectorySendGoalResponse {
        FollowJointTrajectorySendGoalResponse { accepted, stamp }
    }

    fn is_accepted(response: &FollowJointTrajectorySendGoalResponse) -> bool {
        response.accepted
    }

    fn result_request(goal_id: super::unique_identifier_msgs::UUID) -> FollowJointTrajectoryGetResultRequest {
        FollowJointTrajectoryGetResultRequest { goal_id }
    }

    fn result_id(request: &FollowJointTrajectoryGetResultRequest) -> super::unique_identifier_msgs::UUID {
        request.goal_id
    }

    fn result_response(status: i8, result: FollowJointTrajectoryResult) -> FollowJointTrajectoryGetResultResponse {
        FollowJointTrajectoryGetResultResponse { status, result }
    }

    fn result_of(response: FollowJointTrajectoryGetResultResponse) -> (i8, FollowJointTrajectoryResult) {
        (response.status, response.result)
    }

    fn feedback_message(goal_id: super::unique_identifier_msgs::UUID, feedback: FollowJointTrajectoryFeedback) -> FollowJointTrajectoryFeedbackMessage {
        FollowJointTrajectoryFeedbackMessage { goal_id, feedback }
    }

    fn feedback_of(message: FollowJointTrajectoryFeedbackMessage) -> (super::unique_identifier_msgs::UUID, FollowJointTrajectoryFeedback) {
        (message.goal_id, message.feedback)
    }
}

/// The action `control_msgs/action/GripperCommand`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct GripperCommandAction;

impl crate::Action for GripperCommandAction {
    type Goal = GripperCommandGoal;
    type Result = GripperCommandResult;
    type Feedback = GripperCommandFeedback;
    type SendGoal = GripperCommandSendGoal;
    type GetResult = GripperCommandGetResult;
    type FeedbackMessage = GripperCommandFeedbackMessage;
    const TYPE: &'static str = "control_msgs/action/GripperCommand";

    fn goal_request(goal_id: super::unique_identifier_msgs::UUID, goal: GripperCommandGoal) -> GripperCommandSendGoalRequest {
        GripperCommandSendGoalRequest { goal_id, goal }
    }

    fn goal_of(request: GripperCommandSendGoalRequest) -> (super::unique_identifier_msgs::UUID, GripperCommandGoal) {
        (request.goal_id, request.goal)
    }

    fn goal_response(accepted: bool, stamp: super::builtin_interfaces::Time) -> GripperCommandSendGoalResponse {
        GripperCommandSendGoalResponse { accepted, stamp }
    }

    fn is_accepted(response: &GripperCommandSendGoalResponse) -> bool {
        response.accepted
    }

    fn result_request(goal_id: super::unique_identifier_msgs::UUID) -> GripperCommandGetResultRequest {
        GripperCommandGetResultRequest { goal_id }
    }

    fn result_id(request: &GripperCommandGetResultRequest) -> super::unique_identifier_msgs::UUID {
        request.goal_id
    }

    fn result_response(status: i8, result: GripperCommandResult) -> GripperCommandGetResultResponse {
        GripperCommandGetResultResponse { status, result }
    }

    fn result_of(response: GripperCommandGetResultResponse) -> (i8, GripperCommandResult) {
        (response.status, response.result)
    }

    fn feedback_message(goal_id: super::unique_identifier_msgs::UUID, feedback: GripperCommandFeedback) -> GripperCommandFeedbackMessage {
        GripperCommandFeedbackMessage { goal_id, feedback }
    }

    fn feedback_of(message: GripperCommandFeedbackMessage) -> (super::unique_identifier_msgs::UUID, GripperCommandFeedback) {
        (message.goal_id, message.feedback)
    }
}
