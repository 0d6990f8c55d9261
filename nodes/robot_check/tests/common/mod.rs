//! Robots that nobody here wrote: those of the PyPI package `example-robot-data`, which `tests/run` installs.
#![allow(dead_code, reason = "each test uses some of it")]

use arm::{Exclusions, MissingMesh, ReadOptions, Robot};
use robot_files::{Folders, read_text};
use serde_json::Value;
use std::io::Write;
use std::path::PathBuf;
use std::process::{Command, Stdio};

/// The interpreter that has the packages.
pub fn interpreter() -> PathBuf {
    let root = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../..");
    let path = std::env::var_os("APPRENTICE_PYTHON").map_or_else(|| root.join(".venv/bin/python"), PathBuf::from);
    assert!(path.is_file(), "{} is missing; run `tests/run` once, which installs it", path.display());
    path
}

/// The folder that holds the package `example-robot-data`.
pub fn share() -> PathBuf {
    let say = "import sysconfig; print(sysconfig.get_path('purelib'), end='')";
    let output = Command::new(interpreter()).args(["-c", say]).output().expect("Python runs");
    let site = String::from_utf8(output.stdout).expect("a path");
    let share = PathBuf::from(site).join("cmeel.prefix/share");
    assert!(share.join("example-robot-data/robots").is_dir(), "example-robot-data is missing; run `tests/run` once");
    share
}

/// A robot of the package, by its file below `robots`.
pub fn urdf(file: &str) -> PathBuf {
    share().join("example-robot-data/robots").join(file)
}

/// Reads a robot with its meshes.
pub fn read(file: &str, options: &ReadOptions) -> Result<Robot, String> {
    let path = urdf(file);
    let text = read_text(&path, arm::MAX_BYTES).map_err(|error| error.to_string())?;
    let folders = Folders::new(&[share()], Some(&path)).map_err(|error| error.to_string())?;
    Robot::read(&text, &mut |name| folders.find(name), options).map_err(|error| error.to_string())
}

/// With hulls, every mesh being there.
pub fn robot(file: &str) -> Robot {
    let options = ReadOptions { missing: MissingMesh::Refuse, ..ReadOptions::default() };
    read(file, &options).unwrap_or_else(|error| panic!("{file}: {error}"))
}

/// Every pair of links that can move against each other is tested.
pub fn all_pairs(robot: &Robot) -> Exclusions {
    let mut all = Exclusions::none();
    let n = robot.links.len();
    (0..n).for_each(|a| (a + 1..n).for_each(|b| all.enable_pair(a, b)));
    all
}

/// Numbers between 0 and 1 that are the same everywhere.
pub fn uniform(state: &mut u64) -> f64 {
    // SplitMix64 (Steele, Lea and Flood 2014).
    *state = state.wrapping_add(0x9e37_79b9_7f4a_7c15);
    let mut z = *state;
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    ((z ^ (z >> 31)) >> 11) as f64 / (1_u64 << 53) as f64
}

/// Configurations drawn uniformly within the limits, a joint without limits from one turn.
pub fn configurations(robot: &Robot, n: usize, seed: u64) -> Vec<Vec<f64>> {
    let mut state = seed;
    let range = |entry: usize| {
        let limits = robot.driven_joint(entry).limits;
        let pi = std::f64::consts::PI;
        (
            if limits.lower.is_finite() { limits.lower } else { -pi },
            if limits.upper.is_finite() { limits.upper } else { pi },
        )
    };
    let mut draw = |entry: usize| {
        let (lower, upper) = range(entry);
        lower + (upper - lower) * uniform(&mut state)
    };
    (0..n).map(|_| (0..robot.dof()).map(&mut draw).collect()).collect()
}

/// Names of all moving joints, those that mimic too, and their positions in configurations.
fn positions(robot: &Robot, configurations: &[Vec<f64>]) -> (Vec<String>, Vec<Vec<f64>>) {
    let moving = || robot.joints.iter().filter(|joint| joint.kind != arm::JointKind::Fixed);
    let names = moving().map(|joint| joint.name.clone()).collect();
    (names, configurations.iter().map(|q| moving().map(|joint| joint.position(q)).collect()).collect())
}

/// What to ask Pinocchio and Coal about a robot: where its links are and, if `collide`, which of them touch.
pub fn request(file: &str, robot: &Robot, configurations: &[Vec<f64>], collide: bool) -> Value {
    let (joints, positions) = positions(robot, configurations);
    serde_json::json!({
        "urdf": urdf(file), "package_dirs": [share()], "joints": joints, "positions": positions, "collide": collide,
    })
}

/// What they say: `tests/python/arm_peer.py`.
pub fn peer(requests: &[Value]) -> Vec<Value> {
    let script = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../tests/python/arm_peer.py");
    let mut child = Command::new(interpreter())
        .arg(script)
        .env("PYTHONDONTWRITEBYTECODE", "1")
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .spawn()
        .expect("Python runs");
    let mut stdin = child.stdin.take().expect("it was asked for");
    stdin.write_all(serde_json::to_string(requests).expect("JSON").as_bytes()).expect("it reads");
    drop(stdin);
    let output = child.wait_with_output().expect("it ends");
    assert!(output.status.success(), "the Python program failed: {}", output.status);
    serde_json::from_slice(&output.stdout).expect("JSON")
}
