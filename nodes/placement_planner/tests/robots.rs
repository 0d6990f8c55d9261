//! Robots with meshes and SRDFs as the node takes them, and what an arm that cannot do it is told.
#![allow(clippy::unwrap_used, reason = "a test may panic")]

mod support;

use apprentice_msgs::action::{PlaceObjectGoal, PlaceObjectResult};
use apprentice_msgs::builtin_interfaces::Time;
use apprentice_msgs::msg::{PlacementCandidate, PlacementPlan};
use apprentice_msgs::sensor_msgs::JointState;
use apprentice_msgs::to_cdr;
use bus::{ActionRequest, GoalId};
use exchange::scene_to_message;
use placement_planner::{Deed, Event, Output, PlacementPlanner, Request, RobotFiles, Settings};
use scene::{Scene, Shape};
use std::fs;
use std::path::Path;
use support::{URDF, joints, object, only_plan, posterior, ready, scene, step, table};

/// Shape of the base's collision in the description, and a mesh in its place.
const PRIMITIVE: &str = r#"<collision>
      <origin xyz="0 0 0.125"/>
      <geometry><cylinder radius="0.085" length="0.25"/></geometry>"#;
const MESH: &str = r#"<collision>
      <origin xyz="0 0 0.125"/>
      <geometry><mesh filename="package://table_arm_description/base.stl"/></geometry>"#;

fn with_mesh() -> String {
    assert!(URDF.contains(PRIMITIVE));
    URDF.replace(PRIMITIVE, MESH)
}

/// A tetrahedron in a package of its own.
fn package(size_m: f64) -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    let package = folder.path().join("table_arm_description");
    fs::create_dir(&package).unwrap();
    let corners = [[0.0, 0.0, 0.1], [0.08, 0.0, -0.1], [-0.08, 0.06, -0.1], [-0.08, -0.06, -0.1]];
    let vertex = |i: usize| {
        let [x, y, z] = corners[i].map(|v: f64| v * size_m);
        format!("vertex {x} {y} {z}\n")
    };
    let faces = [[0, 1, 2], [0, 2, 3], [0, 3, 1], [1, 3, 2]];
    let facets: String = faces
        .iter()
        .map(|face| {
            let corners: String = face.iter().map(|&i| vertex(i)).collect();
            format!("facet normal 0 0 0\nouter loop\n{corners}endloop\nendfacet\n")
        })
        .collect();
    fs::write(package.join("base.stl"), format!("solid base\n{facets}endsolid base\n")).unwrap();
    folder
}

fn settings(root: &Path) -> Settings {
    Settings { package_paths: vec![root.to_str().unwrap().to_owned()], threads: 1, ..Settings::default() }
}

/// A planner of a robot with files, which knows table, joints and rewards; what it said to the description comes too.
fn planner(settings: Settings, urdf: &str) -> (PlacementPlanner, Vec<Output>) {
    let files = RobotFiles::open(&settings).unwrap();
    let mut node = PlacementPlanner::with_files(settings, files);
    step(&mut node, Event::Joints(joints()));
    step(&mut node, Event::Scene(Box::new(scene())));
    step(&mut node, Event::Posterior(Box::new(posterior(1))));
    let outputs = step(&mut node, Event::RobotDescription(urdf.into()));
    (node, outputs)
}

fn plan_of(outputs: &[Output]) -> PlacementPlan {
    let plan = outputs.iter().find_map(|output| match output {
        Output::Plan(plan) => Some((**plan).clone()),
        _ => None,
    });
    plan.unwrap_or_else(|| panic!("a plan was expected, got {outputs:?}"))
}

fn warnings(outputs: &[Output]) -> Vec<&str> {
    let told = outputs.iter().map(|output| if let Output::Warn(text) = output { text.as_str() } else { "" });
    told.filter(|text| !text.is_empty()).collect()
}

#[test]
fn meshes_are_read_from_the_packages_and_plans_name_them() {
    let (small, large) = (package(1.0), package(1.2));
    let (mut node, outputs) = planner(settings(small.path()), &with_mesh());
    let plan = only_plan(&outputs);
    assert_eq!(plan.outcome, PlacementPlan::PLANNED, "{}", plan.reason);
    assert!(step(&mut node, Event::RobotDescription(with_mesh())).is_empty(), "it was there already");
    let (_, other) = planner(settings(large.path()), &with_mesh());
    let other = only_plan(&other);
    assert_ne!(plan.robot_hash, other.robot_hash, "another mesh is another robot");
    assert_eq!(plan.robot_hash.len(), 64);
    // As a replay computes it.
    let mut again =
        PlacementPlanner::with_files(settings(small.path()), RobotFiles::open(&settings(small.path())).unwrap());
    again.set_robot(&with_mesh(), None).unwrap();
    assert_eq!(again.robot_hash(), plan.robot_hash);
    let request = Request {
        posterior: &posterior(1),
        query_id: "",
        scene: &plan.scene,
        start: &plan.start,
        pick: None,
        inside_bound: false,
    };
    assert_eq!(to_cdr(&again.plan(&request).unwrap()), to_cdr(&plan));
}

