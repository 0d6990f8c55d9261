//! How the tool moves when joints do.

use crate::MAX_CHAIN_JOINTS;
use nalgebra::{Matrix6, SMatrix, Vector3, Vector6};

/// What one joint of a chain does to the tool, per radian or metre, in the root frame.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct JacobianColumn {
    /// Of the tool's origin.
    pub linear: Vector3<f64>,
    /// Of the tool's frame.
    pub angular: Vector3<f64>,
}

impl JacobianColumn {
    /// Linear part first.
    pub fn stacked(&self) -> Vector6<f64> {
        let (v, w) = (&self.linear, &self.angular);
        Vector6::new(v.x, v.y, v.z, w.x, w.y, w.z)
    }
}

/// √det(J Jᵀ) of the columns of [`crate::Chain::linearise`] (Yoshikawa 1985): 0 at a singularity. With fewer than six joints
/// √det(Jᵀ J), which is 0 where two joints do the same. Metres and radians mix, so compare values of one robot only.
pub fn manipulability(columns: &[JacobianColumn]) -> f64 {
    let square = if columns.len() >= 6 {
        let mut square = Matrix6::zeros();
        for column in columns {
            let column = column.stacked();
            square += column * column.transpose();
        }
        square.determinant()
    } else {
        let mut square = SMatrix::<f64, 5, 5>::identity();
        for (i, a) in columns.iter().enumerate() {
            for (j, b) in columns.iter().enumerate() {
                square[(i, j)] = a.stacked().dot(&b.stacked());
            }
        }
        square.determinant()
    };
    square.max(0.0).sqrt()
}

/// J J' of at most [`MAX_CHAIN_JOINTS`] columns needs no heap; this is the room for one value a joint.
pub(crate) type PerJoint = [f64; MAX_CHAIN_JOINTS];
