//! What both controllers say, the arm's and the gripper's, in one form.

use apprentice_msgs::action_msgs::GoalStatus;
use apprentice_msgs::control_msgs::{
    FollowJointTrajectory, FollowJointTrajectoryResult, GripperCommandAction, GripperCommandResult,
};
use bus::{ActionEvent, GoalId};

/// What a controller moves.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Limb {
    /// The joints that move the tool.
    Arm,
    /// The fingers.
    Gripper,
}

/// News of a goal.
#[derive(Debug)]
pub(super) enum News {
    Answered(bool),
    Status(i8),
    /// Seconds of the motion that are done.
    Progress(f64),
    /// It is over; where the fingers are then, or what went wrong in words.
    Finished(Result<Option<f64>, String>),
}

pub(super) fn of_arm(event: &ActionEvent<FollowJointTrajectory>) -> Option<(GoalId, News)> {
    let progress = |feedback: &apprentice_msgs::control_msgs::FollowJointTrajectoryFeedback| {
        News::Progress(feedback.desired.time_from_start.seconds())
    };
    news(event, progress, |status, result| arm_result(status, result).map(|()| None))
}

pub(super) fn of_gripper(event: &ActionEvent<GripperCommandAction>) -> Option<(GoalId, News)> {
    news(event, |_| News::Progress(0.0), |status, result| gripper_result(status, result).map(Some))
}

fn news<A: apprentice_msgs::Action>(
    event: &ActionEvent<A>,
    progress: impl Fn(&A::Feedback) -> News,
    finished: impl Fn(i8, &A::Result) -> Result<Option<f64>, String>,
) -> Option<(GoalId, News)> {
    match event {
        ActionEvent::Answered { goal_id, accepted } => Some((*goal_id, News::Answered(*accepted))),
        ActionEvent::Status { goal_id, status } => Some((*goal_id, News::Status(*status))),
        ActionEvent::Feedback { goal_id, feedback } => Some((*goal_id, progress(feedback))),
        ActionEvent::Finished { goal_id, status, result } => {
            Some((*goal_id, News::Finished(finished(*status, result))))
        }
        ActionEvent::Cancelling { .. } => None,
    }
}

fn arm_result(status: i8, result: &FollowJointTrajectoryResult) -> Result<(), String> {
    let succeeded = status == GoalStatus::STATUS_SUCCEEDED;
    if succeeded && result.error_code == FollowJointTrajectoryResult::SUCCESSFUL {
        return Ok(());
    }
    let what = match result.error_code {
        FollowJointTrajectoryResult::INVALID_GOAL => "calls the trajectory invalid",
        FollowJointTrajectoryResult::INVALID_JOINTS => "has other joints",
        FollowJointTrajectoryResult::OLD_HEADER_TIMESTAMP => "got the trajectory too late",
        FollowJointTrajectoryResult::PATH_TOLERANCE_VIOLATED => "gave up: the arm left its path",
        FollowJointTrajectoryResult::GOAL_TOLERANCE_VIOLATED => "gave up: the arm did not arrive",
        _ => abandoned(status),
    };
    let detail = if result.error_string.is_empty() { String::new() } else { format!(" ({})", result.error_string) };
    Err(format!("the controller {what}{detail}"))
}

/// Where the fingers are. Fingers that stall have found something, or are stuck: where they are tells. ros2_control's controller
/// calls that a failure unless it is told to allow it.
fn gripper_result(status: i8, result: &GripperCommandResult) -> Result<f64, String> {
    if result.stalled || (status == GoalStatus::STATUS_SUCCEEDED && result.position.is_finite()) {
        return Ok(result.position);
    }
    Err(format!("the gripper's controller {}", abandoned(status)))
}

fn abandoned(status: i8) -> &'static str {
    match status {
        GoalStatus::STATUS_CANCELED => "was told by somebody else to stop",
        GoalStatus::STATUS_UNKNOWN => "does not know the motion any more",
        _ => "gave up",
    }
}
