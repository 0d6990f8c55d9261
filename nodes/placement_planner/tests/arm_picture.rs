//! The arm for those who draw it: its solids, where its links are, and how it would carry out the plan.

use apprentice_msgs::builtin_interfaces::Time;
use apprentice_msgs::msg::{ArmModel, ArmMotion, ArmPart, ArmPose, PlacementPlan};
use apprentice_msgs::sensor_msgs::JointState;
use exchange::scene_to_message;
use placement_planner::{Event, Output, PlacementPlanner};

mod support;
use support::{joints, posterior, ready, table};

#[derive(Default)]
struct Shown {
    models: Vec<ArmModel>,
    poses: Vec<ArmPose>,
    motions: Vec<ArmMotion>,
    plans: Vec<PlacementPlan>,
}

fn show(node: &mut PlacementPlanner, now_ms: i64, event: Event) -> Shown {
    let mut shown = Shown::default();
    let now = Time::from_nanoseconds(i128::from(now_ms) * 1_000_000);
    for output in node.step(now, event) {
        match output {
            Output::ArmModel(message) => shown.models.push(*message),
            Output::ArmPose(message) => shown.poses.push(message),
            Output::ArmMotion(message) => shown.motions.push(*message),
            Output::Plan(message) => shown.plans.push(*message),
            _ => {}
        }
    }
    shown
}

fn scene() -> Event {
    Event::Scene(Box::new(scene_to_message(&table(), Time::default())))
}

fn moved(by_rad: f64) -> Event {
    let mut message: JointState = joints();
    message.position[0] += by_rad;
    Event::Joints(message)
}

#[test]
fn the_arm_is_told_once_and_its_links_as_they_move() {
    let mut node = ready();
    let shown = show(&mut node, 1000, scene());
    let [model] = shown.models.as_slice() else { panic!("one arm") };
    assert_eq!((model.header.frame_id.as_str(), model.robot_hash.as_str()), ("table", node.robot_hash()));
    let robot = arm::Robot::from_urdf(support::URDF).expect("the arm of the tests");
    assert_eq!(model.link_names.len(), robot.links.len());
    assert_eq!(model.parts.len(), robot.links.iter().map(|link| link.solids.len()).sum::<usize>());
    for part in &model.parts {
        assert!(
            [ArmPart::BOX, ArmPart::CYLINDER, ArmPart::SPHERE].contains(&part.shape),
            "primitives stay what they are"
        );
        assert!(part.size_m.x > 0.0 && (part.link as usize) < robot.links.len());
    }
    let [pose] = shown.poses.as_slice() else { panic!("where it is") };
    assert_eq!(pose.poses.len(), 7 * robot.links.len());
    // The table itself is a link of this robot, and stands where its own frame is.
    let table = 7 * robot.link_index("table").expect("a link");
    assert!(
        pose.poses[table..table + 6].iter().all(|x| x.abs() < 1e-6) && (pose.poses[table + 6].abs() - 1.0).abs() < 1e-6
    );

    let quiet = |shown: Shown| shown.models.is_empty() && shown.poses.is_empty();
    assert!(quiet(show(&mut node, 2000, moved(0.0))), "it stands");
    assert_eq!(show(&mut node, 3000, moved(0.02)).poses.len(), 1);
    assert!(quiet(show(&mut node, 3050, moved(0.04))), "ten times a second are enough");
    assert_eq!(show(&mut node, 3100, moved(0.04)).poses.len(), 1);
    let again = show(&mut node, 9000, Event::Republish);
    assert_eq!((again.models.len(), again.poses.len()), (1, 1), "for those who come late");
}

#[test]
fn the_motion_begins_where_the_arm_is_and_ends_at_the_place_of_the_plan() {
    let mut node = ready();
    let before = show(&mut node, 1000, scene());
    let shown = show(&mut node, 2000, Event::Posterior(Box::new(posterior(1))));
    let (plan, [motion]) = (&shown.plans[0], shown.motions.as_slice()) else { panic!("one motion") };
    assert_eq!((motion.revision, &motion.robot_hash), (plan.revision, &plan.robot_hash));
    let (n, each) = (motion.times_s.len(), before.poses[0].poses.len());
    assert!((2..=61).contains(&n) && motion.times_s.windows(2).all(|pair| pair[0] < pair[1]));
    assert_eq!(motion.poses.len(), n * each);
    let last = plan.trajectory.points.last().expect("it is reached");
    assert!((motion.times_s[n - 1] - last.time_from_start.seconds()).abs() < 1e-9);
    let start = motion.poses[..each].iter().zip(&before.poses[0].poses);
    assert!(start.into_iter().all(|(a, b)| (a - b).abs() < 1e-5), "it begins where the arm is");
    let (end, target) = (&motion.way_m[motion.way_m.len() - 3..], &motion.target.pose.position);
    assert_eq!((target.x, target.y), (plan.robust_placement.x, plan.robust_placement.y));
    assert!((end[0] - target.x).hypot(end[1] - target.y) < 0.01, "the hand ends above the target");

    // A plan that holds no more has no motion.
    let mut broken = scene_to_message(&table(), Time::default());
    broken.objects[0].size_m.z = f64::NAN;
    let shown = show(&mut node, 3000, Event::Scene(Box::new(broken)));
    assert!(matches!(shown.motions.as_slice(), [gone] if gone.times_s.is_empty() && gone.poses.is_empty()));
}
