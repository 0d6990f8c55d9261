//! From where the arm is to over the place, then straight down; every part checked in small steps.

use crate::access::Access;
use crate::manipulator::Cell;
use crate::rrt;
use crate::settings::{JOINT_STEP, LEAST_APPROACH_M, TOOL_STEP_M};
use arm::{IkOutcome, IkSettings, Isometry3, solve};
use scene::Point;

/// A joint may change by no more than this while the tool goes down by one step: else the arm would have to turn over.
const LARGEST_CHANGE: f64 = 0.2;

/// An edge that would take more checks counts as blocked: no arm that fits a table needs one.
const MOST_STEPS: f64 = 10_000.0;

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
        let mut poses = Vec::new();
        let mut edge = |a: &[f64], b: &[f64]| edge_is_free(&access.cell, a, b, &mut poses);
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
    let mut poses = Vec::new();
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
        if change > LARGEST_CHANGE || !edge_is_free(cell, last, &next, &mut poses) {
            break;
        }
        path.push(next);
    }
    let reached_m = settings.approach_m * (path.len() - 1) as f64 / n as f64;
    (reached_m >= LEAST_APPROACH_M.min(settings.approach_m)).then_some(path)
}

/// Whether nothing touches on the straight edge between two configurations: checked so often that no joint and not the
/// tool moves farther in between than the steps of the settings. Halves first, for most collisions are found early so.
pub(crate) fn edge_is_free(cell: &Cell, a: &[f64], b: &[f64], poses: &mut Vec<Isometry3<f64>>) -> bool {
    let chain = &cell.manipulator.chain;
    let change = |entry: usize| (b[entry] - a[entry]).abs();
    let largest = chain.entries.iter().map(|&entry| change(entry)).fold(0.0, f64::max);
    let tool_m: f64 = chain.entries.iter().zip(&chain.levers).map(|(&entry, lever)| change(entry) * lever).sum();
    let n = (largest / JOINT_STEP).max(tool_m / TOOL_STEP_M).ceil().max(1.0);
    if n > MOST_STEPS {
        return false;
    }
    let n = n as usize;
    let mut q = a.to_vec();
    let mut free_at = |i: usize| {
        let share = i as f64 / n as f64;
        for ((q, a), b) in q.iter_mut().zip(a).zip(b) {
            *q = a + (b - a) * share;
        }
        cell.is_free(&q, poses)
    };
    if !free_at(0) || !free_at(n) {
        return false;
    }
    let mut stride = n.next_power_of_two();
    while stride > 1 {
        let half = stride / 2;
        let mut i = half;
        while i < n {
            if !free_at(i) {
                return false;
            }
            i += stride;
        }
        stride = half;
    }
    true
}
