//! Robots that nobody here wrote: where their links are against Pinocchio, what touches against Coal.
#![allow(clippy::unwrap_used, reason = "a test may panic")]

mod common;

use arm::{
    Body, Chain, Checker, CollisionModel, Exclusions, Goal, IkOutcome, IkSettings, Isometry3, MissingMesh, ReadOptions,
    Robot, Solid, Translation3, UnitQuaternion, Vector3, World, solid_distance, solve,
};
use common::{all_pairs, configurations, peer, read, request, robot, share, uniform, urdf};
use serde_json::Value;
use std::collections::BTreeMap;
use std::sync::Arc;

/// File below the package's folder, driven joints, configurations for collisions.
const ROBOTS: [(&str, usize, usize); 7] = [
    ("panda_description/urdf/panda.urdf", 8, 500),
    ("ur_description/urdf/ur5_robot.urdf", 6, 500),
    ("ur_description/urdf/ur10_robot.urdf", 6, 100),
    ("kinova_description/robots/kinova.urdf", 6, 100),
    ("xarm_description/urdf/xarm7.urdf", 7, 100),
    ("so_arm_description/urdf/so101.urdf", 6, 60),
    ("baxter_description/urdf/baxter.urdf", 17, 30),
];

fn pose(value: &Value) -> Isometry3<f64> {
    let v: Vec<f64> = value.as_array().unwrap().iter().map(|v| v.as_f64().unwrap()).collect();
    let rotation = nalgebra::Quaternion::new(v[6], v[3], v[4], v[5]);
    Isometry3::from_parts(Translation3::new(v[0], v[1], v[2]), UnitQuaternion::from_quaternion(rotation))
}

/// The largest difference of any entry of two poses' matrices.
fn difference(a: &Isometry3<f64>, b: &Isometry3<f64>) -> f64 {
    (a.to_homogeneous() - b.to_homogeneous()).abs().max()
}

/// Compares all links; returns how many poses.
fn compare_links(robot: &Robot, file: &str, configurations: &[Vec<f64>], links: &Value) -> usize {
    let links = links.as_object().unwrap();
    let mut poses = Vec::new();
    let mut n = 0;
    for (i, q) in configurations.iter().enumerate() {
        robot.link_poses(q, &mut poses);
        for (link, ours) in robot.links.iter().zip(&poses) {
            let theirs = links.get(&link.name).unwrap_or_else(|| panic!("{file}: Pinocchio has no link {}", link.name));
            let off = difference(ours, &pose(&theirs[i]));
            assert!(off < 1e-9, "{file}: {} is off by {off:e} in configuration {i}", link.name);
            n += 1;
        }
        // The short way along a chain is the same as the long one.
        for (link, ours) in robot.links.iter().zip(&poses).rev().take(3) {
            if let Ok(chain) = Chain::new(robot, &link.name) {
                assert!(difference(ours, &chain.tool_pose(q)) < 1e-12);
            }
        }
    }
    n
}

