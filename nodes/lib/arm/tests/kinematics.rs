//! Forward kinematics against poses computed by hand and from DH parameters; the Jacobian against finite differences.
#![allow(clippy::unwrap_used, reason = "a test may panic")]

use arm::{
    Chain, Goal, IkOutcome, IkSettings, Isometry3, Robot, Translation3, Vector3, about_z, manipulability, solve,
};
use std::f64::consts::{FRAC_PI_2, PI};

const TABLE_ARM: &str = include_str!("../../../../config/urdf/table_arm.urdf");

/// Two links of 0.5 m and 0.3 m that turn about z.
const PLANAR: &str = r#"<robot name="planar"><link name="base"/><link name="upper"/><link name="lower"/><link name="tip"/>
  <joint name="a" type="continuous"><parent link="base"/><child link="upper"/><axis xyz="0 0 1"/></joint>
  <joint name="b" type="revolute"><origin xyz="0.5 0 0"/><parent link="upper"/><child link="lower"/><axis xyz="0 0 1"/>
    <limit lower="-3.1" upper="3.1" effort="1" velocity="1"/></joint>
  <joint name="c" type="fixed"><origin xyz="0.3 0 0"/><parent link="lower"/><child link="tip"/></joint></robot>"#;

fn pose_of(robot: &Robot, q: &[f64], link: &str) -> Isometry3<f64> {
    let mut poses = Vec::new();
    robot.link_poses(q, &mut poses);
    poses[robot.link_index(link).unwrap()]
}

#[test]
fn planar_arm_matches_the_textbook_formula() {
    let robot = Robot::from_urdf(PLANAR).unwrap();
    for (a, b) in [(0.0, 0.0), (0.3, -1.2), (2.5, 0.7), (-4.0, 3.0)] {
        let tip = pose_of(&robot, &[a, b], "tip");
        let expected =
            Vector3::new(0.5 * f64::cos(a) + 0.3 * f64::cos(a + b), 0.5 * f64::sin(a) + 0.3 * f64::sin(a + b), 0.0);
        assert!((tip.translation.vector - expected).norm() < 1e-14, "{a} {b}");
    }
}

#[test]
fn table_arm_stands_where_the_drawing_says() {
    let robot = Robot::from_urdf(TABLE_ARM).unwrap();
    // Upright: 0.25 + 0.1 + 0.6 + 0.38 + 0.17 + 0.05 + 0.03 + 0.14 above the base.
    let upright = pose_of(&robot, &[0.0; 7], "tool0");
    assert!((upright.translation.vector - Vector3::new(0.5, -0.2, 1.72)).norm() < 1e-12);
    // Shoulder level towards the table, elbow straight: along y at the shoulder's height of 0.35.
    let level = pose_of(&robot, &[0.0, FRAC_PI_2, 0.0, 0.0, 0.0, 0.0, 0.0], "tool0");
    assert!((level.translation.vector - Vector3::new(0.5, -0.2 + 1.37, 0.35)).norm() < 1e-12);
    assert!((level.rotation * Vector3::z() - Vector3::y()).norm() < 1e-12);
    // A quarter turn of the base to the left points along −x.
    let left = pose_of(&robot, &[FRAC_PI_2, FRAC_PI_2, 0.0, 0.0, 0.0, 0.0, 0.0], "tool0");
    assert!((left.translation.vector - Vector3::new(0.5 - 1.37, -0.2, 0.35)).norm() < 1e-12);
    // The place to start from that the file recommends: tool down, above the near edge.
    let home = pose_of(&robot, &[0.0, -0.6, 2.2, 0.0, 1.54, 0.0, 0.05], "tool0");
    assert!((home.rotation * Vector3::z() + Vector3::z()).norm() < 2e-3);
    assert!(home.translation.vector.y > 0.0 && home.translation.vector.z > 0.5);
}

#[test]
fn a_mimicking_finger_follows_its_leader() {
    let robot = Robot::from_urdf(TABLE_ARM).unwrap();
    assert_eq!(robot.dof(), 7);
    assert_eq!(robot.joint_names().last(), Some("finger_left"));
    let mut q = vec![0.0; 7];
    q[6] = 0.05;
    let (left, right) = (pose_of(&robot, &q, "finger_left_link"), pose_of(&robot, &q, "finger_right_link"));
    let opening = (left.translation.vector - right.translation.vector).norm();
    assert!((opening - 2.0 * 0.058).abs() < 1e-12, "{opening}");
}

