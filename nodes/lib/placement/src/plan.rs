//! The placement to take, the maps that show why, and the motion that gets the target there.

use crate::access::Access;
use crate::choice::{Ranked, cvar_m, rank, refine};
use crate::losses::{LossBatch, placement_optima};
use crate::manipulator::{Manipulator, ManipulatorError};
use crate::reach::ReachMap;
use crate::trajectory::Trajectory;
use crate::{MotionSettings, motion};
use scene::{Field, Grid, Point, Rbf, Scene};

/// Cells per axis of the maps.
pub const MAP_SIDE: usize = 32;
/// Other places that are tried when no motion leads to the best one.
const OTHER_PLACES: usize = 4;
/// Other places keep this distance from those that were tried, metres.
const APART_M: f64 = 0.1;

/// How a plan came out.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum PlanOutcome {
    /// There is a trajectory.
    Planned,
    /// The target fits nowhere.
    NoFreePlace,
    /// The arm reaches no free place.
    Unreachable,
    /// No collision-free motion was found.
    NoPath,
    /// Placements stand, but no robot is known, or it does not stand at this table.
    NoRobot,
}

/// One cell of a map.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum CellState {
    /// The target can be put there (in reach, when a robot is known).
    Free,
    /// Something is in the way, or the edge of the table.
    Occupied,
    /// Free, but the arm cannot put it there.
    Unreachable,
}

/// Where the target goes, and how.
#[derive(Debug, Clone, PartialEq)]
pub struct PlacementPlan {
    /// How it came out.
    pub outcome: PlanOutcome,
    /// The same in one sentence.
    pub reason: String,
    /// Best usable placement under the MAP weights; `None` without a free place.
    pub map_placement_m: Option<Point>,
    /// The usable placement of smallest CVaR_α of the distance to each draw's own best; where the trajectory ends.
    pub robust_placement_m: Option<Point>,
    /// CVaR_α of that distance at the MAP placement, metres; `NaN` without one.
    pub map_cvar_m: f64,
    /// And at the robust one.
    pub robust_cvar_m: f64,
    /// Empty unless planned.
    pub trajectory: Trajectory,
    /// Mean reward over the draws at the midpoints of [`MAP_SIDE`] × [`MAP_SIDE`] cells, row-major, first row at y = 0.
    pub reward_map: Vec<f32>,
    /// The cells' states in the same order.
    pub cell_state: Vec<CellState>,
}

/// Plans placements; keeps the robot and its reach map between calls. A plan is a function of the robot and of the
/// arguments of the call alone.
#[derive(Debug, Clone, Default)]
pub struct Planner {
    settings: MotionSettings,
    manipulator: Option<Manipulator>,
    reach: Option<ReachMap>,
}

impl Planner {
    /// A planner that knows no robot.
    pub fn new(settings: MotionSettings) -> Self {
        Self { settings, manipulator: None, reach: None }
    }

    /// Takes a robot description, in place of an earlier one.
    ///
    /// # Errors
    /// A robot that cannot be used; the earlier one stays.
    pub fn set_robot(&mut self, urdf: &str) -> Result<(), ManipulatorError> {
        self.manipulator = Some(Manipulator::from_urdf(urdf, self.settings.clone())?);
        self.reach = None;
        Ok(())
    }

    /// The robot.
    pub fn manipulator(&self) -> Option<&Manipulator> {
        self.manipulator.as_ref()
    }

