//! What a plan asks of the arm and the gripper, one thing after another.

use apprentice_msgs::action::PlaceObjectFeedback;
use apprentice_msgs::builtin_interfaces::Duration;
use apprentice_msgs::control_msgs::{GripperCommand, GripperCommandGoal};
use apprentice_msgs::msg::PlacementPlan;
use apprentice_msgs::trajectory_msgs::{JointTrajectory, JointTrajectoryPoint};
use exchange::{GRIP_S, trajectory_seconds};
use placement::Gripper;

/// A gripper, and how it is told.
#[derive(Debug, Clone, PartialEq)]
pub struct Fingers {
    /// What it is like.
    pub gripper: Gripper,
    /// Whether a controller is to move it, an action of the type `GripperCommand`; else its joint is moved on the topic.
    pub has_controller: bool,
    /// How hard it may press, as the controller understands it.
    pub effort: f64,
}

/// One thing to do.
#[derive(Debug, Clone)]
pub(super) struct Step {
    pub stage: u8,
    pub act: Act,
}

#[derive(Debug, Clone)]
pub(super) enum Act {
    /// The arm moves.
    Move(JointTrajectory),
    /// The fingers go to a position; there may have to be something between them then.
    Grip { to: f64, holds: bool },
}

impl Step {
    fn moving(stage: u8, trajectory: &JointTrajectory) -> Self {
        Self { stage, act: Act::Move(trajectory.clone()) }
    }

    fn open(stage: u8, plan: &PlacementPlan) -> Self {
        Self { stage, act: Act::Grip { to: plan.grip_open, holds: false } }
    }

    /// How long it takes if all goes well.
    pub fn seconds(&self) -> f64 {
        match &self.act {
            Act::Move(trajectory) => trajectory_seconds(trajectory),
            Act::Grip { .. } => GRIP_S,
        }
    }

    pub fn words(&self) -> &'static str {
        match (&self.act, self.stage) {
            (Act::Grip { holds: true, .. }, _) => "the gripper closes",
            (Act::Grip { .. }, PlaceObjectFeedback::RELEASING) => "the gripper lets go",
            (Act::Grip { .. }, _) => "the gripper opens",
            (Act::Move(_), PlaceObjectFeedback::APPROACHING) => "the empty hand goes to it",
            (Act::Move(_), PlaceObjectFeedback::RETREATING) => "the empty hand goes away",
            (Act::Move(_), _) => "the arm takes it there",
        }
    }
}

/// All of a plan.
pub(super) fn of_plan(plan: &PlacementPlan) -> Vec<Step> {
    let mut steps = Vec::new();
    if plan.picks {
        steps.push(Step::open(PlaceObjectFeedback::APPROACHING, plan));
        steps.push(Step::moving(PlaceObjectFeedback::APPROACHING, &plan.approach));
        let act = Act::Grip { to: plan.grip, holds: true };
        steps.push(Step { stage: PlaceObjectFeedback::GRASPING, act });
    }
    steps.push(Step::moving(PlaceObjectFeedback::MOVING, &plan.trajectory));
    if plan.grip_open.is_finite() {
        steps.push(Step::open(PlaceObjectFeedback::RELEASING, plan));
        steps.push(Step::moving(PlaceObjectFeedback::RETREATING, &plan.retreat));
    }
    steps
}

/// Where nothing was in the gripper: open it, and back the way it came.
pub(super) fn of_giving_up(plan: &PlacementPlan) -> Vec<Step> {
    let back = reversed(&plan.approach);
    vec![Step::open(PlaceObjectFeedback::RETREATING, plan), Step::moving(PlaceObjectFeedback::RETREATING, &back)]
}

/// The same motion backwards, as fast.
fn reversed(trajectory: &JointTrajectory) -> JointTrajectory {
    let end_s = trajectory_seconds(trajectory);
    let negated = |of: &[f64]| of.iter().map(|v| -v).collect();
    let points = trajectory.points.iter().rev().map(|point| JointTrajectoryPoint {
        positions: point.positions.clone(),
        velocities: negated(&point.velocities),
        accelerations: point.accelerations.clone(),
        time_from_start: Duration::from_seconds(end_s - point.time_from_start.seconds()),
        ..JointTrajectoryPoint::default()
    });
    JointTrajectory { points: points.collect(), ..trajectory.clone() }
}

impl Fingers {
    /// For the controller.
    pub(super) fn goal(&self, to: f64) -> GripperCommandGoal {
        GripperCommandGoal { command: GripperCommand { position: to, max_effort: self.effort } }
    }

    /// For the topic.
    pub(super) fn trajectory(&self, to: f64) -> JointTrajectory {
        let point = JointTrajectoryPoint {
            positions: vec![to],
            time_from_start: Duration::from_seconds(GRIP_S),
            ..JointTrajectoryPoint::default()
        };
        JointTrajectory {
            joint_names: vec![self.gripper.joint.clone()],
            points: vec![point],
            ..JointTrajectory::default()
        }
    }
}
