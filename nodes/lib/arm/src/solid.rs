//! Solids: the primitives of URDF, and convex pieces of a mesh.

use crate::hull::Hull;
use nalgebra::Vector3;
use std::sync::Arc;

/// A solid in its own frame; primitives are centred, cylinders and capsules along z, as in URDF.
#[derive(Debug, Clone, PartialEq)]
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
    /// The union of convex pieces; shared, so that copies cost nothing. At least one.
    Hulls(Vec<Arc<Hull>>),
}

impl Solid {
    /// Radius of a sphere about the origin that holds it, metres.
    pub fn bounding_radius(&self) -> f64 {
        match *self {
            Self::Ball { radius } => radius,
            Self::Box { half_extents } => Vector3::from(half_extents).norm(),
            Self::Cylinder { radius, half_length } => (radius * radius + half_length * half_length).sqrt(),
            Self::Capsule { radius, half_length } => radius + half_length,
            Self::Hulls(ref hulls) => {
                hulls.iter().flat_map(|hull| hull.corners()).map(|c| c.norm_squared()).fold(0.0, f64::max).sqrt()
            }
        }
    }

    /// Smallest and largest coordinates.
    pub fn bounds(&self) -> (Vector3<f64>, Vector3<f64>) {
        let half = match *self {
            Self::Ball { radius } => Vector3::repeat(radius),
            Self::Box { half_extents } => Vector3::from(half_extents),
            Self::Cylinder { radius, half_length } => Vector3::new(radius, radius, half_length),
            Self::Capsule { radius, half_length } => Vector3::new(radius, radius, half_length + radius),
            Self::Hulls(ref hulls) => return bounds_of(hulls.iter().flat_map(|hull| hull.corners())),
        };
        (-half, half)
    }
}

fn bounds_of(points: impl Iterator<Item = Vector3<f64>>) -> (Vector3<f64>, Vector3<f64>) {
    let nothing = (Vector3::repeat(f64::INFINITY), Vector3::repeat(f64::NEG_INFINITY));
    points.fold(nothing, |(low, high), p| (low.inf(&p), high.sup(&p)))
}

/// Middle and radius of a sphere that holds points: about the middle of the box around them.
pub(crate) fn sphere_around(points: impl ExactSizeIterator<Item = Vector3<f64>> + Clone) -> (Vector3<f64>, f64) {
    let (low, high) = bounds_of(points.clone());
    let middle = 0.5 * (low + high);
    // A hair more, for the rounding of what is computed with it.
    (middle, (1.0 + 1e-12) * points.map(|p| (p - middle).norm_squared()).fold(0.0, f64::max).sqrt())
}
