//! The way of the hand along a plan's trajectory.

use crate::convert;
use apprentice_msgs::msg::PlacementPlan;
use placement::Manipulator;

/// Empty without a trajectory.
#[derive(Debug, Clone, Default)]
pub(crate) struct Way {
    /// The tool's origin at every point of the trajectory, in the table's frame, metres.
    pub(crate) points_m: Vec<[f64; 3]>,
    /// How what it holds is turned about the vertical in the end, radians: a held thing's x axis is the tool's.
    pub(crate) heading_rad: Option<f64>,
}

impl Way {
    /// Of a plan for this arm.
    pub(crate) fn new(arm: &Manipulator, plan: &PlacementPlan) -> Self {
        let Ok(start) = convert::joints(&plan.start) else { return Self::default() };
        let points = plan.trajectory.points.iter().map(|point| &point.positions[..]);
        let tools = arm.tool_poses(&plan.scene.header.frame_id, &start, &plan.trajectory.joint_names, points);
        let tools = tools.unwrap_or_default();
        let heading = |tool: &arm::Isometry3<f64>| {
            let x_axis = tool.rotation * arm::Vector3::x();
            x_axis.y.atan2(x_axis.x)
        };
        Self {
            points_m: tools.iter().map(|tool| tool.translation.vector.into()).collect(),
            heading_rad: tools.last().map(heading),
        }
    }
}
