//! Carrying out one plan at a time, through a controller or blindly on a topic, watched until it is over.
//!
//! The controller is one of ros2_control's kind: a `FollowJointTrajectory` action. A goal's answer may be lost, so its status
//! counts as an answer too; a goal that nobody answers is called off and sent anew under another id, three times. Without
//! a controller the trajectory goes out on a topic, and where the joints are in the end says how it went.

use apprentice_msgs::action::{PlaceObjectFeedback, PlaceObjectResult};
use apprentice_msgs::action_msgs::GoalStatus;
use apprentice_msgs::builtin_interfaces::{Duration, Time};
use apprentice_msgs::control_msgs::{FollowJointTrajectory, FollowJointTrajectoryGoal, FollowJointTrajectoryResult};
use apprentice_msgs::msg::PlacementPlan;
use apprentice_msgs::trajectory_msgs::JointTrajectory;
use bus::{ActionEvent, End, GoalId};
use sha2::{Digest, Sha256};

/// The controller answers within this time, or the goal is sent anew, seconds.
const ANSWER_S: f64 = 1.0;
const ATTEMPTS: u32 = 3;
/// The result is asked for this often, seconds: a request may be lost.
const ASK_S: f64 = 1.0;
/// A controller that is not there for this long is gone, seconds.
const GONE_S: f64 = 2.0;
/// How long a controller may take to call a motion off, seconds.
const CANCEL_S: f64 = 5.0;
/// Without a controller a joint may be this far from where the motion ends, radians or metres.
const NEAR_END: f64 = 0.05;

/// What is to be done about a motion.
#[derive(Debug, Clone)]
pub enum Deed {
    /// Send a trajectory to the controller.
    Send(GoalId, Box<FollowJointTrajectoryGoal>),
    /// Call a goal off.
    Cancel(GoalId),
    /// Ask the controller what came of a goal.
    AskResult(GoalId),
    /// Send a trajectory on the topic.
    Publish(Box<JointTrajectory>),
    /// Tell whoever asked for an object to be placed how far it is.
    Feedback(GoalId, PlaceObjectFeedback),
    /// Tell them how it ended.
    Finish(GoalId, End, Box<PlaceObjectResult>),
    /// Tell the log how the motion of a plan ended.
    Over(Box<PlacementPlan>, PlaceObjectResult),
}

/// At most one motion under way.
#[derive(Debug)]
pub struct Carrier {
    has_controller: bool,
    patience_s: f64,
    sent: u64,
    motion: Option<Motion>,
}

#[derive(Debug)]
struct Motion {
    plan: Box<PlacementPlan>,
    /// Of the client that wants the object placed; none when the robot moves by itself.
    asked: Option<GoalId>,
    goal_id: GoalId,
    attempt: u32,
    phase: Phase,
    /// When the phase began, when the result was asked for last, and when the controller was seen last.
    since: Time,
    asked_at: Time,
    seen: Time,
}

#[derive(Debug)]
enum Phase {
    /// The controller has not answered.
    Sent,
    /// It moves, or nobody can tell.
    Moving,
    /// It is being called off, for a reason that the result will give.
    Stopping { outcome: u8, reason: String },
}

impl Carrier {
    /// With or without a controller; a motion may take `patience_s` longer than planned.
    pub fn new(has_controller: bool, patience_s: f64) -> Self {
        Self { has_controller, patience_s, sent: 0, motion: None }
    }

    /// Whether a motion is under way.
    pub fn is_busy(&self) -> bool {
        self.motion.is_some()
    }

    /// Whether it was asked for by this goal.
    pub fn is_for(&self, goal_id: GoalId) -> bool {
        self.motion.as_ref().is_some_and(|motion| motion.asked == Some(goal_id))
    }

    /// Starts a motion; there must be none. `asked` is the goal of whoever asked for it.
    pub fn start(&mut self, now: Time, plan: Box<PlacementPlan>, asked: Option<GoalId>) -> Vec<Deed> {
        let goal_id = self.fresh_id(&now);
        let phase = if self.has_controller { Phase::Sent } else { Phase::Moving };
        let mut motion = Motion { plan, asked, goal_id, attempt: 1, phase, since: now, asked_at: now, seen: now };
        let mut deeds = Vec::new();
        deeds.extend(motion.tell(PlaceObjectFeedback::MOVING, "the arm takes it there", 0.0));
        deeds.push(match self.has_controller {
            true => motion.send(),
            false => Deed::Publish(Box::new(motion.plan.trajectory.clone())),
        });
        motion.since = now;
        self.motion = Some(motion);
        deeds
    }

