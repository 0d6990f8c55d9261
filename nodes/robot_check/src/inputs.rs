//! The files of the command line.

use crate::{Robot as Arguments, RobotError};
use arm::{Exclusions, MAX_BYTES, MeshDetail, MissingMesh, Problem, ReadOptions, Robot};
use robot_files::{Folders, read_text};
use serde_json::Value;
use std::path::Path;

/// Largest file of joint positions, bytes.
const MAX_JOINTS_BYTES: usize = 100_000_000;
/// Most postures in it.
const MAX_POSTURES: usize = 100_000;

/// The robot, its meshes read; missing ones are an error unless bounding shapes were asked for.
pub(crate) fn robot(arguments: &Arguments) -> Result<Robot, RobotError> {
    let text = read_text(&arguments.urdf, MAX_BYTES)?;
    let folders = Folders::new(&arguments.package_path, Some(&arguments.urdf))?;
    let detail = if arguments.pieces { MeshDetail::Pieces { resolution: 48, most: 24 } } else { MeshDetail::Hull };
    // Bounding shapes first, so that all missing meshes are listed, not only the first.
    let options = ReadOptions { missing: MissingMesh::Bound, detail };
    let path = || arguments.urdf.clone();
    let mut robot = Robot::read(&text, &mut |name| folders.find(name), &options)
        .map_err(|source| RobotError::Urdf { path: path(), source })?;
    if !arguments.bounding_shapes && robot.links.iter().flat_map(|link| &link.meshes).any(|mesh| mesh.n_triangles == 0)
    {
        let about_mesh = |problem: &Problem| problem.what.contains("stands in for it");
        let mut problems: Vec<Problem> = robot.problems.drain(..).filter(about_mesh).collect();
        for problem in &mut problems {
            if let Some((what, _)) = problem.what.split_once("; a box of ") {
                problem.what = what.to_owned();
            }
            problem.advice = "give its folder with --package-path DIR, or go on with --bounding-shapes".into();
        }
        return Err(RobotError::Meshes { path: path(), problems });
    }
    Ok(robot)
}

/// The pairs not to test, and what is odd about their list.
pub(crate) fn exclusions(arguments: &Arguments, robot: &Robot) -> Result<(Exclusions, Vec<Problem>), RobotError> {
    let (exclusions, problems) = match &arguments.srdf {
        None => (Exclusions::none(), Vec::new()),
        Some(path) => {
            let text = read_text(path, MAX_BYTES)?;
            let srdf = Exclusions::from_srdf(robot, &text);
            srdf.map_err(|source| RobotError::Srdf { path: path.clone(), source })?
        }
    };
    if arguments.all_pairs {
        let mut all = Exclusions::none();
        let links = robot.links.len();
        (0..links).for_each(|a| (a + 1..links).for_each(|b| all.enable_pair(a, b)));
        return Ok((all, problems));
    }
    if arguments.srdf.is_some() {
        Ok((exclusions, problems))
    } else {
        Ok((Exclusions::derived(robot, arguments.seed), problems))
    }
}

/// Joint positions by name; whether the file held a list of them.
pub(crate) type Postures = (Vec<Vec<(String, f64)>>, bool);

/// Reads the file of joint positions; without one, all are 0.
pub(crate) fn postures(path: Option<&Path>, robot: &Robot) -> Result<Postures, RobotError> {
    let Some(path) = path else { return Ok((vec![Vec::new()], false)) };
    let wrong = |problem: String| RobotError::Joints { path: path.to_owned(), problem };
    let text = read_text(path, MAX_JOINTS_BYTES)?;
    let value: Value = serde_json::from_str(&text).map_err(|error| wrong(format!("no JSON: {error}")))?;
    let (list, is_list) = match value {
        Value::Array(list) => (list, true),
        one => (vec![one], false),
    };
    if list.is_empty() || list.len() > MAX_POSTURES {
        return Err(wrong(format!("{} postures; 1 to {MAX_POSTURES} are read", list.len())));
    }
    let postures = list.iter().enumerate().map(|(i, value)| {
        let place = if is_list { format!("posture {i}: ") } else { String::new() };
        posture(value, robot).map_err(|problem| wrong(format!("{place}{problem}")))
    });
    Ok((postures.collect::<Result<_, _>>()?, is_list))
}

fn posture(value: &Value, robot: &Robot) -> Result<Vec<(String, f64)>, String> {
    let Value::Object(object) = value else {
        return Err("expected an object of joint names and positions, such as {\"joint1\": 0.5}".into());
    };
    let moving = || robot.joints.iter().filter(|joint| joint.kind != arm::JointKind::Fixed);
    let mut posture = Vec::with_capacity(object.len());
    for (name, position) in object {
        let short: String = name.chars().take(80).collect();
        if !moving().any(|joint| joint.name == *name) {
            let nearest = moving().map(|joint| (strsim::damerau_levenshtein(&joint.name, &short), &joint.name)).min();
            let hint = match nearest {
                Some((distance, nearest)) if distance <= 4 => format!("did you mean '{nearest}'?"),
                _ => format!(
                    "its moving joints are: {}",
                    moving().map(|j| j.name.as_str()).take(20).collect::<Vec<_>>().join(", ")
                ),
            };
            return Err(format!("the robot has no moving joint '{short}'; {hint}"));
        }
        let position = position.as_f64().filter(|position| position.is_finite());
        let position = position.ok_or_else(|| format!("the position of '{short}' is no finite number"))?;
        posture.push((name.clone(), position));
    }
    Ok(posture)
}
