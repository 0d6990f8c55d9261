//! A shape for a link whose mesh is not there: a box around what the description tells of the link otherwise.

use crate::{Placed, Solid};
use nalgebra::{Isometry3, Matrix3, Translation3, Vector3};

/// The box is this much larger than what it is around, metres.
const PADDING: f64 = 0.03;

/// A box around the link's frame, the joints that hang on it, and a uniform block of the link's inertia. A guess.
pub(crate) fn around(inertial: &urdf_rs::Inertial, origin: &Isometry3<f64>, joints: &[Vector3<f64>]) -> Placed {
    let mut low = Vector3::zeros();
    let mut high = Vector3::zeros();
    let mut cover = |p: &Vector3<f64>| {
        low = low.inf(p);
        high = high.sup(p);
    };
    joints.iter().for_each(&mut cover);
    if let Some(half) = uniform_block(inertial) {
        for i in 0..8 {
            let sign = |bit: usize| if i >> bit & 1 == 0 { -1.0 } else { 1.0 };
            let corner = Vector3::new(sign(0) * half.x, sign(1) * half.y, sign(2) * half.z);
            cover(&(origin * nalgebra::Point3::from(corner)).coords);
        }
    }
    let half = 0.5 * (high - low) + Vector3::repeat(PADDING);
    let middle = Translation3::from(0.5 * (low + high));
    Placed { solid: Solid::Box { half_extents: half.into() }, owner_from_solid: middle.into() }
}

/// Half extents of the block, along the axes of the inertial frame: of the sides a, b, c, I_xx = m (b² + c²) / 12.
fn uniform_block(inertial: &urdf_rs::Inertial) -> Option<Vector3<f64>> {
    let (mass, i) = (inertial.mass.value, &inertial.inertia);
    let tensor = Matrix3::new(i.ixx, i.ixy, i.ixz, i.ixy, i.iyy, i.iyz, i.ixz, i.iyz, i.izz);
    if !(mass > 1e-6 && mass < 1e4 && tensor.iter().all(|v| v.is_finite())) {
        return None;
    }
    let diagonal = tensor.diagonal();
    let squares = (Vector3::repeat(0.5 * diagonal.sum()) - diagonal) * (12.0 / mass);
    let half = squares.map(|square| 0.5 * square.max(0.0).sqrt());
    // Made-up inertias are common; a link of more than two metres is none of an arm.
    (half.max() < 1.0).then_some(half)
}
