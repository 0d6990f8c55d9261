//! Whole plans in clutter, from the draws of the reward to a timed trajectory: how often, how fast, how long a way.

use crate::arm::{PANDA, interpreter, read, robot_error, share};
use crate::clock::timed;
use crate::clutter::{Problem, problem};
use crate::error::PeersError;
use arm::{Exclusions, Robot};
use placement::{
    ClosingAxis, Gripper, MotionSettings, PlacementPlan, PlanOutcome, Planner, Source, Stand, TablePose, Trajectory,
    placement_optima,
};
use robot_files::read_text;
use scene::Point;
use serde::Serialize;

const N_SCENES: usize = 200;
const N_DRAWS: usize = 2000;
/// A scene counts as solvable when a search of this many samples, under any of a few seeds, finds a plan.
const LONG_SEARCH: usize = 20_000;
const LONG_SEEDS: u64 = 4;

/// An arm beside a table.
pub(crate) struct Bench {
    pub name: &'static str,
    pub robot: Robot,
    pub exclusions: Option<Exclusions>,
    pub tool: &'static str,
    pub table: Option<TablePose>,
    pub size_m: [f64; 2],
    pub home: Vec<(String, f64)>,
    /// What picks the target up, and where it stands: beside the table.
    gripper: Gripper,
    stand: Stand,
}

/// Figures of one arm, CPU milliseconds.
#[derive(Debug, Serialize)]
pub struct Measured {
    robot: &'static str,
    /// Whether the target is picked up, and let go of; else it is in the hand and stays there.
    picks: bool,
    /// Scenes that a long search solves, and those drawn to get them.
    solvable: usize,
    drawn: usize,
    success: usize,
    p50_ms: f64,
    p95_ms: f64,
    worst_ms: f64,
    /// The first plan at a table, which finds out what the arm reaches.
    first_ms: f64,
    /// The best place under each of the draws.
    optimum_p50_ms: f64,
    optimum_worst_ms: f64,
    /// Mean over the plans: radians along all joints, and seconds.
    path_rad: f64,
    motion_s: f64,
    unsolved: Vec<String>,
}

/// Both arms.
pub fn measure(seed: u64) -> Result<Vec<Measured>, PeersError> {
    let mut all = Vec::new();
    for bench in [panda()?, own()?] {
        for picks in [false, true] {
            let measured = one(&bench, picks, seed)?;
            print(&measured);
            all.push(measured);
        }
    }
    Ok(all)
}

/// The Panda behind a table of 0.8 × 0.6 m.
pub(crate) fn panda() -> Result<Bench, PeersError> {
    let share = share(&interpreter())?;
    let robot = read(&share, PANDA.0)?;
    let srdf =
        read_text(&share.join("example-robot-data/robots").join(PANDA.1), arm::MAX_BYTES).map_err(robot_error)?;
    let (exclusions, _) = Exclusions::from_srdf(&robot, &srdf).map_err(robot_error)?;
    let half = std::f64::consts::FRAC_PI_4;
    let positions = [0.0, -half, 0.0, -3.0 * half, 0.0, 2.0 * half, half];
    let joint = |(i, at): (usize, &f64)| (format!("panda_joint{}", i + 1), *at);
    let fingers = [1, 2].map(|i| (format!("panda_finger_joint{i}"), 0.035));
    let home = positions.iter().enumerate().map(joint).chain(fingers).collect();
    // Its x axis points over the table, whose own x axis points to the right.
    let table = Some(TablePose { position_m: [0.2, 0.4, 0.0], yaw_rad: -std::f64::consts::FRAC_PI_2 });
    let exclusions = Some(exclusions);
    let gripper = gripper("panda_finger_joint1", 0.04, 0.08);
    let stand = beside(-0.1, 0.2);
    Ok(Bench { name: "Panda", robot, exclusions, tool: PANDA.2, table, size_m: [0.8, 0.6], home, gripper, stand })
}

/// Our own arm of seven joints at its table of 1 × 1 m.
fn own() -> Result<Bench, PeersError> {
    let text = include_str!("../../../config/urdf/table_arm_7.urdf");
    let robot = Robot::from_urdf(text).map_err(robot_error)?;
    let names =
        ["shoulder_yaw", "shoulder_pitch", "upper_arm_roll", "elbow", "forearm_roll", "wrist_pitch", "wrist_roll"];
    let at = [0.0, -0.5, 0.0, 2.1, 0.0, 1.54, 0.0];
    let joints = names.iter().zip(at).chain([(&"finger_left", 0.04)]);
    let home = joints.map(|(name, at)| ((*name).to_owned(), at)).collect();
    let gripper = gripper("finger_left", 0.075, 0.154);
    let (tool, table, stand) = ("tool0", None, beside(1.1, 0.15));
    Ok(Bench { name: "table_arm_7", robot, exclusions: None, tool, table, size_m: [1.0, 1.0], home, gripper, stand })
}

fn gripper(joint: &str, open: f64, opening_m: f64) -> Gripper {
    Gripper { joint: joint.to_owned(), closed: 0.0, open, opening_m, axis: ClosingAxis::Y }
}

