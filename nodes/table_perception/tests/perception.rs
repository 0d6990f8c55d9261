//! From detections to a scene: frames, classes, noise, and what is not there.

use apprentice_msgs::builtin_interfaces::Time;
use apprentice_msgs::geometry_msgs::{Point, Pose, PoseStamped, Quaternion, Transform, TransformStamped, Vector3};
use apprentice_msgs::msg::TableScene;
use apprentice_msgs::std_msgs::Header;
use apprentice_msgs::tf2_msgs::TFMessage;
use apprentice_msgs::vision_msgs::{Detection3D, Detection3DArray, ObjectHypothesisWithPose};
use proptest::prelude::{any, proptest};
use table_perception::{Event, Frames, Output, Settings, TablePerceptionNode};

fn settings() -> Settings {
    Settings {
        object_ids: ["cup_left", "cup_right", "tray"].map(String::from).to_vec(),
        object_classes: ["cup", "cup", "tray"].map(String::from).to_vec(),
        object_shapes: ["cylinder", "cylinder", "box"].map(String::from).to_vec(),
        object_sizes_m: vec![0.08, 0.08, 0.1, 0.08, 0.08, 0.1, 0.3, 0.2, 0.02],
        ..Settings::default()
    }
}

/// The camera hangs 1 m above the middle of the table and looks down: its z axis points at the table, its x to the right.
fn camera() -> Event {
    let transform = Transform {
        translation: Vector3 { x: 0.5, y: 0.5, z: 1.0 },
        rotation: Quaternion { x: 1.0, y: 0.0, z: 0.0, w: 0.0 },
    };
    let header = Header { frame_id: "table".into(), ..Header::default() };
    let stamped = TransformStamped { header, child_frame_id: "camera".into(), transform };
    Event::Transforms(Box::new(TFMessage { transforms: vec![stamped] }))
}

/// A pose in the camera's frame of what stands at (x, y) on the table, turned by `yaw_rad` there.
fn in_camera(x: f64, y: f64, yaw_rad: f64) -> Pose {
    // The camera's y and z axes point the other way than the table's: a half turn about x before the turn about z.
    let (sin, cos) = (0.5 * yaw_rad).sin_cos();
    Pose {
        position: Point { x: x - 0.5, y: 0.5 - y, z: 0.95 },
        orientation: Quaternion { x: cos, y: -sin, z: 0.0, w: 0.0 },
    }
}

fn detection(class: &str, score: f64, pose: Pose) -> Detection3D {
    let mut result = ObjectHypothesisWithPose::default();
    result.hypothesis.class_id = class.into();
    result.hypothesis.score = score;
    result.pose.pose = pose;
    Detection3D { results: vec![result], ..Detection3D::default() }
}

fn seen(detections: Vec<Detection3D>) -> Event {
    let header = Header { stamp: Time { sec: 7, nanosec: 0 }, frame_id: "camera".into() };
    Event::Detections(Box::new(Detection3DArray { header, detections }))
}

struct Bench {
    node: TablePerceptionNode,
    status: String,
    target: Option<PoseStamped>,
}

impl Bench {
    fn new() -> Self {
        Self {
            node: TablePerceptionNode::new(settings()).expect("lists that fit"),
            status: String::new(),
            target: None,
        }
    }

    fn step(&mut self, now_s: f64, event: Event) -> Option<TableScene> {
        let now = Time::from_nanoseconds((now_s * 1e9) as i128);
        let mut scene = None;
        for output in self.node.step(now, event) {
            match output {
                Output::Scene(message) => scene = Some(*message),
                Output::TargetPose(pose) => self.target = Some(pose),
                Output::Status(_, text) => self.status = text,
            }
        }
        scene
    }

    /// All three things stand where they belong.
    fn ready() -> Self {
        let mut bench = Self::new();
        bench.step(0.0, camera());
        bench.step(1.0, all()).expect("everything is seen");
        bench
    }
}

fn all() -> Event {
    let cups = [detection("cup", 0.9, in_camera(0.8, 0.3, 0.0)), detection("cup", 0.8, in_camera(0.2, 0.3, 0.0))];
    seen(cups.into_iter().chain([detection("tray", 0.9, in_camera(0.5, 0.8, 0.4))]).collect())
}

fn at(scene: &TableScene, id: &str) -> (f64, f64) {
    let object = scene.objects.iter().find(|object| object.id == id).expect("it is there");
    (object.pose.position.x, object.pose.position.y)
}

