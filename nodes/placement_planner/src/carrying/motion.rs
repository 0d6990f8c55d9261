//! One plan on its way: which step it is at, and what that is in words.

use super::Deed;
use super::controllers::Limb;
use super::steps::{Act, Fingers, Step};
use apprentice_msgs::action::PlaceObjectFeedback;
use apprentice_msgs::builtin_interfaces::{Duration, Time};
use apprentice_msgs::control_msgs::FollowJointTrajectoryGoal;
use apprentice_msgs::msg::{Carrying, PlacementPlan};
use apprentice_msgs::std_msgs::Header;
use apprentice_msgs::trajectory_msgs::JointTrajectory;
use bus::GoalId;

/// Without a controller a joint may be this far from where the motion ends, radians or metres.
const NEAR_END: f64 = 0.05;

/// One plan being carried out.
#[derive(Debug)]
pub(super) struct Motion {
    pub plan: Box<PlacementPlan>,
    /// Of the client that wants the object placed; none when the robot moves by itself.
    pub asked: Option<GoalId>,
    pub steps: Vec<Step>,
    pub at: usize,
    /// How it ends once its steps are done, when that is not well.
    pub ends: Option<(u8, String)>,
    pub goal_id: GoalId,
    pub attempt: u32,
    pub phase: Phase,
    /// When the phase began, when the result was asked for last, and when the controller was seen last.
    pub since: Time,
    pub asked_at: Time,
    pub seen: Time,
    /// Where the gripper's joint was at the last tick.
    pub finger: Option<f64>,
}

/// Where a step stands.
#[derive(Debug)]
pub(super) enum Phase {
    /// The controller has not answered.
    Sent,
    /// It moves, or nobody can tell.
    Moving,
    /// It is being called off, for a reason that the result will give.
    Stopping { outcome: u8, reason: String },
}

impl Motion {
    pub fn step(&self) -> &Step {
        &self.steps[self.at.min(self.steps.len() - 1)]
    }

    pub fn limb(&self) -> Limb {
        if matches!(self.step().act, Act::Grip { .. }) { Limb::Gripper } else { Limb::Arm }
    }

    /// Whether the target is in the hand from the beginning to the end.
    pub fn starts_in_hand(&self) -> bool {
        !self.plan.picks && self.step().stage == PlaceObjectFeedback::MOVING
    }

    /// The step under way, for a sentence.
    pub fn what(&self) -> &'static str {
        if self.limb() == Limb::Arm { "the motion" } else { "the gripper" }
    }

    pub fn send(&self, fingers: Option<&Fingers>, is_watched: bool) -> Option<Deed> {
        Some(match (&self.step().act, is_watched) {
            (Act::Move(trajectory), true) => {
                let goal = FollowJointTrajectoryGoal {
                    trajectory: trajectory.clone(),
                    goal_time_tolerance: Duration::from_seconds(1.0),
                    ..FollowJointTrajectoryGoal::default()
                };
                Deed::Send(self.goal_id, Box::new(goal))
            }
            (Act::Move(trajectory), false) => Deed::Publish(Box::new(trajectory.clone())),
            (&Act::Grip { to, .. }, true) => Deed::Grip(self.goal_id, fingers?.goal(to)),
            (&Act::Grip { to, .. }, false) => Deed::Publish(Box::new(fingers?.trajectory(to))),
        })
    }

    pub fn accepted(&mut self, now: Time) -> Vec<Deed> {
        if !matches!(self.phase, Phase::Sent) {
            return Vec::new();
        }
        (self.phase, self.since, self.asked_at) = (Phase::Moving, now, now);
        vec![Deed::AskResult(self.limb(), self.goal_id)]
    }

    /// How far it is, for everybody.
    pub fn news(&self, now: Time) -> Carrying {
        let step = self.step();
        Carrying {
            header: Header { stamp: now, frame_id: self.plan.scene.header.frame_id.clone() },
            revision: self.plan.revision,
            object_id: self.plan.scene.target.id.clone(),
            stage: step.stage,
            description: step.words().to_owned(),
            progress: self.progress(0.0),
            placement: self.plan.robust_placement,
            ..Carrying::default()
        }
    }

    /// Of the whole, `done_s` into the step, 0 to 1.
    pub fn progress(&self, done_s: f64) -> f64 {
        let before_s: f64 = self.steps[..self.at].iter().map(Step::seconds).sum();
        let total_s: f64 = self.steps.iter().map(Step::seconds).sum();
        ((before_s + done_s.clamp(0.0, self.step().seconds())) / total_s.max(1e-3)).clamp(0.0, 1.0)
    }

    /// How far it is, for whoever asked for it.
    pub fn tell(&self, done_s: f64) -> Option<Deed> {
        let step = self.step();
        let description = step.words().to_owned();
        let feedback = PlaceObjectFeedback { stage: step.stage, description, progress: self.progress(done_s) };
        self.asked.map(|goal_id| Deed::Feedback(goal_id, feedback))
    }
}

/// A joint that is not where a trajectory ends, in words.
pub(super) fn far_joint(trajectory: &JointTrajectory, joints: &[(String, f64)]) -> Option<String> {
    let last = trajectory.points.last()?;
    trajectory.joint_names.iter().zip(&last.positions).find_map(|(name, &wanted)| {
        match joints.iter().find(|(joint, _)| joint == name) {
            None => Some(format!("nothing is heard of joint '{name}'")),
            Some((_, at)) if (at - wanted).abs() > NEAR_END => {
                Some(format!("joint '{name}' is at {at:.3} instead of {wanted:.3}"))
            }
            Some(_) => None,
        }
    })
}
