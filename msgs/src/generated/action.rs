//! Actions of this package.
//!
//! Generated: do not edit. To write it anew: `cargo run --release -p apprentice_msgs --example generate`.

use serde::{Deserialize, Serialize};

/// Put an object where the person wants it: choose a place, pick it up, put it down. Any client may ask; nothing moves unless
/// the lesson is taught, the path is free and the arm is known to be where it starts.
#[derive(Debug, Clone, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct PlaceObjectGoal {
    /// what to place; empty: the target of the scene (`string`)
    pub object_id: std::string::String,
    /// stop before anything moves (`bool`)
    pub plan_only: bool,
}

impl crate::Message for PlaceObjectGoal {
    const TYPE: &'static str = "apprentice_msgs/action/PlaceObject_Goal";
}

/// How it came out.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct PlaceObjectResult {
    /// (`uint8`)
    pub outcome: u8,
    /// the same in one sentence (`string`)
    pub reason: std::string::String,
    /// of the posterior that chose the place (`uint64`)
    pub revision: u64,
    /// where it went or would go, in the table's frame; not numbers without a place (`geometry_msgs/Point`)
    pub placement: super::geometry_msgs::Point,
}

impl PlaceObjectResult {
    /// The constant `DONE`.
    pub const DONE: u8 = 0;
    /// planned, and no more was asked for
    pub const PLANNED: u8 = 1;
    /// the bound on the placement loss exceeds epsilon
    pub const NOT_TAUGHT: u8 = 2;
    /// The constant `NO_FREE_PLACE`.
    pub const NO_FREE_PLACE: u8 = 3;
    /// The constant `UNREACHABLE`.
    pub const UNREACHABLE: u8 = 4;
    /// The constant `NO_PATH`.
    pub const NO_PATH: u8 = 5;
    /// The constant `NO_ROBOT`.
    pub const NO_ROBOT: u8 = 6;
    /// the joint state is older than the set age, or is not that of the robot
    pub const STALE_JOINTS: u8 = 7;
    /// what stands on the table changed on the way
    pub const SCENE_CHANGED: u8 = 8;
    /// the controller refused, aborted, timed out or is gone
    pub const CONTROLLER_FAILED: u8 = 9;
    /// The constant `CANCELED`.
    pub const CANCELED: u8 = 10;
    /// another object is being placed
    pub const BUSY: u8 = 11;
    /// The constant `UNKNOWN_OBJECT`.
    pub const UNKNOWN_OBJECT: u8 = 12;
    /// where the arm is now, it touches something
    pub const START_IN_COLLISION: u8 = 13;
    /// in reach, but the arm would touch something at each free place
    pub const GOAL_IN_COLLISION: u8 = 14;
    /// a joint is beyond its limits
    pub const OUTSIDE_LIMITS: u8 = 15;
    /// the arm cannot pick the object up from where it stands, or nobody knows where that is
    pub const CANNOT_PICK: u8 = 16;
    /// the gripper closed and there was nothing in it, or it did not move
    pub const GRASP_FAILED: u8 = 17;
}

impl crate::Message for PlaceObjectResult {
    const TYPE: &'static str = "apprentice_msgs/action/PlaceObject_Result";
}

/// How far it is.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct PlaceObjectFeedback {
    /// (`uint8`)
    pub stage: u8,
    /// in plain words (`string`)
    pub description: std::string::String,
    /// of the whole, 0 to 1 (`float64`)
    pub progress: f64,
}

impl PlaceObjectFeedback {
    /// The constant `CHOOSING`.
    pub const CHOOSING: u8 = 0;
    /// The constant `PLANNING`.
    pub const PLANNING: u8 = 1;
    /// the empty hand goes to the object
    pub const APPROACHING: u8 = 2;
    /// The constant `GRASPING`.
    pub const GRASPING: u8 = 3;
    /// the object is on its way
    pub const MOVING: u8 = 4;
    /// The constant `RELEASING`.
    pub const RELEASING: u8 = 5;
    /// The constant `RETREATING`.
    pub const RETREATING: u8 = 6;
}

impl crate::Message for PlaceObjectFeedback {
    const TYPE: &'static str = "apprentice_msgs/action/PlaceObject_Feedback";
}

/// The message `apprentice_msgs/action/PlaceObject_SendGoal_Request`.
#[derive(Debug, Clone, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct PlaceObjectSendGoalRequest {
    /// (`unique_identifier_msgs/UUID`)
    pub goal_id: super::unique_identifier_msgs::UUID,
    /// (`apprentice_msgs/PlaceObject_Goal`)
    pub goal: super::action::PlaceObjectGoal,
}

impl crate::Message for PlaceObjectSendGoalRequest {
    const TYPE: &'static str = "apprentice_msgs/action/PlaceObject_SendGoal_Request";
}

