//! The node on the graph.

use crate::{Deed, Event, Output, PlacementPlanner, RobotFiles, Settings};
use apprentice_msgs::action::{PlaceObject, PlaceObjectResult};
use apprentice_msgs::control_msgs::FollowJointTrajectory;
use apprentice_msgs::moveit_msgs::PlanningScene;
use apprentice_msgs::msg::{ArmModel, ArmMotion, ArmPose, PlacementPlan};
use apprentice_msgs::std_msgs;
use apprentice_msgs::tf2_msgs::TFMessage;
use apprentice_msgs::trajectory_msgs::JointTrajectory;
use apprentice_msgs::visualization_msgs::MarkerArray;
use bus::{Arguments, Bus, Graph, Level, NodeError, Qos};
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
    bus.subscribe("posterior", Qos::State, |message| Event::Posterior(Box::new(message)))?;
    bus.subscribe("query", Qos::State, |message| Event::Query(Box::new(message)))?;
    bus.subscribe("scene", Qos::State, |message| Event::Scene(Box::new(message)))?;
    bus.subscribe("lesson", Qos::State, Event::Lesson)?;
    let urdf = |message: std_msgs::String| Event::RobotDescription(message.data);
    bus.subscribe("/robot_description", Qos::State, urdf)?;
    let srdf = |message: std_msgs::String| Event::RobotSemantics(message.data);
    bus.subscribe("/robot_description_semantic", Qos::State, srdf)?;
    bus.subscribe("/joint_states", Qos::Stream, Event::Joints)?;
    let place = bus.action_server::<PlaceObject>("place_object", Event::Place)?;
    let controller = match settings.controller.as_str() {
        "" => None,
        name => Some(bus.action_client::<FollowJointTrajectory>(name, |event| Event::Controller(Box::new(event)))?),
    };
    bus.every(TICK, || Event::Tick { controller_is_there: false });
    bus.every(Duration::from_secs_f64(settings.republish_period_s), || Event::Republish);
    let mut node = PlacementPlanner::with_files(settings, files);
    while let Some((now, event)) = bus.next() {
        let event = match event {
            Event::Tick { .. } => {
                let controller_is_there = controller.as_ref().is_some_and(bus::ActionClient::has_server);
                Event::Tick { controller_is_there }
            }
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
                Output::Deed(deed) => match (deed, &controller) {
                    (Deed::Publish(message), _) => {
                        log::info!("the arm moves: {} points", message.points.len());
                        trajectory.publish(&message)?;
                    }
                    (Deed::Send(goal_id, goal), Some(controller)) => {
                        log::info!("the arm moves: {} points to the controller", goal.trajectory.points.len());
                        controller.send_goal(goal_id, *goal)?;
                    }
                    (Deed::Cancel(goal_id), Some(controller)) => controller.cancel(goal_id)?,
                    (Deed::AskResult(goal_id), Some(controller)) => controller.request_result(goal_id)?,
                    (Deed::Send(..) | Deed::Cancel(_) | Deed::AskResult(_), None) => {}
                    (Deed::Feedback(goal_id, feedback), _) => place.feedback(goal_id, feedback),
                    (Deed::Finish(goal_id, end, result), _) => place.finish(goal_id, end, *result),
                    (Deed::Over(_, result), _) if result.outcome == PlaceObjectResult::DONE => {
                        log::info!("the motion is over: {}", result.reason);
                    }
                    (Deed::Over(_, result), _) => log::warn!("the motion is over: {}", result.reason),
                },
                Output::PlanningScene(message) => planning_scene.publish(&message)?,
                Output::Transforms(message) => transforms.publish(&message)?,
                Output::Markers(message) => markers.publish(&message)?,
                Output::ArmModel(message) => arm_model.publish(&message)?,
                Output::ArmPose(message) => arm_pose.publish(&message)?,
                Output::ArmMotion(message) => arm_motion.publish(&message)?,
                Output::Warn(text) => log::warn!("{text}"),
            }
        }
    }
    Ok(())
}
