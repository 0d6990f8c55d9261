//! From a free point to the top of its hill within the free region: Newton's method with an active set, so that a top
//! beyond an edge or an object ends on the boundary, at the best point there.

use crate::Point;
use crate::hill::{Basis, Derivatives};
use crate::region::{Outline, Region};

const STEPS: usize = 24;
const HALVINGS: usize = 8;
/// After a Newton step this short the rest of the error is of its square, metres: less than a micrometre.
const LAST_M: f64 = 1e-4;
/// Other steps end the climb when they get this short, metres.
const SHORT_M: f64 = 1e-7;

/// A step to try.
struct Step {
    by: Point,
    /// It solves the quadratic model without a bound in its way.
    newton: bool,
}

/// Climbs wᵀφ from `start`, with steps no longer than `reach_m`; returns the top. Metres. Never ends below where it started.
pub fn climb(basis: &Basis, region: &Region, w: &[f64], start: Point, reach_m: f64) -> Point {
    let Some((mut at, mut on)) = region.pull(start) else { return start };
    let mut d = basis.derivatives(w, at);
    for _ in 0..STEPS {
        let Some(step) = direction(&d, region, at, on, reach_m) else { break };
        let length = (step.by.x * step.by.x + step.by.y * step.by.y).sqrt();
        let mut by = step.by;
        let mut taken = None;
        for _ in 0..HALVINGS {
            if let Some((next, next_on)) = region.pull(Point::new(at.x + by.x, at.y + by.y)) {
                if step.newton && length < LAST_M {
                    return next;
                }
                let there = basis.derivatives(w, next);
                if there[0] > d[0] {
                    taken = Some((next, next_on, there));
                    break;
                }
            }
            by = Point::new(0.25 * by.x, 0.25 * by.y);
        }
        let Some((next, next_on, there)) = taken else { break };
        let moved = next.distance(at);
        (at, on, d) = (next, next_on, there);
        if moved < SHORT_M {
            break;
        }
    }
    at
}

/// Where to go from a point: `None` when the boundary leaves no way up.
fn direction(d: &Derivatives, region: &Region, at: Point, on: Option<Outline>, reach_m: f64) -> Option<Step> {
    let [_, gx, gy, hxx, hxy, hyy] = *d;
    if let Some(Outline { normal, curvature }) = on {
        let push = gx * normal.x + gy * normal.y;
        if push < 0.0 {
            let t = Point::new(-normal.y, normal.x);
            let slope = gx * t.x + gy * t.y;
            // Along the outline, which bends away from the object's normal.
            let bend = hxx * t.x * t.x + 2.0 * hxy * t.x * t.y + hyy * t.y * t.y - push * curvature;
            let (s, newton) = along(slope, bend, reach_m)?;
            // Towards the object as the outline bends, and a little beyond: the region puts the point back onto it.
            let inward = 0.5 * curvature * s * s;
            return Some(Step { by: Point::new(s * t.x - inward * normal.x, s * t.y - inward * normal.y), newton });
        }
    }
    let held_x = (at.x <= region.low.x && gx < 0.0) || (at.x >= region.high.x && gx > 0.0);
    let held_y = (at.y <= region.low.y && gy < 0.0) || (at.y >= region.high.y && gy > 0.0);
    match (held_x, held_y) {
        (true, true) => None,
        (true, false) => along(gy, hyy, reach_m).map(|(by, newton)| Step { by: Point::new(0.0, by), newton }),
        (false, true) => along(gx, hxx, reach_m).map(|(by, newton)| Step { by: Point::new(by, 0.0), newton }),
        (false, false) => {
            let det = hxx * hyy - hxy * hxy;
            let concave = hxx < 0.0 && det > 0.0;
            let by = if concave {
                Point::new((hxy * gy - hyy * gx) / det, (hxy * gx - hxx * gy) / det)
            } else {
                let slope = (gx * gx + gy * gy).sqrt();
                if slope.is_nan() || slope <= 0.0 {
                    return None;
                }
                Point::new(gx / slope * reach_m, gy / slope * reach_m)
            };
            let length = (by.x * by.x + by.y * by.y).sqrt();
            if length > reach_m {
                let shrink = reach_m / length;
                return Some(Step { by: Point::new(by.x * shrink, by.y * shrink), newton: false });
            }
            Some(Step { by, newton: concave })
        }
    }
}

/// The same in one dimension: how far, and whether that is a whole Newton step.
fn along(slope: f64, bend: f64, reach_m: f64) -> Option<(f64, bool)> {
    if slope.is_nan() || slope == 0.0 {
        return None;
    }
    if bend < 0.0 && (slope / bend).abs() <= reach_m {
        return Some((-slope / bend, true));
    }
    Some((reach_m.copysign(slope), false))
}