fn near(a: (f64, f64), b: (f64, f64)) -> bool {
    (a.0 - b.0).hypot(a.1 - b.1) < 1e-9
}

#[test]
fn detections_in_the_frame_of_a_camera_become_a_scene_in_that_of_the_table() {
    let mut bench = Bench::new();
    assert!(bench.step(0.0, all()).is_none());
    assert!(bench.status.contains("tf does not connect 'camera' with 'table'"), "{}", bench.status);
    bench.step(0.1, camera());
    let scene = bench.step(1.0, all()).expect("everything is seen");
    assert_eq!((scene.header.stamp.sec, scene.header.frame_id.as_str()), (7, "table"));
    // Of two cups the left one is the one that is listed first.
    assert!(near(at(&scene, "cup_left"), (0.2, 0.3)) && near(at(&scene, "cup_right"), (0.8, 0.3)));
    let tray = &scene.objects[2].pose.orientation;
    assert!((2.0 * tray.z.atan2(tray.w) - 0.4).abs() < 1e-9, "{tray:?}");
    assert_eq!(bench.status, "all 3 things are seen");
}

#[test]
fn noise_changes_nothing_and_a_move_does() {
    let mut bench = Bench::ready();
    let moved = |x: f64, yaw_rad: f64| {
        seen(vec![
            detection("cup", 0.9, in_camera(x, 0.3, 2.0)),
            detection("tray", 0.9, in_camera(0.5, 0.8, 0.4 + yaw_rad)),
        ])
    };
    assert!(bench.step(1.1, moved(0.205, 0.03)).is_none(), "a cup may turn, and 5 mm are noise");
    let scene = bench.step(1.2, moved(0.22, 0.0)).expect("2 cm are a move");
    assert!(near(at(&scene, "cup_left"), (0.22, 0.3)) && near(at(&scene, "cup_right"), (0.8, 0.3)));
    assert!(bench.step(1.3, moved(0.22, 0.2)).is_some(), "the tray turned");
    // Two cups that pass each other keep their names as long as each is nearer to where it was.
    let scene = bench
        .step(
            1.4,
            seen(vec![
                detection("cup", 0.9, in_camera(0.6, 0.3, 0.0)),
                detection("cup", 0.9, in_camera(0.4, 0.3, 0.0)),
            ]),
        )
        .expect("both moved");
    assert!(near(at(&scene, "cup_left"), (0.4, 0.3)) && near(at(&scene, "cup_right"), (0.6, 0.3)));
    // The scene comes again for those who come late.
    assert_eq!((0..4).filter(|i| bench.step(1.5 + 0.1 * f64::from(*i), Event::Tick).is_some()).count(), 1);
}

#[test]
fn what_is_not_seen_for_long_is_gone_and_what_was_never_seen_is_waited_for() {
    let mut bench = Bench::new();
    bench.step(0.0, camera());
    let cup = || seen(vec![detection("cup", 0.9, in_camera(0.2, 0.3, 0.0))]);
    assert!(bench.step(1.0, cup()).is_none());
    assert_eq!(bench.status, "not seen: cup_right, tray");
    bench.step(2.0, all()).expect("everything is seen");
    assert!(bench.step(11.9, cup()).is_none(), "the arm may be in the way");
    let scene = bench.step(12.1, Event::Tick).expect("two things are gone");
    assert_eq!(scene.objects.len(), 1);
    assert_eq!(bench.status, "not seen: cup_right, tray");
    assert_eq!(bench.step(13.0, all()).expect("all are back").objects.len(), 3);
}

#[test]
fn what_does_not_stand_on_the_table_is_not_on_it() {
    let mut bench = Bench::ready();
    let mut lying = in_camera(0.5, 0.5, 0.0);
    lying.orientation = Quaternion { x: 0.5, y: 0.5, z: 0.5, w: 0.5 };
    let mut nowhere = in_camera(0.5, 0.5, 0.0);
    nowhere.position.x = f64::NAN;
    let mut floor = in_camera(0.5, 0.5, 0.0);
    floor.position.z = 1.9;
    for (class, score, pose, told) in [
        ("cup", 0.4, in_camera(0.5, 0.5, 0.0), ""),
        ("cup", f64::NAN, in_camera(0.5, 0.5, 0.0), ""),
        ("spider", 0.9, in_camera(0.5, 0.5, 0.0), ""),
        ("cup", 0.9, in_camera(1.5, 0.5, 0.0), ""),
        ("cup", 0.9, floor, ""),
        ("cup", 0.9, lying, "tilted by 90 degrees"),
        ("cup", 0.9, nowhere, "not finite"),
    ] {
        assert!(bench.step(1.5, seen(vec![detection(class, score, pose)])).is_none(), "{class} {score} {pose:?}");
        assert!(bench.status.contains(told), "{}", bench.status);
    }
    // A detector that says only where the box is.
    let mut boxed = detection("tray", 0.9, Pose::default());
    boxed.bbox.center = in_camera(0.3, 0.8, 0.4);
    let scene = bench.step(1.6, seen(vec![boxed])).expect("the tray moved");
    assert!(near(at(&scene, "tray"), (0.3, 0.8)));
}

