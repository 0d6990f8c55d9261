//! What other programs are shown: MoveIt the table, tf where things stand, RViz the plan.

use apprentice_msgs::builtin_interfaces::Time;
use apprentice_msgs::moveit_msgs::{CollisionObject, PlanningScene};
use apprentice_msgs::msg::{LessonStatus, PlacementCandidate, PlacementPlan, Posterior, TableScene};
use apprentice_msgs::shape_msgs::SolidPrimitive;
use apprentice_msgs::tf2_msgs::TFMessage;
use apprentice_msgs::visualization_msgs::{Marker, MarkerArray};
use exchange::scene_to_message;
use placement_planner::{Event, Output, PlacementPlanner};
use scene::{Object, Point, Scene, Shape};

mod support;
use support::{joints, lesson, object, posterior, ready, table};

#[derive(Default)]
struct Shown {
    scenes: Vec<PlanningScene>,
    transforms: Vec<TFMessage>,
    markers: Vec<MarkerArray>,
    plans: Vec<PlacementPlan>,
}

fn show(node: &mut PlacementPlanner, now_s: i32, event: Event) -> Shown {
    let mut shown = Shown::default();
    for output in node.step(Time { sec: now_s, nanosec: 0 }, event) {
        match output {
            Output::PlanningScene(message) => shown.scenes.push(*message),
            Output::Transforms(message) => shown.transforms.push(message),
            Output::Markers(message) => shown.markers.push(*message),
            Output::Plan(message) => shown.plans.push(*message),
            _ => {}
        }
    }
    shown
}

fn on_table(scene: &Scene) -> Event {
    let message: TableScene = scene_to_message(scene, Time::default());
    Event::Scene(Box::new(message))
}

/// (id, operation) of everything in a diff.
fn deeds(scene: &PlanningScene) -> Vec<(&str, u8)> {
    assert!(scene.is_diff && scene.robot_state.is_diff, "MoveIt keeps the robot's state and what others added");
    scene.world.collision_objects.iter().map(|object| (object.id.as_str(), object.operation)).collect()
}

const ADD: u8 = CollisionObject::ADD;
const REMOVE: u8 = CollisionObject::REMOVE;

