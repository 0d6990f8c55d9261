//! What other programs are shown: MoveIt the table, tf where things stand, RViz the plan.

mod markers;
mod planning_scene;
mod transforms;

pub(crate) use markers::markers;

use crate::Output;
use apprentice_msgs::builtin_interfaces::Time;
use apprentice_msgs::geometry_msgs::{Point, Pose, Quaternion};
use apprentice_msgs::msg::{PlacementPlan, SceneObject, TableScene};
use exchange::scene_from_message;
use placement::resting_height_m;
use std::collections::BTreeSet;

/// The table as it was shown last.
#[derive(Debug, Default)]
pub(crate) struct Sharing {
    /// What was put down since the scene was heard last, at its place.
    placed: Option<SceneObject>,
    /// Whether something changed that was not shown yet.
    changed: bool,
    /// Frame and ids of what MoveIt was told stands there.
    told: (String, BTreeSet<String>),
}

impl Sharing {
    /// The table is another.
    pub(crate) fn scene_changed(&mut self) {
        self.placed = None;
        self.changed = true;
    }

    /// The arm took the target in hand: it stands nowhere.
    pub(crate) fn picked_up(&mut self) {
        self.changed |= self.placed.take().is_some();
    }

    /// The target of a plan stands where the plan puts it.
    pub(crate) fn put_down(&mut self, plan: &PlacementPlan) {
        self.placed = standing(plan);
        self.changed |= self.placed.is_some();
    }

    /// The table for MoveIt and tf if it changed since, or if `again`.
    pub(crate) fn show(&mut self, now: Time, scene: Option<&TableScene>, again: bool) -> Vec<Output> {
        let Some(scene) = scene.filter(|_| self.changed || again) else { return Vec::new() };
        // What cannot be planned with is not shown either; the plan says why.
        if scene_from_message(scene).is_err() {
            return Vec::new();
        }
        self.changed = false;
        let solids: Vec<&SceneObject> = scene.objects.iter().chain(&self.placed).collect();
        let message = planning_scene::diff(scene, &solids, &mut self.told);
        let transforms = transforms::transforms(now, &scene.header.frame_id, &solids);
        vec![Output::PlanningScene(Box::new(message)), Output::Transforms(transforms)]
    }
}

/// The target where a plan puts it; `None` without a place.
fn standing(plan: &PlacementPlan) -> Option<SceneObject> {
    let at = &plan.robust_placement;
    let scene = scene_from_message(&plan.scene).ok()?;
    if !(at.x.is_finite() && at.y.is_finite()) {
        return None;
    }
    let z = resting_height_m(&scene, scene::Point::new(at.x, at.y));
    // It is carried upright, with the heading that the scene gives it.
    let orientation = upright(scene.target.yaw_rad);
    let pose = Pose { position: Point { x: at.x, y: at.y, z }, orientation };
    Some(SceneObject { pose, ..plan.scene.target.clone() })
}

/// Turned about the vertical.
fn upright(yaw_rad: f64) -> Quaternion {
    let (sin, cos) = (0.5 * yaw_rad).sin_cos();
    Quaternion { x: 0.0, y: 0.0, z: sin, w: cos }
}

/// At a point, not turned.
fn at(x: f64, y: f64, z: f64) -> Pose {
    Pose { position: Point { x, y, z }, orientation: upright(0.0) }
}
