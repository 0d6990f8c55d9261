//! Collisions with known answers, and the pairs that are left out.
#![allow(clippy::unwrap_used, reason = "a test may panic")]

use arm::{
    Chain, Checker, CollisionModel, Exclusions, Isometry3, Obstacle, Placed, Robot, Solid, Vector3, World,
    solid_distance,
};
use std::sync::Arc;

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

fn checker(robot: &Robot, exclusions: &Exclusions) -> Checker {
    Checker::new(Arc::new(robot.clone()), Arc::new(CollisionModel::new(robot, exclusions)))
}

/// Names of the first two things that touch.
fn contact(checker: &mut Checker, q: &[f64], world: &World, margin: f64) -> Option<(String, String)> {
    let found = checker.first_contact(q, world, margin)?;
    let robot = checker.robot();
    Some((found.a.name(robot, world).to_owned(), found.b.name(robot, world).to_owned()))
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
        let mut checker = checker(&robot, &Exclusions::none());
        let world = slab();
        let mut contact = |z: f64, margin: f64| contact(&mut checker, &[z], &world, margin);
        let hit = Some(("part".to_owned(), "table".to_owned()));
        assert_eq!(contact(half_height - 0.001, 0.0), hit, "{geometry} 1 mm inside");
        assert_eq!(contact(half_height + 0.001, 0.0), None, "{geometry} 1 mm above");
        assert_eq!(contact(half_height + 0.009, 0.010), hit, "{geometry} 9 mm above, margin 10 mm");
        assert_eq!(contact(half_height + 0.011, 0.010), None, "{geometry} 11 mm above, margin 10 mm");
        let clearance = checker.clearance(&[half_height + 0.07], &world);
        assert!((clearance - 0.07).abs() < 1e-9, "{geometry}: {clearance}");
        assert_eq!(checker.clearance(&[0.0], &world), 0.0);
    }
}

#[test]
fn the_arm_at_home_is_free_and_folded_it_is_not() {
    let robot = Robot::from_urdf(TABLE_ARM).unwrap();
    let mut checker = checker(&robot, &Exclusions::derived(&robot, 1));
    let mut world = World::new();
    world.add(Obstacle {
        name: "table".into(),
        solid: Solid::Box { half_extents: [0.5, 0.5, 0.02] },
        root_from_solid: Isometry3::translation(0.5, 0.5, -0.02),
    });
    assert_eq!(contact(&mut checker, &HOME, &world, 0.005), None);
    // Bent down onto the table.
    let low = contact(&mut checker, &[0.0, 1.5, 0.6, 0.0, 0.5, 0.0, 0.0], &world, 0.0);
    assert_eq!(low.map(|(_, b)| b), Some("table".to_owned()));
    // Folded so far that the gripper meets the arm.
    let folded = contact(&mut checker, &[0.0, 0.0, 2.7, 0.0, 2.2, 0.0, 0.0], &World::new(), 0.0);
    let (a, b) = folded.expect("it touches itself");
    assert!(a.ends_with("_link") && b.ends_with("_link"), "{a} {b}");
}