    /// Plans for one scene. `joints` are the arm's positions by name; what is missing rests at the position nearest 0.
    ///
    /// # Panics
    /// When the numbers of draws, weights and objects do not fit together.
    pub fn plan(&mut self, scene: &Scene, batch: &LossBatch, alpha: f64, joints: &[(String, f64)]) -> PlacementPlan {
        let grid = Grid::midpoints(MAP_SIDE);
        let field = Field::new(&Rbf::new(scene), &grid, Some(scene));
        let mut plan = PlacementPlan {
            outcome: PlanOutcome::NoFreePlace,
            reason: format!("there is no free place for '{}' on the table", scene.target.label),
            map_placement_m: None,
            robust_placement_m: None,
            map_cvar_m: f64::NAN,
            robust_cvar_m: f64::NAN,
            trajectory: Trajectory::default(),
            reward_map: mean_rewards(&field, batch),
            cell_state: cells(field.free(), |_| CellState::Free),
        };
        let found = placement_optima(std::slice::from_ref(scene), batch).pop().flatten();
        let Some((map_m, optima_m)) = found else { return plan };
        let optima_m = if optima_m.is_empty() { vec![map_m] } else { optima_m };
        let task = Task { scene, field: &field, batch, alpha, map_m, optima_m: &optima_m };
        let Some(manipulator) = &self.manipulator else {
            task.choose(&mut plan, None);
            plan.outcome = PlanOutcome::NoRobot;
            plan.reason = "no robot description has been received".into();
            return plan;
        };
        let Some(cell) = manipulator.at_table(scene, true) else {
            task.choose(&mut plan, None);
            plan.outcome = PlanOutcome::NoRobot;
            plan.reason = format!(
                "the robot '{}' has no fixed link '{}', the frame of the table; join one to its base by a fixed joint",
                manipulator.robot.name, scene.frame
            );
            return plan;
        };
        if self.reach.as_ref().is_none_or(|reach| !reach.fits(scene)) {
            self.reach = ReachMap::new(manipulator, scene, MAP_SIDE);
        }
        let reach = self.reach.as_ref().expect("the robot stands at this table");
        let current = manipulator.configuration(joints);
        let access = Access::new(cell, scene, reach, field.free(), &current);
        plan.cell_state =
            cells(field.free(), |i| if access.is_open(i) { CellState::Free } else { CellState::Unreachable });
        task.finish(&mut plan, &access, &current);
        plan
    }
}

/// One plan being made.
struct Task<'a> {
    scene: &'a Scene,
    field: &'a Field,
    batch: &'a LossBatch<'a>,
    alpha: f64,
    map_m: Point,
    optima_m: &'a [Point],
}