/// The message `apprentice_msgs/action/PlaceObject_SendGoal_Response`.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct PlaceObjectSendGoalResponse {
    /// (`bool`)
    pub accepted: bool,
    /// (`builtin_interfaces/Time`)
    pub stamp: super::builtin_interfaces::Time,
}

impl crate::Message for PlaceObjectSendGoalResponse {
    const TYPE: &'static str = "apprentice_msgs/action/PlaceObject_SendGoal_Response";
}

/// The message `apprentice_msgs/action/PlaceObject_GetResult_Request`.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct PlaceObjectGetResultRequest {
    /// (`unique_identifier_msgs/UUID`)
    pub goal_id: super::unique_identifier_msgs::UUID,
}

impl crate::Message for PlaceObjectGetResultRequest {
    const TYPE: &'static str = "apprentice_msgs/action/PlaceObject_GetResult_Request";
}

/// The message `apprentice_msgs/action/PlaceObject_GetResult_Response`.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct PlaceObjectGetResultResponse {
    /// (`int8`)
    pub status: i8,
    /// (`apprentice_msgs/PlaceObject_Result`)
    pub result: super::action::PlaceObjectResult,
}

impl crate::Message for PlaceObjectGetResultResponse {
    const TYPE: &'static str = "apprentice_msgs/action/PlaceObject_GetResult_Response";
}

/// The message `apprentice_msgs/action/PlaceObject_FeedbackMessage`.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct PlaceObjectFeedbackMessage {
    /// (`unique_identifier_msgs/UUID`)
    pub goal_id: super::unique_identifier_msgs::UUID,
    /// (`apprentice_msgs/PlaceObject_Feedback`)
    pub feedback: super::action::PlaceObjectFeedback,
}

impl crate::Message for PlaceObjectFeedbackMessage {
    const TYPE: &'static str = "apprentice_msgs/action/PlaceObject_FeedbackMessage";
}

/// The service `apprentice_msgs/action/PlaceObject_SendGoal`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct PlaceObjectSendGoal;

impl crate::Service for PlaceObjectSendGoal {
    type Request = PlaceObjectSendGoalRequest;
    type Response = PlaceObjectSendGoalResponse;
    const TYPE: &'static str = "apprentice_msgs/action/PlaceObject_SendGoal";
}

/// The service `apprentice_msgs/action/PlaceObject_GetResult`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct PlaceObjectGetResult;

impl crate::Service for PlaceObjectGetResult {
    type Request = PlaceObjectGetResultRequest;
    type Response = PlaceObjectGetResultResponse;
    const TYPE: &'static str = "apprentice_msgs/action/PlaceObject_GetResult";
}

/// The action `apprentice_msgs/action/PlaceObject`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct PlaceObject;

impl crate::Action for PlaceObject {
    type Goal = PlaceObjectGoal;
    type Result = PlaceObjectResult;
    type Feedback = PlaceObjectFeedback;
    type SendGoal = PlaceObjectSendGoal;
    type GetResult = PlaceObjectGetResult;
    type FeedbackMessage = PlaceObjectFeedbackMessage;
    const TYPE: &'static str = "apprentice_msgs/action/PlaceObject";

    fn goal_request(goal_id: super::unique_identifier_msgs::UUID, goal: PlaceObjectGoal) -> PlaceObjectSendGoalRequest {
        PlaceObjectSendGoalRequest { goal_id, goal }
    }

    fn goal_of(request: PlaceObjectSendGoalRequest) -> (super::unique_identifier_msgs::UUID, PlaceObjectGoal) {
        (request.goal_id, request.goal)
    }

    fn goal_response(accepted: bool, stamp: super::builtin_interfaces::Time) -> PlaceObjectSendGoalResponse {
        PlaceObjectSendGoalResponse { accepted, stamp }
    }

    fn is_accepted(response: &PlaceObjectSendGoalResponse) -> bool {
        response.accepted
    }

    fn result_request(goal_id: super::unique_identifier_msgs::UUID) -> PlaceObjectGetResultRequest {
        PlaceObjectGetResultRequest { goal_id }
    }

    fn result_id(request: &PlaceObjectGetResultRequest) -> super::unique_identifier_msgs::UUID {
        request.goal_id
    }

    fn result_response(status: i8, result: PlaceObjectResult) -> PlaceObjectGetResultResponse {
        PlaceObjectGetResultResponse { status, result }
    }

    fn result_of(response: PlaceObjectGetResultResponse) -> (i8, PlaceObjectResult) {
        (response.status, response.result)
    }

    fn feedback_message(goal_id: super::unique_identifier_msgs::UUID, feedback: PlaceObjectFeedback) -> PlaceObjectFeedbackMessage {
        PlaceObjectFeedbackMessage { goal_id, feedback }
    }

    fn feedback_of(message: PlaceObjectFeedbackMessage) -> (super::unique_identifier_msgs::UUID, PlaceObjectFeedback) {
        (message.goal_id, message.feedback)
    }
}
