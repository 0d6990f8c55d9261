//! The seven-joint arm that is shipped: as drawn, free of oddities, and able to do its work.
#![allow(clippy::unwrap_used, reason = "a test may panic")]

use arm::{
    AxisGoal, Chain, Checker, CollisionModel, Exclusions, Goal, IkOutcome, IkSettings, Isometry3, Obstacle, Robot,
    Solid, Vector3, World, approach_posture, solutions, solve,
};
use std::f64::consts::FRAC_PI_2;
use std::sync::Arc;

const ARM: &str = include_str!("../../../../config/urdf/table_arm_7.urdf");
const HOME: [f64; 8] = [0.0, -0.5, 0.0, 2.1, 0.0, 1.54, 0.0, 0.04];

fn robot() -> Robot {
    Robot::from_urdf(ARM).unwrap()
}

#[test]
fn it_is_as_drawn() {
    let robot = robot();
    assert_eq!(robot.problems, []);
    let chain = Chain::new(&robot, "tool0").unwrap();
    assert_eq!((chain.entries.len(), robot.dof()), (7, 8));
    // Upright: 0.2 + 0.13 + 0.3 + 0.25 + 0.3 + 0.23 + 0.06 + 0.03 + 0.14.
    let upright = chain.tool_pose(&[0.0; 8]).translation.vector;
    assert!((upright - Vector3::new(0.5, -0.2, 1.64)).norm() < 1e-12);
    let level = chain.tool_pose(&[0.0, FRAC_PI_2, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0]).translation.vector;
    assert!((level - Vector3::new(0.5, -0.2 + 1.31, 0.33)).norm() < 1e-12);
    let home = chain.tool_pose(&HOME);
    assert!((home.rotation * Vector3::z() + Vector3::z()).norm() < 2e-3 && home.translation.vector.y > 0.0);
    // Arms of this size: it weighs what they weigh and turns as fast as they turn.
    for entry in 0..7 {
        let limits = robot.driven_joint(entry).limits;
        assert!((1.5..=3.5).contains(&limits.velocity) && (20.0..=300.0).contains(&limits.effort));
    }
}

#[test]
fn it_reaches_the_table_without_touching_itself() {
    let robot = Arc::new(robot());
    let chain = Chain::new(&robot, "tool0").unwrap();
    let model = CollisionModel::new(&robot, &Exclusions::derived(&robot, 1));
    let mut checker = Checker::new(Arc::clone(&robot), Arc::new(model));
    let mut world = World::new();
    let slab = Solid::Box { half_extents: [0.5, 0.5, 0.02] };
    world.add(Obstacle { name: "table".into(), solid: slab, root_from_solid: Isometry3::translation(0.5, 0.5, -0.02) });
    assert!(checker.is_free(&HOME, &world, 0.005));
    let mut reached = 0;
    for i in 0..100 {
        let position = Vector3::new(0.05 + 0.1 * f64::from(i % 10), 0.05 + 0.07 * f64::from(i / 10), 0.15);
        let goal = Goal::Axis(AxisGoal { position, direction: -Vector3::z_axis() });
        let outcome =
            solve(&robot, &chain, &goal, &HOME, &IkSettings::default(), |q| checker.is_free(q, &world, 0.005));
        reached += i32::from(matches!(outcome, IkOutcome::Solved(_)));
    }
    assert!(reached >= 90, "only {reached} of 100");
}

#[test]
fn its_elbow_swings_while_the_hand_stays() {
    let robot = robot();
    let chain = Chain::new(&robot, "tool0").unwrap();
    let settings = IkSettings::default();
    let pose = chain.tool_pose(&HOME);
    let goal = Goal::Pose(pose);
    let many = solutions(&robot, &chain, &goal, &HOME, &settings, 8);
    assert!(many.len() >= 4, "{}", many.len());
    for q in &many {
        let off = chain.tool_pose(q).inverse() * pose;
        assert!(off.translation.vector.norm() < 1e-6 && off.rotation.angle() < 2e-6 && robot.within_limits(q));
    }
    // From any of them back towards home as far as their branch allows, the hand where it is.
    let distance = |q: &[f64]| (0..7).map(|i| (q[i] - HOME[i]).powi(2)).sum::<f64>();
    let mut nearer = 0;
    for start in &many[1..] {
        let mut q = start.clone();
        let left = approach_posture(&robot, &chain, &goal, &mut q, &HOME, &settings);
        assert!((left - distance(&q)).abs() < 1e-12 && left <= distance(start) + 1e-12);
        nearer += i32::from(left < 0.9 * distance(start));
        let off = chain.tool_pose(&q).inverse() * pose;
        assert!(off.translation.vector.norm() < 1e-6 && off.rotation.angle() < 2e-6 && robot.within_limits(&q));
    }
    assert!(nearer >= 2, "{nearer} of {}", many.len() - 1);
    // Near home it gets all the way: the posture itself meets the goal.
    let mut near = HOME.to_vec();
    near[2] = 0.3;
    let IkOutcome::Solved(mut q) = solve(&robot, &chain, &goal, &near, &settings, |_| true) else {
        panic!("not solved")
    };
    assert!(distance(&q) > 1e-3);
    assert!(approach_posture(&robot, &chain, &goal, &mut q, &HOME, &settings) < 1e-4, "{q:?}");
}

#[test]
fn goals_beyond_it_and_goals_that_are_no_numbers_are_told_apart() {
    let robot = robot();
    let chain = Chain::new(&robot, "tool0").unwrap();
    let try_at = |position: Vector3<f64>| {
        solve(&robot, &chain, &Goal::Position(position), &HOME, &IkSettings::default(), |_| true)
    };
    assert!(matches!(try_at(Vector3::new(0.5, 2.0, 0.3)), IkOutcome::OutOfReach { .. }));
    assert!(matches!(try_at(Vector3::new(f64::NAN, 0.0, 0.0)), IkOutcome::OutOfReach { .. }));
    assert!(matches!(try_at(Vector3::new(0.5, 0.4, 0.3)), IkOutcome::Solved(_)));
    // In the base of the arm no hand fits, whatever the number of starts.
    assert!(matches!(try_at(Vector3::new(0.5, -0.2, 0.33)), IkOutcome::NotFound { .. }));
}