fn beside(x: f64, y: f64) -> Stand {
    Stand { at_m: Point::new(x, y), base_m: 0.0, yaw_rad: 0.0 }
}

impl Bench {
    fn planner(&self, picks: bool, samples: Option<usize>, seed: u64) -> Result<Planner, PeersError> {
        let defaults = MotionSettings::default();
        let samples = samples.unwrap_or(defaults.samples);
        let gripper = picks.then(|| self.gripper.clone());
        let settings =
            MotionSettings { tool_link: self.tool.into(), table: self.table, gripper, samples, seed, ..defaults };
        let mut planner = Planner::new(settings);
        planner.set_arm(self.robot.clone(), self.exclusions.as_ref()).map_err(robot_error)?;
        Ok(planner)
    }

    pub fn problem(&self, seed: u64, n: u64, n_draws: usize) -> Problem {
        problem(seed, n, "table", self.size_m, n_draws)
    }
}

fn one(bench: &Bench, picks: bool, seed: u64) -> Result<Measured, PeersError> {
    let mut quick = bench.planner(picks, None, 1)?;
    let mut long =
        (0..LONG_SEEDS).map(|i| bench.planner(picks, Some(LONG_SEARCH), 100 + i)).collect::<Result<Vec<_>, _>>()?;
    let (mut times, mut optimum, mut success) = (Vec::new(), Vec::new(), 0);
    let (mut path, mut motion_s, mut unsolved) = (0.0, 0.0, Vec::new());
    let source = if picks { Source::Stands(bench.stand) } else { Source::Hand };
    let (_, first_s) = timed(|| plan(&mut quick, &bench.problem(seed, u64::MAX, N_DRAWS), &bench.home, &source));
    let (mut solvable, mut n) = (0, 0);
    while solvable < N_SCENES && n < 4 * N_SCENES as u64 {
        let problem = bench.problem(seed, n, N_DRAWS);
        n += 1;
        let (found, took) = timed(|| plan(&mut quick, &problem, &bench.home, &source));
        let planned = found.outcome == PlanOutcome::Planned;
        if !planned
            && !long.iter_mut().any(|long| plan(long, &problem, &bench.home, &source).outcome == PlanOutcome::Planned)
        {
            continue;
        }
        solvable += 1;
        times.push(1e3 * took);
        let batch = problem.batch();
        optimum.push(1e3 * timed(|| placement_optima(std::slice::from_ref(&problem.scene), &batch)).1);
        if planned {
            success += 1;
            path += length(&found);
            motion_s += parts(&found).map(Trajectory::seconds).iter().sum::<f64>();
        } else {
            unsolved.push(format!("{}: {}", problem.scene.id, found.reason));
        }
    }
    times.sort_unstable_by(f64::total_cmp);
    optimum.sort_unstable_by(f64::total_cmp);
    let at = |of: &[f64], share: f64| of[((share * of.len() as f64) as usize).min(of.len() - 1)];
    let mean = |sum: f64| sum / f64::from(u32::try_from(success.max(1)).unwrap_or(1));
    Ok(Measured {
        robot: bench.name,
        picks,
        solvable,
        drawn: n as usize,
        success,
        p50_ms: at(&times, 0.5),
        p95_ms: at(&times, 0.95),
        worst_ms: at(&times, 1.0),
        first_ms: 1e3 * first_s,
        optimum_p50_ms: at(&optimum, 0.5),
        optimum_worst_ms: at(&optimum, 1.0),
        path_rad: mean(path),
        motion_s: mean(motion_s),
        unsolved,
    })
}

fn plan(planner: &mut Planner, problem: &Problem, home: &[(String, f64)], source: &Source) -> PlacementPlan {
    planner.plan_from(&problem.scene, &problem.batch(), 0.95, home, source)
}

fn parts(plan: &PlacementPlan) -> [&Trajectory; 3] {
    [&plan.approach, &plan.trajectory, &plan.retreat]
}

/// Euclidean, over all joints of the arm.
fn length(plan: &PlacementPlan) -> f64 {
    let step = |pair: &[placement::TrajectoryPoint]| {
        let squared: f64 = pair[0].positions.iter().zip(&pair[1].positions).map(|(a, b)| (a - b) * (a - b)).sum();
        squared.sqrt()
    };
    parts(plan).iter().flat_map(|part| part.points.windows(2)).map(step).sum()
}

fn print(m: &Measured) {
    println!(
        "{}, {}: {} of {} solvable scenes planned ({:.1} %; {} drawn); CPU ms p50 {:.1}, p95 {:.1}, worst {:.1}; the first plan \
         at a table {:.0}; optimum under {N_DRAWS} draws p50 {:.1}, worst {:.1}; way {:.2} rad, motion {:.2} s",
        m.robot,
        if m.picks { "picked up, carried, let go" } else { "in the hand" },
        m.success,
        m.solvable,
        100.0 * m.success as f64 / m.solvable.max(1) as f64,
        m.drawn,
        m.p50_ms,
        m.p95_ms,
        m.worst_ms,
        m.first_ms,
        m.optimum_p50_ms,
        m.optimum_worst_ms,
        m.path_rad,
        m.motion_s
    );
    for text in &m.unsolved {
        println!("  {text}");
    }
}
