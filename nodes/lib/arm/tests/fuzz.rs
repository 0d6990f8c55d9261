//! Descriptions and meshes damaged in every way: each is read or refused, and what is read can be used.
//!
//! `PROPTEST_CASES` sets how many; `ARM_FUZZ_CORPUS`, a folder, adds its files to those written here.
#![allow(clippy::unwrap_used, reason = "a test may panic")]

mod common;

use arm::{
    Checker, CollisionModel, Exclusions, Mesh, MeshDetail, MeshFormat, MissingMesh, ReadOptions, Robot, Solid, World,
};
use proptest::prelude::{Strategy, any, prop, prop_assert, prop_assert_eq, proptest};
use std::path::Path;
use std::sync::{Arc, LazyLock};

const TABLE_ARM: &str = include_str!("../../../../config/urdf/table_arm.urdf");
/// Larger files of the corpus are left out: most time would go into copying.
const MAX_FILE: u64 = 120_000;

static MESHES: LazyLock<Vec<(MeshFormat, Vec<u8>)>> = LazyLock::new(|| {
    let mut meshes = vec![
        (MeshFormat::Stl, common::stl_text().into_bytes()),
        (MeshFormat::Stl, common::stl_binary()),
        (MeshFormat::Obj, common::obj().into_bytes()),
        (MeshFormat::Dae, common::dae().into_bytes()),
    ];
    meshes.extend(corpus().into_iter().filter_map(|(name, bytes)| Some((MeshFormat::of(&name).ok()?, bytes))));
    meshes
});

static ROBOTS: LazyLock<Vec<Vec<u8>>> = LazyLock::new(|| {
    let mut robots = vec![TABLE_ARM.as_bytes().to_vec(), common::MESH_ROBOT.as_bytes().to_vec()];
    robots.extend(corpus().into_iter().filter(|(name, _)| name.ends_with(".urdf")).map(|(_, bytes)| bytes));
    robots
});

/// Name and content of every small file below the folder of `ARM_FUZZ_CORPUS`, in order.
fn corpus() -> Vec<(String, Vec<u8>)> {
    fn walk(folder: &Path, found: &mut Vec<(String, Vec<u8>)>) {
        let mut entries: Vec<_> = std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect();
        entries.sort();
        for path in entries {
            if path.is_dir() {
                walk(&path, found);
            } else if path.metadata().is_ok_and(|data| data.len() <= MAX_FILE) {
                found.push((path.to_string_lossy().into_owned(), std::fs::read(&path).unwrap()));
            }
        }
    }
    let mut found = Vec::new();
    if let Some(folder) = std::env::var_os("ARM_FUZZ_CORPUS") {
        walk(Path::new(&folder), &mut found);
    }
    found
}

