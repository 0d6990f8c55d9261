//! Where the target's centre may be, as a region with a boundary one can slide along: a rectangle without the offset
//! outlines of the objects. The same region as [`crate::Occupied`], which only says yes or no.

use crate::{Point, Scene, Shape};

/// A point is put this far outside an outline, so that it is free in spite of rounding, metres.
const OUTSIDE_M: f64 = 1e-9;
/// A point this near to an outline is on it, metres.
const ON_M: f64 = 1e-7;

/// The free region of a scene.
#[derive(Debug, Clone)]
pub struct Region {
    pub(crate) low: Point,
    pub(crate) high: Point,
    /// Radius of the target's bounding circle: its centre keeps that far from every block.
    margin_m: f64,
    blocks: Vec<Block>,
}

#[derive(Debug, Clone)]
struct Block {
    centre: Point,
    /// Half extents of the footprint in its own frame, and the radius around it: (0, 0), r for a disc.
    half: Point,
    radius_m: f64,
    sin: f64,
    cos: f64,
}

/// The outline that a point is on.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Outline {
    /// Unit normal, away from the object.
    pub normal: Point,
    /// 1 / radius there, 1/m; 0 where it is straight.
    pub curvature: f64,
}

impl Region {
    /// The free region of a scene, for its target.
    pub fn new(scene: &Scene) -> Self {
        let margin_m = scene.target.shape.bounding_radius_m();
        let blocks = scene.objects.iter().filter(|object| !object.supports).map(|object| {
            let (half, radius_m) = match object.shape {
                Shape::Cylinder { radius_m, .. } => (Point::default(), radius_m),
                Shape::Box { width_m, depth_m, .. } => (Point::new(0.5 * width_m, 0.5 * depth_m), 0.0),
            };
            let (sin, cos) = libm::sincos(object.yaw_rad);
            Block { centre: object.position_m, half, radius_m, sin, cos }
        });
        Self {
            low: Point::new(margin_m, margin_m),
            high: Point::new(scene.width_m - margin_m, scene.depth_m - margin_m),
            margin_m,
            blocks: blocks.collect(),
        }
    }

    /// Whether no point within `radius_m` of another is free.
    pub(crate) fn is_blocked_around(&self, at_m: Point, radius_m: f64) -> bool {
        self.blocks.iter().any(|block| block.distance(at_m) + radius_m < self.margin_m)
    }

    /// The point of the region that a step to `at` ends on: clamped to the rectangle, and put back onto an outline it has
    /// crossed. `None` when it then meets something else.
    pub(crate) fn pull(&self, at: Point) -> Option<(Point, Option<Outline>)> {
        let at = self.clamp(at);
        match self.at(at) {
            Place::Free(outline) => Some((at, outline)),
            Place::Inside(None) => None,
            Place::Inside(Some(push)) => {
                let at = self.clamp(Point::new(at.x + push.x, at.y + push.y));
                match self.at(at) {
                    Place::Free(outline) => Some((at, outline)),
                    Place::Inside(_) => None,
                }
            }
        }
    }

    fn clamp(&self, at: Point) -> Point {
        Point::new(at.x.max(self.low.x).min(self.high.x), at.y.max(self.low.y).min(self.high.y))
    }

    /// A point of the rectangle against the objects.
    fn at(&self, at: Point) -> Place {
        let mut on = None;
        for block in &self.blocks {
            let Some((distance, normal, curvature)) = block.outline(at) else { return Place::Inside(None) };
            let missing = self.margin_m - distance;
            if missing > 0.0 {
                let push = missing + OUTSIDE_M;
                return Place::Inside(Some(Point::new(push * normal.x, push * normal.y)));
            }
            if missing > -ON_M {
                on = Some(Outline { normal, curvature });
            }
        }
        Place::Free(on)
    }
}

enum Place {
    /// On an outline or not.
    Free(Option<Outline>),
    /// Too near to an object; the push that takes it back to the outline, if there is one.
    Inside(Option<Point>),
}

impl Block {
    /// Distance from the footprint, metres; 0 or less inside.
    fn distance(&self, at: Point) -> f64 {
        self.outline(at).map_or(-self.radius_m, |(distance, ..)| distance)
    }

    /// Distance from the footprint, the direction away from it, and the curvature of the outline through the point.
    fn outline(&self, at: Point) -> Option<(f64, Point, f64)> {
        let (dx, dy) = (at.x - self.centre.x, at.y - self.centre.y);
        let own = Point::new(self.cos * dx + self.sin * dy, self.cos * dy - self.sin * dx);
        let out = Point::new(
            (own.x.abs() - self.half.x).max(0.0).copysign(own.x),
            (own.y.abs() - self.half.y).max(0.0).copysign(own.y),
        );
        let length = (out.x * out.x + out.y * out.y).sqrt();
        if length == 0.0 {
            return None;
        }
        let n = Point::new(out.x / length, out.y / length);
        let normal = Point::new(self.cos * n.x - self.sin * n.y, self.sin * n.x + self.cos * n.y);
        let round = (self.half.x == 0.0 && self.half.y == 0.0) || (out.x != 0.0 && out.y != 0.0);
        Some((length - self.radius_m, normal, if round { 1.0 / length } else { 0.0 }))
    }
}
