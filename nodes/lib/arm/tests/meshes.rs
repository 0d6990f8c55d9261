//! Meshes in every format, good and bad, and robots made of them.
#![allow(clippy::unwrap_used, reason = "a test may panic")]

mod common;

use arm::{
    Exclusions, Isometry3, MAX_MESH_BYTES, Mesh, MeshDetail, MeshError, MeshFormat, MissingMesh, Obstacle, ReadOptions,
    Robot, Solid, UrdfError, Vector3, World, solid_distance,
};
use common::{MESH_ROBOT, dae, find, obj, stl_binary, stl_text};

fn bounds(mesh: &Mesh) -> (Vector3<f64>, Vector3<f64>) {
    let nothing = (Vector3::repeat(f64::INFINITY), Vector3::repeat(f64::NEG_INFINITY));
    mesh.used_vertices().iter().fold(nothing, |(low, high), v| (low.inf(v), high.sup(v)))
}

#[test]
fn a_cube_is_the_same_cube_in_every_format() {
    for (format, bytes) in [
        (MeshFormat::Stl, stl_text().into_bytes()),
        (MeshFormat::Stl, stl_binary()),
        (MeshFormat::Obj, obj().into_bytes()),
    ] {
        let mesh = Mesh::read(format, &bytes).unwrap();
        assert_eq!(mesh.triangles.len(), 12);
        assert_eq!(bounds(&mesh), (Vector3::repeat(-1.0), Vector3::repeat(1.0)));
        assert!((mesh.volume() - 8.0).abs() < 1e-12, "{format:?}");
        let Some(Solid::Hulls(hulls)) = Solid::hull_of(&mesh) else { panic!("no hull") };
        assert_eq!((hulls.len(), hulls[0].corners().len()), (1, 8));
        assert!((hulls[0].volume() - 8.0).abs() < 1e-12);
    }
}

#[test]
fn collada_units_nodes_and_repeated_geometries_count() {
    let mesh = Mesh::read(MeshFormat::Dae, dae().as_bytes()).unwrap();
    assert_eq!(mesh.triangles.len(), 24);
    // Scaled by 10 around a node moved by (0, 0, 5), in centimetres; and (30, 0, 0) turned by a quarter turn.
    let (low, high) = bounds(&mesh);
    assert!((low - Vector3::new(-0.1, -0.1, -0.01)).norm() < 1e-12, "{low}");
    assert!((high - Vector3::new(0.1, 0.31, 0.6)).norm() < 1e-12, "{high}");
    // Without a scene the geometry stands as it is written.
    let bare = dae().replace("<instance_visual_scene url=\"#scene\"/>", "").replace("library_visual_scenes", "extra");
    let (low, high) = bounds(&Mesh::read(MeshFormat::Dae, bare.as_bytes()).unwrap());
    assert!((low + Vector3::repeat(0.01)).norm() < 1e-12 && (high - Vector3::repeat(0.01)).norm() < 1e-12);
}

#[test]
fn formats_are_told_by_the_name() {
    for (name, format) in
        [("a/b.STL", MeshFormat::Stl), ("package://p/x.y.dae", MeshFormat::Dae), ("other/c.Obj", MeshFormat::Obj)]
    {
        assert_eq!(MeshFormat::of(name), Ok(format));
    }
    for name in ["stl", "a.stl/b", "a.glb", ""] {
        assert!(matches!(MeshFormat::of(name), Err(MeshError::Format { .. })), "{name}");
    }
}

