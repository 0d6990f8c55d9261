//! The placement that is best under a reward, and the one that is wrong by the least when it is wrong: arg min of the
//! conditional value at risk of the distance to each draw's own best placement.

use crate::tail::cvar;
use scene::Point;

/// Steps of the refinement, as shares of a cell.
const SHARES: [f64; 5] = [0.5, 0.25, 0.125, 0.0625, 0.03125];
const MOVES_PER_SHARE: usize = 8;

/// CVaR_α of the distance from a point to each draw's best placement, metres.
pub(crate) fn cvar_m(at_m: Point, optima_m: &[Point], alpha: f64, room: &mut Vec<f64>) -> f64 {
    room.clear();
    room.extend(optima_m.iter().map(|x| x.distance(at_m)));
    cvar(room, alpha)
}

/// Where a search for the most cautious placement may start, and how good each start is.
pub(crate) struct Ranked {
    pub at_m: Point,
    pub cvar_m: f64,
}

/// Candidates by CVaR, best first; the first of equals stays first.
pub(crate) fn rank(candidates: impl Iterator<Item = Point>, optima_m: &[Point], alpha: f64) -> Vec<Ranked> {
    let mut room = Vec::with_capacity(optima_m.len());
    let mut ranked: Vec<Ranked> =
        candidates.map(|at_m| Ranked { at_m, cvar_m: cvar_m(at_m, optima_m, alpha, &mut room) }).collect();
    ranked.sort_by(|a, b| a.cvar_m.total_cmp(&b.cvar_m));
    ranked
}

/// Betters a placement by moves in eight directions, shorter and shorter, that stay usable. The objective is convex in
/// the placement, so only the boundary of what is usable can stop it early.
pub(crate) fn refine(
    start: Ranked,
    optima_m: &[Point],
    alpha: f64,
    cell_m: Point,
    mut usable: impl FnMut(Point) -> bool,
) -> Ranked {
    const AROUND: [(f64, f64); 8] =
        [(1.0, 0.0), (0.0, 1.0), (-1.0, 0.0), (0.0, -1.0), (1.0, 1.0), (-1.0, 1.0), (-1.0, -1.0), (1.0, -1.0)];
    let mut room = Vec::with_capacity(optima_m.len());
    let mut best = start;
    for share in SHARES {
        for _ in 0..MOVES_PER_SHARE {
            let steps = AROUND
                .iter()
                .map(|&(dx, dy)| Point::new(best.at_m.x + share * dx * cell_m.x, best.at_m.y + share * dy * cell_m.y));
            let better =
                rank(steps, optima_m, alpha).into_iter().find(|step| step.cvar_m < best.cvar_m && usable(step.at_m));
            let Some(step) = better else { break };
            best = step;
        }
    }
    best.cvar_m = cvar_m(best.at_m, optima_m, alpha, &mut room);
    best
}
