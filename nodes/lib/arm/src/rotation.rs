//! Rotations built from angles with the same bits on every machine: sines and cosines come from `libm`.

use nalgebra::{Quaternion, Unit, UnitQuaternion, Vector3};

/// Rotation by `angle` radians about a unit axis.
pub fn about_axis(axis: &Unit<Vector3<f64>>, angle: f64) -> UnitQuaternion<f64> {
    let (sin, cos) = libm::sincos(0.5 * angle);
    UnitQuaternion::new_unchecked(Quaternion::new(cos, axis.x * sin, axis.y * sin, axis.z * sin))
}

/// Rotation by `angle` radians about the vertical.
pub fn about_z(angle: f64) -> UnitQuaternion<f64> {
    about_axis(&Vector3::z_axis(), angle)
}

/// The URDF convention: roll about x, then pitch about y, then yaw about z, all of the fixed (parent) frame.
pub fn from_rpy([roll, pitch, yaw]: [f64; 3]) -> UnitQuaternion<f64> {
    about_z(yaw) * about_axis(&Vector3::y_axis(), pitch) * about_axis(&Vector3::x_axis(), roll)
}