#[test]
fn ur5_from_dh_parameters_matches_the_product_of_dh_matrices() {
    let a = [0.0, -0.425, -0.39225, 0.0, 0.0, 0.0];
    let d = [0.089159, 0.0, 0.0, 0.10915, 0.09465, 0.0823];
    let alpha = [FRAC_PI_2, 0.0, 0.0, FRAC_PI_2, -FRAC_PI_2, 0.0];
    let mut text = String::from("<robot name='ur5'><link name='l0'/>");
    for i in 0..6 {
        let (x, z, roll) = if i == 0 { (0.0, 0.0, 0.0) } else { (a[i - 1], d[i - 1], alpha[i - 1]) };
        text += &format!(
            "<link name='l{1}'/><joint name='j{1}' type='revolute'><origin xyz='{x} 0 {z}' rpy='{roll} 0 0'/>\
             <parent link='l{0}'/><child link='l{1}'/><axis xyz='0 0 1'/>\
             <limit lower='-6.3' upper='6.3' effort='1' velocity='1'/></joint>",
            i,
            i + 1
        );
    }
    text += &format!(
        "<link name='flange'/><joint name='end' type='fixed'><origin xyz='{} 0 {}' rpy='{} 0 0'/>\
         <parent link='l6'/><child link='flange'/></joint></robot>",
        a[5], d[5], alpha[5]
    );
    let robot = Robot::from_urdf(&text).unwrap();
    // The maker's published position with all joints at 0.
    let zero = pose_of(&robot, &[0.0; 6], "flange").translation.vector;
    assert!((zero - Vector3::new(-0.81725, -0.19145, -0.005491)).norm() < 1e-12, "{zero}");
    for case in 0..20 {
        let q: Vec<f64> = (0..6).map(|j| f64::sin(1.7 * f64::from(case) + 2.3 * f64::from(j)) * PI).collect();
        let mut product = nalgebra::Matrix4::<f64>::identity();
        for i in 0..6 {
            let (s, c, sa, ca) = (q[i].sin(), q[i].cos(), alpha[i].sin(), alpha[i].cos());
            product *= nalgebra::Matrix4::new(
                c,
                -s * ca,
                s * sa,
                a[i] * c,
                s,
                c * ca,
                -c * sa,
                a[i] * s,
                0.0,
                sa,
                ca,
                d[i],
                0.0,
                0.0,
                0.0,
                1.0,
            );
        }
        assert!((pose_of(&robot, &q, "flange").to_homogeneous() - product).norm() < 1e-12, "case {case}");
    }
}

#[test]
fn jacobian_matches_central_differences() {
    // A chain with a prismatic joint and a mimic on the way.
    let mixed = r#"<robot name="m"><link name="r"/><link name="s"/><link name="t"/><link name="u"/>
      <joint name="slide" type="prismatic"><origin xyz="0.1 0 0" rpy="0.3 0.2 0"/><parent link="r"/><child link="s"/>
        <axis xyz="1 2 0"/><limit lower="-1" upper="1" effort="1" velocity="1"/></joint>
      <joint name="turn" type="revolute"><origin xyz="0 0.2 0.4"/><parent link="s"/><child link="t"/><axis xyz="0 1 1"/>
        <limit lower="-3" upper="3" effort="1" velocity="1"/></joint>
      <joint name="follow" type="revolute"><origin xyz="0.3 0 0.1"/><parent link="t"/><child link="u"/><axis xyz="1 0 0"/>
        <limit lower="-3" upper="3" effort="1" velocity="1"/><mimic joint="turn" multiplier="-0.5" offset="0.2"/></joint>
      </robot>"#;
    for (text, tool, q) in [
        (TABLE_ARM, "tool0", vec![0.4, 0.6, 1.1, -0.7, 0.9, 0.3, 0.02]),
        (TABLE_ARM, "finger_right_link", vec![-1.4, -0.6, 2.1, 0.7, -0.9, 2.3, 0.05]),
        (mixed, "u", vec![0.3, -0.8]),
    ] {
        let robot = Robot::from_urdf(text).unwrap();
        let chain = Chain::new(&robot, tool).unwrap();
        let mut columns = Vec::new();
        let pose = chain.linearise(&q, &mut columns);
        assert_eq!(columns.len(), chain.entries.len());
        let expected = pose_of(&robot, &q, tool);
        assert!((pose.to_homogeneous() - expected.to_homogeneous()).norm() < 1e-13);
        assert_eq!(pose, chain.tool_pose(&q));
        let h = 1e-6;
        for (column, &entry) in columns.iter().zip(&chain.entries) {
            let at = |offset: f64| {
                let mut moved = q.clone();
                moved[entry] += offset;
                pose_of(&robot, &moved, tool)
            };
            let (low, high) = (at(-h), at(h));
            let linear = (high.translation.vector - low.translation.vector) / (2.0 * h);
            let angular = (high.rotation * low.rotation.inverse()).scaled_axis() / (2.0 * h);
            assert!((column.linear - linear).norm() < 1e-8, "{tool} {entry}");
            assert!((column.angular - angular).norm() < 1e-8, "{tool} {entry}");
        }
    }
}

