//! A Panda among 20 objects: forward kinematics, collision checks and inverse kinematics beside Pinocchio and Coal.

use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::sync::Arc;

use arm::{
    Chain, Checker, CollisionModel, Exclusions, Goal, IkOutcome, IkSettings, Isometry3, Obstacle, ReadOptions, Robot,
    Solid, SweepSettings, Translation3, World, about_z, solve,
};
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{Rng, SeedableRng};
use robot_files::{Folders, read_text};
use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};

use crate::clock::timed;
use crate::error::PeersError;

pub(crate) const PANDA: (&str, &str, &str) =
    ("panda_description/urdf/panda.urdf", "panda_description/srdf/panda.srdf", "panda_hand_tcp");
const UR5: (&str, &str) = ("ur_description/urdf/ur5_robot.urdf", "tool0");
const N_CONFIGURATIONS: usize = 500;
const N_OBJECTS: usize = 20;
const N_POSES: usize = 1000;

/// All figures, CPU microseconds unless they say otherwise.
#[derive(Debug, Serialize)]
pub struct Compared {
    peers: Report,
    links_us: f64,
    chain_us: f64,
    jacobian_us: f64,
    pairs: usize,
    n_free: usize,
    free_us: f64,
    mixed_us: f64,
    nearest_us: f64,
    sweep_us: f64,
    /// Configurations on which we and Coal's hulls disagree.
    disagreements: usize,
    inverse: Vec<Inverse>,
}

/// Inverse kinematics of one robot.
#[derive(Debug, Serialize)]
struct Inverse {
    robot: &'static str,
    solved: usize,
    of: usize,
    median_us: f64,
    p95_us: f64,
    worst_us: f64,
}

/// What the Python program reports.
#[derive(Debug, Serialize, Deserialize)]
struct Report {
    versions: std::collections::BTreeMap<String, String>,
    call_us: f64,
    links_us: f64,
    collision: Collision,
}

#[derive(Debug, Serialize, Deserialize)]
struct Collision {
    hulls: OfShapes,
    meshes: OfShapes,
}

#[derive(Debug, Serialize, Deserialize)]
struct OfShapes {
    pairs: usize,
    free: Vec<bool>,
    free_us: f64,
    free_tree_us: f64,
    mixed_us: f64,
    mixed_tree_us: f64,
    tree_agrees: usize,
}

/// An object on the table, for both sides.
#[derive(Debug, Clone, Serialize)]
pub(crate) struct Object {
    /// `box` (all sides), `cylinder` (radius, height) or `ball` (radius).
    pub shape: &'static str,
    pub size: Vec<f64>,
    /// Its middle.
    pub at: [f64; 3],
    /// About the vertical.
    pub yaw: f64,
}

