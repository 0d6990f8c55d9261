//! With the target in the hand to over its place, straight down, and straight up again without it; every part proven free.

use crate::access::Access;
use crate::manipulator::{Cell, resting_height_m};
use crate::picking::Stand;
use crate::settings::{LEAST_APPROACH_M, TOOL_STEP_M};
use crate::space::ArmSpace;
use crate::trajectory::Trajectory;
use arm::{Goal, IkOutcome, IkSettings, Vector3, solutions, solve};
use motion::{Limits, Metric, Path, Search, Space, connect, shorten, time};
use scene::{Point, Scene};

/// A joint may change by no more than this while the tool goes up by one step: else the arm would have to turn over.
const LARGEST_CHANGE: f64 = 0.2;
/// Ways of holding the target over one place that are tried as ends of a search.
pub(crate) const MOST_POSTURES: usize = 6;
/// Random starts to find them.
pub(crate) const POSTURE_RESTARTS: usize = 12;
/// How far the tool may be from the straight line down, metres.
const OFF_LINE_M: f64 = 5e-4;
/// Shortcuts that are tried on a way that was found.
const SHORTCUTS: usize = 60;

/// A motion with the target in the hand, and the one that takes the empty hand away.
pub(crate) struct Carried {
    pub carry: Trajectory,
    /// Empty without a gripper.
    pub retreat: Trajectory,
}

/// Plans a motion from a configuration of the whole robot that ends with the target at a point, and from there straight up again
/// once a gripper has let go; `None` when no free one was found.
pub(crate) fn plan(access: &Access, scene: &Scene, start: &[f64], at_m: Point) -> Option<Carried> {
    let cell = &access.cell;
    let pace = Pace::new(cell, start)?;
    let mut space = ArmSpace::new(cell, start);
    let goal = |up_m: f64| cell.goal(at_m, access.base_m(at_m) + up_m);
    let ups: Vec<(Vec<f64>, Path)> = postures(access, start, at_m)
        .into_iter()
        .filter_map(|place| rise(&mut space, &place, goal).map(|up| (place, up)))
        .collect();
    let tops: Vec<Vec<f64>> = ups.iter().map(|(_, up)| up.end().to_vec()).collect();
    let over = pace.way(&mut space, start, &tops)?;
    let (place, up) = ups.iter().find(|(_, up)| up.end() == over.end())?;
    let mut carry = pace.timed(&mut space, &over)?;
    carry.append(&pace.timed(&mut space, &up.reversed())?, 0.0);
    let manipulator = cell.manipulator;
    let retreat = match manipulator.gripper() {
        None => Trajectory::default(),
        Some(_) => {
            let stand = Stand { at_m, base_m: resting_height_m(scene, at_m), yaw_rad: cell.heading_rad(place) };
            let left = cell.around(scene, &stand);
            let mut space = ArmSpace::new(&left, start);
            let up = rise(&mut space, place, goal)?;
            Trajectory::new(manipulator, pace.timed(&mut space, &up)?)
        }
    };
    Some(Carried { carry: Trajectory::new(manipulator, carry), retreat })
}

/// How an arm may move, and how its ways are looked for.
pub(crate) struct Pace {
    limits: Limits,
    metric: Metric,
    search: Search,
    sample_s: f64,
    seed: u64,
}

impl Pace {
    /// As the settings say; `None` for an arm that cannot move.
    pub fn new(cell: &Cell, q: &[f64]) -> Option<Self> {
        let settings = &cell.manipulator.settings;
        let velocities = ArmSpace::new(cell, q).velocities();
        let limits = Limits::from_velocity(velocities, settings.acceleration_s).ok()?;
        let metric = Metric::of_limits(&limits);
        let search = Search { samples: settings.samples, seed: settings.seed, ..Search::default() };
        Some(Self { limits, metric, search, sample_s: settings.sample_s, seed: settings.seed })
    }

    /// A short way from a configuration of the whole robot to one of several ends.
    pub fn way(&self, space: &mut ArmSpace, start: &[f64], ends: &[Vec<f64>]) -> Option<Path> {
        let start = space.part(start);
        let found = connect(space, &self.metric, &start, ends, &self.search).ok()?;
        Some(shorten(space, &self.metric, &found, SHORTCUTS, self.seed))
    }

    /// When to be where on a way. What is sent is what is checked: the very points, whatever was proven of the path they were
    /// taken from.
    pub fn timed(&self, space: &mut ArmSpace, path: &Path) -> Option<motion::Trajectory> {
        let timed = time(space, path, &self.limits, self.sample_s).ok()?;
        let free =
            timed.points.windows(2).all(|pair| space.edge_touches_nothing(&pair[0].positions, &pair[1].positions));
        free.then_some(timed)
    }
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
    let more = solutions(&manipulator.robot, &cell.chain, &goal, current, &ik, MOST_POSTURES);
    found.extend(more.into_iter().filter(|q| cell.is_free(q, &mut checker)));
    found.dedup();
    found.truncate(MOST_POSTURES);
    found
}

/// Straight up from a configuration of the whole robot, as far as the settings ask or the arm reaches; `goal` says where the hand
/// is so much higher, metres. `None` when that is not far enough to come from above.
pub(crate) fn rise(space: &mut ArmSpace, bottom: &[f64], goal: impl Fn(f64) -> Goal) -> Option<Path> {
    let cell = space.cell();
    let manipulator = cell.manipulator;
    let settings = &manipulator.settings;
    let ik = IkSettings { restarts: 0, seed: settings.seed, ..IkSettings::default() };
    let mut steps = vec![bottom.to_vec()];
    let n = (settings.approach_m / TOOL_STEP_M).ceil().max(1.0) as usize;
    for i in 1..=n {
        let height_m = settings.approach_m * i as f64 / n as f64;
        let last = steps.last().expect("it starts with the bottom");
        let next = match solve(&manipulator.robot, &cell.chain, &goal(height_m), last, &ik, |_| true) {
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
