//! From where the arm is to over the place, then straight down; every part proven free.

use crate::access::Access;
use crate::rrt;
use crate::settings::{LEAST_APPROACH_M, TOOL_STEP_M};
use arm::{IkOutcome, IkSettings, solve};
use scene::Point;

/// A joint may change by no more than this while the tool goes down by one step: else the arm would have to turn over.
const LARGEST_CHANGE: f64 = 0.2;

/// Configurations joined by straight edges in joint space.
pub(crate) struct Motion {
    /// From where the arm is to above the place.
    pub over: Vec<Vec<f64>>,
    /// From above the place down to it.
    pub down: Vec<Vec<f64>>,
}

/// Plans a motion that ends with the target at a point; `None` when no free one was found.
pub(crate) fn plan(access: &Access, current: &[f64], at_m: Point) -> Option<Motion> {
    let near = access.near(at_m, current);
    let other = access.configuration(at_m);
    [near, other].into_iter().flatten().find_map(|place| {
        let mut down = lift(access, &place, at_m)?;
        down.reverse();
        let mut checker = access.cell.manipulator.checker();
        let mut edge = |a: &[f64], b: &[f64]| access.cell.way_is_free(a, b, &mut checker);
        let over = rrt::connect(access.cell.manipulator, current, &down[0], &mut edge)?;
        Some(Motion { over, down })
    })
}

/// Straight up from a place in steps of the tool, as far as the settings ask or the arm reaches; `None` when that is not
/// far enough to come from above.
fn lift(access: &Access, place: &[f64], at_m: Point) -> Option<Vec<Vec<f64>>> {
    let cell = &access.cell;
    let settings = &cell.manipulator.settings;
    let base_m = access.base_m(at_m);
    let ik = IkSettings { restarts: 0, seed: settings.seed, ..IkSettings::default() };
    let mut checker = cell.manipulator.checker();
    let mut path = vec![place.to_vec()];
    let n = (settings.approach_m / TOOL_STEP_M).ceil().max(1.0) as usize;
    for i in 1..=n {
        let height_m = settings.approach_m * i as f64 / n as f64;
        let last = path.last().expect("it starts with the place");
        let goal = cell.goal(at_m, base_m + height_m);
        let manipulator = cell.manipulator;
        let next = match solve(&manipulator.robot, &manipulator.chain, &goal, last, &ik, |_| true) {
            IkOutcome::Solved(next) => next,
            _ => break,
        };
        let change = last.iter().zip(&next).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        if change > LARGEST_CHANGE || !cell.way_is_free(last, &next, &mut checker) {
            break;
        }
        path.push(next);
    }
    let reached_m = settings.approach_m * (path.len() - 1) as f64 / n as f64;
    (reached_m >= LEAST_APPROACH_M.min(settings.approach_m)).then_some(path)
}