    /// Calls the motion off, if there is one.
    pub fn stop(&mut self, now: Time, outcome: u8, reason: &str) -> Vec<Deed> {
        let Some(motion) = &mut self.motion else { return Vec::new() };
        if matches!(motion.phase, Phase::Stopping { .. }) {
            return Vec::new();
        }
        if self.has_controller {
            motion.phase = Phase::Stopping { outcome, reason: reason.to_owned() };
            motion.since = now;
            return vec![Deed::Cancel(motion.goal_id)];
        }
        // On a topic an empty trajectory means: stop where you are.
        let names = motion.plan.trajectory.joint_names.clone();
        let halt = JointTrajectory { joint_names: names, ..JointTrajectory::default() };
        let mut deeds = vec![Deed::Publish(Box::new(halt))];
        deeds.extend(self.end(outcome, reason));
        deeds
    }

    /// Takes in what the controller says.
    pub fn hear(&mut self, now: Time, event: ActionEvent<FollowJointTrajectory>) -> Vec<Deed> {
        let Some(motion) = &mut self.motion else { return Vec::new() };
        motion.seen = now;
        match event {
            ActionEvent::Answered { goal_id, accepted } if goal_id == motion.goal_id => {
                if accepted {
                    motion.accepted(now)
                } else if matches!(motion.phase, Phase::Sent) {
                    self.fail("the controller refused the trajectory")
                } else {
                    Vec::new()
                }
            }
            ActionEvent::Status { goal_id, status } if goal_id == motion.goal_id => {
                let ended = [GoalStatus::STATUS_SUCCEEDED, GoalStatus::STATUS_CANCELED, GoalStatus::STATUS_ABORTED];
                let mut deeds = motion.accepted(now);
                if ended.contains(&status) {
                    motion.asked_at = now;
                    deeds.push(Deed::AskResult(goal_id));
                }
                deeds
            }
            ActionEvent::Finished { goal_id, status, result } if goal_id == motion.goal_id => {
                self.finished(status, &result)
            }
            ActionEvent::Feedback { goal_id, feedback } if goal_id == motion.goal_id => {
                let total_s = motion.seconds().max(1e-3);
                let done = (feedback.desired.time_from_start.seconds() / total_s).clamp(0.0, 1.0);
                motion.tell(PlaceObjectFeedback::MOVING, "the arm takes it there", done).into_iter().collect()
            }
            _ => Vec::new(),
        }
    }

    /// Sees what time it is, whether the controller is there, and where the joints are.
    pub fn tick(&mut self, now: Time, controller_is_there: bool, joints: &[(String, f64)]) -> Vec<Deed> {
        let Some(motion) = &mut self.motion else { return Vec::new() };
        let elapsed_s = |since: &Time| now.nanoseconds_since(since) as f64 * 1e-9;
        if !self.has_controller {
            let left_s = motion.seconds() - elapsed_s(&motion.since);
            if left_s > -0.5 {
                let done = (1.0 - left_s / motion.seconds().max(1e-3)).clamp(0.0, 1.0);
                return motion.tell(PlaceObjectFeedback::MOVING, "the arm takes it there", done).into_iter().collect();
            }
            let Some(far) = motion.far_joint(joints) else { return self.end(PlaceObjectResult::DONE, "it stands") };
            if left_s > -0.5 - self.patience_s {
                return Vec::new();
            }
            return self.fail(&format!("the arm did not arrive: {far}"));
        }
        if controller_is_there {
            motion.seen = now;
        } else if elapsed_s(&motion.seen) > GONE_S {
            return self.fail("the controller is gone; the arm may be anywhere on its way");
        }
        let waited_s = elapsed_s(&motion.since);
        match &motion.phase {
            Phase::Sent if waited_s > ANSWER_S && motion.attempt >= ATTEMPTS => {
                let goal_id = motion.goal_id;
                let mut deeds = vec![Deed::Cancel(goal_id)];
                deeds.extend(self.fail("the controller does not answer"));
                deeds
            }
            Phase::Sent if waited_s > ANSWER_S => {
                // Should the goal have arrived after all, it must not run beside the next one.
                let old = motion.goal_id;
                let attempt = motion.attempt + 1;
                let goal_id = self.fresh_id(&now);
                let Some(motion) = &mut self.motion else { return Vec::new() };
                (motion.attempt, motion.since, motion.goal_id) = (attempt, now, goal_id);
                vec![Deed::Cancel(old), motion.send()]
            }
            Phase::Moving if waited_s > motion.seconds() + self.patience_s => {
                let late = format!("the motion took {waited_s:.1} s instead of {:.1} s", motion.seconds());
                self.stop(now, PlaceObjectResult::CONTROLLER_FAILED, &late)
            }
            Phase::Stopping { outcome, reason } if waited_s > CANCEL_S => {
                let (outcome, reason) = (*outcome, format!("{reason}; the controller did not confirm that it stopped"));
                self.end(outcome, &reason)
            }
            Phase::Moving | Phase::Stopping { .. } if elapsed_s(&motion.asked_at) > ASK_S => {
                motion.asked_at = now;
                vec![Deed::AskResult(motion.goal_id)]
            }
            _ => Vec::new(),
        }
    }