#[test]
fn a_tracker_says_where_one_thing_is() {
    let mut bench = Bench::ready();
    let header = Header { frame_id: "/camera".into(), ..Header::default() };
    let pose = PoseStamped { header, pose: in_camera(0.6, 0.6, 0.0) };
    let scene = bench.step(1.5, Event::Pose(1, Box::new(pose.clone()))).expect("the right cup moved");
    assert!(near(at(&scene, "cup_right"), (0.6, 0.6)));
    assert!(bench.step(1.6, Event::Pose(9, Box::new(pose))).is_none(), "there is no such thing");
}

#[test]
fn frames_that_go_in_a_circle_connect_nothing() {
    let edge = |parent: &str, child: &str| TransformStamped {
        header: Header { frame_id: parent.into(), ..Header::default() },
        child_frame_id: child.into(),
        transform: Transform { rotation: Quaternion { w: 1.0, ..Quaternion::default() }, ..Transform::default() },
    };
    let mut frames = Frames::default();
    let circle = vec![edge("a", "b"), edge("b", "c"), edge("c", "a"), edge("x", "y")];
    assert!(frames.take(&TFMessage { transforms: circle }));
    assert!(frames.between("a", "b").is_none() && frames.between("x", "a").is_none());
    assert!(frames.between("x", "y").is_some() && frames.between("z", "z").is_some());
    let mut wrong = edge("x", "w");
    wrong.transform.rotation.w = 0.0;
    assert!(!frames.take(&TFMessage { transforms: vec![wrong] }) && frames.between("x", "w").is_none());
}

proptest! {
    #[test]
    fn any_numbers_are_survived(p in any::<[f64; 3]>(), q in any::<[f64; 4]>(), score in any::<f64>()) {
        let mut bench = Bench::ready();
        let [x, y, z] = p;
        let orientation = Quaternion { x: q[0], y: q[1], z: q[2], w: q[3] };
        let pose = Pose { position: Point { x, y, z }, orientation };
        if let Some(scene) = bench.step(2.0, seen(vec![detection("cup", score, pose)])) {
            assert!(exchange::scene_from_message(&scene).is_ok());
        }
    }
}

/// The camera sees the thing to place, its middle 10 cm above the table's surface.
fn vase(score: f64, x: f64, y: f64, yaw_rad: f64) -> Detection3D {
    let mut pose = in_camera(x, y, yaw_rad);
    pose.position.z = 0.9;
    detection("target", score, pose)
}

/// A tracker sees the middle of the thing to place at (x, y, z) in the table's frame, upright.
fn tracked([x, y, z]: [f64; 3]) -> Event {
    let header = Header { frame_id: "table".into(), ..Header::default() };
    let orientation = Quaternion { w: 1.0, ..Quaternion::default() };
    let pose = Pose { position: Point { x, y, z }, orientation };
    Event::TargetPose(Box::new(PoseStamped { header, pose }))
}

#[test]
fn where_the_thing_to_place_stands_is_told_on_the_table_and_beside_it() {
    let mut bench = Bench::ready();
    assert!(bench.target.is_none(), "nobody has seen it");
    for (x, y) in [(0.4, 0.6), (1.2, 0.1)] {
        bench.step(2.0, seen(vec![vase(0.9, x, y, 0.3)]));
        let told = bench.target.take().expect("it is seen");
        assert_eq!((told.header.frame_id.as_str(), told.header.stamp.sec), ("table", 7));
        let Pose { position, orientation } = told.pose;
        // 20 cm high: its base is 10 cm below its middle.
        assert!(near((position.x, position.y), (x, y)) && position.z.abs() < 1e-9, "{position:?}");
        assert!((2.0 * orientation.z.atan2(orientation.w) - 0.3).abs() < 1e-9 && orientation.x == 0.0);
    }
    // The likeliest of several is meant; none of them is a thing on the table.
    let scene =
        bench.step(6.0, seen(vec![vase(0.6, 0.1, 0.1, 0.0), vase(0.8, 0.9, 0.9, 0.0), vase(0.7, 0.2, 0.1, 0.0)]));
    let told = bench.target.take().expect("it is seen").pose.position;
    assert!(near((told.x, told.y), (0.9, 0.9)) && scene.is_none());
}

