//! Claims about the simulated world.

use apprentice_msgs::builtin_interfaces::{Duration, Time};
use apprentice_msgs::trajectory_msgs::{JointTrajectory, JointTrajectoryPoint};
use bus::NodeSettings;
use proptest::prelude::{prop_assert, proptest};
use simulated_table::{
    BUILT_IN_URDF, Event, Follower, JointModel, Output, RobotModel, Settings, SimulatedTableNode, task_scene,
};

fn cups() -> Settings {
    Settings {
        object_ids: vec!["cup".to_owned(), "napkin".to_owned()],
        object_shapes: vec!["cylinder".to_owned(), "box".to_owned()],
        object_sizes_m: vec![0.1, 0.1, 0.09, 0.2, 0.1, 0.01],
        object_positions_m: vec![0.25, 0.75, 0.6, 0.3],
        object_yaws_rad: vec![0.0, 0.5],
        object_supports: vec![false, true],
        ..Settings::default()
    }
}

fn at(seconds: f64) -> Time {
    Time::from_nanoseconds((seconds * 1e9) as i128)
}

fn world() -> SimulatedTableNode {
    SimulatedTableNode::new(&cups(), BUILT_IN_URDF.to_owned()).expect("a sound world")
}

fn go_to(joint_names: &[&str], points: &[(f64, &[f64])]) -> JointTrajectory {
    JointTrajectory {
        joint_names: joint_names.iter().map(|name| (*name).to_owned()).collect(),
        points: points
            .iter()
            .map(|(seconds, positions)| JointTrajectoryPoint {
                positions: positions.to_vec(),
                time_from_start: Duration::from_seconds(*seconds),
                ..JointTrajectoryPoint::default()
            })
            .collect(),
        ..JointTrajectory::default()
    }
}

fn two_joints() -> Follower {
    let joint = |name: &str| JointModel { name: name.to_owned(), lower: -2.0, upper: 2.0 };
    Follower::new(vec![joint("a"), joint("b")], vec![0.0, 1.0])
}

#[test]
fn the_announced_scene_is_the_one_in_the_parameters() {
    let outputs = world().step(at(3.0), Event::Announce);
    let Some(Output::Scene(message)) = outputs.first() else { panic!("no scene in {outputs:?}") };
    let scene = exchange::scene_from_message(message).expect("a sound scene");
    let wanted = task_scene(&cups()).expect("a sound scene");
    assert_eq!(scene.objects.len(), 2);
    for (got, wanted) in scene.objects.iter().zip(&wanted.objects) {
        assert_eq!(
            (&got.id, &got.shape, got.position_m, got.supports),
            (&wanted.id, &wanted.shape, wanted.position_m, wanted.supports)
        );
        assert!((got.yaw_rad - wanted.yaw_rad).abs() < 1e-12);
    }
    assert_eq!(message.header.stamp, at(3.0));
}

#[test]
fn an_unchanged_table_is_announced_with_the_same_bytes_and_the_robot_now_and_then() {
    let mut world = world();
    let first = world.step(at(1.0), Event::Announce);
    let second = world.step(at(3.0), Event::Announce);
    assert_eq!(first[..second.len()], second[..]);
    let robots = |outputs: &[Output]| outputs.iter().filter(|o| matches!(o, Output::RobotDescription(_))).count();
    assert_eq!((robots(&first), robots(&second)), (1, 0));
}

#[test]
fn the_built_in_arm_reports_every_joint_within_its_limits() {
    let robot = RobotModel::new(BUILT_IN_URDF.to_owned(), &[]).expect("the arm built in is sound");
    assert!(robot.joints.len() >= 5, "{:?}", robot.joints);
    let outputs = world().step(at(1.0), Event::Tick);
    let [Output::Joints(message)] = &outputs[..] else { panic!("no joint state in {outputs:?}") };
    assert_eq!(message.name.len(), robot.joints.len());
    for (joint, position) in robot.joints.iter().zip(&message.position) {
        assert!((joint.lower..=joint.upper).contains(position));
    }
}

#[test]
fn the_arm_is_half_way_at_half_time_and_stays_where_the_trajectory_ends() {
    let mut follower = two_joints();
    follower.follow(0, &go_to(&["b", "a"], &[(1.0, &[0.0, 1.0]), (3.0, &[2.0, 1.0])])).expect("fits");
    let seconds = |s: f64| (s * 1e9) as i128;
    assert_eq!(follower.positions(seconds(0.5)), [0.5, 0.5]);
    assert_eq!(follower.positions(seconds(2.0)), [1.0, 1.0]);
    assert!(follower.is_moving(seconds(2.9)) && !follower.is_moving(seconds(3.0)));
    assert_eq!(follower.positions(seconds(60.0)), [1.0, 2.0]);
    // A new motion begins where the arm is; an empty one stops it there.
    follower.follow(seconds(61.0), &go_to(&["a"], &[(2.0, &[-1.0])])).expect("fits");
    assert_eq!(follower.positions(seconds(62.0)), [0.0, 2.0]);
    follower.follow(seconds(62.0), &JointTrajectory::default()).expect("fits");
    assert_eq!(follower.positions(seconds(90.0)), [0.0, 2.0]);
}