/// Measures both sides on the same robot, objects, pairs and configurations.
pub fn compare(seconds: f64, seed: u64) -> Result<Compared, PeersError> {
    let python = interpreter();
    let share = share(&python)?;
    let robot = Arc::new(read(&share, PANDA.0)?);
    let srdf =
        read_text(&share.join("example-robot-data/robots").join(PANDA.1), arm::MAX_BYTES).map_err(robot_error)?;
    let (exclusions, _) = Exclusions::from_srdf(&robot, &srdf).map_err(robot_error)?;
    let model = Arc::new(CollisionModel::new(&robot, &exclusions));
    let mut rng = ChaCha8Rng::seed_from_u64(seed);
    let objects = objects(&mut rng);
    let world = world(&objects);
    let configurations: Vec<Vec<f64>> = (0..N_CONFIGURATIONS).map(|_| draw(&robot, &mut rng)).collect();
    let request = request(&share, &robot, &model, &objects, &configurations, seconds);
    let peers: Report = run(&python, "arm_pinocchio.py", &request, "the report of Pinocchio's run")?;

    let mut checker = Checker::new(Arc::clone(&robot), Arc::clone(&model));
    let free: Vec<bool> = configurations.iter().map(|q| checker.is_free(q, &world, 0.0)).collect();
    let of_free: Vec<Vec<f64>> =
        configurations.iter().zip(&free).filter(|(_, free)| **free).map(|(q, _)| q.clone()).collect();
    let chain = Chain::new(&robot, PANDA.2).map_err(robot_error)?;
    let mut poses = Vec::new();
    let mut columns = Vec::new();
    let links_us = per_call(&configurations, seconds, |q| robot.link_poses(q, &mut poses));
    let chain_us = per_call(&configurations, seconds, |q| {
        std::hint::black_box(chain.tool_pose(q));
    });
    let jacobian_us = per_call(&configurations, seconds, |q| {
        std::hint::black_box(chain.linearise(q, &mut columns));
    });
    let free_us = per_call(&of_free, seconds, |q| assert!(checker.is_free(q, &world, 0.0)));
    let mixed_us = per_call(&configurations, seconds, |q| {
        std::hint::black_box(checker.is_free(q, &world, 0.0));
    });
    let nearest_us = per_call(&of_free, seconds, |q| {
        std::hint::black_box(checker.nearest(q, &world, 0.1));
    });
    // Ways as a planner tries them: at most 0.35 rad in each joint.
    let ways: Vec<(Vec<f64>, Vec<f64>)> = of_free.iter().map(|q| (q.clone(), nearby(&robot, q, &mut rng))).collect();
    let settings = SweepSettings { margin: 0.003, ..SweepSettings::default() };
    let sweep_us = per_call(&ways, seconds, |(from, to)| {
        std::hint::black_box(checker.sweep(from, to, &world, &settings));
    });
    let inverse = vec![inverse("Panda", &robot, PANDA.2, seed)?, inverse("UR5", &read(&share, UR5.0)?, UR5.1, seed)?];
    let compared = Compared {
        disagreements: free.iter().zip(&peers.collision.hulls.free).filter(|(a, b)| a != b).count(),
        peers,
        links_us,
        chain_us,
        jacobian_us,
        pairs: model.n_pairs(),
        n_free: of_free.len(),
        free_us,
        mixed_us,
        nearest_us,
        sweep_us,
        inverse,
    };
    print(&compared);
    Ok(compared)
}

/// CPU microseconds of a call, best of ten rounds over all inputs.
fn per_call<T>(inputs: &[T], seconds: f64, mut work: impl FnMut(&T)) -> f64 {
    let ((), once) = timed(|| inputs.iter().for_each(&mut work));
    let rounds = ((seconds / 10.0 / once.max(1e-6)) as usize).max(1);
    let mut best = f64::INFINITY;
    for _ in 0..10 {
        let ((), took) = timed(|| (0..rounds).for_each(|_| inputs.iter().for_each(&mut work)));
        best = best.min(took / (rounds * inputs.len()) as f64);
    }
    1e6 * best
}

fn print(c: &Compared) {
    let Report { versions, call_us, links_us, collision } = &c.peers;
    println!(
        "Panda, {N_CONFIGURATIONS} configurations, {N_OBJECTS} objects; CPU microseconds a call, best of ten rounds; \
         {versions:?}"
    );
    println!("  a call from Python that does nothing {call_us:>39.2}");
    println!(
        "  poses of all links: ours {:.2}, Pinocchio {links_us:.2} ({:.1} times)",
        c.links_us,
        links_us / c.links_us
    );
    println!("  tool pose alone {:.2}, with the Jacobian {:.2}", c.chain_us, c.jacobian_us);
    let (hulls, meshes) = (&collision.hulls, &collision.meshes);
    println!(
        "  {} pairs of links with each other and {} of shapes in all; {} of {N_CONFIGURATIONS} configurations free; \
         {} judged otherwise by Coal's hulls",
        c.pairs, hulls.pairs, c.n_free, c.disagreements
    );
    for (name, ours, hulls_us, hulls_tree, meshes_us, meshes_tree) in [
        ("free", c.free_us, hulls.free_us, hulls.free_tree_us, meshes.free_us, meshes.free_tree_us),
        ("all", c.mixed_us, hulls.mixed_us, hulls.mixed_tree_us, meshes.mixed_us, meshes.mixed_tree_us),
    ] {
        let best = hulls_us.min(hulls_tree);
        println!(
            "  check of {name:<4} ours {ours:>7.2}; Coal hulls {hulls_us:>7.2}, with a tree {hulls_tree:>7.2} ({:.1} times); \
             meshes {meshes_us:>7.2}, with a tree {meshes_tree:>7.2}",
            best / ours
        );
    }
    println!(
        "  nearest pair within 0.1 m {:.2}; a way of at most 0.35 rad a joint, proven {:.2}",
        c.nearest_us, c.sweep_us
    );
    for i in &c.inverse {
        println!(
            "  inverse kinematics, {}: {} of {} reachable poses; median {:.1}, 95th percentile {:.1}, worst {:.1}",
            i.robot, i.solved, i.of, i.median_us, i.p95_us, i.worst_us
        );
    }
}

