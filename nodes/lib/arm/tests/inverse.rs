//! Inverse kinematics: solutions meet the goal and the limits, agree with the closed form, and repeat.
#![allow(clippy::unwrap_used, reason = "a test may panic")]

use arm::{AxisGoal, Chain, Goal, IkOutcome, IkSettings, Robot, Vector3, solve};

const TABLE_ARM: &str = include_str!("../../../../config/urdf/table_arm.urdf");

fn down(x: f64, y: f64, z: f64) -> Goal {
    Goal::Axis(AxisGoal { position: Vector3::new(x, y, z), direction: -Vector3::z_axis() })
}

#[test]
fn planar_arm_finds_the_closed_form() {
    let text = r#"<robot name="planar"><link name="base"/><link name="upper"/><link name="lower"/><link name="tip"/>
      <joint name="a" type="continuous"><parent link="base"/><child link="upper"/><axis xyz="0 0 1"/></joint>
      <joint name="b" type="revolute"><origin xyz="0.5 0 0"/><parent link="upper"/><child link="lower"/>
        <axis xyz="0 0 1"/><limit lower="0" upper="3.1" effort="1" velocity="1"/></joint>
      <joint name="c" type="fixed"><origin xyz="0.3 0 0"/><parent link="lower"/><child link="tip"/></joint></robot>"#;
    let robot = Robot::from_urdf(text).unwrap();
    let chain = Chain::new(&robot, "tip").unwrap();
    for (x, y) in [(0.6, 0.2), (-0.3, 0.4), (0.1, -0.5), (0.25, 0.0), (0.0, 0.75)] {
        let goal = Goal::Axis(AxisGoal { position: Vector3::new(x, y, 0.0), direction: Vector3::z_axis() });
        let outcome = solve(&robot, &chain, &goal, &[0.1, 0.5], &IkSettings::default(), |_| true);
        let IkOutcome::Solved(q) = outcome else { panic!("({x}, {y}): {outcome:?}") };
        // Law of cosines; the limit leaves one of the two elbows.
        let cos_b = (x * x + y * y - 0.25 - 0.09) / (2.0 * 0.5 * 0.3);
        let b = f64::acos(cos_b);
        let a = f64::atan2(y, x) - f64::atan2(0.3 * b.sin(), 0.5 + 0.3 * b.cos());
        let turn = (q[0] - a).rem_euclid(std::f64::consts::TAU);
        assert!((q[1] - b).abs() < 1e-4, "({x}, {y}): {q:?} vs {a} {b}");
        assert!(turn.min(std::f64::consts::TAU - turn) < 1e-4, "({x}, {y}): {q:?} vs {a} {b}");
    }
}

#[test]
fn solutions_meet_goal_and_limits_and_repeat() {
    let robot = Robot::from_urdf(TABLE_ARM).unwrap();
    let chain = Chain::new(&robot, "tool0").unwrap();
    let start = [0.0, -0.6, 2.2, 0.0, 1.54, 0.0, 0.05];
    let (mut poses, mut solved) = (Vec::new(), 0);
    for i in 0..100 {
        let at = Vector3::new(0.05 + 0.1 * f64::from(i % 10), 0.05 + 0.09 * f64::from(i / 10), 0.15);
        let goal = down(at.x, at.y, at.z);
        let settings = IkSettings::default();
        let outcome = solve(&robot, &chain, &goal, &start, &settings, |_| true);
        assert_eq!(outcome, solve(&robot, &chain, &goal, &start, &settings, |_| true));
        if let IkOutcome::Solved(q) = outcome {
            assert!(robot.within_limits(&q));
            robot.link_poses(&q, &mut poses);
            let tool = poses[chain.tool];
            assert!((tool.translation.vector - at).norm() <= 1e-6);
            assert!((tool.rotation * Vector3::z() + Vector3::z()).norm() <= 1.1e-6);
            assert_eq!(q[6], start[6], "the finger does not move the tool");
            solved += 1;
        }
    }
    assert!(solved >= 95, "only {solved} of 100");
}

#[test]
fn goals_beyond_the_arm_are_told_apart() {
    let robot = Robot::from_urdf(TABLE_ARM).unwrap();
    let chain = Chain::new(&robot, "tool0").unwrap();
    let far = solve(&robot, &chain, &down(0.5, 3.0, 0.1), &robot.rest(), &IkSettings::default(), |_| true);
    let IkOutcome::OutOfReach { distance, reach } = far else { panic!("{far:?}") };
    assert!((distance - (3.2_f64.powi(2) + 0.15_f64.powi(2)).sqrt()).abs() < 1e-9);
    assert!(reach < distance);
    // In reach of the straight arm, but not with the tool pointing down.
    let stretched = solve(&robot, &chain, &down(0.0, 1.0, 0.1), &robot.rest(), &IkSettings::default(), |_| true);
    assert!(matches!(stretched, IkOutcome::NotFound { .. }), "{stretched:?}");
    // A solution that the caller refuses is none.
    let refused = solve(&robot, &chain, &down(0.5, 0.5, 0.1), &robot.rest(), &IkSettings::default(), |_| false);
    assert!(matches!(refused, IkOutcome::NotFound { .. }), "{refused:?}");
}
