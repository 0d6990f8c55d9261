//! Straight ways: nothing is stepped over, and what counts as blocked comes within the resolution.
#![allow(clippy::unwrap_used, reason = "a test may panic")]

use arm::{
    Body, Chain, Checker, CollisionModel, Exclusions, Isometry3, Obstacle, Placed, Robot, Solid, Sweep, SweepSettings,
    World,
};
use proptest::prelude::{prop, prop_assert, prop_assert_eq, proptest};
use std::sync::Arc;

const TABLE_ARM: &str = include_str!("../../../../config/urdf/table_arm.urdf");
const HOME: [f64; 7] = [0.0, -0.6, 2.2, 0.0, 1.54, 0.0, 0.05];

fn checker(text: &str) -> Checker {
    let robot = Robot::from_urdf(text).unwrap();
    let model = CollisionModel::new(&robot, &Exclusions::derived(&robot, 1));
    Checker::new(Arc::new(robot), Arc::new(model))
}

fn obstacle(name: &str, solid: Solid, x: f64, y: f64, z: f64) -> Obstacle {
    Obstacle { name: name.into(), solid, root_from_solid: Isometry3::translation(x, y, z) }
}

/// A ball of 1 cm on a slide of 20 m, and one at the end of a rod of 1 m without a shape.
const SLIDE: &str = r#"<robot name="s"><link name="r"/>
  <link name="ball"><collision><geometry><sphere radius="0.01"/></geometry></collision></link>
  <joint name="x" type="prismatic"><parent link="r"/><child link="ball"/><axis xyz="1 0 0"/>
    <limit lower="-10" upper="10" effort="1" velocity="1"/></joint></robot>"#;
const ROD: &str = r#"<robot name="s"><link name="r"/>
  <link name="rod"><collision><origin xyz="1 0 0"/><geometry><sphere radius="0.01"/></geometry></collision></link>
  <joint name="turn" type="continuous"><parent link="r"/><child link="rod"/><axis xyz="0 0 1"/></joint></robot>"#;

#[test]
fn a_sheet_of_a_hundredth_of_a_millimetre_is_not_stepped_over() {
    let mut checker = checker(SLIDE);
    for at in [-9.7, -3.337, 0.0, 1e-3, 2.5, 7.123_456, 9.9] {
        let mut world = World::new();
        world.add(obstacle("sheet", Solid::Box { half_extents: [5e-6, 1.0, 1.0] }, at, 0.0, 0.0));
        let found = checker.sweep(&[-10.0], &[10.0], &world, &SweepSettings::default());
        let Sweep::Blocked { share, contact } = found else { panic!("stepped over the sheet at {at}") };
        assert_eq!((contact.a, contact.b), (Body::Link(1), Body::Obstacle(0)));
        assert!((-10.0 + 20.0 * share - at).abs() < 0.0103, "{share} for {at}");
        // Both sides of it are free.
        assert!(checker.way_is_free(&[-10.0], &[at - 0.011], &world, &SweepSettings::default()));
        assert!(checker.way_is_free(&[10.0], &[at + 0.011], &world, &SweepSettings::default()));
    }
}

#[test]
fn a_needle_in_the_way_of_a_turning_rod_is_not_stepped_over() {
    let mut checker = checker(ROD);
    for i in 0..20 {
        let angle = 0.3 * f64::from(i) + 0.05;
        let mut world = World::new();
        let needle = Solid::Cylinder { radius: 1e-5, half_length: 0.5 };
        world.add(obstacle("needle", needle, angle.cos(), angle.sin(), 0.0));
        assert!(!checker.way_is_free(&[0.0], &[6.2], &world, &SweepSettings::default()), "at {angle}");
        // Where the straight line between the ends would cut the corner but the rod does not pass.
        let inside = obstacle("needle", Solid::Ball { radius: 1e-5 }, 0.985 * angle.cos(), 0.985 * angle.sin(), 0.0);
        let mut world = World::new();
        world.add(inside);
        assert!(checker.way_is_free(&[0.0], &[6.2], &world, &SweepSettings::default()), "at {angle}");
    }
}

#[test]
fn margin_and_resolution_mean_what_they_say() {
    let mut checker = checker(SLIDE);
    let mut world = World::new();
    // The ball passes 5 mm below.
    world.add(obstacle("beam", Solid::Box { half_extents: [0.1, 0.1, 0.1] }, 0.0, 0.0, 0.115));
    let free = |checker: &mut Checker, margin: f64, resolution: f64| {
        checker.way_is_free(&[-1.0], &[1.0], &world, &SweepSettings { margin, resolution })
    };
    assert!(free(&mut checker, 0.0, 2e-4) && free(&mut checker, 0.0047, 2e-4));
    assert!(!free(&mut checker, 0.0051, 2e-4) && !free(&mut checker, 0.0051, 1e-9));
    assert!(free(&mut checker, 0.00499, 1e-6));
}

