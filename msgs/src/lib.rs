//! Messages of Apprentice and the standard ROS 2 ones that it uses, their CDR encoding and their schemas.
//!
//! The types are generated from `msg/`, `srv/`, `action/` and `standard/` by
//! `cargo run --release -p apprentice_msgs --example generate`.

mod bounded;
mod cdr;
#[rustfmt::skip]
mod generated;
pub mod generator;
pub mod interface;
mod schema;
mod time;

pub use cdr::{CdrError, from_cdr, to_cdr};
pub use generated::{
    action, action_msgs, builtin_interfaces, control_msgs, diagnostic_msgs, geometry_msgs, moveit_msgs, msg,
    object_recognition_msgs, octomap_msgs, rcl_interfaces, rosgraph_msgs, sensor_msgs, shape_msgs, srv, std_msgs,
    std_srvs, tf2_msgs, trajectory_msgs, unique_identifier_msgs, vision_msgs, visualization_msgs,
};
pub use schema::{SchemaError, all_actions, all_services, all_types, compose_schema, definition, schema};

use builtin_interfaces::Time;
use serde::Serialize;
use serde::de::DeserializeOwned;
use unique_identifier_msgs::UUID;

/// A type that travels on a topic, or as a half of a service.
pub trait Message: Serialize + DeserializeOwned + Clone + Send + 'static {
    /// Name of the type: `package/msg/Name`, or `package/srv/Name_Request` for a half of a service.
    const TYPE: &'static str;
}

/// A question with an answer.
pub trait Service {
    /// What the client sends.
    type Request: Message;
    /// What the server answers.
    type Response: Message;
    /// Name of the type: `package/srv/Name`.
    const TYPE: &'static str;
}

/// Work that takes time, can be watched and can be cancelled: two services and a topic, which the methods put together and
/// take apart.
pub trait Action: 'static {
    /// What the client asks for.
    type Goal: Message;
    /// What came of it.
    type Result: Message + Default;
    /// How far it is.
    type Feedback: Message;
    /// Asks for work.
    type SendGoal: Service;
    /// Asks what came of it.
    type GetResult: Service;
    /// What travels on the feedback topic.
    type FeedbackMessage: Message;
    /// Name of the type: `package/action/Name`.
    const TYPE: &'static str;

    /// The request that sends a goal.
    fn goal_request(goal_id: UUID, goal: Self::Goal) -> <Self::SendGoal as Service>::Request;
    /// The goal in a request.
    fn goal_of(request: <Self::SendGoal as Service>::Request) -> (UUID, Self::Goal);
    /// The answer to a goal.
    fn goal_response(accepted: bool, stamp: Time) -> <Self::SendGoal as Service>::Response;
    /// Whether a goal was accepted.
    fn is_accepted(response: &<Self::SendGoal as Service>::Response) -> bool;
    /// The request for a result.
    fn result_request(goal_id: UUID) -> <Self::GetResult as Service>::Request;
    /// Whose result is asked for.
    fn result_id(request: &<Self::GetResult as Service>::Request) -> UUID;
    /// The answer with a result; `status` is one of [`action_msgs::GoalStatus`].
    fn result_response(status: i8, result: Self::Result) -> <Self::GetResult as Service>::Response;
    /// Status and result.
    fn result_of(response: <Self::GetResult as Service>::Response) -> (i8, Self::Result);
    /// What goes on the feedback topic.
    fn feedback_message(goal_id: UUID, feedback: Self::Feedback) -> Self::FeedbackMessage;
    /// Whose feedback, and the feedback.
    fn feedback_of(message: Self::FeedbackMessage) -> (UUID, Self::Feedback);
}

/// Compiles and runs the code of the README.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
