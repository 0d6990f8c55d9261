//! The target where it stands, as somebody sees it: what a plan picks up, and whether that still holds.

use crate::node::{Output, deeds};
use crate::{PlacementPlanner, convert};
use apprentice_msgs::action::PlaceObjectResult;
use apprentice_msgs::builtin_interfaces::Time;
use apprentice_msgs::geometry_msgs::{Pose, PoseStamped};
use apprentice_msgs::msg::{PlacementPlan, SceneObject, TableScene};
use placement::Source;

/// What was seen to move by less has not moved, metres and radians.
const STILL_M: f64 = 0.005;
const STILL_RAD: f64 = 0.05;

impl PlacementPlanner {
    /// Takes where the target is seen, and plans anew when the plan picks it up from elsewhere.
    pub(crate) fn take_target(&mut self, now: Time, message: &PoseStamped) -> Vec<Output> {
        let Some(scene) = &self.scene else { return Vec::new() };
        let (frame, table) = (&message.header.frame_id, &scene.header.frame_id);
        let wrong = match convert::source(Some(&message.pose)) {
            Source::Stands(_) if frame == table => None,
            Source::Stands(_) => Some(format!("it is in the frame '{frame}', the table is in '{table}'")),
            _ => Some("it is no pose".to_owned()),
        };
        if let Some(reason) = wrong {
            let is_new = !std::mem::replace(&mut self.target_wrong, true);
            return is_new.then(|| Output::Warn(format!("target_pose is ignored: {reason}"))).into_iter().collect();
        }
        self.target_wrong = false;
        self.target = Some((message.pose, now));
        if self.carrier.has_target() {
            return Vec::new();
        }
        let moved = self.plan.as_ref().is_some_and(|plan| plan.picks && has_moved(plan, &message.pose));
        self.sharing.seen(SceneObject { pose: message.pose, ..scene.target.clone() });
        if !moved {
            // The joints may have been heard before the target.
            return self.execute(now);
        }
        if self.carrier.is_busy() {
            // It is put down already, or the empty hand is on its way to it.
            let is_on_its_way = self.carrier.is_fetching();
            let reason = format!("'{}' was moved before the hand was there", scene.target.label);
            let stop = is_on_its_way.then(|| self.carrier.stop(now, PlaceObjectResult::SCENE_CHANGED, &reason));
            return deeds(stop.unwrap_or_default());
        }
        if self.plan.as_ref().is_some_and(|plan| self.put_down == Some(plan.revision)) {
            // What the robot put down is where its plan says, not where its plan took it from.
            return Vec::new();
        }
        self.plan = None;
        self.update(now)
    }

    /// Where a plan is to pick the target up; `None` when it is in the hand.
    pub(crate) fn pick(&self, scene: &TableScene) -> Option<Pose> {
        let is_held = self.carrier.held() == Some(scene.target.id.as_str());
        let seen = || self.target.map_or_else(convert::unseen, |(pose, _)| pose);
        (self.settings.pick && !is_held).then(seen)
    }

    /// Why the target cannot be taken to be where a plan picks it up.
    pub(crate) fn target_is_lost(&self, now: &Time, plan: &PlacementPlan) -> Option<String> {
        if !plan.picks {
            return None;
        }
        let label = &plan.scene.target.label;
        let Some((pose, at)) = &self.target else { return Some(format!("nothing is heard of where '{label}' stands")) };
        let age_s = now.nanoseconds_since(at) as f64 * 1e-9;
        if age_s > self.settings.target_age_s {
            let most_s = self.settings.target_age_s;
            return Some(format!("where '{label}' stands was heard {age_s:.1} s ago; {most_s} s are allowed"));
        }
        has_moved(plan, pose).then(|| format!("'{label}' was moved since the plan was made"))
    }
}

/// Whether the target is seen elsewhere than where a plan picks it up.
fn has_moved(plan: &PlacementPlan, pose: &Pose) -> bool {
    is_elsewhere(&plan.scene.target, &plan.pick, pose)
}

/// Whether a thing stands elsewhere at one pose than at the other; how something round is turned says nothing.
pub(crate) fn is_elsewhere(object: &SceneObject, a: &Pose, b: &Pose) -> bool {
    let is_round = object.shape == SceneObject::SHAPE_CYLINDER;
    match (convert::source(Some(a)), convert::source(Some(b))) {
        (Source::Stands(a), Source::Stands(b)) => {
            let by_m = a.at_m.distance(b.at_m).max((a.base_m - b.base_m).abs());
            let turn = a.yaw_rad - b.yaw_rad;
            by_m > STILL_M || (!is_round && libm::atan2(turn.sin(), turn.cos()).abs() > STILL_RAD)
        }
        (Source::Unknown, Source::Unknown) => false,
        _ => true,
    }
}
