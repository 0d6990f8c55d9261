//! Collisions with known answers, and the pairs that are left out.
#![allow(clippy::unwrap_used, reason = "a test may panic")]

use arm::{
    Chain, CollisionModel, Contact, Exclusions, Isometry3, Obstacle, Placed, Robot, Solid, Vector3, World,
    solid_distance,
};

const TABLE_ARM: &str = include_str!("../../../../config/urdf/table_arm.urdf");
const HOME: [f64; 7] = [0.0, -0.6, 2.2, 0.0, 1.54, 0.0, 0.05];

/// A solid that slides along z.
fn slider(geometry: &str) -> Robot {
    Robot::from_urdf(&format!(
        r#"<robot name="s"><link name="r"/><link name="part"><collision><geometry>{geometry}</geometry></collision></link>
        <joint name="z" type="prismatic"><parent link="r"/><child link="part"/><axis xyz="0 0 1"/>
        <limit lower="-9" upper="9" effort="1" velocity="1"/></joint></robot>"#
    ))
    .unwrap()
}

fn slab() -> World {
    let mut world = World::new();
    world.add(Obstacle {
        name: "table".into(),
        solid: Solid::Box { half_extents: [0.5, 0.5, 0.02] },
        root_from_solid: Isometry3::translation(0.0, 0.0, -0.02),
    });
    world
}

fn poses(robot: &Robot, q: &[f64]) -> Vec<Isometry3<f64>> {
    let mut poses = Vec::new();
    robot.link_poses(q, &mut poses);
    poses
}