fn inverse(name: &'static str, robot: &Robot, tool: &str, seed: u64) -> Result<Inverse, PeersError> {
    let chain = Chain::new(robot, tool).map_err(robot_error)?;
    let settings = IkSettings { restarts: 50, ..IkSettings::default() };
    let mut rng = ChaCha8Rng::seed_from_u64(seed);
    let start = robot.rest();
    let mut times = Vec::with_capacity(N_POSES);
    let mut solved = 0;
    for _ in 0..N_POSES {
        let goal = Goal::Pose(chain.tool_pose(&draw(robot, &mut rng)));
        let (outcome, took) = timed(|| solve(robot, &chain, &goal, &start, &settings, |_| true));
        solved += usize::from(matches!(outcome, IkOutcome::Solved(_)));
        times.push(1e6 * took);
    }
    times.sort_unstable_by(f64::total_cmp);
    let at = |share: f64| times[((share * N_POSES as f64) as usize).min(N_POSES - 1)];
    Ok(Inverse { robot: name, solved, of: N_POSES, median_us: at(0.5), p95_us: at(0.95), worst_us: at(1.0) })
}

pub(crate) fn uniform(rng: &mut ChaCha8Rng) -> f64 {
    (rng.next_u64() >> 11) as f64 / (1_u64 << 53) as f64
}

fn draw(robot: &Robot, rng: &mut ChaCha8Rng) -> Vec<f64> {
    let draw = |entry: usize| {
        let limits = robot.driven_joint(entry).limits;
        limits.lower + (limits.upper - limits.lower) * uniform(rng)
    };
    (0..robot.dof()).map(draw).collect()
}

fn nearby(robot: &Robot, q: &[f64], rng: &mut ChaCha8Rng) -> Vec<f64> {
    let step = |(entry, q): (usize, &f64)| {
        let limits = robot.driven_joint(entry).limits;
        (q + 0.35 * (2.0 * uniform(rng) - 1.0)).clamp(limits.lower, limits.upper)
    };
    q.iter().enumerate().map(step).collect()
}

/// Boxes, cylinders and balls of the size of tableware in a ring around the arm, and the table.
fn objects(rng: &mut ChaCha8Rng) -> Vec<Object> {
    let mut objects = vec![Object { shape: "box", size: vec![1.6, 1.6, 0.04], at: [0.0, 0.0, -0.05], yaw: 0.0 }];
    while objects.len() < N_OBJECTS {
        let (angle, far) = (std::f64::consts::TAU * uniform(rng), 0.35 + 0.4 * uniform(rng));
        let (a, b) = (0.04 + 0.08 * uniform(rng), 0.08 + 0.2 * uniform(rng));
        let (shape, size, height) = match objects.len() % 3 {
            0 => ("box", vec![a, 1.5 * a, b], b),
            1 => ("cylinder", vec![0.5 * a, b], b),
            _ => ("ball", vec![0.6 * a], 1.2 * a),
        };
        let at = [far * libm::cos(angle), far * libm::sin(angle), -0.03 + 0.5 * height];
        objects.push(Object { shape, size, at, yaw: 0.0 });
    }
    objects
}

pub(crate) fn world(objects: &[Object]) -> World {
    let mut world = World::new();
    for (i, object) in objects.iter().enumerate() {
        let [x, y, z] = object.at;
        let root_from_solid = Isometry3::from_parts(Translation3::new(x, y, z), about_z(object.yaw));
        world.add(Obstacle { name: format!("object {i}"), solid: solid(object), root_from_solid });
    }
    world
}

pub(crate) fn solid(object: &Object) -> Solid {
    let size = &object.size;
    match object.shape {
        "box" => Solid::Box { half_extents: [0.5 * size[0], 0.5 * size[1], 0.5 * size[2]] },
        "cylinder" => Solid::Cylinder { radius: size[0], half_length: 0.5 * size[1] },
        _ => Solid::Ball { radius: size[0] },
    }
}