#[test]
fn what_lies_or_is_far_away_is_not_picked_up() {
    let mut bench = Bench::ready();
    let mut lying = vase(0.9, 0.4, 0.6, 0.0);
    lying.results[0].pose.pose.orientation = Quaternion { x: 0.5, y: 0.5, z: 0.5, w: 0.5 };
    bench.step(2.0, seen(vec![lying]));
    assert!(bench.target.is_none() && bench.status.contains("'target' is tilted by 90 degrees"), "{}", bench.status);
    bench.step(2.1, seen(vec![vase(0.9, 3.1, 0.5, 0.0)]));
    bench.step(2.2, seen(vec![vase(0.3, 0.4, 0.5, 0.0)]));
    assert!(bench.target.is_none(), "on another table, or hardly seen");
}

#[test]
fn a_class_that_things_on_the_table_have_too_is_theirs() {
    let cups = Settings { target_class: "cup".into(), ..settings() };
    let mut bench = Bench { node: TablePerceptionNode::new(cups).expect("lists that fit"), ..Bench::new() };
    bench.step(0.0, camera());
    assert!(bench.step(1.0, all()).is_some() && bench.target.is_none());
    // A tracker of its own tells it apart.
    bench.step(1.5, tracked([0.1, 0.2, 0.1]));
    let told = bench.target.expect("it is tracked").pose.position;
    assert!(near((told.x, told.y), (0.1, 0.2)) && told.z.abs() < 1e-12);
}

#[test]
fn the_thing_to_place_is_near_up_to_two_metres_from_the_table() {
    let mut bench = Bench::ready();
    for (at, is_near) in [
        ([-1.99, 0.5, 0.1], true),
        ([-2.01, 0.5, 0.1], false),
        ([2.99, 0.5, 0.1], true),
        ([3.01, 0.5, 0.1], false),
        ([0.5, -1.99, 0.1], true),
        ([0.5, -2.01, 0.1], false),
        ([0.5, 2.99, 0.1], true),
        ([0.5, 3.01, 0.1], false),
        ([0.5, 0.5, 1.99], true),
        ([0.5, 0.5, 2.01], false),
        ([1.2, 0.5, -1.99], true),
        ([1.2, 0.5, -2.01], false),
    ] {
        bench.step(2.0, tracked(at));
        let told = bench.target.take().map(|told| told.pose.position);
        assert_eq!(told.is_some(), is_near, "{at:?}");
        assert!(told.is_none_or(|base| (base.z - (at[2] - 0.1)).abs() < 1e-9), "{at:?}");
    }
    for at in [[f64::NAN, 0.5, 0.1], [0.5, f64::INFINITY, 0.1], [0.5, 0.5, f64::NEG_INFINITY]] {
        bench.step(2.1, tracked(at));
        assert!(bench.target.is_none() && bench.status.contains("not finite"), "{at:?} {}", bench.status);
    }
}

#[test]
fn the_thing_to_place_is_no_thing_that_the_scene_waits_for_or_misses() {
    let boxed = Settings { target_shape: "box".into(), target_size_m: vec![0.1, 0.2, 0.3], ..settings() };
    let mut bench = Bench { node: TablePerceptionNode::new(boxed).expect("lists that fit"), ..Bench::new() };
    assert!(bench.step(0.0, tracked([0.5, 0.5, 0.5])).is_none(), "the first scene waits for the others");
    // 30 cm high, on something 35 cm above the table.
    let told = bench.target.take().expect("it waits for nothing").pose.position;
    assert!((told.z - 0.35).abs() < 1e-9, "{told:?}");
    assert_eq!(bench.status, "not seen: cup_left, cup_right, tray");
    bench.step(0.1, camera());
    let scene = bench.step(1.0, all()).expect("everything else is seen");
    assert_eq!((scene.objects.len(), bench.status.as_str()), (3, "all 3 things are seen"));
    // Where it is, and whether it is, changes nothing about the others.
    assert!(bench.step(2.0, tracked([0.2, 0.2, 0.5])).is_none());
    assert!(bench.step(50.0, all()).is_none() && bench.target.take().is_some_and(|told| told.pose.position.x == 0.2));
    assert_eq!(bench.status, "all 3 things are seen");
}
