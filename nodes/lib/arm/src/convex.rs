//! Convex solids as the narrow phase sees them, and the one question it asks: how far apart, if nearer than this?
//!
//! A solid is a core (a point, a segment, a box, a flat-ended cylinder, a hull) and what lies within a radius of it, so balls and
//! capsules cost as little as points and segments. The algorithm is parry's GJK (Gilbert, Johnson and Keerthi 1988) over support
//! functions of our own; all lie along z as in URDF.

use crate::hull::Hull;
use crate::{Solid, solid};
use nalgebra::{Isometry3, Vector3};
use parry3d_f64::bounding_volume::Aabb;
use parry3d_f64::math::{Pose, Rotation, Vector};
use parry3d_f64::query::gjk::{CsoPoint, GJKResult, VoronoiSimplex, closest_points};
use parry3d_f64::shape::SupportMap;
use std::sync::Arc;

/// A convex solid in its own frame.
#[derive(Debug, Clone)]
pub(crate) struct Convex {
    core: Core,
    /// Everything this near to the core belongs to the solid, metres.
    rounding: f64,
    /// Middle of a sphere that holds the solid.
    pub middle: Vector,
    /// Radius of that sphere, metres.
    pub radius: f64,
}

#[derive(Debug, Clone)]
enum Core {
    Point,
    Segment { half_length: f64 },
    Box { half_extents: Vector },
    Cylinder { radius: f64, half_length: f64 },
    Hull(Arc<Hull>),
}

impl Convex {
    /// The convex parts of a solid.
    pub fn parts(solid: &Solid) -> Vec<Self> {
        let about_origin =
            |core, rounding| Self { core, rounding, middle: Vector::ZERO, radius: solid.bounding_radius() };
        match *solid {
            Solid::Ball { radius } => vec![about_origin(Core::Point, radius)],
            Solid::Capsule { radius, half_length } => vec![about_origin(Core::Segment { half_length }, radius)],
            Solid::Box { half_extents } => {
                vec![about_origin(Core::Box { half_extents: Vector::from(half_extents) }, 0.0)]
            }
            Solid::Cylinder { radius, half_length } => {
                vec![about_origin(Core::Cylinder { radius, half_length }, 0.0)]
            }
            Solid::Hulls(ref hulls) => hulls
                .iter()
                .map(|hull| {
                    let (middle, radius) = solid::sphere_around(hull.corners());
                    let middle = Vector::new(middle.x, middle.y, middle.z);
                    Self { core: Core::Hull(Arc::clone(hull)), rounding: 0.0, middle, radius }
                })
                .collect(),
        }
    }

    /// Distance from a point of the solid's frame to the solid, metres; for a hull a lower bound. Zero inside.
    pub fn distance_to_point(&self, at: Vector) -> f64 {
        let to_core = match self.core {
            Core::Point => at.length(),
            Core::Segment { half_length } => Vector::new(at.x, at.y, (at.z.abs() - half_length).max(0.0)).length(),
            Core::Box { half_extents } => (at.abs() - half_extents).max(Vector::ZERO).length(),
            Core::Cylinder { radius, half_length } => {
                let radial = ((at.x * at.x + at.y * at.y).sqrt() - radius).max(0.0);
                let axial = (at.z.abs() - half_length).max(0.0);
                (radial * radial + axial * axial).sqrt()
            }
            Core::Hull(..) => (at - self.middle).length() - self.radius,
        };
        (to_core - self.rounding).max(0.0)
    }
}

impl Convex {
    /// The smallest box along the axes of a frame that holds the solid, placed in that frame.
    pub fn bounds(&self, pose: &Pose) -> Aabb {
        let farthest = |axis: Vector| {
            let along = pose.inverse_transform_vector(axis);
            pose.transform_point(self.local_support_point(along)).dot(axis) + self.rounding
        };
        let high = Vector::new(farthest(Vector::X), farthest(Vector::Y), farthest(Vector::Z));
        let low = -Vector::new(farthest(-Vector::X), farthest(-Vector::Y), farthest(-Vector::Z));
        Aabb::new(low, high)
    }
}