#[test]
fn solids_meet_the_slab_to_the_millimetre() {
    // The half height of each solid over its centre; a cylinder stands along z as in URDF.
    for (geometry, half_height) in [
        (r#"<sphere radius="0.1"/>"#, 0.1),
        (r#"<cylinder radius="0.05" length="0.4"/>"#, 0.2),
        (r#"<capsule radius="0.05" length="0.4"/>"#, 0.25),
        (r#"<box size="0.1 0.2 0.3"/>"#, 0.15),
    ] {
        let robot = slider(geometry);
        let model = CollisionModel::new(&robot, &Exclusions::none());
        let world = slab();
        let contact = |z: f64, margin: f64| {
            model.first_contact(&robot, &poses(&robot, &[z]), &world, margin).map(|c| (c.a.to_owned(), c.b.to_owned()))
        };
        let hit = Some(("part".to_owned(), "table".to_owned()));
        assert_eq!(contact(half_height - 0.001, 0.0), hit, "{geometry} 1 mm inside");
        assert_eq!(contact(half_height + 0.001, 0.0), None, "{geometry} 1 mm above");
        assert_eq!(contact(half_height + 0.009, 0.010), hit, "{geometry} 9 mm above, margin 10 mm");
        assert_eq!(contact(half_height + 0.011, 0.010), None, "{geometry} 11 mm above, margin 10 mm");
        let clearance = model.clearance(&poses(&robot, &[half_height + 0.07]), &world);
        assert!((clearance - 0.07).abs() < 1e-9, "{geometry}: {clearance}");
        assert_eq!(model.clearance(&poses(&robot, &[0.0]), &world), 0.0);
    }
}

#[test]
fn the_arm_at_home_is_free_and_folded_it_is_not() {
    let robot = Robot::from_urdf(TABLE_ARM).unwrap();
    let model = CollisionModel::new(&robot, &Exclusions::derived(&robot, 1));
    let mut world = World::new();
    world.add(Obstacle {
        name: "table".into(),
        solid: Solid::Box { half_extents: [0.5, 0.5, 0.02] },
        root_from_solid: Isometry3::translation(0.5, 0.5, -0.02),
    });
    assert_eq!(model.first_contact(&robot, &poses(&robot, &HOME), &world, 0.005), None);
    // Bent down onto the table.
    let low = poses(&robot, &[0.0, 1.5, 0.6, 0.0, 0.5, 0.0, 0.0]);
    assert_eq!(model.first_contact(&robot, &low, &world, 0.0).map(|c| c.b), Some("table"));
    // Folded so far that the gripper meets the arm.
    let folded = poses(&robot, &[0.0, 0.0, 2.7, 0.0, 2.2, 0.0, 0.0]);
    let empty = World::new();
    let Some(Contact { a, b }) = model.first_contact(&robot, &folded, &empty, 0.0) else {
        panic!("folded arm is free")
    };
    assert!(a.ends_with("_link") && b.ends_with("_link"), "{a} {b}");
}

#[test]
fn what_is_held_collides_but_not_with_the_hand() {
    let robot = Robot::from_urdf(TABLE_ARM).unwrap();
    let chain = Chain::new(&robot, "tool0").unwrap();
    let model = CollisionModel::new(&robot, &Exclusions::derived(&robot, 1));
    let at_home = poses(&robot, &HOME);
    let tool = at_home[chain.tool].translation.vector;
    let cup = Placed {
        solid: Solid::Cylinder { radius: 0.055, half_length: 0.1 },
        owner_from_solid: Isometry3::translation(0.0, 0.0, 0.08),
    };
    let mut world = World::new();
    world.hold("cup", chain.tool, cup.clone(), chain.hand(&robot));
    assert_eq!(model.first_contact(&robot, &at_home, &world, 0.0), None);
    // The same cup that may touch nothing touches the fingers.
    let mut strict = World::new();
    strict.hold("cup", chain.tool, cup, vec![false; robot.links.len()]);
    assert_eq!(model.first_contact(&robot, &at_home, &strict, 0.0).map(|c| c.a), Some("cup"));
    // A ball under the tool that only the cup reaches: the cup ends 0.18 below the tool.
    for (gap, free) in [(0.002, true), (-0.002, false)] {
        let mut around = world.clone();
        let centre = tool - Vector3::new(0.0, 0.0, 0.18 + 0.03 + gap);
        around.add(Obstacle {
            name: "ball".into(),
            solid: Solid::Ball { radius: 0.03 },
            root_from_solid: Isometry3::translation(centre.x, centre.y, centre.z),
        });
        assert_eq!(model.is_free(&robot, &at_home, &around, 0.0), free, "gap {gap}");
    }
}

#[test]
fn pairs_that_always_touch_are_left_out_and_others_are_kept() {
    // `a` and `c` overlap in every configuration, `a` and `d` in some.
    let text = r#"<robot name="p"><link name="a"><collision><geometry><sphere radius="0.3"/></geometry></collision></link>
      <link name="b"/><link name="c"><collision><geometry><sphere radius="0.3"/></geometry></collision></link>
      <link name="d"><collision><geometry><sphere radius="0.2"/></geometry></collision></link>
      <joint name="j1" type="continuous"><parent link="a"/><child link="b"/><axis xyz="0 1 0"/></joint>
      <joint name="j2" type="continuous"><origin xyz="0.1 0 0"/><parent link="b"/><child link="c"/><axis xyz="0 1 0"/></joint>
      <joint name="j3" type="continuous"><origin xyz="0.5 0 0"/><parent link="c"/><child link="e"/><axis xyz="0 1 0"/></joint>
      <link name="e"/>
      <joint name="j4" type="revolute"><origin xyz="0.4 0 0"/><parent link="e"/><child link="d"/><axis xyz="0 1 0"/>
        <limit lower="-1" upper="1" effort="1" velocity="1"/></joint></robot>"#;
    let robot = Robot::from_urdf(text).unwrap();
    let index = |name: &str| robot.link_index(name).unwrap();
    let all = CollisionModel::new(&robot, &Exclusions::none());
    assert_eq!(all.n_pairs(), 3, "a-c, a-d, c-d");
    let derived = Exclusions::derived(&robot, 7);
    assert!(derived.contains(index("c"), index("a")));
    assert!(!derived.contains(index("a"), index("d")));
    assert_eq!(derived.len(), 1);
    assert_eq!(derived, Exclusions::derived(&robot, 7));
    // The same by name and from an SRDF.
    let named = Exclusions::none().disable(&robot, [("c", "a")]).unwrap();
    assert_eq!(named, derived);
    let srdf = r#"<robot name="p"><disable_collisions link1="a" link2="c" reason="Default"/></robot>"#;
    assert_eq!(Exclusions::none().disable_srdf(&robot, srdf).unwrap(), derived);
    let unknown = Exclusions::none().disable(&robot, [("a", "z")]).unwrap_err().to_string();
    assert_eq!(unknown, "the list of disabled collisions names the link 'z', which the robot does not have");
    let lacking = Exclusions::none().disable_srdf(&robot, "<robot><disable_collisions link1='a'/></robot>");
    assert!(lacking.unwrap_err().to_string().contains("lacks 'link2'"));
}

#[test]
fn distances_between_solids_are_the_known_ones() {
    let at = |x: f64, y: f64, z: f64| Isometry3::translation(x, y, z);
    let (ball, cube) = (Solid::Ball { radius: 0.1 }, Solid::Box { half_extents: [0.1, 0.2, 0.3] });
    let cylinder = Solid::Cylinder { radius: 0.1, half_length: 0.4 };
    let cases = [
        (ball, at(0.0, 0.0, 0.0), ball, at(0.3, 0.4, 0.0), 0.3),
        (ball, at(0.0, 0.0, 0.0), ball, at(0.1, 0.0, 0.0), 0.0),
        // Corner to corner: (0.3, 0.4, 0) apart.
        (cube, at(0.0, 0.0, 0.0), cube, at(0.5, 0.8, 0.0), 0.5),
        // Side to side, and end to end along z.
        (cylinder, at(0.0, 0.0, 0.0), cylinder, at(0.3, 0.4, 0.5), 0.3),
        (cylinder, at(0.0, 0.0, 0.0), cylinder, at(0.05, 0.0, 1.0), 0.2),
    ];
    for (a, pose_a, b, pose_b, expected) in cases {
        let found = solid_distance(&a, &pose_a, &b, &pose_b);
        assert!((found - expected).abs() < 1e-6, "{a:?} {b:?}: {found}");
        assert!((solid_distance(&b, &pose_b, &a, &pose_a) - found).abs() < 1e-9);
    }
}