#[test]
fn what_is_held_sweeps_along() {
    let mut checker = checker(TABLE_ARM);
    let chain = Chain::new(checker.robot(), "tool0").unwrap();
    let (from, mut to) = (HOME, HOME);
    to[0] = 0.8;
    let mut world = World::new();
    // Half way, below the tool: only the long thing in the hand reaches it.
    let mut half = HOME;
    half[0] = 0.4;
    let at = chain.tool_pose(&half).translation.vector;
    world.add(obstacle("ball", Solid::Ball { radius: 0.02 }, at.x, at.y, at.z - 0.3));
    assert!(checker.way_is_free(&from, &to, &world, &SweepSettings::default()));
    let stick = Placed {
        solid: Solid::Cylinder { radius: 0.01, half_length: 0.2 },
        owner_from_solid: Isometry3::translation(0.0, 0.0, 0.12),
    };
    let hand = chain.hand(checker.robot());
    world.hold("stick", chain.tool, stick, hand);
    let found = checker.sweep(&from, &to, &world, &SweepSettings::default());
    let Sweep::Blocked { contact, share } = found else { panic!("the stick went through the ball") };
    assert_eq!((contact.a.name(checker.robot(), &world), contact.b.name(checker.robot(), &world)), ("stick", "ball"));
    assert!((share - 0.5).abs() < 0.1);
    world.let_held_touch("ball");
    assert!(checker.way_is_free(&from, &to, &world, &SweepSettings::default()));
    // Put down, it is an obstacle like any other.
    let pose = chain.tool_pose(&half);
    world.put_down(&pose);
    assert_eq!(world.held_name(), None);
    assert_eq!(world.obstacle_names().last(), Some("stick"));
    half[6] = 0.0;
    assert!(!checker.is_free(&half, &world, 0.0), "closed fingers are where it stands");
}

#[test]
fn a_configuration_that_is_no_number_is_never_free() {
    let mut checker = checker(SLIDE);
    let world = World::new();
    for bad in [f64::NAN, f64::INFINITY] {
        assert!(!checker.is_free(&[bad], &world, 0.0) && !checker.contacts(&[bad], &world, 0.0).is_empty());
        assert_eq!(checker.clearance(&[bad], &world), 0.0);
        for (from, to) in [(0.0, bad), (bad, 0.0)] {
            assert!(!checker.way_is_free(&[from], &[to], &world, &SweepSettings::default()));
        }
    }
    assert!(checker.is_free(&[0.0], &world, 0.0));
}

fn cluttered() -> World {
    let mut world = World::new();
    world.add(obstacle("table", Solid::Box { half_extents: [0.5, 0.5, 0.02] }, 0.5, 0.5, -0.02));
    for (i, (x, y)) in [(0.3, 0.4), (0.7, 0.4), (0.5, 0.7), (0.2, 0.8)].into_iter().enumerate() {
        let solid = if i % 2 == 0 {
            Solid::Cylinder { radius: 0.05, half_length: 0.1 }
        } else {
            Solid::Box { half_extents: [0.05, 0.03, 0.15] }
        };
        world.add(obstacle(&format!("thing {i}"), solid, x, y, 0.15));
    }
    world
}

proptest! {
    /// Against many single checks: a free way has no contact on it, and on a blocked one something comes near.
    #[test]
    fn ways_agree_with_a_thousand_single_checks(
        from in prop::array::uniform7(-1.0..1.0_f64),
        to in prop::array::uniform7(-1.0..1.0_f64),
        margin in 0.0..0.01_f64,
    ) {
        let mut checker = checker(TABLE_ARM);
        let world = cluttered();
        let within = |unit: [f64; 7]| -> Vec<f64> {
            (0..7).map(|i| {
                let limits = checker.robot().driven_joint(i).limits;
                let (low, high) = (limits.lower.max(HOME[i] - 1.0), limits.upper.min(HOME[i] + 1.0));
                low + (high - low) * 0.5 * (unit[i] + 1.0)
            }).collect()
        };
        let (from, to) = (within(from), within(to));
        let settings = SweepSettings { margin, resolution: 1e-3 };
        let found = checker.sweep(&from, &to, &world, &settings);
        let at = |share: f64| -> Vec<f64> { from.iter().zip(&to).map(|(a, b)| a + (b - a) * share).collect() };
        match found {
            Sweep::Free => for i in 0..=1000 {
                let q = at(f64::from(i) / 1000.0);
                prop_assert!(checker.is_free(&q, &world, margin), "at {i}");
            },
            Sweep::Blocked { share, .. } => {
                prop_assert!((0.0..=1.0).contains(&share));
                // The robot's own links count with the resolution alone, obstacles with the margin and the resolution.
                let (_, nearest) = checker.nearest(&at(share), &world, 1.0).unwrap();
                prop_assert!(nearest <= margin + 1.001e-3, "{nearest} at {share}");
            }
        }
        prop_assert_eq!(found, checker.sweep(&from, &to, &world, &settings));
    }
}
