//! What other programs are shown: MoveIt the table, tf where things stand, RViz the plan.

mod arm_picture;
mod markers;
mod planning_scene;
mod transforms;
mod way;

pub(crate) use way::Way;

use crate::Output;
use crate::target::is_elsewhere;
use apprentice_msgs::builtin_interfaces::Time;
use apprentice_msgs::msg::{ArmMotion, PlacementPlan, SceneObject, TableScene};
use apprentice_msgs::std_msgs::Header;
use exchange::{pose_at, scene_from_message, scene_to_message};
use placement::{Manipulator, resting_height_m};
use scene::Point;
use std::collections::BTreeSet;

/// What was shown last.
#[derive(Debug, Default)]
pub(crate) struct Sharing {
    /// The target where it stands: as it is seen, or where the arm put it down.
    placed: Option<SceneObject>,
    /// Whether something changed that was not shown yet.
    changed: bool,
    /// Frame and ids of what MoveIt was told stands there.
    told: (String, BTreeSet<String>),
    /// The frame of the plan that is drawn, if one is.
    drawn: Option<String>,
    /// Robot and frame of the arm that was shown.
    arm: Option<(String, String)>,
    /// When its links were told last, and the joints they came from.
    told_at: Option<(Time, Vec<(String, f64)>)>,
}

/// The links are told this often, at most, nanoseconds.
const TOLD_EVERY_NS: i128 = 100_000_000;
/// A joint that moved less stands, radians or metres.
const STANDS: f64 = 1e-3;

impl Sharing {
    /// The table changed from what was `known`. What the arm put down still stands there, seen or not, unless the table or the
    /// target is another.
    pub(crate) fn scene_changed(&mut self, known: Option<&TableScene>, scene: &TableScene) {
        let of = |scene: &TableScene| (scene.id.clone(), scene.target.id.clone(), scene.header.frame_id.clone());
        if known.map(of) != Some(of(scene)) {
            self.placed = None;
        }
        self.changed = true;
    }

    /// The arm took the target in hand: it stands nowhere.
    pub(crate) fn picked_up(&mut self) {
        self.changed |= self.placed.take().is_some();
    }

    /// The target is seen to stand somewhere.
    pub(crate) fn seen(&mut self, target: SceneObject) {
        if self.placed.as_ref().is_none_or(|placed| is_elsewhere(&target, &placed.pose, &target.pose)) {
            self.placed = Some(target);
            self.changed = true;
        }
    }

    /// The target of a plan stands where its way ends.
    pub(crate) fn put_down(&mut self, plan: &PlacementPlan, way: &Way) {
        self.placed = standing(plan, way);
        self.changed |= self.placed.is_some();
    }

    /// The table for MoveIt and tf if it changed since, or if `again`.
    pub(crate) fn show(&mut self, now: Time, scene: Option<&TableScene>, again: bool) -> Vec<Output> {
        if !(self.changed || again) {
            return Vec::new();
        }
        self.changed = false;
        // What cannot be planned with is not shown either; the plan says why. What can is shown as the planner takes it.
        let Some(Ok(scene)) = scene.map(scene_from_message) else { return Vec::new() };
        let scene = scene_to_message(&scene, Time::default());
        let is_seen = |placed: &&SceneObject| scene.objects.iter().any(|object| object.id == placed.id);
        let unseen = self.placed.iter().filter(|placed| !is_seen(placed));
        let solids: Vec<&SceneObject> = scene.objects.iter().chain(unseen).collect();
        let message = planning_scene::diff(&scene, &solids, &mut self.told);
        let transforms = transforms::transforms(now, &scene.header.frame_id, &solids);
        vec![Output::PlanningScene(Box::new(message)), Output::Transforms(transforms)]
    }

    /// A new plan, drawn.
    pub(crate) fn draw(&mut self, plan: &PlacementPlan, way: &Way) -> [Output; 2] {
        self.drawn = Some(plan.scene.header.frame_id.clone());
        let motion = arm_picture::motion(plan, way);
        [Output::Markers(Box::new(markers::markers(plan, way))), Output::ArmMotion(Box::new(motion))]
    }

    /// Takes away the picture of a plan that holds no more.
    pub(crate) fn wipe(&mut self) -> Vec<Output> {
        let Some(frame) = self.drawn.take() else { return Vec::new() };
        let header = Header { frame_id: frame.clone(), ..Header::default() };
        let nothing = ArmMotion { header, ..ArmMotion::default() };
        vec![Output::Markers(Box::new(markers::no_markers(&frame))), Output::ArmMotion(Box::new(nothing))]
    }

    /// The arm, when it is another or in another frame, or `again`, and where its links are, when that changed.
    pub(crate) fn show_arm(
        &mut self,
        now: Time,
        arm: &Manipulator,
        robot_hash: &str,
        scene: &TableScene,
        joints: &[(String, f64)],
        again: bool,
    ) -> Vec<Output> {
        let frame = &scene.header.frame_id;
        let mut shown = Vec::new();
        let is_known = self.arm.as_ref().is_some_and(|(hash, of)| (hash.as_str(), of) == (robot_hash, frame));
        if !is_known || again {
            self.arm = Some((robot_hash.to_owned(), frame.clone()));
            self.told_at = None;
            shown.push(Output::ArmModel(Box::new(arm_picture::model(arm, robot_hash, frame))));
        }
        let near = |(a, b): (&(String, f64), &(String, f64))| a.0 == b.0 && (a.1 - b.1).abs() < STANDS;
        let stands = |before: &[(String, f64)]| before.len() == joints.len() && before.iter().zip(joints).all(near);
        let too_soon = |(at, before): &(Time, Vec<(String, f64)>)| {
            (0..TOLD_EVERY_NS).contains(&now.nanoseconds_since(at)) || stands(before)
        };
        if joints.is_empty() || self.told_at.as_ref().is_some_and(too_soon) {
            return shown;
        }
        self.told_at = Some((now, joints.to_vec()));
        shown.extend(arm_picture::arm_pose(arm, robot_hash, frame, joints, now).map(Output::ArmPose));
        shown
    }
}

/// The target where a plan puts it, turned as the hand turns it there; `None` without a place.
fn standing(plan: &PlacementPlan, way: &Way) -> Option<SceneObject> {
    let at = &plan.robust_placement;
    let scene = scene_from_message(&plan.scene).ok()?;
    if !(at.x.is_finite() && at.y.is_finite()) {
        return None;
    }
    let z_m = resting_height_m(&scene, Point::new(at.x, at.y));
    let yaw_rad = way.heading_rad.unwrap_or(scene.target.yaw_rad);
    let target = scene_to_message(&scene, Time::default()).target;
    Some(SceneObject { pose: pose_at([at.x, at.y, z_m], yaw_rad), ..target })
}
