//! Where a tool is to be, and how far it is from there.

use crate::JacobianColumn;
use nalgebra::{Isometry3, Unit, UnitQuaternion, Vector3, Vector6};

/// Where the tool is to be, in the root frame.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Goal {
    /// Its whole pose.
    Pose(Isometry3<f64>),
    /// Its origin and where its z axis points, the turn about that axis left free.
    Axis(AxisGoal),
    /// Its origin.
    Position(Vector3<f64>),
}

/// A position and a direction.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct AxisGoal {
    /// Of the tool's origin, metres.
    pub position: Vector3<f64>,
    /// Where the tool's z axis is to point.
    pub direction: Unit<Vector3<f64>>,
}

/// Errors of the direction count as if the tool were a lever of this length, metres.
pub(crate) const LEVER: f64 = 0.3;

/// What is missing to a goal.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Miss {
    /// Three of position, three of rotation weighted by the lever; zero where the goal does not care.
    pub rows: Vector6<f64>,
    /// Metres.
    pub position: f64,
    /// Radians.
    pub angle: f64,
}

/// A goal, ready to be compared with.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Target {
    goal: Goal,
    /// Two unit vectors across the direction of an axis goal.
    across: [Vector3<f64>; 2],
}

impl Target {
    pub fn new(goal: &Goal) -> Self {
        let across = match goal {
            Goal::Axis(goal) => across(&goal.direction),
            _ => [Vector3::zeros(); 2],
        };
        Self { goal: *goal, across }
    }

    pub fn position(&self) -> Vector3<f64> {
        match &self.goal {
            Goal::Pose(pose) => pose.translation.vector,
            Goal::Axis(goal) => goal.position,
            Goal::Position(position) => *position,
        }
    }

    /// What is missing when the tool is at a pose.
    pub fn miss(&self, tool: &Isometry3<f64>) -> Miss {
        let position = self.position() - tool.translation.vector;
        let (turn, angle) = match &self.goal {
            Goal::Pose(pose) => {
                let turn = rotation_vector(&(pose.rotation * tool.rotation.inverse()));
                (turn * LEVER, turn.norm())
            }
            Goal::Axis(goal) => {
                let z = tool.rotation * Vector3::z();
                let turn = z.cross(&goal.direction);
                let angle = libm::atan2(turn.norm(), z.dot(&goal.direction));
                // The turn that is needed lies across the goal's direction; pointing the other way, any will do.
                let turn = match turn.norm() {
                    norm if norm > 1e-12 => turn * (angle / norm),
                    _ => self.across[0] * angle,
                };
                (self.rotation_rows(&turn), angle)
            }
            Goal::Position(_) => (Vector3::zeros(), 0.0),
        };
        let rows = Vector6::new(position.x, position.y, position.z, turn.x, turn.y, turn.z);
        Miss { rows, position: position.norm(), angle }
    }

    /// What a joint does to the rows of a miss, per radian or metre.
    pub fn row(&self, column: &JacobianColumn) -> Vector6<f64> {
        let (v, w) = (&column.linear, self.rotation_rows(&column.angular));
        Vector6::new(v.x, v.y, v.z, w.x, w.y, w.z)
    }

    fn rotation_rows(&self, turn: &Vector3<f64>) -> Vector3<f64> {
        match self.goal {
            Goal::Pose(_) => turn * LEVER,
            Goal::Axis(_) => Vector3::new(turn.dot(&self.across[0]), turn.dot(&self.across[1]), 0.0) * LEVER,
            Goal::Position(_) => Vector3::zeros(),
        }
    }
}

/// Two unit vectors that span the plane across a direction.
fn across(direction: &Unit<Vector3<f64>>) -> [Vector3<f64>; 2] {
    let aside = if direction.x.abs() < 0.9 { Vector3::x() } else { Vector3::y() };
    let first = direction.cross(&aside).normalize();
    [first, direction.cross(&first)]
}

/// Axis times angle, the angle in [0, π].
fn rotation_vector(rotation: &UnitQuaternion<f64>) -> Vector3<f64> {
    let (imaginary, real) = (rotation.imag(), rotation.scalar());
    let sin = imaginary.norm();
    if sin < 1e-12 {
        return imaginary * (2.0 * real.signum());
    }
    let angle = 2.0 * libm::atan2(sin, real.abs());
    imaginary * (real.signum() * angle / sin)
}