#[test]
fn each_broken_mesh_has_its_message() {
    let declared = |n: u32| {
        let mut bytes = stl_binary();
        bytes[80..84].copy_from_slice(&n.to_le_bytes());
        bytes
    };
    let mut nan = stl_binary();
    nan[96..100].copy_from_slice(&f32::NAN.to_le_bytes());
    let dae_with = |from: &str, to: &str| dae().replace(from, to).into_bytes();
    let circle = "<library_nodes><node id=\"again\"><instance_node url=\"#again\"/>";
    let cases: Vec<(MeshFormat, Vec<u8>, &str)> = vec![
        (MeshFormat::Stl, vec![], "byte 0: neither text nor a binary header"),
        (MeshFormat::Stl, declared(13), "cut off: it declares 13 triangles and holds 12"),
        (MeshFormat::Stl, declared(u32::MAX), "more than 1000000 triangles"),
        (MeshFormat::Stl, declared(0)[..84].to_vec(), "it holds no triangle"),
        (MeshFormat::Stl, nan, "triangle 0: 'NaN' is no finite number"),
        (MeshFormat::Stl, stl_text().replace("1 1 1", "1 1 inf").into_bytes(), "line 20: 'inf' is no finite number"),
        (MeshFormat::Stl, stl_text().replacen("endloop", "vertex 0 0 0", 1).into_bytes(), "line 7: a facet with more"),
        (MeshFormat::Stl, stl_text().replacen("vertex", "corner", 1).into_bytes(), "line 7: a facet with fewer"),
        (MeshFormat::Stl, stl_text().as_bytes()[..400].to_vec(), "the end: cut off"),
        (MeshFormat::Obj, b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 4".to_vec(), "line 4: index 4, but there are 3 vertices"),
        (MeshFormat::Obj, b"v 0 0 0\nf 1 0 1".to_vec(), "line 2: index 0"),
        (MeshFormat::Obj, b"v 0 0 0\nf -1 -2 -1".to_vec(), "line 2: index -2"),
        (MeshFormat::Obj, b"v 0 0 0\nf 1 1".to_vec(), "line 2: a face with fewer than three corners"),
        (MeshFormat::Obj, b"v 0 0".to_vec(), "line 1: '' is no finite number"),
        (MeshFormat::Obj, b"v 0 0 1e99".to_vec(), "line 1: '1e99' is no finite number of at most 1000000"),
        (MeshFormat::Obj, b"f 99999999999999999999 1 1".to_vec(), "line 1: a face whose corner is no whole number"),
        (MeshFormat::Obj, b"v 0 0 0".to_vec(), "it holds no triangle"),
        (MeshFormat::Dae, b"".to_vec(), "it holds no triangle"),
        (MeshFormat::Dae, b"<svg/>".to_vec(), "<svg>: the outermost element should be <COLLADA>"),
        (MeshFormat::Dae, "<COLLADA>".repeat(100_000).into_bytes(), "byte 585: elements nested more than 64 deep"),
        (MeshFormat::Dae, b"<!DOCTYPE x [<!ENTITY a 'b'>]><COLLADA/>".to_vec(), "byte 30: a document type declaration"),
        (MeshFormat::Dae, dae().as_bytes()[..900].to_vec(), "byte 900:"),
        (MeshFormat::Dae, dae_with("meter=\"0.01\"", "meter=\"0\""), "<unit meter>: '0' is no finite number"),
        (MeshFormat::Dae, dae_with("0 0 3 0", "0 0 8 0"), "<polylist>: index 8, but there are 8 vertices"),
        (MeshFormat::Dae, dae_with("0 0 3 0", "0 0 -1 0"), "<polylist>: index -1, but there are 8 vertices"),
        (MeshFormat::Dae, dae_with("<vcount>4", "<vcount>9999999999"), "<polylist>: cut off: fewer corners"),
        (MeshFormat::Dae, dae_with("-1 -1 -1 1", "-1 -1 NaN 1"), "<float_array id=\"w\">: 'NaN' is no finite number"),
        (
            MeshFormat::Dae,
            dae_with("source=\"#where\"", "source=\"#there\""),
            "<vertices id=\"v\">: its source of positions",
        ),
        (MeshFormat::Dae, dae_with("url=\"#cube\"", "url=\"#ball\""), "the scene: an instance of the geometry 'ball'"),
        (
            MeshFormat::Dae,
            dae_with("url=\"#cube\"", "url=\"cube.dae\""),
            "<instance_geometry>: its 'url' names nothing",
        ),
        (
            MeshFormat::Dae,
            dae_with("<library_nodes><node id=\"again\">", circle),
            "<node id=\"again\">: nodes refer to each other",
        ),
    ];
    for (format, bytes, expected) in cases {
        let message = Mesh::read(format, &bytes).expect_err(expected).to_string();
        assert!(message.starts_with(expected), "got: {message}\nwanted: {expected}");
    }
    assert!(matches!(Mesh::read(MeshFormat::Stl, &vec![0; MAX_MESH_BYTES + 1]), Err(MeshError::TooLarge { .. })));
}

#[test]
fn nodes_that_refer_to_each_other_twice_do_not_grow_without_bound() {
    let nodes: String = (0..60)
        .map(|i| {
            let next = format!("<instance_node url=\"#n{}\"/>", i + 1);
            format!("<node id=\"n{i}\">{next}{next}</node>")
        })
        .collect();
    let text = dae()
        .replace(
            "<library_nodes>",
            &format!("<library_nodes>{nodes}<node id=\"n60\"><instance_geometry url=\"#cube\"/></node>"),
        )
        .replace("url=\"#again\"", "url=\"#n0\"");
    let error = Mesh::read(MeshFormat::Dae, text.as_bytes()).unwrap_err();
    assert!(matches!(error, MeshError::TooMany { .. }), "{error}");
}

#[test]
fn a_robot_takes_its_meshes_scaled_and_placed() {
    let mut asked = Vec::new();
    let mut finder = |name: &str| {
        asked.push(name.to_owned());
        find(name)
    };
    let robot = Robot::read(MESH_ROBOT, &mut finder, &ReadOptions::default()).unwrap();
    let tip = &robot.links[1];
    let (low, high) = tip.solids[0].solid.bounds();
    assert!((low + Vector3::new(0.1, 0.1, 0.2)).norm() < 1e-12 && (high - Vector3::new(0.1, 0.1, 0.2)).norm() < 1e-12);
    assert_eq!(tip.solids[0].owner_from_solid, Isometry3::translation(0.0, 0.0, 0.5));
    assert_eq!((tip.meshes.len(), tip.meshes[0].n_triangles, tip.meshes[1].n_triangles), (2, 12, 24));
    // The hull of the two cubes of the COLLADA file is much larger than both.
    assert!(
        robot.problems.iter().any(|p| p.what.starts_with("the convex hull of cube.dae of link 'tip' has")),
        "{:?}",
        robot.problems
    );
    assert_eq!(asked, ["package://p/cube.stl", "cube.obj", "cube.dae"]);
}

#[test]
fn a_missing_mesh_is_refused_or_bounded_as_asked() {
    let mut none = |name: &str| Err(format!("no {name} here"));
    let refused = Robot::read(MESH_ROBOT, &mut none, &ReadOptions::default()).unwrap_err();
    assert_eq!(
        refused.to_string(),
        "line 2: the collision mesh of link 'base' cannot be used: package://p/cube.stl: no package://p/cube.stl here; \
         give it, or accept a bounding shape in its place"
    );
    assert_eq!(refused.line(), 2);
    let options = ReadOptions { missing: MissingMesh::Bound, ..ReadOptions::default() };
    let robot = Robot::read(MESH_ROBOT, &mut none, &options).unwrap();
    let said: Vec<String> = robot.problems.iter().map(ToString::to_string).collect();
    assert_eq!(said.len(), 3, "{said:?}");
    assert!(
        said[0].starts_with("line 2: the collision mesh of link 'base' cannot be used") && said[0].contains("a guess")
    );
    // The base reaches from its frame to the joint at 3 m; the tip is as large as its inertia says: a cube of mass 1.2 and
    // moment 0.01 has the side √(6 · 0.01 / 1.2), about its middle 0.1 m up.
    let (low, high) = robot.links[0].solids[0].solid.bounds();
    assert!((high - low - Vector3::new(0.06, 0.06, 3.06)).norm() < 1e-12);
    let tip = &robot.links[1].solids[0];
    let side = f64::sqrt(0.05);
    let (low, high) = tip.solid.bounds();
    let top = tip.owner_from_solid.translation.vector + high;
    assert!(
        (top - Vector3::new(side / 2.0 + 0.03, side / 2.0 + 0.03, 0.1 + side / 2.0 + 0.03)).norm() < 1e-9,
        "{low} {top}"
    );
    // A mesh of no size is refused in any case.
    let flat = MESH_ROBOT.replace("0.1 0.1 -0.2", "0.1 0 0.1");
    let error = Robot::read(&flat, &mut |name| find(name), &options).unwrap_err();
    assert!(matches!(error, UrdfError::Size { shape: "mesh", .. }), "{error}");
}

/// Two posts of 0.1 x 0.1 x 1 m, 0.8 m apart, on a plate: a U.
fn u_shape() -> Mesh {
    let cube = Mesh::read(MeshFormat::Obj, obj().as_bytes()).unwrap();
    let mut u = Mesh { vertices: Vec::new(), triangles: Vec::new() };
    for (scale, at) in [
        ([0.05, 0.05, 0.5], Vector3::new(-0.45, 0.0, 0.55)),
        ([0.05, 0.05, 0.5], Vector3::new(0.45, 0.0, 0.55)),
        ([0.5, 0.05, 0.05], Vector3::zeros()),
    ] {
        let first = u.vertices.len() as u32;
        let part = cube.clone().scaled(scale);
        u.vertices.extend(part.vertices.iter().map(|v| v + at));
        u.triangles.extend(part.triangles.iter().map(|triangle| triangle.map(|i| first + i)));
    }
    u
}

#[test]
fn pieces_leave_a_hollow_open_and_the_hull_closes_it() {
    let u = u_shape();
    let ball = Solid::Ball { radius: 0.2 };
    let here = Isometry3::identity();
    let within = Isometry3::translation(0.0, 0.0, 0.6);
    let (hull, pieces) = (Solid::hull_of(&u).unwrap(), Solid::pieces_of(&u, 64, 16).unwrap());
    assert_eq!(solid_distance(&hull, &here, &ball, &within), 0.0);
    let gap = solid_distance(&pieces, &here, &ball, &within);
    assert!((0.1..=0.2 + 1e-9).contains(&gap), "{gap}: the posts are 0.2 m from the ball");
    let Solid::Hulls(parts) = &pieces else { panic!("pieces") };
    assert!((3..=16).contains(&parts.len()));
    // Nothing of the mesh is lost.
    for vertex in &u.vertices {
        let at = Isometry3::translation(vertex.x, vertex.y, vertex.z);
        assert!(solid_distance(&pieces, &here, &Solid::Ball { radius: 1e-9 }, &at) < 1e-6, "{vertex}");
    }
    // A mesh that its hull describes well stays one piece.
    let cube = Mesh::read(MeshFormat::Obj, obj().as_bytes()).unwrap();
    assert_eq!(Solid::pieces_of(&cube, 64, 16), Solid::hull_of(&cube));
    // Robots can be read that way too.
    let options = ReadOptions { detail: MeshDetail::Pieces { resolution: 48, most: 16 }, ..ReadOptions::default() };
    let robot = Robot::read(MESH_ROBOT, &mut |name| find(name), &options).unwrap();
    assert!(robot.links[1].meshes[1].n_hulls >= 2);
}

#[test]
fn a_mesh_may_stand_in_the_world() {
    let robot = Robot::from_urdf(
        r#"<robot name="s"><link name="r"/><link name="part"><collision><geometry><sphere radius="0.1"/></geometry></collision></link>
        <joint name="x" type="prismatic"><parent link="r"/><child link="part"/><axis xyz="1 0 0"/>
        <limit lower="-9" upper="9" effort="1" velocity="1"/></joint></robot>"#,
    )
    .unwrap();
    let mut world = World::new();
    world.add(Obstacle {
        name: "gate".into(),
        solid: Solid::pieces_of(&u_shape(), 64, 16).unwrap(),
        root_from_solid: Isometry3::translation(0.0, 0.0, -0.6),
    });
    let model = arm::CollisionModel::new(&robot, &Exclusions::none());
    let mut checker = arm::Checker::new(robot.into(), model.into());
    assert!(checker.is_free(&[0.0], &world, 0.0), "through the gate");
    assert!(!checker.is_free(&[0.35], &world, 0.0), "at its post");
    assert!((checker.clearance(&[1.0], &world) - 0.4).abs() < 0.02);
}
