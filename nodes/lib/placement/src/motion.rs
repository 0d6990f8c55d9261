//! From where the arm is to over the place, then straight down; every part proven free.

use crate::access::Access;
use crate::settings::{LEAST_APPROACH_M, TOOL_STEP_M};
use crate::space::ArmSpace;
use crate::trajectory::Trajectory;
use arm::{IkOutcome, IkSettings, Vector3, solutions, solve};
use motion::{Limits, Metric, Path, Search, Space, connect, shorten, time};
use scene::Point;

/// A joint may change by no more than this while the tool goes up by one step: else the arm would have to turn over.
const LARGEST_CHANGE: f64 = 0.2;
/// Ways of holding the target over one place that are tried as ends of a search.
const MOST_POSTURES: usize = 6;
/// Random starts to find them.
const POSTURE_RESTARTS: usize = 12;
/// How far the tool may be from the straight line down, metres.
const OFF_LINE_M: f64 = 5e-4;
/// Shortcuts that are tried on a way that was found.
const SHORTCUTS: usize = 60;

/// Plans a motion that ends with the target at a point; `None` when no free one was found.
pub(crate) fn plan(access: &Access, current: &[f64], at_m: Point) -> Option<Trajectory> {
    let cell = &access.cell;
    let settings = &cell.manipulator.settings;
    let mut space = ArmSpace::new(cell, current);
    let limits = Limits::from_velocity(space.velocities(), settings.acceleration_s).ok()?;
    let metric = Metric::of_limits(&limits);
    let ups: Vec<Path> =
        postures(access, current, at_m).iter().filter_map(|place| lift(access, &mut space, place, at_m)).collect();
    let tops: Vec<Vec<f64>> = ups.iter().map(|up| up.end().to_vec()).collect();
    let search = Search { samples: settings.samples, seed: settings.seed, ..Search::default() };
    let start = space.part(current);
    let over = connect(&mut space, &metric, &start, &tops, &search).ok()?;
    let over = shorten(&mut space, &metric, &over, SHORTCUTS, settings.seed);
    let down = ups.iter().find(|up| up.end() == over.end())?.reversed();
    let mut timed = time(&mut space, &over, &limits, settings.sample_s).ok()?;
    timed.append(&time(&mut space, &down, &limits, settings.sample_s).ok()?, 0.0);
    // What is sent is what is checked: the very points, whatever was proven of the path they were taken from.
    let free = timed.points.windows(2).all(|pair| space.edge_touches_nothing(&pair[0].positions, &pair[1].positions));
    free.then(|| Trajectory::new(cell.manipulator, timed))
}

/// Configurations that put the target at a point, those near to known ones first.
fn postures(access: &Access, current: &[f64], at_m: Point) -> Vec<Vec<f64>> {
    let cell = &access.cell;
    let manipulator = cell.manipulator;
    let mut found: Vec<Vec<f64>> =
        [access.near(at_m, current), access.configuration(at_m)].into_iter().flatten().collect();
    let ik = IkSettings { restarts: POSTURE_RESTARTS, seed: manipulator.settings.seed, ..IkSettings::default() };
    let goal = cell.goal(at_m, access.base_m(at_m));
    let mut checker = manipulator.checker();
    let more = solutions(&manipulator.robot, &manipulator.chain, &goal, current, &ik, MOST_POSTURES);
    found.extend(more.into_iter().filter(|q| cell.is_free(q, &mut checker)));
    found.dedup();
    found.truncate(MOST_POSTURES);
    found
}

/// Straight up from a place, as far as the settings ask or the arm reaches; `None` when that is not far enough to come from
/// above.
fn lift(access: &Access, space: &mut ArmSpace, place: &[f64], at_m: Point) -> Option<Path> {
    let cell = &access.cell;
    let manipulator = cell.manipulator;
    let settings = &manipulator.settings;
    let base_m = access.base_m(at_m);
    let ik = IkSettings { restarts: 0, seed: settings.seed, ..IkSettings::default() };
    let mut steps = vec![place.to_vec()];
    let n = (settings.approach_m / TOOL_STEP_M).ceil().max(1.0) as usize;
    for i in 1..=n {
        let height_m = settings.approach_m * i as f64 / n as f64;
        let last = steps.last().expect("it starts with the place");
        let goal = cell.goal(at_m, base_m + height_m);
        let next = match solve(&manipulator.robot, &manipulator.chain, &goal, last, &ik, |_| true) {
            IkOutcome::Solved(next) => next,
            _ => break,
        };
        let change = last.iter().zip(&next).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        if change > LARGEST_CHANGE || !space.edge_is_free(&space.part(last), &space.part(&next)) {
            break;
        }
        steps.push(next);
    }
    let reached_m = settings.approach_m * (steps.len() - 1) as f64 / n as f64;
    if reached_m < LEAST_APPROACH_M.min(settings.approach_m) {
        return None;
    }
    Path::new(straightened(space, steps.iter().map(|step| space.part(step)).collect()))
}

/// Leaves out steps between which a straight edge in joint space keeps the tool on its line: fewer corners are quicker.
fn straightened(space: &mut ArmSpace, steps: Vec<Vec<f64>>) -> Vec<Vec<f64>> {
    let ends = [&steps[0], &steps[steps.len() - 1]].map(|q| space.tool(q).translation.vector);
    let line: Vector3<f64> = (ends[1] - ends[0]).normalize();
    let mut kept = vec![steps[0].clone()];
    let mut i = 0;
    while i + 1 < steps.len() {
        let mut next = i + 1;
        for j in (i + 2..steps.len()).rev() {
            let on_line = (1..=4).all(|k| {
                let share = f64::from(k) / 5.0;
                let q: Vec<f64> = steps[i].iter().zip(&steps[j]).map(|(a, b)| a + (b - a) * share).collect();
                let off = space.tool(&q).translation.vector - ends[0];
                (off - line * off.dot(&line)).norm() < OFF_LINE_M
            });
            if on_line && space.edge_is_free(&steps[i], &steps[j]) {
                next = j;
                break;
            }
        }
        kept.push(steps[next].clone());
        i = next;
    }
    kept
}