#[test]
fn moveit_sees_the_same_table() {
    let mut node = ready();
    let with_box = Scene {
        objects: vec![
            object("cup", 0.2, 0.25, 0.05),
            Object {
                shape: Shape::Box { width_m: 0.3, depth_m: 0.1, height_m: 0.06 },
                yaw_rad: 0.5,
                position_m: Point::new(0.7, 0.8),
                ..object("tray", 0.0, 0.0, 0.1)
            },
        ],
        ..table()
    };
    let shown = show(&mut node, 1, on_table(&with_box));
    let scene = &shown.scenes[0];
    assert_eq!(deeds(scene), [("table_top", ADD), ("cup", ADD), ("tray", ADD)]);
    let [top, cup, tray] = scene.world.collision_objects.as_slice() else { panic!("three objects") };
    assert_eq!(top.header.frame_id, "table");
    // The top ends where things stand.
    assert!((top.pose.position.z + 0.5 * top.primitives[0].dimensions[2]).abs() < 1e-12);
    assert_eq!(cup.primitives[0].r#type, SolidPrimitive::CYLINDER);
    assert_eq!(cup.primitives[0].dimensions, [0.1, 0.05], "height and radius");
    assert_eq!((cup.pose.position.x, cup.pose.position.z, cup.primitive_poses[0].position.z), (0.2, 0.0, 0.05));
    assert_eq!(tray.primitives[0].dimensions, [0.3, 0.1, 0.06]);
    assert!((tray.pose.orientation.z - 0.25_f64.sin()).abs() < 1e-12);

    // The same table again is no news; a client that came late hears it with everything that is repeated.
    assert!(show(&mut node, 2, on_table(&with_box)).scenes.is_empty());
    assert_eq!(show(&mut node, 3, Event::Republish).scenes.len(), 1);
    // What has gone is taken away, and only once.
    let shown = show(&mut node, 4, on_table(&table()));
    assert_eq!(deeds(&shown.scenes[0]), [("tray", REMOVE), ("table_top", ADD), ("cup", ADD)]);
    assert_eq!(deeds(&show(&mut node, 5, Event::Republish).scenes[0]), [("table_top", ADD), ("cup", ADD)]);
    // MoveIt sees objects as the planner takes them: upright, and on the table.
    let mut odd = scene_to_message(&with_box, Time::default());
    odd.objects[0].pose.position.z = 0.7;
    odd.objects[1].pose.orientation.z *= 3.0;
    odd.objects[1].pose.orientation.w *= 3.0;
    let shown = show(&mut node, 6, Event::Scene(Box::new(odd)));
    assert_eq!(shown.scenes[0].world.collision_objects[1].pose.position.z, 0.0);
    assert!((shown.transforms[0].transforms[1].transform.rotation.w - 0.25_f64.cos()).abs() < 1e-12);
    // A table that nothing can be planned on is not shown.
    let mut broken = scene_to_message(&with_box, Time::default());
    broken.objects[0].size_m.z = f64::NAN;
    assert!(show(&mut node, 7, Event::Scene(Box::new(broken))).scenes.is_empty());
}

#[test]
fn things_have_frames_and_what_was_put_down_stands_there() {
    let mut node = ready();
    let shown = show(&mut node, 7, on_table(&table()));
    let [cup] = shown.transforms[0].transforms.as_slice() else { panic!("one object") };
    assert_eq!((cup.header.frame_id.as_str(), cup.child_frame_id.as_str()), ("table", "object/cup"));
    assert_eq!((cup.header.stamp.sec, cup.transform.translation.x, cup.transform.rotation.w), (7, 0.2, 1.0));

    show(&mut node, 8, Event::Posterior(Box::new(posterior(1))));
    // Taught, and the arm is heard of: it takes the vase to the middle.
    show(&mut node, 9, Event::Joints(joints()));
    let shown = show(&mut node, 9, lesson(LessonStatus::TAUGHT, 1));
    let trajectory = shown.plans[0].trajectory.clone();
    let last = trajectory.points.last().expect("it moves");
    let mut there = joints();
    for (name, position) in trajectory.joint_names.iter().zip(&last.positions) {
        let place = there.name.iter().position(|joint| joint == name).expect("a joint");
        there.position[place] = *position;
    }
    show(&mut node, 10, Event::Joints(there));
    let seconds = last.time_from_start.sec + 3;
    let shown = show(&mut node, 10 + seconds, Event::Tick(placement_planner::Heard::default()));
    assert_eq!(deeds(&shown.scenes[0]), [("table_top", ADD), ("cup", ADD), ("vase", ADD)]);
    let vase = shown.transforms[0].transforms.iter().find(|t| t.child_frame_id == "object/vase").expect("it stands");
    assert!((vase.transform.translation.x - 0.5).abs() < 1e-6 && vase.transform.translation.z == 0.0);
    // Perception does not list the vase; it stands there all the same when a cup is moved, until the vase is seen elsewhere.
    let other = Scene { objects: vec![object("cup", 0.3, 0.25, 0.05)], ..table() };
    let shown = show(&mut node, 60, on_table(&other));
    assert_eq!(deeds(&shown.scenes[0]), [("table_top", ADD), ("cup", ADD), ("vase", ADD)]);
    // Another table has no vase on it.
    let shown = show(&mut node, 61, on_table(&Scene { id: "next".into(), ..table() }));
    assert_eq!(deeds(&shown.scenes[0]), [("vase", REMOVE), ("table_top", ADD), ("cup", ADD)]);
}

#[test]
fn what_is_put_down_is_turned_as_the_hand_turns_it() {
    let mut node = ready();
    let bar = Shape::Box { width_m: 0.12, depth_m: 0.03, height_m: 0.1 };
    let with_bar = Scene { target: Object { shape: bar, ..object("vase", 0.0, 0.0, 0.04) }, ..table() };
    show(&mut node, 1, on_table(&with_bar));
    let task = scene_to_message(&with_bar, Time::default());
    let shown = show(&mut node, 2, Event::Posterior(Box::new(Posterior { task, ..posterior(1) })));
    let robot = arm::Robot::from_urdf(support::URDF).expect("the arm of the tests");
    let (plan, markers) = (&shown.plans[0], &shown.markers[0].markers);
    let end = plan.trajectory.points.last().expect("it is reached");
    // The hand's x axis, by the robot itself: this arm's root stands in the table's frame as its fixed link says.
    let joints: Vec<f64> = robot
        .joint_names()
        .map(|name| {
            let moved = plan.trajectory.joint_names.iter().position(|joint| joint == name);
            let stays = || joints().name.iter().position(|joint| joint == name).map(|i| joints().position[i]);
            moved.map(|i| end.positions[i]).or_else(stays).expect("every joint is known")
        })
        .collect();
    let mut poses = Vec::new();
    robot.link_poses(&joints, &mut poses);
    let link = |name: &str| poses[robot.link_index(name).expect("a link")];
    let x_axis = link("table").rotation.inverse() * link("tool0").rotation * arm::Vector3::x();
    let target = markers.iter().find(|marker| marker.ns == "target" && marker.r#type == Marker::CUBE).expect("a bar");
    let drawn = 2.0 * target.pose.orientation.z.atan2(target.pose.orientation.w);
    assert!((drawn - x_axis.y.atan2(x_axis.x)).sin().abs() < 1e-9, "{drawn}");
}

#[test]
fn a_plan_is_drawn_with_what_became_of_each_place() {
    let mut node = ready();
    show(&mut node, 1, on_table(&table()));
    let shown = show(&mut node, 2, Event::Posterior(Box::new(posterior(1))));
    let (plan, markers) = (&shown.plans[0], &shown.markers[0].markers);
    assert_eq!(markers[0].action, Marker::DELETEALL, "nothing of an older plan stays");
    let of = |ns: &str| markers.iter().filter(|marker| marker.ns == ns).collect::<Vec<_>>();
    assert_eq!(of("candidates").len(), plan.candidates.len());
    let chosen = plan.candidates.iter().position(|c| c.verdict == PlacementCandidate::CHOSEN).expect("one is");
    assert!(of("verdicts")[chosen].text.ends_with("chosen"));
    assert_eq!(of("candidates")[chosen].pose.position.x, plan.candidates[chosen].position.x);
    // The hand ends above the place, as high as it holds the vase (0.2 m high, held 3 cm below its top).
    let [path] = of("path")[..] else { panic!("one path") };
    assert_eq!(path.points.len(), plan.trajectory.points.len());
    let end = path.points.last().expect("a path has an end");
    let place = &plan.robust_placement;
    assert!((end.x - place.x).abs() < 2e-3 && (end.y - place.y).abs() < 2e-3, "{end:?} {place:?}");
    assert!((end.z - 0.17).abs() < 0.02, "{end:?}");
    // Every marker can be drawn: finite, in the table's frame, of an id of its own.
    let mut ids: Vec<_> = markers.iter().map(|marker| (marker.ns.clone(), marker.id)).collect();
    ids.sort();
    ids.dedup();
    assert_eq!(ids.len(), markers.len());
    assert!(markers.iter().all(|marker| marker.header.frame_id == "table" && marker.pose.position.x.is_finite()));

    // The picture of a plan that holds no more goes away: nothing can be planned on this table.
    let mut broken = scene_to_message(&table(), Time::default());
    broken.objects[0].size_m.z = f64::NAN;
    let shown = show(&mut node, 3, Event::Scene(Box::new(broken)));
    let [wiped] = shown.markers[0].markers.as_slice() else { panic!("one marker") };
    assert_eq!(wiped.action, Marker::DELETEALL);
    assert!(show(&mut node, 4, Event::Republish).markers.is_empty(), "said once; the topic keeps it");
}
