//! The placement to take, the maps that show why, and the motion that gets the target there.

use crate::access::Access;
use crate::candidate::{Candidate, Verdict, clearance_m};
use crate::choice::{Judge, Ranked};
use crate::losses::{LossBatch, placement_optima};
use crate::manipulator::{Manipulator, ManipulatorError};
use crate::picking::{Source, pick};
use crate::reach::ReachMap;
use crate::trajectory::Trajectory;
use crate::{Choice, MotionSettings, motion};
use arm::{Exclusions, Robot};
use scene::{Field, Grid, Point, Rbf, Scene};

/// Cells per axis of the maps.
pub const MAP_SIDE: usize = 32;
/// Places that a motion is looked for to, the best first.
const MOST_TRIED: usize = 5;
/// Places that are told, those out of reach among them.
const MOST_CANDIDATES: usize = 8;
/// Why a place is not taken.
const OUT_OF_REACH: &str = "out of the arm's reach";
/// Candidates keep this distance from each other, metres.
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
    /// It reaches some, but would touch something at each.
    GoalInCollision,
    /// Where the arm is now, it touches something.
    StartInCollision,
    /// Nothing is heard of a joint that moves the tool.
    JointsUnknown,
    /// Such a joint is beyond its limits.
    OutsideLimits,
    /// No collision-free motion was found.
    NoPath,
    /// Placements stand, but no robot is known, or it does not stand at this table.
    NoRobot,
    /// Placements stand, but the target cannot be picked up, or nobody knows where it is.
    CannotPick,
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
    /// The usable placement that the settings' [`Choice`] prefers; where the trajectory ends.
    pub robust_placement_m: Option<Point>,
    /// CVaR_α of that distance at the MAP placement, metres; `NaN` without one.
    pub map_cvar_m: f64,
    /// And at the robust one.
    pub robust_cvar_m: f64,
    /// The places that were considered, best first, each with what became of it.
    pub candidates: Vec<Candidate>,
    /// Empty-handed, from where the arm is to where the gripper closes; empty unless planned and the target has to be picked up.
    pub approach: Trajectory,
    /// With the target in the hand, to where it is let go; empty unless planned.
    pub trajectory: Trajectory,
    /// Empty-handed, straight up from there; empty unless planned, and without a gripper.
    pub retreat: Trajectory,
    /// Where the gripper's joint is told to go to let the target in or out, and to hold it; `None` without one that can.
    pub grip: Option<[f64; 2]>,
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
        self.set_arm(Robot::from_urdf(urdf)?, None)
    }

    /// Takes a robot that was read already, in place of an earlier one, with the pairs of its links that may touch; without such
    /// a list those that always do.
    ///
    /// # Errors
    /// A robot that cannot be used; the earlier one stays.
    pub fn set_arm(&mut self, robot: Robot, exclusions: Option<&Exclusions>) -> Result<(), ManipulatorError> {
        self.manipulator = Some(Manipulator::new(robot, exclusions, self.settings.clone())?);
        self.reach = None;
        Ok(())
    }

    /// The robot.
    pub fn manipulator(&self) -> Option<&Manipulator> {
        self.manipulator.as_ref()
    }

    /// Which cells of the bare table the robot can put the target of a scene on.
    ///
    /// # Errors
    /// In a sentence: no robot, or one that stands at no such table.
    pub fn reach(&mut self, scene: &Scene) -> Result<&ReachMap, String> {
        let manipulator = self.manipulator.as_ref().ok_or(NO_ROBOT)?;
        ReachMap::kept(&mut self.reach, manipulator, scene).ok_or_else(|| manipulator.not_at(scene))
    }

    /// Plans for one scene. `joints` are the arm's positions by name. Without those of all joints that move the tool there are
    /// placements, but no trajectory; other joints rest at the position nearest 0 when they are missing.
    ///
    /// # Panics
    /// When the numbers of draws, weights and objects do not fit together.
    pub fn plan(&mut self, scene: &Scene, batch: &LossBatch, alpha: f64, joints: &[(String, f64)]) -> PlacementPlan {
        self.plan_from(scene, batch, alpha, joints, &Source::Hand)
    }

    /// The same with the target in the hand, or to be picked up from where it stands, which takes a gripper.
    ///
    /// # Panics
    /// When the numbers of draws, weights and objects do not fit together.
    pub fn plan_from(
        &mut self,
        scene: &Scene,
        batch: &LossBatch,
        alpha: f64,
        joints: &[(String, f64)],
        source: &Source,
    ) -> PlacementPlan {
        let grid = Grid::midpoints(MAP_SIDE);
        let field = Field::new(&Rbf::new(scene), &grid, Some(scene));
        let mut plan = PlacementPlan {
            outcome: PlanOutcome::NoFreePlace,
            reason: format!("there is no free place for '{}' on the table", scene.target.label),
            map_placement_m: None,
            robust_placement_m: None,
            map_cvar_m: f64::NAN,
            robust_cvar_m: f64::NAN,
            candidates: Vec::new(),
            approach: Trajectory::default(),
            trajectory: Trajectory::default(),
            retreat: Trajectory::default(),
            grip: None,
            reward_map: mean_rewards(&field, batch),
            cell_state: cells(field.free(), |_| CellState::Free),
        };
        let found = placement_optima(std::slice::from_ref(scene), batch).pop().flatten();
        let Some((map_m, optima_m)) = found else { return plan };
        let optima_m = if optima_m.is_empty() { vec![map_m] } else { optima_m };
        let judge = Judge::new(scene, &optima_m, batch.map_weights, mean_weights(batch), alpha);
        let task = Task { scene, field: &field, batch, judge, choice: self.settings.choice, map_m };
        let Some(manipulator) = &self.manipulator else {
            task.choose(&mut plan, None);
            plan.outcome = PlanOutcome::NoRobot;
            plan.reason = NO_ROBOT.into();
            return plan;
        };
        let Some(cell) = manipulator.at_table(scene, true) else {
            task.choose(&mut plan, None);
            plan.outcome = PlanOutcome::NoRobot;
            plan.reason = manipulator.not_at(scene);
            return plan;
        };
        let reach = ReachMap::kept(&mut self.reach, manipulator, scene).expect("the robot stands at this table");
        let mut current = manipulator.configuration(joints);
        if let (Some(gripper), Ok(grasp)) = (manipulator.gripper(), &cell.grasp) {
            // Whatever the fingers do, they are not wider than open.
            current = manipulator.with_gripper_at(gripper.let_in(grasp), &current);
            plan.grip = Some([gripper.let_in(grasp), gripper.hold(grasp)]);
        }
        let access = Access::new(cell, scene, reach, field.free(), &current);
        plan.cell_state =
            cells(field.free(), |i| if access.is_open(i) { CellState::Free } else { CellState::Unreachable });
        task.finish(&mut plan, &access, joints, &current, source);
        plan
    }
}