#[test]
fn links_are_where_pinocchio_has_them_and_touch_where_coal_says() {
    for (file, dof, n) in ROBOTS {
        let robot = Arc::new(robot(file));
        assert_eq!(robot.dof(), dof, "{file}");
        let configurations = configurations(&robot, n, 7);
        let answer = &peer(&[request(file, &robot, &configurations, true)])[0];
        let n_poses = compare_links(&robot, file, &configurations, &answer["links"]);
        // (configuration, link, link): the mesh touches, the hull touches, distance of the hulls.
        let mut theirs: BTreeMap<(usize, usize, usize), (bool, bool, f64)> = BTreeMap::new();
        for found in answer["pairs"].as_array().unwrap() {
            let link = |value: &Value| robot.link_index(value.as_str().unwrap()).unwrap();
            let (a, b) = (link(&found[1]), link(&found[2]));
            let key = (found[0].as_u64().unwrap() as usize, a.min(b), a.max(b));
            let (mesh, hull) = (found[3].as_bool().unwrap(), found[4].as_bool().unwrap());
            let entry = theirs.entry(key).or_insert((false, false, f64::INFINITY));
            *entry = (entry.0 || mesh, entry.1 || hull, entry.2.min(found[5].as_f64().unwrap()));
        }
        let model = CollisionModel::new(&robot, &all_pairs(&robot));
        let pairs: Vec<(usize, usize)> = model.link_pairs().collect();
        let mut checker = Checker::new(Arc::clone(&robot), Arc::new(model));
        let world = World::new();
        let (mut both, mut neither, mut hull_only) = (0, 0, 0);
        for (i, q) in configurations.iter().enumerate() {
            let contacts = checker.contacts(q, &world, 0.0);
            for &(a, b) in &pairs {
                let ours = contacts.iter().any(|contact| (contact.a, contact.b) == (Body::Link(a), Body::Link(b)));
                let (mesh, hull, gap) = theirs.get(&(i, a, b)).copied().unwrap_or((false, false, f64::INFINITY));
                let names = || format!("{file}: {} and {} in {i}", robot.links[a].name, robot.links[b].name);
                // Hull against hull there is one answer, unless they touch to within rounding of the meshes' 32 bits.
                assert!(ours == hull || gap.abs() < 1e-6, "{}: we say {ours}, Coal's hulls {hull} at {gap:e}", names());
                // Against the mesh itself a hull may touch where the mesh has a hollow, and never the other way round.
                assert!(!mesh || hull, "{}: a mesh touches and its hull does not", names());
                match (mesh, ours) {
                    (true, true) => both += 1,
                    (false, false) => neither += 1,
                    (false, true) => hull_only += 1,
                    (true, false) => assert!(gap.abs() < 1e-6, "{}: missed at {gap:e}", names()),
                }
            }
        }
        println!(
            "{file}: {n_poses} poses, {n} configurations: {both} contacts and {neither} gaps agree, {hull_only} contacts of hulls only"
        );
        assert!(both > 10 || file.contains("xarm"), "{file}: the comparison saw contacts");
    }
}

#[test]
fn distances_are_those_of_coal() {
    let file = "panda_description/urdf/panda.urdf";
    let robot = Arc::new(robot(file));
    let configurations = configurations(&robot, 60, 11);
    let answer = &peer(&[request(file, &robot, &configurations, true)])[0];
    let mut theirs: BTreeMap<(usize, usize, usize), f64> = BTreeMap::new();
    for found in answer["pairs"].as_array().unwrap() {
        let link = |value: &Value| robot.link_index(value.as_str().unwrap()).unwrap();
        let (a, b) = (link(&found[1]), link(&found[2]));
        let entry = theirs.entry((found[0].as_u64().unwrap() as usize, a.min(b), a.max(b))).or_insert(f64::INFINITY);
        *entry = entry.min(found[5].as_f64().unwrap());
    }
    let mut poses = Vec::new();
    let mut n = 0;
    for (&(i, a, b), &gap) in &theirs {
        robot.link_poses(&configurations[i], &mut poses);
        let of = |link: usize| robot.links[link].solids.iter().map(move |placed| (placed, link));
        let mut least = f64::INFINITY;
        for (first, a) in of(a) {
            for (second, b) in of(b) {
                let at = |placed: &arm::Placed, link: usize| poses[link] * placed.owner_from_solid;
                least = least.min(solid_distance(&first.solid, &at(first, a), &second.solid, &at(second, b)));
            }
        }
        // Only pairs whose spheres meet are in the answer, so a nearer one of the same links may be missing above.
        if gap > 0.0 && least > 0.0 {
            assert!((least - gap).abs() < 1e-6, "{} and {}: {least} {gap}", robot.links[a].name, robot.links[b].name);
            n += 1;
        }
    }
    assert!(n > 100, "{n}");
}

#[test]
fn every_robot_of_the_package_is_read_or_refused_with_a_reason() {
    let mut files = Vec::new();
    let mut folders = vec![share().join("example-robot-data/robots")];
    while let Some(folder) = folders.pop() {
        for entry in std::fs::read_dir(folder).unwrap() {
            let path = entry.unwrap().path();
            if path.is_dir() {
                folders.push(path);
            } else if path.extension().is_some_and(|e| e == "urdf") {
                files.push(path.strip_prefix(urdf("")).unwrap().to_string_lossy().into_owned());
            }
        }
    }
    files.sort();
    let options = ReadOptions { missing: MissingMesh::Bound, ..ReadOptions::default() };
    let mut refused = Vec::new();
    let (mut asked, mut requests) = (Vec::new(), Vec::new());
    for file in &files {
        let robot = match read(file, &options) {
            Err(error) => {
                refused.push(format!("{file}: {error}"));
                continue;
            }
            Ok(robot) => robot,
        };
        // Pinocchio lets floating joints move.
        if robot.problems.iter().any(|p| p.what.contains("is floating") || p.what.contains("is planar")) {
            continue;
        }
        let configurations = configurations(&robot, 3, 5);
        requests.push(request(file, &robot, &configurations, false));
        asked.push((file, robot, configurations));
    }
    for ((file, robot, configurations), answer) in asked.iter().zip(peer(&requests)) {
        compare_links(robot, file, configurations, &answer["links"]);
    }
    let compared = asked.len();
    println!("{} robots, {compared} compared; refused:\n{}", files.len(), refused.join("\n"));
    assert!(files.len() >= 60 && compared >= 55, "{} {compared}\n{}", files.len(), refused.join("\n"));
    // A mimicked joint that is not there, three textures without a name, a file without a robot.
    assert!(refused.len() <= 5, "{}", refused.join("\n"));
    assert!(
        refused.iter().all(|reason| reason.contains("line ") || reason.contains("holds no link")),
        "{}",
        refused.join("\n")
    );
}

