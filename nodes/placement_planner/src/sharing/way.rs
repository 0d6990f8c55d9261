//! What the arm does along a plan's trajectory.

use crate::convert;
use apprentice_msgs::msg::PlacementPlan;
use arm::Isometry3;
use placement::Manipulator;

/// Empty without a trajectory.
#[derive(Debug, Clone, Default)]
pub(crate) struct Way {
    /// Every link at every point of the trajectory, in the table's frame.
    pub(crate) poses: Vec<Vec<Isometry3<f64>>>,
    /// The tool's origin there, metres.
    pub(crate) points_m: Vec<[f64; 3]>,
    /// How what it holds is turned about the vertical in the end, radians: a held thing's x axis is the tool's.
    pub(crate) heading_rad: Option<f64>,
}

impl Way {
    /// Of a plan for this arm. Joints that the plan says nothing about, a gripper's for one, are where `joints` has them.
    pub(crate) fn new(arm: &Manipulator, plan: &PlacementPlan, joints: &[(String, f64)]) -> Self {
        let Ok(mut start) = convert::joints(&plan.start) else { return Self::default() };
        let others = joints.iter().filter(|(name, _)| !plan.start.name.contains(name));
        start.extend(others.cloned());
        let points = plan.trajectory.points.iter().map(|point| &point.positions[..]);
        let poses = arm.poses_along(&plan.scene.header.frame_id, &start, &plan.trajectory.joint_names, points);
        let poses = poses.unwrap_or_default();
        let tools = || poses.iter().map(|links| links[arm.tool_link()]);
        let heading = |tool: Isometry3<f64>| {
            let x_axis = tool.rotation * arm::Vector3::x();
            x_axis.y.atan2(x_axis.x)
        };
        Self {
            points_m: tools().map(|tool| tool.translation.vector.into()).collect(),
            heading_rad: tools().next_back().map(heading),
            poses,
        }
    }
}