#[test]
fn chain_knows_its_joints_and_its_hand() {
    let robot = Robot::from_urdf(TABLE_ARM).unwrap();
    let chain = Chain::new(&robot, "tool0").unwrap();
    let names: Vec<&str> = chain.joint_names(&robot).collect();
    assert_eq!(names, ["shoulder_yaw", "shoulder_pitch", "elbow", "forearm_roll", "wrist_pitch", "wrist_roll"]);
    let hand = chain.hand(&robot);
    let carried: Vec<&str> =
        robot.links.iter().zip(&hand).filter(|(_, hand)| **hand).map(|(link, _)| link.name.as_str()).collect();
    assert_eq!(carried, ["wrist_3_link", "palm_link", "finger_left_link", "finger_right_link", "tool0"]);
    let missing = Chain::new(&robot, "tool9").unwrap_err().to_string();
    assert!(missing.starts_with("the robot has no link 'tool9'") && missing.contains("tool0"), "{missing}");
    let rigid = Chain::new(&robot, "base_link").unwrap_err().to_string();
    assert_eq!(rigid, "no joint moves the link 'base_link'; name the tool at the end of the arm");
}

#[test]
fn levers_bound_how_far_the_tool_moves() {
    let robot = Robot::from_urdf(TABLE_ARM).unwrap();
    let chain = Chain::new(&robot, "tool0").unwrap();
    let mut columns = Vec::new();
    // The straight arm, stretched out: 1.47 from the origin of the base's joint, 0.22 from the wrist's.
    assert!((chain.levers[0] - 1.47).abs() < 1e-12 && (chain.levers[4] - 0.22).abs() < 1e-12, "{:?}", chain.levers);
    for case in 0..200 {
        let q: Vec<f64> = (0..7).map(|j| f64::sin(1.7 * f64::from(case) + 2.3 * f64::from(j)) * 2.0).collect();
        chain.linearise(&q, &mut columns);
        assert!(columns.iter().zip(&chain.levers).all(|(column, &lever)| column.linear.norm() <= lever + 1e-12));
    }
}

#[test]
fn manipulability_is_the_textbook_one_and_vanishes_at_singularities() {
    // Two links in the plane: only l1 l2 |sin q2| of the position matters, and √det(JᵀJ) of the whole 6 × 2 Jacobian adds turns:
    // the columns are (position, 1), so det = |a|²|b|² − (a·b)² with a, b of position and turn.
    let robot = Robot::from_urdf(PLANAR).unwrap();
    let chain = Chain::new(&robot, "tip").unwrap();
    let mut columns = Vec::new();
    for (a, b) in [(0.3, 0.8), (-1.0, 2.0)] {
        chain.linearise(&[a, b], &mut columns);
        let first =
            Vector3::new(-0.5 * f64::sin(a) - 0.3 * f64::sin(a + b), 0.5 * f64::cos(a) + 0.3 * f64::cos(a + b), 1.0);
        let second = Vector3::new(-0.3 * f64::sin(a + b), 0.3 * f64::cos(a + b), 1.0);
        let expected = first.cross(&second).norm();
        assert!((manipulability(&columns) - expected).abs() < 1e-12);
    }
    // Six joints: zero with the wrist straight, where two of them turn about one line.
    let robot = Robot::from_urdf(TABLE_ARM).unwrap();
    let chain = Chain::new(&robot, "tool0").unwrap();
    chain.linearise(&[0.0, 0.5, 1.0, 0.0, 0.0, 0.0, 0.0], &mut columns);
    assert!(manipulability(&columns) < 1e-9);
    chain.linearise(&[0.0, 0.5, 1.0, 0.0, 1.0, 0.0, 0.0], &mut columns);
    assert!(manipulability(&columns) > 1e-2);
}

#[test]
fn another_point_of_the_tool_moves_with_it() {
    let robot = Robot::from_urdf(TABLE_ARM).unwrap();
    let chain = Chain::new(&robot, "tool0").unwrap();
    let tool_from_point = Isometry3::from_parts(Translation3::new(0.03, -0.12, 0.05), about_z(0.7));
    let moved = chain.moving_point(&tool_from_point);
    assert_eq!((moved.tool, &moved.entries), (chain.tool, &chain.entries), "the link and its joints stay");
    let mut columns = Vec::new();
    let mut farther = 0;
    for case in 0..200 {
        let q: Vec<f64> = (0..7).map(|i| 3.0 * f64::from(case * 7 + i).sin()).collect();
        let pose = moved.linearise(&q, &mut columns);
        assert!((pose.to_homogeneous() - (chain.tool_pose(&q) * tool_from_point).to_homogeneous()).norm() < 1e-13);
        assert!(columns.iter().zip(&moved.levers).all(|(column, &lever)| column.linear.norm() <= lever + 1e-12));
        farther += columns.iter().zip(&chain.levers).filter(|(column, lever)| column.linear.norm() > **lever).count();
    }
    assert!(farther > 0, "the levers of the tool's own origin would not do");
    // Where the point is of the arm stretched out, the tool's own origin never comes.
    let stretched = vec![0.0; 7];
    let goal = Goal::Position(moved.tool_pose(&stretched).translation.vector);
    let reached = |chain: &Chain| solve(&robot, chain, &goal, &stretched, &IkSettings::default(), |_| true);
    assert!(matches!(reached(&moved), IkOutcome::Solved(_)) && matches!(reached(&chain), IkOutcome::OutOfReach { .. }));
}
