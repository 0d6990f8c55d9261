//! Carrying out one plan at a time, step by step, through controllers or blindly on a topic, watched until it is over.
//!
//! The arm's controller is one of ros2_control's kind, a `FollowJointTrajectory` action, the gripper's a `GripperCommand` action. A
//! goal's answer may be lost, so its status counts as an answer too; a goal that nobody answers is called off and sent anew under
//! another id, three times. Without a controller trajectories go out on a topic, and where the joints are in the end says how it went.

mod controllers;
mod motion;
mod steps;

pub use controllers::Limb;
pub use steps::Fingers;

use apprentice_msgs::action::{PlaceObjectFeedback, PlaceObjectResult};
use apprentice_msgs::action_msgs::GoalStatus;
use apprentice_msgs::builtin_interfaces::Time;
use apprentice_msgs::control_msgs::{
    FollowJointTrajectory, FollowJointTrajectoryGoal, GripperCommandAction, GripperCommandGoal,
};
use apprentice_msgs::msg::{Carrying, PlacementPlan};
use apprentice_msgs::trajectory_msgs::JointTrajectory;
use bus::{ActionEvent, End, GoalId};
use controllers::News;
use motion::{Motion, Phase, far_joint};
use placement::Found;
use sha2::{Digest, Sha256};
use steps::Act;

/// The controller answers within this time, or the goal is sent anew, seconds.
const ANSWER_S: f64 = 1.0;
const ATTEMPTS: u32 = 3;
/// The result is asked for this often, seconds: a request may be lost.
const ASK_S: f64 = 1.0;
/// A controller that is not there for this long is gone, seconds.
const GONE_S: f64 = 2.0;
/// How long a controller may take to call a motion off, seconds.
const CANCEL_S: f64 = 5.0;
/// Without a controller: fingers may be off by this share of their way, and stand when they move less than a tenth of it.
const NEAR_GRIP: f64 = 0.05;
/// After a motion without a controller, joint states may be this late, seconds.
const LATE_S: f64 = 0.5;

/// What is to be done about a motion.
#[derive(Debug, Clone)]
pub enum Deed {
    /// Send a trajectory to the arm's controller.
    Send(GoalId, Box<FollowJointTrajectoryGoal>),
    /// Send fingers somewhere, through the gripper's controller.
    Grip(GoalId, GripperCommandGoal),
    /// Call a goal off.
    Cancel(Limb, GoalId),
    /// Ask a controller what came of a goal.
    AskResult(Limb, GoalId),
    /// Send a trajectory on the topic.
    Publish(Box<JointTrajectory>),
    /// Tell whoever asked for an object to be placed how far it is.
    Feedback(GoalId, PlaceObjectFeedback),
    /// Tell everybody what the arm is doing.
    Tell(Box<Carrying>),
    /// Tell them how it ended.
    Finish(GoalId, End, Box<PlaceObjectResult>),
    /// Tell the log how the motion of a plan ended.
    Over(Box<PlacementPlan>, PlaceObjectResult),
}

/// Which controllers can be heard.
#[derive(Debug, Clone, Copy, Default)]
pub struct Heard {
    /// The arm's.
    pub arm: bool,
    /// The gripper's.
    pub gripper: bool,
}

/// At most one motion under way.
#[derive(Debug)]
pub struct Carrier {
    has_controller: bool,
    fingers: Option<Fingers>,
    patience_s: f64,
    sent: u64,
    motion: Option<Motion>,
    /// Id of what the gripper took and has not let go of.
    held: Option<String>,
    /// The plan whose target was put down, until somebody takes note.
    put_down: Option<Box<PlacementPlan>>,
}

impl Carrier {
    /// With or without a controller of the arm and a gripper; a motion may take `patience_s` longer than planned.
    pub fn new(has_controller: bool, fingers: Option<Fingers>, patience_s: f64) -> Self {
        Self { has_controller, fingers, patience_s, sent: 0, motion: None, held: None, put_down: None }
    }

    /// Whether a motion is under way.
    pub fn is_busy(&self) -> bool {
        self.motion.is_some()
    }

    /// Whether it was asked for by this goal.
    pub fn is_for(&self, goal_id: GoalId) -> bool {
        self.motion.as_ref().is_some_and(|motion| motion.asked == Some(goal_id))
    }

    /// Id of what was picked up and not put down.
    pub fn held(&self) -> Option<&str> {
        self.held.as_deref()
    }