const NO_ROBOT: &str = "no robot description has been received";

/// One plan being made.
struct Task<'a> {
    scene: &'a Scene,
    field: &'a Field,
    batch: &'a LossBatch<'a>,
    judge: Judge<'a>,
    choice: Choice,
    map_m: Point,
}

impl Task<'_> {
    fn finish(
        &self,
        plan: &mut PlacementPlan,
        access: &Access,
        joints: &[(String, f64)],
        current: &[f64],
        source: &Source,
    ) {
        let label = &self.scene.target.label;
        let manipulator = access.cell.manipulator;
        if !plan.cell_state.contains(&CellState::Free) {
            // Where it would go, if the arm were another or stood elsewhere.
            self.choose(plan, None);
            for candidate in &mut plan.candidates {
                (candidate.verdict, candidate.reason) = self.why_not(access, candidate.at_m);
            }
            let free = (0..self.field.grid().n()).filter(|&i| self.field.free()[i]);
            let mut blocked = free.filter_map(|i| access.blocked_by(i)).peekable();
            if blocked.peek().is_some() {
                plan.outcome = PlanOutcome::GoalInCollision;
                let example = blocked.flatten().next();
                let example = example.map_or(String::new(), |(a, b)| format!(" ('{a}' would touch '{b}', for one)"));
                plan.reason = format!("the arm would touch something at each free place for '{label}'{example}");
                return;
            }
            plan.outcome = PlanOutcome::Unreachable;
            plan.reason = format!("the arm reaches none of the free places for '{label}'");
            let stuck = manipulator.stuck();
            if !stuck.is_empty() {
                plan.reason += &format!("; by their limits these joints cannot move: {}", stuck.join(", "));
            }
            return;
        }
        self.choose(plan, Some(access));
        let moved = if plan.map_placement_m == Some(self.map_m) {
            String::new()
        } else {
            let why = match self.why_not(access, self.map_m) {
                (Verdict::Blocked, reason) => format!("cannot be used: {reason}"),
                _ => "is out of the arm's reach".into(),
            };
            format!("; the best place, {}, {why}, so the next best counts", words(self.map_m))
        };
        let unheard = manipulator.unheard(joints);
        if let Some(first) = unheard.first() {
            plan.outcome = PlanOutcome::JointsUnknown;
            let more = match unheard.len() - 1 {
                0 => String::new(),
                n => format!(" and {n} more"),
            };
            plan.reason = format!("where the arm is, is not known: nothing is heard of joint '{first}'{more}");
            return;
        }
        if let Some(reason) = manipulator.outside(joints) {
            plan.outcome = PlanOutcome::OutsideLimits;
            plan.reason = format!("{reason}; move it back by hand");
            return;
        }
        let empty_handed = match source {
            Source::Hand => None,
            Source::Stands(stand) => Some(access.cell.beside(self.scene, stand)),
            Source::Unknown => {
                plan.outcome = PlanOutcome::CannotPick;
                plan.reason = format!("nothing is heard of where '{label}' stands");
                return;
            }
        };
        if let Err(reason) = &access.cell.grasp {
            plan.outcome = PlanOutcome::CannotPick;
            plan.reason = format!("the gripper cannot hold '{label}': {reason}");
            return;
        }
        if let Some((a, b)) = empty_handed.as_ref().unwrap_or(&access.cell).contact(current) {
            plan.outcome = PlanOutcome::StartInCollision;
            plan.reason = format!("where the arm is now, '{a}' touches '{b}'; move it away by hand");
            return;
        }
        let picked = match source {
            Source::Stands(stand) => match pick(&access.cell, self.scene, stand, current) {
                Ok(picked) => Some(picked),
                Err(reason) => {
                    (plan.outcome, plan.reason) = (PlanOutcome::CannotPick, reason);
                    return;
                }
            },
            Source::Hand | Source::Unknown => None,
        };
        let start = picked.as_ref().map_or(current, |picked| &picked.risen);
        plan.outcome = PlanOutcome::NoPath;
        let mut tried: Vec<Point> = Vec::new();
        for candidate in plan.candidates.iter_mut().filter(|one| one.verdict == Verdict::NextBest).take(MOST_TRIED) {
            let Some(carried) = motion::plan(access, self.scene, start, candidate.at_m) else {
                candidate.verdict = Verdict::NoPath;
                candidate.reason = "no collision-free motion leads there".into();
                tried.push(candidate.at_m);
                continue;
            };
            candidate.verdict = Verdict::Chosen;
            candidate.reason = "taken".into();
            plan.trajectory = match &picked {
                Some(picked) => carried.carry.after(&picked.up),
                None => carried.carry,
            };
            plan.approach =
                picked.map_or(Trajectory::default(), |picked| Trajectory::new(manipulator, picked.approach));
            plan.retreat = carried.retreat;
            plan.outcome = PlanOutcome::Planned;
            plan.robust_placement_m = Some(candidate.at_m);
            plan.robust_cvar_m = candidate.cvar_m;
            let seconds: f64 = [&plan.approach, &plan.trajectory, &plan.retreat].map(Trajectory::seconds).iter().sum();
            let detour = match tried.first() {
                Some(&first) => format!("; no motion to {} was found", words(first)),
                None => String::new(),
            };
            let at = words(candidate.at_m);
            plan.reason = format!("the arm puts '{label}' at {at} and moves for {seconds:.1} s{moved}{detour}");
            return;
        }
        let best = tried.first().copied().unwrap_or(self.map_m);
        plan.reason = format!(
            "no collision-free motion to {} was found, nor to {} other places{moved}",
            words(best),
            tried.len().saturating_sub(1)
        );
    }

    /// Sets both placements and the candidates. Without an arm every free place is usable.
    fn choose(&self, plan: &mut PlacementPlan, access: Option<&Access>) {
        let occupied = self.scene.occupied();
        let usable =
            |at_m: Point| occupied.is_free(at_m) && access.is_none_or(|access| access.configuration(at_m).is_some());
        let grid = self.field.grid();
        let free: Vec<usize> = (0..grid.n()).filter(|&i| self.field.free()[i]).collect();
        let is_open = |i: usize| access.is_none_or(|access| access.is_open(i));
        let open: Vec<usize> = free.iter().copied().filter(|&i| is_open(i)).collect();
        let map_m = if usable(self.map_m) { Some(self.map_m) } else { self.best_cell(&open) };
        let mut room = Vec::new();
        plan.map_placement_m = map_m;
        plan.map_cvar_m = map_m.map_or(f64::NAN, |at_m| self.judge.cvar_m(at_m, &mut room));
        let ranked = self.judge.rank(self.choice, free.iter().map(|&i| self.scene.metres(grid.at(i))));
        let first = ranked.iter().find(|ranked| self.is_open_at(access, ranked.at_m)).copied();
        // The MAP placement comes first among equals, so that the chosen one is never worse.
        let map = map_m.map(|at_m| Ranked { at_m, cost: self.judge.cost(self.choice, at_m, &mut room) });
        let best = match (map, first) {
            (Some(map), Some(cell)) => Some(if cell.cost < map.cost { cell } else { map }),
            (one, other) => one.or(other),
        };
        let best = best.map(|best| {
            let side = grid.side() as f64;
            let cell_m = Point::new(self.scene.width_m / side, self.scene.depth_m / side);
            self.judge.refine(self.choice, best, cell_m, usable)
        });
        if let Some(best) = best {
            plan.robust_placement_m = Some(best.at_m);
            plan.robust_cvar_m = self.judge.cvar_m(best.at_m, &mut room);
        }
        plan.candidates = self.candidates(access, best, &ranked);
    }

    /// The best place, then others by cost that keep apart; those that are better but out of reach among them.
    fn candidates(&self, access: Option<&Access>, best: Option<Ranked>, ranked: &[Ranked]) -> Vec<Candidate> {
        let mut room = Vec::new();
        let mut found: Vec<Candidate> = Vec::new();
        let mut usable = 0;
        let mut all: Vec<Ranked> = best.into_iter().collect();
        // Cells are ranked already; the best place goes before the first that costs as much.
        let (better, others): (Vec<Ranked>, Vec<Ranked>) =
            ranked.iter().copied().partition(|cell| best.is_some_and(|best| cell.cost < best.cost));
        all.splice(0..0, better);
        all.extend(others);
        for Ranked { at_m, .. } in all {
            let is_best = best.is_some_and(|best| best.at_m == at_m);
            let reachable = is_best || self.is_open_at(access, at_m);
            // What can be used keeps apart from what can be used, and the rest from the rest: the place that the person
            // would like best is told although one beside it is taken.
            let is_near =
                |one: &Candidate| one.at_m.distance(at_m) < APART_M && (one.verdict == Verdict::NextBest) == reachable;
            let near_best = reachable && !is_best && best.is_some_and(|best| best.at_m.distance(at_m) < APART_M);
            if near_best || (!is_best && found.iter().any(is_near)) {
                continue;
            }
            // Room is kept for the best place, which always stands in the list.
            let wait = best.is_some() && usable == 0 && !reachable && found.len() + 1 == MOST_CANDIDATES;
            if wait {
                continue;
            }
            let figures = self.judge.figures(at_m, &mut room);
            let (verdict, reason) = match access {
                Some(access) if !reachable => self.why_not(access, at_m),
                _ => (Verdict::NextBest, "a better one was taken".into()),
            };
            found.push(Candidate {
                at_m,
                mean_reward: figures.mean_reward,
                probability_best: figures.probability_best,
                var_m: figures.var_m,
                cvar_m: figures.cvar_m,
                clearance_m: clearance_m(self.scene, at_m),
                verdict,
                reason,
            });
            usable += usize::from(reachable);
            if found.len() == MOST_CANDIDATES || usable == MOST_TRIED {
                break;
            }
        }
        found
    }

    /// Whether the cell around a point can be used.
    fn is_open_at(&self, access: Option<&Access>, at_m: Point) -> bool {
        access.is_none_or(|access| access.is_open(self.cell_of(at_m)))
    }

    fn cell_of(&self, at_m: Point) -> usize {
        let (at, side) = (self.scene.normalised(at_m), self.field.grid().side());
        let index = |v: f64| ((v * side as f64) as usize).min(side - 1);
        index(at.y) * side + index(at.x)
    }

    /// Why the arm cannot use a place.
    fn why_not(&self, access: &Access, at_m: Point) -> (Verdict, String) {
        match access.blocked_by(self.cell_of(at_m)) {
            Some(Some((a, b))) => (Verdict::Blocked, format!("'{a}' would touch '{b}' there")),
            Some(None) => (Verdict::Blocked, "the arm would touch something there".into()),
            None => (Verdict::Unreachable, OUT_OF_REACH.into()),
        }
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

/// The mean of the draws; the MAP weights without any.
fn mean_weights(batch: &LossBatch) -> Vec<f64> {
    let k = batch.n_features;
    let n = batch.draws.len() / k;
    if n == 0 {
        return batch.map_weights.to_vec();
    }
    let mut mean = vec![0.0; k];
    for draw in batch.draws.chunks_exact(k) {
        for (mean, &w) in mean.iter_mut().zip(draw) {
            *mean += f64::from(w) / n as f64;
        }
    }
    mean
}

/// The reward is linear in the weights: its mean is the reward of the mean.
fn mean_rewards(field: &Field, batch: &LossBatch) -> Vec<f32> {
    let mut rewards = vec![0.0; field.grid().n()];
    field.rewards(&mean_weights(batch), &mut rewards);
    rewards.into_iter().map(|reward| reward as f32).collect()
}
