//! The node on the graph.

use crate::{Deed, Event, Heard, Limb, Output, PlacementPlanner, RobotFiles, Settings};
use apprentice_msgs::action::{PlaceObject, PlaceObjectResult};
use apprentice_msgs::control_msgs::{FollowJointTrajectory, GripperCommandAction};
use apprentice_msgs::moveit_msgs::PlanningScene;
use apprentice_msgs::msg::{ArmModel, ArmMotion, ArmPose, Carrying, PlacementPlan, TableReach};
use apprentice_msgs::std_msgs;
use apprentice_msgs::tf2_msgs::TFMessage;
use apprentice_msgs::trajectory_msgs::JointTrajectory;
use apprentice_msgs::visualization_msgs::MarkerArray;
use bus::{ActionClient, Arguments, Bus, Graph, Level, NodeError, Qos};
use std::time::Duration;

/// How often a motion is looked after.
const TICK: Duration = Duration::from_millis(100);

/// Runs the node until it is asked to stop.
pub fn run(graph: &Graph, arguments: &Arguments) -> Result<(), NodeError> {
    let settings: Settings = arguments.settings()?;
    let files = RobotFiles::open(&settings).map_err(|error| NodeError::Start(error.to_string()))?;
    let mut bus = Bus::open(graph, arguments, &settings)?;
    let guess = bus.publisher::<PlacementPlan>("guess", Qos::State)?;
    let plan = bus.publisher::<PlacementPlan>("plan", Qos::State)?;
    let trajectory = bus.publisher::<JointTrajectory>("/joint_trajectory", Qos::Event)?;
    let planning_scene = bus.publisher::<PlanningScene>("/planning_scene", Qos::State)?;
    let transforms = bus.publisher::<TFMessage>("/tf", Qos::Event)?;
    let markers = bus.publisher::<MarkerArray>("plan_markers", Qos::State)?;
    let arm_model = bus.publisher::<ArmModel>("arm_model", Qos::State)?;
    let arm_pose = bus.publisher::<ArmPose>("arm_pose", Qos::Stream)?;
    let arm_motion = bus.publisher::<ArmMotion>("arm_motion", Qos::State)?;
    let reach = bus.publisher::<TableReach>("reach", Qos::State)?;
    let carrying = bus.publisher::<Carrying>("carrying", Qos::State)?;
    bus.subscribe("posterior", Qos::State, |message| Event::Posterior(Box::new(message)))?;
    bus.subscribe("query", Qos::State, |message| Event::Query(Box::new(message)))?;
    bus.subscribe("scene", Qos::State, |message| Event::Scene(Box::new(message)))?;
    bus.subscribe("lesson", Qos::State, Event::Lesson)?;
    let urdf = |message: std_msgs::String| Event::RobotDescription(message.data);
    bus.subscribe("/robot_description", Qos::State, urdf)?;
    let srdf = |message: std_msgs::String| Event::RobotSemantics(message.data);
    bus.subscribe("/robot_description_semantic", Qos::State, srdf)?;
    bus.subscribe("/joint_states", Qos::Stream, Event::Joints)?;
    bus.subscribe("target_pose", Qos::Stream, |message| Event::TargetPose(Box::new(message)))?;
    let place = bus.action_server::<PlaceObject>("place_object", Event::Place)?;
    let controller = match settings.controller.as_str() {
        "" => None,
        name => Some(bus.action_client::<FollowJointTrajectory>(name, |event| Event::Controller(Box::new(event)))?),
    };
    let gripper = match settings.gripper_controller.as_str() {
        "" => None,
        name => Some(bus.action_client::<GripperCommandAction>(name, |event| Event::Gripper(Box::new(event)))?),
    };
    bus.every(TICK, || Event::Tick(Heard::default()));
    bus.every(Duration::from_secs_f64(settings.republish_period_s), || Event::Republish);
    let mut node = PlacementPlanner::with_files(settings, files);
    while let Some((now, event)) = bus.next() {
        let event = match event {
            Event::Tick(_) => Event::Tick(Heard {
                arm: controller.as_ref().is_some_and(ActionClient::has_server),
                gripper: gripper.as_ref().is_some_and(ActionClient::has_server),
            }),
            event => event,
        };
        for output in node.step(now, event) {
            match output {
                Output::Guess(message) => guess.publish(&message)?,
                Output::Plan(message) => {
                    let level = if message.outcome == PlacementPlan::PLANNED { Level::Ok } else { Level::Warn };
                    let facts = [
                        ("revision", message.revision.to_string()),
                        ("robust_cvar_m", message.robust_cvar_m.to_string()),
                        ("inside_bound", message.inside_bound.to_string()),
                    ];
                    bus.status(level, message.reason.clone(), &facts);
                    plan.publish(&message)?;
                }
                Output::Accept(goal_id) => place.accept(goal_id),
                Output::Deed(deed) => match deed {
                    Deed::Publish(message) => {
                        log::info!("{}: {} points", moves(&message.joint_names), message.points.len());
                        trajectory.publish(&message)?;
                    }
                    Deed::Send(goal_id, goal) => {
                        log::info!("the arm moves: {} points to the controller", goal.trajectory.points.len());
                        if let Some(controller) = &controller {
                            controller.send_goal(goal_id, *goal)?;
                        }
                    }
                    Deed::Grip(goal_id, goal) => {
                        log::info!("the gripper moves to {:.4}", goal.command.position);
                        if let Some(gripper) = &gripper {
                            gripper.send_goal(goal_id, goal)?;
                        }
                    }
                    Deed::Cancel(limb, goal_id) => match (limb, &controller, &gripper) {
                        (Limb::Arm, Some(controller), _) => controller.cancel(goal_id)?,
                        (Limb::Gripper, _, Some(gripper)) => gripper.cancel(goal_id)?,
                        _ => {}
                    },
                    Deed::AskResult(limb, goal_id) => match (limb, &controller, &gripper) {
                        (Limb::Arm, Some(controller), _) => controller.request_result(goal_id)?,
                        (Limb::Gripper, _, Some(gripper)) => gripper.request_result(goal_id)?,
                        _ => {}
                    },
                    Deed::Feedback(goal_id, feedback) => place.feedback(goal_id, feedback),
                    Deed::Tell(message) => carrying.publish(&message)?,
                    Deed::Finish(goal_id, end, result) => place.finish(goal_id, end, *result),
                    Deed::Over(_, result) if result.outcome == PlaceObjectResult::DONE => {
                        log::info!("the motion is over: {}", result.reason);
                    }
                    Deed::Over(_, result) => log::warn!("the motion is over: {}", result.reason),
                },
                Output::PlanningScene(message) => planning_scene.publish(&message)?,
                Output::Transforms(message) => transforms.publish(&message)?,
                Output::Markers(message) => markers.publish(&message)?,
                Output::ArmModel(message) => arm_model.publish(&message)?,
                Output::ArmPose(message) => arm_pose.publish(&message)?,
                Output::ArmMotion(message) => arm_motion.publish(&message)?,
                Output::Reach(message) => reach.publish(&message)?,
                Output::Warn(text) => log::warn!("{text}"),
            }
        }
    }
    Ok(())
}

/// What a trajectory on the topic moves.
fn moves(joints: &[String]) -> &'static str {
    if joints.len() == 1 { "a joint moves" } else { "the arm moves" }
}