#[test]
fn without_its_mesh_a_robot_is_refused_or_bounded_as_the_parameter_says() {
    let empty = tempfile::tempdir().unwrap();
    let (_, outputs) = planner(settings(empty.path()), &with_mesh());
    let [Output::Warn(text)] = outputs.as_slice() else { panic!("{outputs:?}") };
    for part in ["the robot description is ignored", "base.stl", "set the parameter package_paths"] {
        assert!(text.contains(part), "{text}");
    }
    let no_folder = Settings { package_paths: Vec::new(), ..settings(empty.path()) };
    let (_, outputs) = planner(no_folder, &with_mesh());
    assert!(warnings(&outputs)[0].contains("no folder was given"), "{outputs:?}");
    let bound = Settings { missing_meshes: "bound".into(), ..settings(empty.path()) };
    let (_, outputs) = planner(bound, &with_mesh());
    let told = warnings(&outputs);
    assert!(told.len() == 1 && told[0].contains("base.stl") && told[0].contains("stands in for it"), "{told:?}");
    assert_eq!(plan_of(&outputs).outcome, PlacementPlan::PLANNED);
    // A name that leads out of the folders finds nothing.
    let out = with_mesh().replace("table_arm_description/base.stl", "../../etc/passwd.stl");
    let (_, outputs) = planner(settings(package(1.0).path()), &out);
    assert!(warnings(&outputs)[0].contains("without '..'"), "{outputs:?}");
}

