//! Actions: work that takes time, can be watched and can be cancelled. Three services and two topics, as ROS 2 lays them down,
//! over either graph.

mod client;
mod server;

pub use client::{ActionClient, ActionEvent};
pub use server::{ActionRequest, ActionServer, End};

use apprentice_msgs::unique_identifier_msgs::UUID;

/// Names a goal; unique among all goals that its server knows.
pub type GoalId = UUID;

/// The names that make up an action.
struct Names {
    send_goal: String,
    cancel_goal: String,
    get_result: String,
    feedback: String,
    status: String,
}

impl Names {
    /// Of an action by its absolute name.
    fn new(action: &str) -> Self {
        let of = |part: &str| format!("{action}/_action/{part}");
        Self {
            send_goal: of("send_goal"),
            cancel_goal: of("cancel_goal"),
            get_result: of("get_result"),
            feedback: of("feedback"),
            status: of("status"),
        }
    }
}