impl SupportMap for Convex {
    /// Of the core.
    fn local_support_point(&self, direction: Vector) -> Vector {
        match self.core {
            Core::Point => Vector::ZERO,
            Core::Segment { half_length } => Vector::new(0.0, 0.0, half_length.copysign(direction.z)),
            Core::Box { half_extents } => {
                let Vector { x, y, z } = half_extents;
                Vector::new(x.copysign(direction.x), y.copysign(direction.y), z.copysign(direction.z))
            }
            Core::Cylinder { radius, half_length } => {
                let across = (direction.x * direction.x + direction.y * direction.y).sqrt();
                let scale = if across > 0.0 { radius / across } else { 0.0 };
                Vector::new(direction.x * scale, direction.y * scale, half_length.copysign(direction.z))
            }
            Core::Hull(ref hull) => hull.farthest(direction),
        }
    }
}

/// A convex solid, placed.
#[derive(Clone, Copy)]
pub(crate) struct Posed<'a> {
    pub solid: &'a Convex,
    pub pose: Pose,
    /// The middle of its sphere, placed.
    pub middle: Vector,
}

impl<'a> Posed<'a> {
    pub fn new(solid: &'a Convex, pose: Pose) -> Self {
        Self { solid, pose, middle: pose.transform_point(solid.middle) }
    }

    /// Whether the spheres leave it open that the two are nearer than `limit`.
    pub fn may_be_within(&self, other: &Posed, limit: f64) -> bool {
        let far = self.solid.radius + other.solid.radius + limit;
        far >= 0.0 && (self.middle - other.middle).length_squared() <= far * far
    }

    /// Whether two are nearer than `limit` (at least 0), or touch.
    pub fn is_within(&self, other: &Posed, limit: f64) -> bool {
        self.may_be_within(other, limit) && {
            let reach = limit + self.solid.rounding + other.solid.rounding;
            match self.gjk(other, reach, false) {
                GJKResult::Intersection => true,
                GJKResult::NoIntersection(_) => false,
                // At a reach of 0 this is a touch without overlap.
                GJKResult::Proximity(_) | GJKResult::ClosestPoints(..) => reach > 0.0,
            }
        }
    }

    /// The distance of two, metres, 0 when they touch; `None` when it is certainly more than `limit`.
    pub fn distance_within(&self, other: &Posed, limit: f64) -> Option<f64> {
        if !self.may_be_within(other, limit) {
            return None;
        }
        let rounding = self.solid.rounding + other.solid.rounding;
        match self.gjk(other, limit + rounding, true) {
            GJKResult::Intersection => Some(0.0),
            GJKResult::NoIntersection(_) => None,
            GJKResult::ClosestPoints(a, b, _) => Some(((b - a).length() - rounding).max(0.0)),
            // It was asked for the exact distance; near is the safe answer.
            GJKResult::Proximity(_) => Some(0.0),
        }
    }

    fn gjk(&self, other: &Posed, reach: f64, exact: bool) -> GJKResult {
        let a_from_b = self.pose.inv_mul(&other.pose);
        let between = a_from_b.transform_point(other.solid.middle) - self.solid.middle;
        let direction = between.try_normalize().unwrap_or(Vector::X);
        let mut simplex = VoronoiSimplex::new();
        simplex.reset(CsoPoint::from_shapes(&a_from_b, self.solid, other.solid, direction));
        let result = closest_points(&a_from_b, self.solid, other.solid, reach, exact, &mut simplex);
        // That is also what it answers when it gives up; then the direction separates nothing.
        if result == GJKResult::NoIntersection(Vector::X) {
            let support = CsoPoint::from_shapes(&a_from_b, self.solid, other.solid, Vector::X);
            if -Vector::X.dot(support.point) <= reach {
                return GJKResult::Intersection;
            }
        }
        result
    }
}

/// The same pose for parry.
pub(crate) fn to_parry(pose: &Isometry3<f64>) -> Pose {
    let (t, r) = (&pose.translation.vector, pose.rotation.coords);
    Pose::from_parts(Vector::new(t.x, t.y, t.z), Rotation::from_xyzw(r.x, r.y, r.z, r.w))
}

/// The same vector for nalgebra.
pub(crate) fn to_nalgebra(v: Vector) -> Vector3<f64> {
    Vector3::new(v.x, v.y, v.z)
}