/// One damage to a file.
#[derive(Debug, Clone)]
enum Damage {
    Put(f64, Vec<u8>),
    Cut(f64, usize),
    Repeat(f64, usize, u8),
    End(f64),
    Number(f64, &'static str),
}

fn damages() -> impl Strategy<Value = Vec<Damage>> {
    let at = 0.0..1.0_f64;
    let number = prop::sample::select(vec![
        "NaN",
        "inf",
        "-inf",
        "1e400",
        "0",
        "-1",
        "4294967295",
        "9223372036854775808",
        "1e-320",
        "",
        "0x1",
        "1,5",
        "--1",
    ]);
    let one = proptest::prop_oneof![
        (at.clone(), prop::collection::vec(any::<u8>(), 1..8)).prop_map(|(at, bytes)| Damage::Put(at, bytes)),
        (at.clone(), 1..200_usize).prop_map(|(at, n)| Damage::Cut(at, n)),
        (at.clone(), 1..300_usize, 1..20_u8).prop_map(|(at, n, times)| Damage::Repeat(at, n, times)),
        at.clone().prop_map(Damage::End),
        (at, number).prop_map(|(at, number)| Damage::Number(at, number)),
    ];
    prop::collection::vec(one, 1..6)
}

fn damaged(mut bytes: Vec<u8>, damages: &[Damage]) -> Vec<u8> {
    for damage in damages {
        let place = |at: f64| ((at * bytes.len() as f64) as usize).min(bytes.len());
        match damage {
            Damage::Put(at, with) => {
                let start = place(*at);
                let end = (start + with.len()).min(bytes.len());
                bytes.splice(start..end, with.iter().copied());
            }
            Damage::Cut(at, n) => {
                let start = place(*at);
                let end = (start + n).min(bytes.len());
                bytes.drain(start..end);
            }
            Damage::Repeat(at, n, times) => {
                let start = place(*at);
                let end = (start + n).min(bytes.len());
                let again = bytes[start..end].repeat(usize::from(*times));
                bytes.splice(start..start, again);
            }
            Damage::End(at) => bytes.truncate(place(*at)),
            // The next number becomes another.
            Damage::Number(at, with) => {
                let is_number = |b: &u8| b.is_ascii_digit() || b"+-.eE".contains(b);
                let Some(start) = (place(*at)..bytes.len()).find(|&i| bytes[i].is_ascii_digit()) else { continue };
                let length = bytes[start..].iter().take_while(|b| is_number(b)).count();
                bytes.splice(start..start + length, with.bytes());
            }
        }
    }
    bytes
}

proptest! {
    #[test]
    fn a_damaged_mesh_is_read_or_refused(pick in any::<prop::sample::Index>(), damages in damages(), pieces in 0..20_u8) {
        let (format, bytes) = &MESHES[pick.index(MESHES.len())];
        match Mesh::read(*format, &damaged(bytes.clone(), &damages)) {
            Err(error) => prop_assert!(!error.to_string().contains('\n')),
            Ok(mesh) => {
                prop_assert!(!mesh.triangles.is_empty());
                prop_assert!(mesh.triangles.iter().flatten().all(|&i| (i as usize) < mesh.vertices.len()));
                prop_assert!(mesh.vertices.iter().flatten().all(|v| v.is_finite()));
                let solid = if pieces == 0 { Solid::pieces_of(&mesh, 16, 4) } else { Solid::hull_of(&mesh) };
                let Some(Solid::Hulls(hulls)) = solid else { panic!("a mesh without a hull") };
                prop_assert!(hulls.iter().all(|hull| hull.volume() > 0.0 && hull.corners().len() >= 4));
            }
        }
    }

    #[test]
    fn a_damaged_robot_is_read_or_refused(
        pick in any::<prop::sample::Index>(),
        damages in damages(),
        mesh in any::<prop::sample::Index>(),
        bound in any::<bool>(),
    ) {
        let text = damaged(ROBOTS[pick.index(ROBOTS.len())].clone(), &damages);
        let (format, bytes) = &MESHES[mesh.index(MESHES.len())];
        let mut find = |name: &str| {
            if MeshFormat::of(name) == Ok(*format) { Ok(bytes.clone()) } else { Err("not found".to_owned()) }
        };
        let missing = if bound { MissingMesh::Bound } else { MissingMesh::Refuse };
        let options = ReadOptions { missing, detail: MeshDetail::Hull };
        match Robot::read(&String::from_utf8_lossy(&text), &mut find, &options) {
            Err(error) => prop_assert!(!error.to_string().contains('\n'), "{error}"),
            Ok(robot) => {
                prop_assert!(robot.problems.iter().all(|problem| !problem.to_string().contains('\n')));
                let robot = Arc::new(robot);
                let model = CollisionModel::new(&robot, &Exclusions::none());
                let mut checker = Checker::new(Arc::clone(&robot), Arc::new(model));
                let rest = robot.rest();
                prop_assert!(checker.poses(&rest).iter().all(|pose| pose.translation.vector.iter().all(|v| v.is_finite())));
                let contacts = checker.contacts(&rest, &World::new(), 0.0);
                prop_assert_eq!(contacts.is_empty(), checker.is_free(&rest, &World::new(), 0.0));
            }
        }
    }

    #[test]
    fn a_damaged_srdf_is_read_or_refused(damages in damages()) {
        let robot = Robot::from_urdf(TABLE_ARM).unwrap();
        let srdf = "<?xml version='1.0'?>\n<robot name='r'>\n<group name='arm'><joint name='elbow'/></group>\n\
            <disable_default_collisions link='tool0'/>\n<disable_collisions link1='base_link' link2='palm_link' reason='Never'/>\n\
            <enable_collisions link1='base_link' link2='shoulder_link'/>\n</robot>\n";
        let text = damaged(srdf.as_bytes().to_vec(), &damages);
        if let Err(error) = Exclusions::from_srdf(&robot, &String::from_utf8_lossy(&text)) {
            prop_assert!(!error.to_string().contains('\n'));
        }
    }
}