#[test]
fn a_thousand_reachable_poses_are_solved_for_panda_and_ur5() {
    for (file, tool) in
        [("panda_description/urdf/panda.urdf", "panda_hand_tcp"), ("ur_description/urdf/ur5_robot.urdf", "tool0")]
    {
        let robot = robot(file);
        let chain = Chain::new(&robot, tool).unwrap();
        let settings = IkSettings { restarts: 50, ..IkSettings::default() };
        let start = robot.rest();
        let mut solved = 0;
        for q in configurations(&robot, 1000, 3) {
            let pose = chain.tool_pose(&q);
            if let IkOutcome::Solved(found) = solve(&robot, &chain, &Goal::Pose(pose), &start, &settings, |_| true) {
                let off = pose.inverse() * chain.tool_pose(&found);
                assert!(off.translation.vector.norm() <= 1.01e-6 && off.rotation.angle() <= 1.1e-6);
                assert!(robot.within_limits(&found));
                solved += 1;
            }
        }
        println!("{file}: {solved} of 1000");
        assert!(solved >= 990, "{file}: {solved} of 1000");
    }
}

#[test]
fn hulls_hold_every_vertex_of_their_meshes() {
    for (file, ..) in ROBOTS {
        let robot = robot(file);
        for link in &robot.links {
            for (placed, mesh) in link.solids.iter().filter(|p| matches!(p.solid, Solid::Hulls(_))).zip(&link.meshes) {
                let folders = robot_files::Folders::new(&[share()], Some(&urdf(file))).unwrap();
                let bytes = folders.find(&mesh.file).unwrap();
                let read = arm::Mesh::read(arm::MeshFormat::of(&mesh.file).unwrap(), &bytes).unwrap();
                let Solid::Hulls(hulls) = &placed.solid else { panic!("a mesh that is no hull") };
                // In every direction the hull reaches exactly as far as the vertices do.
                let mut state = 9;
                for _ in 0..200 {
                    let d = Vector3::from_fn(|_, _| 2.0 * uniform(&mut state) - 1.0);
                    let of_mesh = read.used_vertices().iter().map(|v| v.dot(&d)).fold(f64::NEG_INFINITY, f64::max);
                    let of_hull = hulls
                        .iter()
                        .flat_map(|hull| hull.corners())
                        .map(|c| c.dot(&d))
                        .fold(f64::NEG_INFINITY, f64::max);
                    assert!((of_mesh - of_hull).abs() < 1e-9, "{file}: {}: {of_mesh} {of_hull}", mesh.file);
                }
            }
        }
    }
}

#[test]
fn srdfs_of_others_are_read() {
    for (urdf_file, srdf) in [
        ("panda_description/urdf/panda.urdf", "panda_description/srdf/panda.srdf"),
        ("ur_description/urdf/ur5_gripper.urdf", "ur_description/srdf/ur5_gripper.srdf"),
        ("kinova_description/robots/kinova.urdf", "kinova_description/srdf/kinova.srdf"),
        ("xarm_description/urdf/xarm7.urdf", "xarm_description/srdf/xarm7.srdf"),
        ("baxter_description/urdf/baxter.urdf", "baxter_description/srdf/baxter_manipulation.srdf"),
    ] {
        let robot = robot(urdf_file);
        let text = robot_files::read_text(&urdf(srdf), arm::MAX_BYTES).unwrap();
        let (exclusions, problems) = Exclusions::from_srdf(&robot, &text).unwrap();
        println!("{srdf}: {} pairs, {problems:?}", exclusions.len());
        assert!(problems.iter().all(|p| p.line > 0));
    }
}