    fn finished(&mut self, status: i8, result: &FollowJointTrajectoryResult) -> Vec<Deed> {
        let Some(motion) = &self.motion else { return Vec::new() };
        if let Phase::Stopping { outcome, reason } = &motion.phase {
            // It may have arrived before it could be called off; it is not asked to be anywhere else then.
            let (outcome, reason) = (*outcome, reason.clone());
            return self.end(outcome, &reason);
        }
        let succeeded = status == GoalStatus::STATUS_SUCCEEDED;
        if succeeded && result.error_code == FollowJointTrajectoryResult::SUCCESSFUL {
            return self.end(PlaceObjectResult::DONE, "it stands");
        }
        let what = match result.error_code {
            FollowJointTrajectoryResult::INVALID_GOAL => "calls the trajectory invalid",
            FollowJointTrajectoryResult::INVALID_JOINTS => "has other joints",
            FollowJointTrajectoryResult::OLD_HEADER_TIMESTAMP => "got the trajectory too late",
            FollowJointTrajectoryResult::PATH_TOLERANCE_VIOLATED => "gave up: the arm left its path",
            FollowJointTrajectoryResult::GOAL_TOLERANCE_VIOLATED => "gave up: the arm did not arrive",
            _ if status == GoalStatus::STATUS_CANCELED => "was told by somebody else to stop",
            _ if status == GoalStatus::STATUS_UNKNOWN => "does not know the motion any more",
            _ => "gave up",
        };
        let detail = if result.error_string.is_empty() { String::new() } else { format!(" ({})", result.error_string) };
        self.fail(&format!("the controller {what}{detail}"))
    }

    fn fail(&mut self, reason: &str) -> Vec<Deed> {
        self.end(PlaceObjectResult::CONTROLLER_FAILED, reason)
    }

    fn end(&mut self, outcome: u8, reason: &str) -> Vec<Deed> {
        let Some(motion) = self.motion.take() else { return Vec::new() };
        let result = result_of(&motion.plan, outcome, reason);
        let mut deeds: Vec<Deed> = motion.asked.map(|goal_id| finish(goal_id, result.clone())).into_iter().collect();
        deeds.push(Deed::Over(motion.plan, result));
        deeds
    }

    /// Different for every goal of every run.
    fn fresh_id(&mut self, now: &Time) -> GoalId {
        self.sent += 1;
        let hash = Sha256::new()
            .chain_update(b"placement_planner")
            .chain_update(now.nanoseconds().to_le_bytes())
            .chain_update(self.sent.to_le_bytes())
            .finalize();
        let mut uuid = [0; 16];
        uuid.copy_from_slice(&hash[..16]);
        GoalId { uuid }
    }
}

impl Motion {
    fn seconds(&self) -> f64 {
        self.plan.trajectory.points.last().map_or(0.0, |point| point.time_from_start.seconds())
    }

    fn send(&self) -> Deed {
        let goal = FollowJointTrajectoryGoal {
            trajectory: self.plan.trajectory.clone(),
            goal_time_tolerance: Duration::from_seconds(1.0),
            ..FollowJointTrajectoryGoal::default()
        };
        Deed::Send(self.goal_id, Box::new(goal))
    }

    fn accepted(&mut self, now: Time) -> Vec<Deed> {
        if !matches!(self.phase, Phase::Sent) {
            return Vec::new();
        }
        (self.phase, self.since, self.asked_at) = (Phase::Moving, now, now);
        vec![Deed::AskResult(self.goal_id)]
    }

    fn tell(&self, stage: u8, description: &str, progress: f64) -> Option<Deed> {
        let feedback = PlaceObjectFeedback { stage, description: description.to_owned(), progress };
        self.asked.map(|goal_id| Deed::Feedback(goal_id, feedback))
    }

    /// A joint that is not where the motion ends, in words.
    fn far_joint(&self, joints: &[(String, f64)]) -> Option<String> {
        let last = self.plan.trajectory.points.last()?;
        self.plan.trajectory.joint_names.iter().zip(&last.positions).find_map(|(name, &wanted)| {
            match joints.iter().find(|(joint, _)| joint == name) {
                None => Some(format!("nothing is heard of joint '{name}'")),
                Some((_, at)) if (at - wanted).abs() > NEAR_END => {
                    Some(format!("joint '{name}' is at {at:.3} instead of {wanted:.3}"))
                }
                Some(_) => None,
            }
        })
    }
}

/// The answer to whoever asked, with the place of a plan.
pub(crate) fn result_of(plan: &PlacementPlan, outcome: u8, reason: &str) -> PlaceObjectResult {
    PlaceObjectResult { outcome, reason: reason.to_owned(), revision: plan.revision, placement: plan.robust_placement }
}

/// Ends a goal as its outcome asks for.
pub(crate) fn finish(goal_id: GoalId, result: PlaceObjectResult) -> Deed {
    let end = match result.outcome {
        PlaceObjectResult::DONE | PlaceObjectResult::PLANNED => End::Succeeded,
        PlaceObjectResult::CANCELED => End::Canceled,
        _ => End::Aborted,
    };
    Deed::Finish(goal_id, end, Box::new(result))
}