impl Task<'_> {
    fn finish(&self, plan: &mut PlacementPlan, access: &Access, current: &[f64]) {
        let label = &self.scene.target.label;
        if !plan.cell_state.contains(&CellState::Free) {
            self.choose(plan, None);
            plan.outcome = PlanOutcome::Unreachable;
            plan.reason = format!("the arm reaches none of the free places for '{label}'");
            return;
        }
        let ranked = self.choose(plan, Some(access));
        let moved = if plan.map_placement_m == Some(self.map_m) {
            String::new()
        } else {
            format!("; the best place, {}, is out of the arm's reach, so the next best counts", words(self.map_m))
        };
        if let Some((a, b)) = access.cell.contact(current) {
            plan.outcome = PlanOutcome::NoPath;
            plan.reason = format!("where the arm is now, '{a}' touches '{b}'; move it away by hand");
            return;
        }
        let best = plan.robust_placement_m.expect("a cell is free");
        let mut tried: Vec<Point> = Vec::new();
        let others = ranked.iter().map(|ranked| (ranked.at_m, ranked.cvar_m));
        for (at_m, cvar_m) in std::iter::once((best, plan.robust_cvar_m)).chain(others) {
            if tried.len() > OTHER_PLACES {
                break;
            }
            if tried.iter().any(|tried| tried.distance(at_m) < APART_M) {
                continue;
            }
            if let Some(trajectory) = motion::plan(access, current, at_m) {
                plan.trajectory = trajectory;
                plan.outcome = PlanOutcome::Planned;
                plan.robust_placement_m = Some(at_m);
                plan.robust_cvar_m = cvar_m;
                let seconds = plan.trajectory.points.last().map_or(0.0, |point| point.time_from_start_s);
                let detour = match tried.first() {
                    Some(&first) => format!("; no motion to {} was found", words(first)),
                    None => String::new(),
                };
                plan.reason = format!("the arm puts '{label}' at {} in {seconds:.1} s{moved}{detour}", words(at_m));
                return;
            }
            tried.push(at_m);
        }
        plan.outcome = PlanOutcome::NoPath;
        plan.reason = format!(
            "no collision-free motion to {} was found, nor to {} other places{moved}",
            words(best),
            tried.len() - 1
        );
    }

    /// Sets both placements and returns the usable cells by CVaR. Without an arm every free place is usable.
    fn choose(&self, plan: &mut PlacementPlan, access: Option<&Access>) -> Vec<Ranked> {
        let occupied = self.scene.occupied();
        let usable =
            |at_m: Point| occupied.is_free(at_m) && access.is_none_or(|access| access.configuration(at_m).is_some());
        let grid = self.field.grid();
        let open: Vec<usize> =
            (0..grid.n()).filter(|&i| self.field.free()[i] && access.is_none_or(|access| access.is_open(i))).collect();
        let map_m = if usable(self.map_m) { Some(self.map_m) } else { self.best_cell(&open) };
        let mut room = Vec::new();
        plan.map_placement_m = map_m;
        plan.map_cvar_m = map_m.map_or(f64::NAN, |at_m| cvar_m(at_m, self.optima_m, self.alpha, &mut room));
        let ranked = rank(open.iter().map(|&i| self.scene.metres(grid.at(i))), self.optima_m, self.alpha);
        // The MAP placement comes first among equals, so that the robust one is never worse.
        let starts = map_m.map(|at_m| Ranked { at_m, cvar_m: plan.map_cvar_m });
        let first = ranked.first().map(|r| Ranked { at_m: r.at_m, cvar_m: r.cvar_m });
        let best = match (starts, first) {
            (Some(map), Some(cell)) => Some(if cell.cvar_m < map.cvar_m { cell } else { map }),
            (one, other) => one.or(other),
        };
        if let Some(best) = best {
            let side = grid.side() as f64;
            let cell_m = Point::new(self.scene.width_m / side, self.scene.depth_m / side);
            let best = refine(best, self.optima_m, self.alpha, cell_m, usable);
            plan.robust_placement_m = Some(best.at_m);
            plan.robust_cvar_m = best.cvar_m;
        }
        ranked
    }

    /// The cell of largest MAP reward, the first of equals.
    fn best_cell(&self, open: &[usize]) -> Option<Point> {
        let mut rewards = vec![0.0; self.field.grid().n()];
        self.field.rewards(self.batch.map_weights, &mut rewards);
        let best = open.iter().copied().reduce(|a, b| if rewards[b] > rewards[a] { b } else { a })?;
        Some(self.scene.metres(self.field.grid().at(best)))
    }
}

fn words(at_m: Point) -> String {
    format!("({:.3}, {:.3}) m", at_m.x, at_m.y)
}

fn cells(free: &[bool], of_free: impl Fn(usize) -> CellState) -> Vec<CellState> {
    let state = |(i, &free): (usize, &bool)| if free { of_free(i) } else { CellState::Occupied };
    free.iter().enumerate().map(state).collect()
}

/// The reward is linear in the weights: its mean is the reward of the mean.
fn mean_rewards(field: &Field, batch: &LossBatch) -> Vec<f32> {
    let k = batch.n_features;
    let n = batch.draws.len() / k;
    let mut mean = batch.map_weights.to_vec();
    if n > 0 {
        mean.fill(0.0);
        for draw in batch.draws.chunks_exact(k) {
            for (mean, &w) in mean.iter_mut().zip(draw) {
                *mean += f64::from(w) / n as f64;
            }
        }
    }
    let mut rewards = vec![0.0; field.grid().n()];
    field.rewards(&mean, &mut rewards);
    rewards.into_iter().map(|reward| reward as f32).collect()
}
