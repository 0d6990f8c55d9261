//! What the arm does in the course of a plan.

use crate::convert;
use apprentice_msgs::msg::PlacementPlan;
use apprentice_msgs::trajectory_msgs::JointTrajectory;
use arm::Isometry3;
use exchange::GRIP_S;
use placement::Manipulator;

/// Empty without a trajectory.
#[derive(Debug, Clone, Default)]
pub(crate) struct Way {
    /// When, seconds from the start, and every link then, in the table's frame: to the target, with it, and away from it.
    pub(crate) moments: Vec<(f64, Vec<Isometry3<f64>>)>,
    /// The tool's origin at every point of the trajectory with the target, metres.
    pub(crate) points_m: Vec<[f64; 3]>,
    /// When the target is in the hand, seconds from the start.
    pub(crate) held_s: [f64; 2],
    /// How what it holds is turned about the vertical in the end, radians.
    pub(crate) heading_rad: Option<f64>,
}

impl Way {
    /// Of a plan for this arm. Joints that the plan says nothing about are where `joints` has them.
    pub(crate) fn new(arm: &Manipulator, plan: &PlacementPlan, joints: &[(String, f64)]) -> Self {
        let Ok(mut start) = convert::joints(&plan.start) else { return Self::default() };
        let others = joints.iter().filter(|(name, _)| !plan.start.name.contains(name));
        start.extend(others.cloned());
        let mut way = Self::default();
        if !way.add(arm, plan, &plan.approach, &start, plan.grip_open) {
            return Self::default();
        }
        way.held_s[0] = way.pause();
        let first = way.moments.len().saturating_sub(1);
        if !way.add(arm, plan, &plan.trajectory, &start, plan.grip) {
            return Self::default();
        }
        let mut tools = way.moments[first..].iter().map(|(_, links)| links[arm.tool_link()]);
        way.points_m = tools.clone().map(|tool| tool.translation.vector.into()).collect();
        let turn_rad = exchange::scene_from_message(&plan.scene).map_or(0.0, |scene| arm.turn_in_hand_rad(&scene));
        let heading = |tool: Isometry3<f64>| {
            let x_axis = tool.rotation * arm::Vector3::x();
            x_axis.y.atan2(x_axis.x) - turn_rad
        };
        way.heading_rad = tools.next_back().map(heading);
        way.held_s[1] = if plan.retreat.points.is_empty() { way.end_s() } else { way.pause() };
        way.add(arm, plan, &plan.retreat, &start, plan.grip_open);
        way
    }

    fn end_s(&self) -> f64 {
        self.moments.last().map_or(0.0, |(s, _)| *s)
    }

    /// While the gripper moves, after something: when it has.
    fn pause(&mut self) -> f64 {
        let Some((at_s, links)) = self.moments.last().cloned() else { return 0.0 };
        self.moments.push((at_s + GRIP_S, links));
        at_s + GRIP_S
    }

    /// Appends a part of the motion, `finger` being where the gripper's joint is; whether it could be done.
    fn add(
        &mut self,
        arm: &Manipulator,
        plan: &PlacementPlan,
        part: &JointTrajectory,
        start: &[(String, f64)],
        finger: f64,
    ) -> bool {
        let mut start = start.to_vec();
        if let Some(gripper) = arm.gripper().filter(|_| finger.is_finite()) {
            start.retain(|(name, _)| *name != gripper.joint);
            start.push((gripper.joint.clone(), finger));
        }
        let points = part.points.iter().map(|point| &point.positions[..]);
        let Some(poses) = arm.poses_along(&plan.scene.header.frame_id, &start, &part.joint_names, points) else {
            return false;
        };
        // A part begins where the one before it ended.
        let n_known = usize::from(!self.moments.is_empty());
        let start_s = self.end_s();
        let times = part.points.iter().map(|point| start_s + point.time_from_start.seconds());
        self.moments.extend(times.zip(poses).skip(n_known));
        true
    }
}