fn request(
    share: &Path,
    robot: &Robot,
    model: &CollisionModel,
    objects: &[Object],
    configurations: &[Vec<f64>],
    seconds: f64,
) -> serde_json::Value {
    let positions: Vec<Vec<f64>> = configurations.iter().map(|q| positions(robot, q)).collect();
    let mut request = described(share, robot, model);
    request["configurations"] = serde_json::json!(positions);
    request["objects"] = serde_json::json!(objects);
    request["seconds"] = seconds.into();
    request
}

/// The Panda as the Python programs take it: file, joints that move, and what is tested for collisions.
pub(crate) fn described(share: &Path, robot: &Robot, model: &CollisionModel) -> serde_json::Value {
    let name = |link: usize| robot.links[link].name.as_str();
    let groups = robot.rigid_groups();
    let moving: Vec<&str> =
        (0..robot.links.len()).filter(|&l| groups[l] != 0 && !robot.links[l].solids.is_empty()).map(name).collect();
    serde_json::json!({
        "urdf": share.join("example-robot-data/robots").join(PANDA.0),
        "package_dirs": [share],
        "joints": moving_joints(robot).map(|joint| joint.name.as_str()).collect::<Vec<_>>(),
        "pairs": model.link_pairs().map(|(a, b)| [name(a), name(b)]).collect::<Vec<_>>(),
        "moving": moving,
    })
}

fn moving_joints(robot: &Robot) -> impl Iterator<Item = &arm::Joint> {
    robot.joints.iter().filter(|joint| joint.kind != arm::JointKind::Fixed)
}

/// Where each of the joints that move is, those that mimic another among them.
pub(crate) fn positions(robot: &Robot, q: &[f64]) -> Vec<f64> {
    moving_joints(robot).map(|joint| joint.position(q)).collect()
}

pub(crate) fn read(share: &Path, file: &str) -> Result<Robot, PeersError> {
    let path = share.join("example-robot-data/robots").join(file);
    let text = read_text(&path, arm::MAX_BYTES).map_err(robot_error)?;
    let folders = Folders::new(&[share.to_owned()], Some(&path)).map_err(robot_error)?;
    Robot::read(&text, &mut |name| folders.find(name), &ReadOptions::default()).map_err(robot_error)
}

pub(crate) fn robot_error(error: impl std::fmt::Display) -> PeersError {
    PeersError::Robot { problem: error.to_string() }
}

/// The interpreter that `tests/run` sets up: it has Pinocchio, Coal and the robots.
pub(crate) fn interpreter() -> PathBuf {
    let root = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../..");
    std::env::var_os("APPRENTICE_PYTHON").map_or_else(|| root.join(".venv/bin/python"), PathBuf::from)
}

/// The folder that holds the package `example-robot-data`.
pub(crate) fn share(python: &Path) -> Result<PathBuf, PeersError> {
    let say = "import sysconfig; print(sysconfig.get_path('purelib'), end='')";
    let output = Command::new(python).args(["-c", say]).output();
    let output = output.map_err(|source| PeersError::NoPython { python: python.to_owned(), source })?;
    let share = PathBuf::from(String::from_utf8_lossy(&output.stdout).into_owned()).join("cmeel.prefix/share");
    if share.join("example-robot-data").is_dir() {
        Ok(share)
    } else {
        Err(PeersError::Robot { problem: "example-robot-data is not installed; run tests/run once".into() })
    }
}

/// Runs one of our Python programs on a request and reads its report; `what` names the report in an error.
pub(crate) fn run<T: DeserializeOwned>(
    python: &Path,
    program: &str,
    request: &serde_json::Value,
    what: &'static str,
) -> Result<T, PeersError> {
    let script = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("python").join(program);
    let failed = |source| PeersError::NoPython { python: python.to_owned(), source };
    let mut child = Command::new(python)
        .arg(&script)
        .env("PYTHONDONTWRITEBYTECODE", "1")
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .spawn()
        .map_err(failed)?;
    if let Some(mut stdin) = child.stdin.take() {
        use std::io::Write;
        stdin.write_all(request.to_string().as_bytes()).map_err(failed)?;
    }
    let output = child.wait_with_output().map_err(failed)?;
    if !output.status.success() {
        return Err(PeersError::Script { script, status: output.status });
    }
    serde_json::from_slice(&output.stdout).map_err(|source| PeersError::Json { what, source })
}