    /// Whether the target of the motion under way is in the hand.
    pub fn has_target(&self) -> bool {
        self.motion.as_ref().is_some_and(|motion| self.held.is_some() || motion.starts_in_hand())
    }

    /// Whether the empty hand is on its way to the target.
    pub fn is_fetching(&self) -> bool {
        let fetches = |motion: &Motion| motion.plan.picks && motion.step().stage <= PlaceObjectFeedback::GRASPING;
        self.held.is_none() && self.motion.as_ref().is_some_and(fetches)
    }

    /// The plan whose target was put down since this was last asked.
    pub fn take_put_down(&mut self) -> Option<Box<PlacementPlan>> {
        self.put_down.take()
    }

    /// Starts a motion; there must be none. `asked` is the goal of whoever asked for it.
    pub fn start(&mut self, now: Time, plan: Box<PlacementPlan>, asked: Option<GoalId>) -> Vec<Deed> {
        let steps = steps::of_plan(&plan);
        self.motion = Some(Motion {
            plan,
            asked,
            steps,
            at: 0,
            ends: None,
            goal_id: GoalId::default(),
            attempt: 1,
            phase: Phase::Moving,
            since: now,
            asked_at: now,
            seen: now,
            finger: None,
        });
        self.begin(now)
    }

    /// Begins the step that the motion is at.
    fn begin(&mut self, now: Time) -> Vec<Deed> {
        let goal_id = self.fresh_id(&now);
        let is_watched = self.is_watched();
        let fingers = self.fingers.as_ref();
        let Some(motion) = &mut self.motion else { return Vec::new() };
        motion.phase = if is_watched { Phase::Sent } else { Phase::Moving };
        (motion.goal_id, motion.attempt, motion.finger) = (goal_id, 1, None);
        (motion.since, motion.asked_at, motion.seen) = (now, now, now);
        let mut deeds = vec![Deed::Tell(Box::new(motion.news(now)))];
        deeds.extend(motion.tell(0.0));
        deeds.extend(motion.send(fingers, is_watched));
        deeds
    }

    /// Calls the motion off, if there is one.
    pub fn stop(&mut self, now: Time, outcome: u8, reason: &str) -> Vec<Deed> {
        let is_watched = self.is_watched();
        let fingers = self.fingers.as_ref();
        let Some(motion) = &mut self.motion else { return Vec::new() };
        if matches!(motion.phase, Phase::Stopping { .. }) {
            return Vec::new();
        }
        if is_watched {
            motion.phase = Phase::Stopping { outcome, reason: reason.to_owned() };
            motion.since = now;
            return vec![Deed::Cancel(motion.limb(), motion.goal_id)];
        }
        // On a topic an empty trajectory means: stop where you are.
        let names = match (&motion.step().act, fingers) {
            (Act::Move(trajectory), _) => trajectory.joint_names.clone(),
            (Act::Grip { .. }, fingers) => fingers.map(|fingers| fingers.gripper.joint.clone()).into_iter().collect(),
        };
        let halt = JointTrajectory { joint_names: names, ..JointTrajectory::default() };
        let mut deeds = vec![Deed::Publish(Box::new(halt))];
        deeds.extend(self.end(outcome, reason));
        deeds
    }

    /// Whether a controller carries out the step under way.
    fn is_watched(&self) -> bool {
        self.motion.as_ref().is_some_and(|motion| match motion.limb() {
            Limb::Arm => self.has_controller,
            Limb::Gripper => self.fingers.as_ref().is_some_and(|fingers| fingers.has_controller),
        })
    }

    /// Takes in what the arm's controller says.
    pub fn hear(&mut self, now: Time, event: &ActionEvent<FollowJointTrajectory>) -> Vec<Deed> {
        controllers::of_arm(event).map_or_else(Vec::new, |(goal_id, news)| self.take(now, goal_id, news))
    }

    /// Takes in what the gripper's controller says.
    pub fn hear_gripper(&mut self, now: Time, event: &ActionEvent<GripperCommandAction>) -> Vec<Deed> {
        controllers::of_gripper(event).map_or_else(Vec::new, |(goal_id, news)| self.take(now, goal_id, news))
    }