#[test]
fn an_srdf_says_which_links_may_touch_by_file_or_by_topic() {
    let folder = tempfile::tempdir().unwrap();
    // An upper arm so thick that it always touches the forearm's end and the base.
    let thick = URDF.replace(
        r#"<origin xyz="0 0 0.31"/>
      <geometry><cylinder radius="0.05" length="0.5"/></geometry>
    </collision>"#,
        r#"<origin xyz="0 0 0.31"/>
      <geometry><cylinder radius="0.05" length="0.5"/></geometry>
    </collision>
    <collision>
      <origin xyz="0 0 0"/>
      <geometry><cylinder radius="0.05" length="0.34"/></geometry>
    </collision>"#,
    );
    assert_ne!(thick, URDF);
    let pairs = |rest: &str| format!(r#"<robot name="table_arm">{rest}</robot>"#);
    let some = pairs(r#"<disable_collisions link1="base_link" link2="upper_arm_link" reason="Never"/>"#);
    let none = pairs("");
    let path = folder.path().join("arm.srdf");
    fs::write(&path, &some).unwrap();
    let bare = Settings { threads: 1, ..Settings::default() };
    let by_file = Settings { srdf: path.to_str().unwrap().to_owned(), ..bare.clone() };
    let (mut node, outputs) = planner(by_file, &thick);
    let plan = plan_of(&outputs);
    assert_eq!(plan.outcome, PlacementPlan::PLANNED, "{}", plan.reason);
    assert!(step(&mut node, Event::RobotSemantics(none.clone())).is_empty(), "the file counts");
    let (mut node, _) = planner(bare, &thick);
    let on_topic = plan_of(&step(&mut node, Event::RobotSemantics(some)));
    assert_eq!(on_topic.robot_hash, plan.robot_hash);
    assert_eq!(to_cdr(&on_topic), to_cdr(&plan));
    let strict = plan_of(&step(&mut node, Event::RobotSemantics(none)));
    assert_eq!(strict.outcome, PlacementPlan::GOAL_IN_COLLISION.min(strict.outcome), "{}", strict.reason);
    assert_ne!((strict.outcome, &strict.robot_hash), (PlacementPlan::PLANNED, &plan.robot_hash));
    // One that is broken is told, and what always touches is left out.
    let outputs = step(&mut node, Event::RobotSemantics("<robot".into()));
    assert!(warnings(&outputs)[0].contains("SRDF"), "{outputs:?}");
    let outputs =
        step(&mut node, Event::RobotSemantics(pairs(r#"<disable_collisions link1="base_link" link2="tail"/>"#)));
    assert!(warnings(&outputs)[0].contains("the SRDF names the link 'tail'"), "{outputs:?}");
}

#[test]
fn files_that_are_not_there_stop_the_node_with_their_names() {
    let lost = Settings { package_paths: vec!["/no/such/folder".into()], ..Settings::default() };
    let error = RobotFiles::open(&lost).unwrap_err().to_string();
    assert!(error.starts_with("parameter package_paths: the package path /no/such/folder"), "{error}");
    let lost = Settings { srdf: "/no/such/file.srdf".into(), ..Settings::default() };
    let error = RobotFiles::open(&lost).unwrap_err().to_string();
    assert!(error.starts_with("parameter srdf: /no/such/file.srdf"), "{error}");
}

/// What comes of a goal of `place_object` that only plans.
fn placed(node: &mut PlacementPlanner) -> PlaceObjectResult {
    let goal = PlaceObjectGoal { plan_only: true, ..PlaceObjectGoal::default() };
    let request = ActionRequest::Goal { goal_id: GoalId { uuid: [7; 16] }, goal };
    let outputs = step(node, Event::Place(request));
    let result = outputs.iter().find_map(|output| match output {
        Output::Deed(Deed::Finish(_, _, result)) => Some((**result).clone()),
        _ => None,
    });
    result.unwrap_or_else(|| panic!("a result was expected, got {outputs:?}"))
}

/// A planner that knows everything, the joints being these.
fn standing(joints: JointState) -> (PlacementPlanner, PlacementPlan) {
    let mut node = ready();
    step(&mut node, Event::Joints(joints));
    step(&mut node, Event::Scene(Box::new(scene())));
    let plan = only_plan(&step(&mut node, Event::Posterior(Box::new(posterior(1)))));
    (node, plan)
}

fn moved(joint: &str, to: f64) -> JointState {
    let mut joints = joints();
    let i = joints.name.iter().position(|name| name == joint).unwrap();
    joints.position[i] = to;
    joints
}

#[test]
fn a_start_in_collision_is_told_and_planned_anew_once_the_arm_is_elsewhere() {
    let mut lying = moved("shoulder_pitch", 1.5);
    (lying.position[2], lying.position[4]) = (0.6, 0.5);
    let (mut node, plan) = standing(lying.clone());
    assert_eq!(plan.outcome, PlacementPlan::START_IN_COLLISION, "{}", plan.reason);
    assert!(plan.reason.contains("touches") && plan.trajectory.points.is_empty(), "{}", plan.reason);
    assert!(plan.robust_placement.x.is_finite() && !plan.candidates.is_empty(), "the place stands");
    assert_eq!(placed(&mut node).outcome, PlaceObjectResult::START_IN_COLLISION);
    assert!(step(&mut node, Event::Joints(lying)).is_empty(), "nothing changed");
    assert_eq!(only_plan(&step(&mut node, Event::Joints(joints()))).outcome, PlacementPlan::PLANNED);
}

#[test]
fn a_goal_in_collision_is_told_with_what_would_touch() {
    // A pillar leaves room for the thing beside it, but not for the hand.
    let mut narrow = table();
    (narrow.width_m, narrow.depth_m) = (0.3, 0.3);
    narrow.objects[0] = object("cup", 0.15, 0.15, 0.1);
    narrow.objects[0].shape = Shape::Box { width_m: 0.24, depth_m: 0.24, height_m: 0.9 };
    narrow.target.shape = Shape::Cylinder { radius_m: 0.01, height_m: 0.1 };
    let mut node = ready();
    step(&mut node, Event::Scene(Box::new(scene_to_message(&narrow, Time::default()))));
    let plan = only_plan(&step(&mut node, Event::Posterior(Box::new(posterior(1)))));
    assert_eq!(plan.outcome, PlacementPlan::GOAL_IN_COLLISION, "{}", plan.reason);
    assert!(plan.reason.contains("would touch 'cup', for one"), "{}", plan.reason);
    assert!(plan.candidates.iter().any(|one| one.verdict == PlacementCandidate::BLOCKED));
    assert_eq!(placed(&mut node).outcome, PlaceObjectResult::GOAL_IN_COLLISION);
}

#[test]
fn joints_that_are_missing_are_named_and_more_joints_change_nothing() {
    let mut few = joints();
    few.name.remove(2);
    few.position.remove(2);
    let (mut node, plan) = standing(few);
    assert_eq!(plan.outcome, PlacementPlan::JOINTS_UNKNOWN, "{}", plan.reason);
    assert_eq!(plan.reason, "where the arm is, is not known: nothing is heard of joint 'elbow'");
    assert!(plan.robust_placement.x.is_finite() && plan.trajectory.points.is_empty());
    assert_eq!(placed(&mut node).outcome, PlaceObjectResult::STALE_JOINTS);
    let whole = only_plan(&step(&mut node, Event::Joints(joints())));
    assert_eq!(whole.outcome, PlacementPlan::PLANNED);
    let mut many = joints();
    for i in 0..40 {
        many.name.push(format!("wheel_{i}"));
        many.position.push(f64::from(i));
    }
    let (_, with_more) = standing(many);
    assert_eq!(to_cdr(&with_more), to_cdr(&whole));
}

#[test]
fn a_joint_beyond_its_limits_is_told() {
    let (mut node, plan) = standing(moved("shoulder_yaw", 3.2));
    assert_eq!(plan.outcome, PlacementPlan::OUTSIDE_LIMITS, "{}", plan.reason);
    assert!(plan.reason.starts_with("joint 'shoulder_yaw' is at 3.200, outside its limits -2.900 to 2.900"));
    assert_eq!(placed(&mut node).outcome, PlaceObjectResult::OUTSIDE_LIMITS);
    // An encoder's error is none.
    let (_, plan) = standing(moved("shoulder_yaw", 2.901));
    assert_eq!(plan.outcome, PlacementPlan::PLANNED, "{}", plan.reason);
}

#[test]
fn limits_of_zero_are_told() {
    let yaw = r#"<limit lower="-2.9" upper="2.9" effort="150" velocity="1.6"/>"#;
    assert!(URDF.contains(yaw));
    let mut node = ready();
    let still = URDF.replace(yaw, r#"<limit lower="-2.9" upper="2.9" effort="150" velocity="0"/>"#);
    let outputs = step(&mut node, Event::RobotDescription(still));
    let [Output::Warn(text)] = outputs.as_slice() else { panic!("{outputs:?}") };
    assert!(text.contains("shoulder_yaw") && text.contains("velocity"), "{text}");
    // No room to move in: a joint of no use, but none that spoils the others.
    let stuck = URDF
        .replace("-2.0\" upper=\"2.0\"", "0\" upper=\"0\"")
        .replace("lower=\"-2.7\" upper=\"2.7\"", "lower=\"0\" upper=\"0\"");
    let mut zero = moved("shoulder_pitch", 0.0);
    zero.position[2] = 0.0;
    step(&mut node, Event::Joints(zero));
    step(&mut node, Event::RobotDescription(stuck));
    step(&mut node, Event::Scene(Box::new(scene())));
    let plan = only_plan(&step(&mut node, Event::Posterior(Box::new(posterior(1)))));
    assert_eq!(plan.outcome, PlacementPlan::UNREACHABLE, "{}", plan.reason);
    assert!(
        plan.reason.ends_with("by their limits these joints cannot move: shoulder_pitch, elbow"),
        "{}",
        plan.reason
    );
}

#[test]
fn goals_out_of_reach_are_told() {
    let mut far = table();
    far.target.shape = Shape::Cylinder { radius_m: 0.04, height_m: 2.0 };
    let mut node = ready();
    step(&mut node, Event::Scene(Box::new(scene_to_message(&far, Time::default()))));
    let plan = only_plan(&step(&mut node, Event::Posterior(Box::new(posterior(1)))));
    assert_eq!(plan.outcome, PlacementPlan::UNREACHABLE, "{}", plan.reason);
    assert_eq!(plan.reason, "the arm reaches none of the free places for 'vase'");
    assert!(plan.candidates.iter().all(|one| one.reason == "out of the arm's reach"));
    assert_eq!(placed(&mut node).outcome, PlaceObjectResult::UNREACHABLE);
}

#[test]
fn a_table_may_be_placed_by_parameters() {
    let elsewhere = scene_to_message(&Scene { frame: "kitchen".into(), ..table() }, Time::default());
    let mut by_link = ready();
    step(&mut by_link, Event::Scene(Box::new(elsewhere.clone())));
    let plan = only_plan(&step(&mut by_link, Event::Posterior(Box::new(posterior(1)))));
    assert_eq!(plan.outcome, PlacementPlan::NO_ROBOT, "{}", plan.reason);
    let settings = Settings { table_position_m: vec![0.0, 0.05, 0.0], ..Settings::default() };
    let mut node = PlacementPlanner::new(settings);
    step(&mut node, Event::Joints(joints()));
    step(&mut node, Event::RobotDescription(URDF.into()));
    step(&mut node, Event::Scene(Box::new(elsewhere)));
    let plan = only_plan(&step(&mut node, Event::Posterior(Box::new(posterior(1)))));
    assert_eq!(plan.outcome, PlacementPlan::PLANNED, "{}", plan.reason);
}
