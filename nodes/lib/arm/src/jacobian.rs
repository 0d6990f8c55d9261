//! How the tool moves when joints do.

use crate::{Chain, JointKind, Robot};
use nalgebra::{Isometry3, Vector3};

/// What one joint of a chain does to the tool, per radian or metre, in the root frame.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct JacobianColumn {
    /// Of the tool's origin.
    pub linear: Vector3<f64>,
    /// Of the tool's frame.
    pub angular: Vector3<f64>,
}

/// The geometric Jacobian of the tool, one column per entry of the chain, from the poses of
/// [`Robot::link_poses`]. Joints that mimic add to the column of their leader.
pub fn jacobian(robot: &Robot, chain: &Chain, poses: &[Isometry3<f64>], columns: &mut Vec<JacobianColumn>) {
    columns.clear();
    columns.resize(chain.entries.len(), JacobianColumn::default());
    let tool = poses[chain.tool].translation.vector;
    for &(j, place, factor) in &chain.moves {
        let joint = &robot.joints[j];
        // The motion leaves its own axis and origin where they are, so the child's pose will do for revolute joints.
        let child = &poses[joint.child];
        let axis = child.rotation * joint.axis.into_inner() * factor;
        let column = &mut columns[place];
        if joint.kind == JointKind::Prismatic {
            column.linear += axis;
        } else {
            column.linear += axis.cross(&(tool - child.translation.vector));
            column.angular += axis;
        }
    }
}