    fn take(&mut self, now: Time, goal_id: GoalId, news: News) -> Vec<Deed> {
        let Some(motion) = &mut self.motion else { return Vec::new() };
        motion.seen = now;
        if goal_id != motion.goal_id {
            return Vec::new();
        }
        match news {
            News::Answered(true) => motion.accepted(now),
            News::Answered(false) if matches!(motion.phase, Phase::Sent) => {
                let what = if motion.limb() == Limb::Arm {
                    "controller refused the trajectory"
                } else {
                    "gripper's controller refused"
                };
                self.fail(&format!("the {what}"))
            }
            News::Answered(false) => Vec::new(),
            News::Status(status) => {
                let ended = [GoalStatus::STATUS_SUCCEEDED, GoalStatus::STATUS_CANCELED, GoalStatus::STATUS_ABORTED];
                let mut deeds = motion.accepted(now);
                if ended.contains(&status) {
                    motion.asked_at = now;
                    deeds.push(Deed::AskResult(motion.limb(), goal_id));
                }
                deeds
            }
            News::Progress(done_s) => motion.tell(done_s).into_iter().collect(),
            News::Finished(result) => {
                if let Phase::Stopping { outcome, reason } = &motion.phase {
                    // It may have arrived before it could be called off; it is not asked to be anywhere else then.
                    let (outcome, reason) = (*outcome, reason.clone());
                    return self.end(outcome, &reason);
                }
                match result {
                    Ok(finger) => self.step_done(now, finger),
                    Err(reason) => self.fail(&reason),
                }
            }
        }
    }

    /// Sees what time it is, which controllers are there, and where the joints are.
    pub fn tick(&mut self, now: Time, heard: Heard, joints: &[(String, f64)]) -> Vec<Deed> {
        let is_watched = self.is_watched();
        let Some(motion) = &mut self.motion else { return Vec::new() };
        if !is_watched {
            motion.seen = now;
            return self.look(now, joints);
        }
        let limb = motion.limb();
        let (is_there, whose) = match limb {
            Limb::Arm => (heard.arm, "controller"),
            Limb::Gripper => (heard.gripper, "gripper's controller"),
        };
        let elapsed_s = |since: &Time| now.nanoseconds_since(since) as f64 * 1e-9;
        if is_there {
            motion.seen = now;
        } else if elapsed_s(&motion.seen) > GONE_S {
            return self.fail(&format!("the {whose} is gone; the arm may be anywhere on its way"));
        }
        let waited_s = elapsed_s(&motion.since);
        match &motion.phase {
            Phase::Sent if waited_s > ANSWER_S && motion.attempt >= ATTEMPTS => {
                let mut deeds = vec![Deed::Cancel(limb, motion.goal_id)];
                deeds.extend(self.fail(&format!("the {whose} does not answer")));
                deeds
            }
            Phase::Sent if waited_s > ANSWER_S => {
                // Should the goal have arrived after all, it must not run beside the next one.
                let old = motion.goal_id;
                let attempt = motion.attempt + 1;
                let goal_id = self.fresh_id(&now);
                let fingers = self.fingers.as_ref();
                let Some(motion) = &mut self.motion else { return Vec::new() };
                (motion.attempt, motion.since, motion.goal_id) = (attempt, now, goal_id);
                std::iter::once(Deed::Cancel(limb, old)).chain(motion.send(fingers, true)).collect()
            }
            Phase::Moving if waited_s > motion.step().seconds() + self.patience_s => {
                let late =
                    format!("{} took {waited_s:.1} s instead of {:.1} s", motion.what(), motion.step().seconds());
                self.stop(now, PlaceObjectResult::CONTROLLER_FAILED, &late)
            }
            Phase::Stopping { outcome, reason } if waited_s > CANCEL_S => {
                let (outcome, reason) = (*outcome, format!("{reason}; the {whose} did not confirm that it stopped"));
                self.end(outcome, &reason)
            }
            Phase::Moving | Phase::Stopping { .. } if elapsed_s(&motion.asked_at) > ASK_S => {
                motion.asked_at = now;
                vec![Deed::AskResult(limb, motion.goal_id)]
            }
            _ => Vec::new(),
        }
    }

