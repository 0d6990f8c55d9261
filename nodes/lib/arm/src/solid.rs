//! Primitive solids, and the one edge at which they and their poses become parry's.

use nalgebra::{Isometry3, Vector3};
use parry3d_f64::math::{Pose, Rotation, Vector};
use parry3d_f64::shape::{Ball, Capsule, Cuboid, Cylinder, Shape};

/// A convex solid, centred in its own frame; cylinders and capsules along z, as in URDF.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Solid {
    /// Sphere.
    Ball {
        /// Metres.
        radius: f64,
    },
    /// Cuboid.
    Box {
        /// Half of each side, metres.
        half_extents: [f64; 3],
    },
    /// Flat-ended.
    Cylinder {
        /// Metres.
        radius: f64,
        /// Half of the height, metres.
        half_length: f64,
    },
    /// Cylinder with round ends, which stick out of `half_length` by the radius.
    Capsule {
        /// Metres.
        radius: f64,
        /// Half of the straight part, metres.
        half_length: f64,
    },
}

impl Solid {
    /// Radius of the smallest sphere about the centre that holds it, metres.
    pub fn bounding_radius(&self) -> f64 {
        match *self {
            Self::Ball { radius } => radius,
            Self::Box { half_extents } => Vector3::from(half_extents).norm(),
            Self::Cylinder { radius, half_length } => (radius * radius + half_length * half_length).sqrt(),
            Self::Capsule { radius, half_length } => radius + half_length,
        }
    }

    /// Distance from a point of the solid's frame to the solid, metres; zero inside.
    pub fn distance_to_point(&self, at: &Vector3<f64>) -> f64 {
        match *self {
            Self::Ball { radius } => (at.norm() - radius).max(0.0),
            Self::Box { half_extents: [x, y, z] } => {
                Vector3::new((at.x.abs() - x).max(0.0), (at.y.abs() - y).max(0.0), (at.z.abs() - z).max(0.0)).norm()
            }
            Self::Cylinder { radius, half_length } => {
                let radial = ((at.x * at.x + at.y * at.y).sqrt() - radius).max(0.0);
                let axial = (at.z.abs() - half_length).max(0.0);
                (radial * radial + axial * axial).sqrt()
            }
            Self::Capsule { radius, half_length } => {
                let axial = (at.z.abs() - half_length).max(0.0);
                ((at.x * at.x + at.y * at.y + axial * axial).sqrt() - radius).max(0.0)
            }
        }
    }
}

/// A parry shape; cylinders and capsules lie along its y.
#[derive(Debug, Clone)]
pub(crate) enum ParryShape {
    Ball(Ball),
    Cuboid(Cuboid),
    Cylinder(Cylinder),
    Capsule(Capsule),
}

impl ParryShape {
    pub fn as_shape(&self) -> &dyn Shape {
        match self {
            Self::Ball(shape) => shape,
            Self::Cuboid(shape) => shape,
            Self::Cylinder(shape) => shape,
            Self::Capsule(shape) => shape,
        }
    }
}

/// The same solid for parry, and the pose of parry's shape in the solid's frame.
pub(crate) fn to_parry(solid: &Solid) -> (ParryShape, Pose) {
    // A quarter turn about x takes parry's y to our z.
    let half = std::f64::consts::FRAC_1_SQRT_2;
    let z_from_y = Pose::from_parts(Vector::ZERO, Rotation::from_xyzw(half, 0.0, 0.0, half));
    match *solid {
        Solid::Ball { radius } => (ParryShape::Ball(Ball::new(radius)), Pose::IDENTITY),
        Solid::Box { half_extents: [x, y, z] } => {
            (ParryShape::Cuboid(Cuboid::new(Vector::new(x, y, z))), Pose::IDENTITY)
        }
        Solid::Cylinder { radius, half_length } => (ParryShape::Cylinder(Cylinder::new(half_length, radius)), z_from_y),
        Solid::Capsule { radius, half_length } => (ParryShape::Capsule(Capsule::new_y(half_length, radius)), z_from_y),
    }
}

/// The same pose for parry.
pub(crate) fn to_parry_pose(pose: &Isometry3<f64>) -> Pose {
    let (t, r) = (&pose.translation.vector, pose.rotation.coords);
    Pose::from_parts(Vector::new(t.x, t.y, t.z), Rotation::from_xyzw(r.x, r.y, r.z, r.w))
}
