//! A table with a cup, a vase to place in its middle, and an arm beside it.
#![allow(dead_code, reason = "each test uses some of it")]

use apprentice_msgs::builtin_interfaces::Time;
use apprentice_msgs::msg::{LessonStatus, PlacementPlan, PlacementQuery, Posterior, TableScene};
use apprentice_msgs::sensor_msgs::JointState;
use exchange::scene_to_message;
use placement_planner::{Deed, Event, Output, PlacementPlanner, Settings};
use scene::{Object, Point, Rbf, Scene, Shape};

pub const URDF: &str = include_str!("../../../../config/urdf/table_arm.urdf");

pub fn object(id: &str, x: f64, y: f64, radius_m: f64) -> Object {
    Object {
        id: id.into(),
        label: id.into(),
        shape: Shape::Cylinder { radius_m, height_m: 0.1 },
        position_m: Point::new(x, y),
        yaw_rad: 0.0,
        supports: false,
    }
}

pub fn table() -> Scene {
    Scene {
        id: "task".into(),
        frame: "table".into(),
        width_m: 1.0,
        depth_m: 1.0,
        objects: vec![object("cup", 0.2, 0.25, 0.05)],
        target: Object { shape: Shape::Cylinder { radius_m: 0.04, height_m: 0.2 }, ..object("vase", 0.0, 0.0, 0.04) },
    }
}

pub fn scene() -> TableScene {
    scene_to_message(&table(), Time::default())
}

/// All draws want the middle.
pub fn posterior(revision: u64) -> Posterior {
    let weights = |k: usize| if k == 5 { 1.0 } else { 0.0 };
    Posterior {
        revision,
        task: scene(),
        feature_names: Rbf::names(&table()),
        n_chains: 4,
        n_draws: 8,
        draws: (0..80).map(|i| weights(i % 10) as f32).collect(),
        map_weights: (0..10).map(weights).collect(),
        ..Posterior::default()
    }
}

pub fn query(id: &str, revision: u64) -> PlacementQuery {
    PlacementQuery { id: id.into(), revision, scene: scene(), ..PlacementQuery::default() }
}

pub fn lesson(state: u8, revision: u64) -> Event {
    Event::Lesson(LessonStatus { state, revision, ..LessonStatus::default() })
}

pub fn joints() -> JointState {
    let names = ["shoulder_yaw", "shoulder_pitch", "elbow", "forearm_roll", "wrist_pitch", "wrist_roll", "finger_left"];
    JointState {
        name: names.map(String::from).to_vec(),
        position: vec![0.0, -0.6, 2.2, 0.0, 1.54, 0.0, 0.05],
        ..JointState::default()
    }
}

/// What a node does about an event, what it shows to other programs left out.
pub fn step(node: &mut PlacementPlanner, event: Event) -> Vec<Output> {
    let mut outputs = node.step(Time::default(), event);
    outputs.retain(|output| {
        let is_shown = matches!(output, Output::PlanningScene(_) | Output::Transforms(_) | Output::Markers(_));
        let is_told = matches!(output, Output::Deed(Deed::Tell(_)) | Output::Reach(_));
        !(is_shown || is_told || matches!(output, Output::ArmModel(_) | Output::ArmPose(_) | Output::ArmMotion(_)))
    });
    outputs
}

/// A planner with robot and joints.
pub fn ready() -> PlacementPlanner {
    let mut node = PlacementPlanner::new(Settings::default());
    assert!(step(&mut node, Event::Joints(joints())).is_empty());
    assert!(step(&mut node, Event::RobotDescription(URDF.into())).is_empty());
    node
}

pub fn only_plan(outputs: &[Output]) -> PlacementPlan {
    match outputs {
        [Output::Plan(plan)] => (**plan).clone(),
        other => panic!("a plan was expected, got {other:?}"),
    }
}