    /// What the joints say of a step that no controller watches.
    fn look(&mut self, now: Time, joints: &[(String, f64)]) -> Vec<Deed> {
        let Some(motion) = &mut self.motion else { return Vec::new() };
        let waited_s = now.nanoseconds_since(&motion.since) as f64 * 1e-9;
        let over_s = waited_s - motion.step().seconds();
        if over_s < LATE_S {
            return motion.tell(waited_s).into_iter().collect();
        }
        let is_late = over_s > LATE_S + self.patience_s;
        match (&motion.step().act, &self.fingers) {
            (Act::Move(trajectory), _) => match far_joint(trajectory, joints) {
                None => self.step_done(now, None),
                Some(far) if is_late => self.fail(&format!("the arm did not arrive: {far}")),
                Some(_) => Vec::new(),
            },
            (&Act::Grip { to, holds }, Some(fingers)) => {
                let gripper = &fingers.gripper;
                let Some(&(_, at)) = joints.iter().find(|(name, _)| *name == gripper.joint) else {
                    let unheard = format!("nothing is heard of the gripper's joint '{}'", gripper.joint);
                    return if is_late { self.fail(&unheard) } else { Vec::new() };
                };
                let near = NEAR_GRIP * (gripper.open - gripper.closed).abs();
                let stands = motion.finger.replace(at).is_some_and(|before| (before - at).abs() < 0.1 * near);
                let has_closed = || gripper.found(to, at) != Found::StillOpen;
                match stands && (if holds { has_closed() || is_late } else { (at - to).abs() < near }) {
                    true => self.step_done(now, Some(at)),
                    false if is_late => self.fail(&format!("the gripper is at {at:.4} instead of {to:.4}")),
                    false => Vec::new(),
                }
            }
            (Act::Grip { .. }, None) => self.fail("there is no gripper"),
        }
    }

    /// A step is over; `finger` is where the gripper's joint is after one of the gripper's.
    fn step_done(&mut self, now: Time, finger: Option<f64>) -> Vec<Deed> {
        let Some(motion) = &mut self.motion else { return Vec::new() };
        match (&motion.step().act, motion.step().stage) {
            (&Act::Grip { to, holds: true }, _) => {
                let found = self.fingers.as_ref().zip(finger).map(|(fingers, at)| fingers.gripper.found(to, at));
                if found != Some(Found::Something) {
                    let label = &motion.plan.scene.target.label;
                    let what = match found {
                        Some(Found::Nothing) => format!("closed and '{label}' was not in it"),
                        _ => "did not close".to_owned(),
                    };
                    let reason = format!("the gripper {what}; the hand goes back");
                    motion.ends = Some((PlaceObjectResult::GRASP_FAILED, reason));
                    (motion.steps, motion.at) = (steps::of_giving_up(&motion.plan), 0);
                    return self.begin(now);
                }
                self.held = Some(motion.plan.scene.target.id.clone());
            }
            (Act::Grip { .. }, PlaceObjectFeedback::RELEASING) => {
                self.held = None;
                self.put_down = Some(motion.plan.clone());
            }
            _ => {}
        }
        motion.at += 1;
        if motion.at < motion.steps.len() {
            return self.begin(now);
        }
        if let Some((outcome, reason)) = motion.ends.take() {
            return self.end(outcome, &reason);
        }
        if !motion.plan.grip_open.is_finite() {
            self.put_down = Some(motion.plan.clone());
        }
        self.end(PlaceObjectResult::DONE, "it stands")
    }

    fn fail(&mut self, reason: &str) -> Vec<Deed> {
        let is_of_gripper = self.motion.as_ref().is_some_and(|motion| motion.limb() == Limb::Gripper);
        let outcome =
            if is_of_gripper { PlaceObjectResult::GRASP_FAILED } else { PlaceObjectResult::CONTROLLER_FAILED };
        self.end(outcome, reason)
    }

    fn end(&mut self, outcome: u8, reason: &str) -> Vec<Deed> {
        let Some(motion) = self.motion.take() else { return Vec::new() };
        if motion.step().stage == PlaceObjectFeedback::RELEASING {
            // The fingers may have let go, or not: where it is seen tells.
            self.held = None;
        }
        let result = result_of(&motion.plan, outcome, reason);
        let progress = if outcome == PlaceObjectResult::DONE { 1.0 } else { motion.progress(0.0) };
        let news = motion.news(motion.seen);
        let news = Carrying { description: reason.to_owned(), progress, over: true, outcome, ..news };
        let mut deeds = vec![Deed::Tell(Box::new(news))];
        deeds.extend(motion.asked.map(|goal_id| finish(goal_id, result.clone())));
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