#[test]
fn what_is_held_collides_but_not_with_the_hand() {
    let robot = Robot::from_urdf(TABLE_ARM).unwrap();
    let chain = Chain::new(&robot, "tool0").unwrap();
    let mut checker = checker(&robot, &Exclusions::derived(&robot, 1));
    let tool = chain.tool_pose(&HOME).translation.vector;
    let cup = Placed {
        solid: Solid::Cylinder { radius: 0.055, half_length: 0.1 },
        owner_from_solid: Isometry3::translation(0.0, 0.0, 0.08),
    };
    let mut world = World::new();
    world.hold("cup", chain.tool, cup.clone(), chain.hand(&robot));
    assert_eq!(contact(&mut checker, &HOME, &world, 0.0), None);
    // The same cup that may touch nothing touches the fingers.
    let mut strict = World::new();
    strict.hold("cup", chain.tool, cup, vec![false; robot.links.len()]);
    assert_eq!(contact(&mut checker, &HOME, &strict, 0.0).map(|(a, _)| a), Some("cup".to_owned()));
    // A ball under the tool that only the cup reaches: the cup ends 0.18 below the tool.
    for (gap, free) in [(0.002, true), (-0.002, false)] {
        let mut around = world.clone();
        let centre = tool - Vector3::new(0.0, 0.0, 0.18 + 0.03 + gap);
        around.add(Obstacle {
            name: "ball".into(),
            solid: Solid::Ball { radius: 0.03 },
            root_from_solid: Isometry3::translation(centre.x, centre.y, centre.z),
        });
        assert_eq!(checker.is_free(&HOME, &around, 0.0), free, "gap {gap}");
        // What it may touch, and what is no longer there, do not count.
        let mut lifting = around.clone();
        lifting.let_held_touch("ball");
        assert!(checker.is_free(&HOME, &lifting, 0.0));
        assert!(around.remove("ball") && !around.remove("ball"));
        assert!(checker.is_free(&HOME, &around, 0.0));
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
    assert_eq!(Exclusions::from_srdf(&robot, srdf).unwrap(), (derived, Vec::new()));
    let unknown = Exclusions::none().disable(&robot, [("a", "z")]).unwrap_err().to_string();
    assert_eq!(unknown, "the list of disabled collisions names the link 'z', which the robot does not have");
    let lacking = Exclusions::from_srdf(&robot, "<robot>\n<disable_collisions link1='a'/></robot>").unwrap_err();
    assert_eq!(
        lacking.to_string(),
        "line 2: the semantic robot description (SRDF) cannot be read: a <disable_collisions> lacks 'link2'"
    );
}

#[test]
fn an_srdf_disables_enables_and_names_what_is_not_there() {
    let text = r#"<robot name="p"><link name="a"><collision><geometry><sphere radius="0.3"/></geometry></collision></link>
      <link name="b"><collision><geometry><sphere radius="0.3"/></geometry></collision></link>
      <link name="c"><collision><geometry><sphere radius="0.3"/></geometry></collision></link>
      <joint name="j1" type="continuous"><parent link="a"/><child link="b"/><axis xyz="0 1 0"/></joint>
      <joint name="j2" type="continuous"><parent link="b"/><child link="c"/><axis xyz="0 1 0"/></joint></robot>"#;
    let robot = Robot::from_urdf(text).unwrap();
    let pairs = |srdf: &str| {
        let (exclusions, problems) = Exclusions::from_srdf(&robot, srdf).unwrap();
        let pairs: Vec<_> = CollisionModel::new(&robot, &exclusions).link_pairs().collect();
        (pairs, problems.iter().map(ToString::to_string).collect::<Vec<_>>())
    };
    // Neighbours are left out without being named.
    assert_eq!(pairs("<robot/>").0, [(0, 2)]);
    assert_eq!(pairs("<robot><disable_default_collisions link='c'/></robot>").0, []);
    let enabled = "<robot><enable_collisions link1='b' link2='c'/><disable_default_collisions link='c'/></robot>";
    assert_eq!(pairs(enabled).0, [(1, 2)]);
    let (left, problems) = pairs("<robot>\n<disable_collisions link1='a' link2='z'/></robot>");
    assert_eq!(left, [(0, 2)]);
    assert!(
        problems[0].starts_with("line 2: the SRDF names the link 'z', which the robot does not have;"),
        "{problems:?}"
    );
    for (bad, expected) in [
        ("<robot><disable_collisions".to_owned(), "cannot be read"),
        ("<robot>".to_owned(), "cut off"),
        ("<!DOCTYPE r [<!ENTITY x 'y'>]><robot/>".to_owned(), "document type"),
        ("<a>".repeat(100), "deep"),
        (" ".repeat(arm::MAX_BYTES + 1), "at most"),
    ] {
        let message = Exclusions::from_srdf(&robot, &bad).unwrap_err().to_string();
        assert!(message.contains(expected), "{message}");
    }
}

#[test]
fn distances_between_solids_are_the_known_ones() {
    let at = |x: f64, y: f64, z: f64| Isometry3::translation(x, y, z);
    let (ball, cube) = (Solid::Ball { radius: 0.1 }, Solid::Box { half_extents: [0.1, 0.2, 0.3] });
    let cylinder = Solid::Cylinder { radius: 0.1, half_length: 0.4 };
    let cases = [
        (ball.clone(), at(0.0, 0.0, 0.0), ball.clone(), at(0.3, 0.4, 0.0), 0.3),
        (ball.clone(), at(0.0, 0.0, 0.0), ball, at(0.1, 0.0, 0.0), 0.0),
        // Corner to corner: (0.3, 0.4, 0) apart.
        (cube.clone(), at(0.0, 0.0, 0.0), cube, at(0.5, 0.8, 0.0), 0.5),
        // Side to side, and end to end along z.
        (cylinder.clone(), at(0.0, 0.0, 0.0), cylinder.clone(), at(0.3, 0.4, 0.5), 0.3),
        (cylinder.clone(), at(0.0, 0.0, 0.0), cylinder, at(0.05, 0.0, 1.0), 0.2),
    ];
    for (a, pose_a, b, pose_b, expected) in cases {
        let found = solid_distance(&a, &pose_a, &b, &pose_b);
        assert!((found - expected).abs() < 1e-6, "{a:?} {b:?}: {found}");
        assert!((solid_distance(&b, &pose_b, &a, &pose_a) - found).abs() < 1e-9);
    }
}