#[test]
fn trajectories_that_do_not_fit_are_refused_and_leave_the_motion_alone() {
    let mut follower = two_joints();
    follower.follow(0, &go_to(&["a"], &[(2.0, &[1.0])])).expect("fits");
    for (bad, named) in [
        (go_to(&["c"], &[(1.0, &[0.0])]), "'c'"),
        (go_to(&["a", "a"], &[(1.0, &[0.0, 0.0])]), "twice"),
        (go_to(&["a"], &[(1.0, &[0.0, 0.0])]), "2 positions for 1"),
        (go_to(&["a"], &[(1.0, &[f64::NAN])]), "NaN"),
        (go_to(&["a"], &[(1.0, &[2.5])]), "limits"),
        (go_to(&["a"], &[(1.0, &[0.0]), (1.0, &[0.0])]), "not after"),
        (go_to(&["a"], &[(-1.0, &[0.0])]), "not after"),
    ] {
        let error = follower.follow(0, &bad).expect_err("must not fit").to_string();
        assert!(error.contains(named), "{error}");
    }
    assert_eq!(follower.positions(1_000_000_000), [0.5, 1.0]);
    let outputs = world().step(at(1.0), Event::Trajectory(go_to(&["nose"], &[(1.0, &[0.0])])));
    assert!(matches!(&outputs[..], [Output::Warning(text)] if text.contains("nose")), "{outputs:?}");
}

proptest! {
    #[test]
    fn the_arm_never_leaves_its_limits_nor_jumps(
        points in proptest::collection::vec((0.01..1.0_f64, -2.0..2.0_f64), 1..6), times in proptest::collection::vec(0.0..6.0_f64, 2..20)
    ) {
        let mut follower = two_joints();
        let mut clock = 0.0;
        let mut steepest = 0.0_f64;
        let mut previous = 0.0;
        let mut trajectory = go_to(&["a"], &[]);
        for (wait, position) in &points {
            clock += wait;
            steepest = steepest.max((position - previous).abs() / wait);
            previous = *position;
            trajectory.points.extend(go_to(&["a"], &[(clock, &[*position])]).points);
        }
        follower.follow(0, &trajectory).expect("fits");
        let mut times = times;
        times.sort_by(f64::total_cmp);
        for pair in times.windows(2) {
            let [before, after] = [pair[0], pair[1]].map(|t| follower.positions((t * 1e9) as i128)[0]);
            prop_assert!((-2.0..=2.0).contains(&after));
            prop_assert!((after - before).abs() <= steepest * (pair[1] - pair[0]) * (1.0 + 1e-6) + 1e-6);
        }
    }
}

#[test]
fn parameters_that_do_not_fit_together_are_named() {
    let bad = [
        (Settings { object_sizes_m: vec![0.1], ..cups() }, "object_sizes_m has 1 entries; 6"),
        (Settings { object_supports: vec![true], ..cups() }, "object_supports"),
        (Settings { object_ids: vec!["cup".to_owned(), "cup".to_owned()], ..cups() }, "twice"),
        (Settings { object_positions_m: vec![0.25, 0.75, 1.6, 0.3], ..cups() }, "off the"),
        (Settings { object_sizes_m: vec![0.1, 0.2, 0.09, 0.2, 0.1, 0.01], ..cups() }, "diameter"),
        (Settings { target_size_m: vec![0.1], ..cups() }, "target_size_m"),
        (Settings { robot_base_position_m: vec![0.1], ..cups() }, "robot_base_position_m"),
    ];
    for (settings, named) in bad {
        let error = settings.check().expect_err("must be refused");
        assert!(error.contains(named), "{error}");
    }
    assert_eq!(cups().check(), Ok(()));
    let start = Settings { start_positions: vec![0.1], ..cups() };
    let error = SimulatedTableNode::new(&start, BUILT_IN_URDF.to_owned()).expect_err("must be refused").to_string();
    assert!(error.contains("start_positions has 1"), "{error}");
    assert!(SimulatedTableNode::new(&cups(), "<robot/>".to_owned()).is_err());
}
