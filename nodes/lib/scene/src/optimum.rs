//! Where a reward puts the target: the best free grid point, then Newton steps to the top of its hill.

use crate::{Field, Point, Rbf, Scene};

const NEWTON_STEPS: usize = 12;
/// Steps shorter than this, in normalised coordinates, end the refinement.
const TOLERANCE: f64 = 1e-10;

/// The best placement under one reward.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Optimum {
    /// Normalised coordinates.
    pub at: Point,
    /// R there.
    pub reward: f64,
}

/// The free placement of largest reward: argmax over the field's free grid points (first of equals), refined by Newton
/// steps that stay free and never lose reward. `None` when no grid point is free.
///
/// `scratch` is resized to the grid and overwritten.
pub fn best_placement(scene: &Scene, rbf: &Rbf, field: &Field, w: &[f64], scratch: &mut Vec<f64>) -> Option<Optimum> {
    scratch.resize(field.grid().n(), 0.0);
    field.rewards(w, scratch);
    let mut best: Option<(usize, f64)> = None;
    for (i, (&reward, &free)) in scratch.iter().zip(field.free()).enumerate() {
        if free && best.is_none_or(|(_, top)| reward > top) {
            best = Some((i, reward));
        }
    }
    let (index, _) = best?;
    let occupied = scene.occupied();
    Some(refine(rbf, w, field.grid().at(index), 1.0 / field.side() as f64, |at| occupied.is_free(scene.metres(at))))
}

/// Climbs from `start` to the top of its hill: Newton steps where the Hessian is negative definite, else gradient steps,
/// none longer than `reach` (normalised). Where the whole step leaves the free area or loses reward, the best of its
/// halvings and of steps along one axis is taken; the latter slide along the table's edges.
pub fn refine(rbf: &Rbf, w: &[f64], start: Point, reach: f64, is_free: impl Fn(Point) -> bool) -> Optimum {
    let mut at = start;
    let mut d = rbf.derivatives(w, at);
    for _ in 0..NEWTON_STEPS {
        let steps = directions(&d, reach);
        let whole = Point::new(at.x + steps[0].x, at.y + steps[0].y);
        let there = rbf.derivatives(w, whole);
        if there[0] > d[0] && is_free(whole) {
            (at, d) = (whole, there);
            continue;
        }
        let tried = steps.iter().filter_map(|&step| line_search(rbf, w, at, d[0], step, &is_free));
        let Some(best) = tried.reduce(|a, b| if b.1[0] > a.1[0] { b } else { a }) else { break };
        (at, d) = best;
    }
    Optimum { at, reward: d[0] }
}

/// Uphill steps to try, best first: in the plane, along x, along y.
fn directions(d: &[f64; 6], reach: f64) -> [Point; 3] {
    let [_, gx, gy, hxx, hxy, hyy] = *d;
    let det = hxx * hyy - hxy * hxy;
    let slope = (gx * gx + gy * gy).sqrt();
    let plane = if hxx < 0.0 && det > 0.0 {
        Point::new((hxy * gy - hyy * gx) / det, (hxy * gx - hxx * gy) / det)
    } else if slope > 0.0 {
        Point::new(gx / slope * reach, gy / slope * reach)
    } else {
        Point::default()
    };
    let length = plane.distance(Point::default());
    let shrink = if length > reach { reach / length } else { 1.0 };
    let axis = |g: f64, h: f64| if h < 0.0 { (-g / h).clamp(-reach, reach) } else { reach.copysign(g) };
    [Point::new(plane.x * shrink, plane.y * shrink), Point::new(axis(gx, hxx), 0.0), Point::new(0.0, axis(gy, hyy))]
}

/// Halves a step until it ends on a free point of larger reward.
fn line_search(
    rbf: &Rbf,
    w: &[f64],
    at: Point,
    reward: f64,
    mut step: Point,
    is_free: impl Fn(Point) -> bool,
) -> Option<(Point, [f64; 6])> {
    while step.x * step.x + step.y * step.y > TOLERANCE * TOLERANCE {
        let next = Point::new(at.x + step.x, at.y + step.y);
        if is_free(next) {
            let there = rbf.derivatives(w, next);
            if there[0] > reward {
                return Some((next, there));
            }
        }
        step = Point::new(0.5 * step.x, 0.5 * step.y);
    }
    None
}
