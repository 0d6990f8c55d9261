//! Goals of `place_object`: planned anew from where the arm is, and refused with the reason when something is in the way.

use crate::PlacementPlanner;
use crate::carrying::{finish, result_of};
use crate::node::{Output, deeds, is_task};
use apprentice_msgs::action::{PlaceObject, PlaceObjectGoal, PlaceObjectResult};
use apprentice_msgs::builtin_interfaces::Time;
use apprentice_msgs::msg::PlacementPlan;
use bus::{ActionRequest, GoalId};

/// A joint that is farther than this from where the plan starts has moved since, radians or metres.
pub(crate) const SAME_START: f64 = 0.02;

impl PlacementPlanner {
    /// Takes a goal or a cancellation.
    pub(crate) fn place(&mut self, now: Time, request: ActionRequest<PlaceObject>) -> Vec<Output> {
        match request {
            ActionRequest::Cancel { goal_id } if self.carrier.is_for(goal_id) => {
                deeds(self.carrier.stop(now, PlaceObjectResult::CANCELED, "called off"))
            }
            ActionRequest::Cancel { .. } => Vec::new(),
            ActionRequest::Goal { goal_id, goal } => {
                let mut outputs = vec![Output::Accept(goal_id)];
                outputs.extend(self.begin(now, goal_id, &goal));
                outputs
            }
        }
    }

    fn begin(&mut self, now: Time, goal_id: GoalId, goal: &PlaceObjectGoal) -> Vec<Output> {
        let refuse = |plan: &PlacementPlan, outcome, reason: &str| {
            deeds(vec![finish(goal_id, result_of(plan, outcome, reason))])
        };
        let none = PlacementPlan::default();
        if self.carrier.is_busy() {
            return refuse(&none, PlaceObjectResult::BUSY, "another object is being placed");
        }
        let Some(scene) = &self.scene else {
            return refuse(&none, PlaceObjectResult::UNKNOWN_OBJECT, "no table has been seen");
        };
        let target = &scene.target.id;
        if !goal.object_id.is_empty() && goal.object_id != *target {
            let reason = format!("'{}' is not the object to place; that is '{target}'", goal.object_id);
            return refuse(&none, PlaceObjectResult::UNKNOWN_OBJECT, &reason);
        }
        let Some(posterior) = &self.posterior else {
            return refuse(&none, PlaceObjectResult::NOT_TAUGHT, "nothing has been learned yet");
        };
        let inside_bound = self.taught == Some(posterior.revision) && is_task(scene, posterior);
        // From where the arm is now.
        self.plan = None;
        let mut outputs: Vec<Output> =
            self.update(now).into_iter().filter(|output| !matches!(output, Output::Deed(_))).collect();
        let Some(plan) = self.plan.clone() else {
            outputs.extend(refuse(&none, PlaceObjectResult::NO_ROBOT, "no plan could be made; the log says why"));
            return outputs;
        };
        let failed = match plan.outcome {
            PlacementPlan::PLANNED => None,
            PlacementPlan::NO_FREE_PLACE => Some(PlaceObjectResult::NO_FREE_PLACE),
            PlacementPlan::UNREACHABLE => Some(PlaceObjectResult::UNREACHABLE),
            PlacementPlan::NO_PATH => Some(PlaceObjectResult::NO_PATH),
            PlacementPlan::START_IN_COLLISION => Some(PlaceObjectResult::START_IN_COLLISION),
            PlacementPlan::GOAL_IN_COLLISION => Some(PlaceObjectResult::GOAL_IN_COLLISION),
            PlacementPlan::JOINTS_UNKNOWN => Some(PlaceObjectResult::STALE_JOINTS),
            PlacementPlan::OUTSIDE_LIMITS => Some(PlaceObjectResult::OUTSIDE_LIMITS),
            PlacementPlan::CANNOT_PICK => Some(PlaceObjectResult::CANNOT_PICK),
            _ => Some(PlaceObjectResult::NO_ROBOT),
        };
        let end = match failed {
            Some(outcome) => refuse(&plan, outcome, &plan.reason),
            None if goal.plan_only => refuse(&plan, PlaceObjectResult::PLANNED, &plan.reason),
            None if !inside_bound => {
                let reason = "the bound on the placement loss is not known to be below epsilon for this table";
                refuse(&plan, PlaceObjectResult::NOT_TAUGHT, reason)
            }
            None => match self.obstacle(&now, &plan) {
                Some((outcome, reason)) => refuse(&plan, outcome, &reason),
                None => deeds(self.start(now, plan, Some(goal_id))),
            },
        };
        outputs.extend(end);
        outputs
    }

    /// Why arm and target cannot be taken to be where a plan starts; `None` when they can.
    pub(crate) fn obstacle(&self, now: &Time, plan: &PlacementPlan) -> Option<(u8, String)> {
        let stale = |reason| (PlaceObjectResult::STALE_JOINTS, reason);
        let lost = |reason| (PlaceObjectResult::CANNOT_PICK, reason);
        self.arm_is_elsewhere(now, plan).map(stale).or_else(|| self.target_is_lost(now, plan).map(lost))
    }

    fn arm_is_elsewhere(&self, now: &Time, plan: &PlacementPlan) -> Option<String> {
        let Some(at) = &self.joints_at else { return Some("nothing is heard of the joints".into()) };
        let age_s = now.nanoseconds_since(at) as f64 * 1e-9;
        if age_s > self.settings.joint_age_s {
            return Some(format!("the joint states are {age_s:.2} s old; {} s are allowed", self.settings.joint_age_s));
        }
        plan.trajectory.joint_names.iter().find_map(|name| {
            let known = |names: &[String], positions: &[f64]| {
                names.iter().position(|known| known == name).and_then(|i| positions.get(i).copied())
            };
            let now_at = self.joints.iter().find(|(joint, _)| joint == name).map(|(_, position)| *position);
            match (known(&plan.start.name, &plan.start.position), now_at) {
                (Some(start), Some(at)) if (start - at).abs() <= SAME_START => None,
                (Some(_), Some(_)) => Some(format!("joint '{name}' moved since the plan was made")),
                _ => Some(format!("nothing is heard of joint '{name}'")),
            }
        })
    }
}
