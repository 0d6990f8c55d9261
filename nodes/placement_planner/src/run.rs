//! The node on the graph.

use crate::{Event, Output, PlacementPlanner, Settings};
use apprentice_msgs::msg::PlacementPlan;
use apprentice_msgs::std_msgs;
use apprentice_msgs::trajectory_msgs::JointTrajectory;
use bus::{Arguments, Bus, Graph, Level, NodeError, Qos};
use std::time::Duration;

/// Runs the node until it is asked to stop.
pub fn run(graph: &Graph, arguments: &Arguments) -> Result<(), NodeError> {
    let settings: Settings = arguments.settings()?;
    let mut bus = Bus::open(graph, arguments, &settings)?;
    let guess = bus.publisher::<PlacementPlan>("guess", Qos::State)?;
    let plan = bus.publisher::<PlacementPlan>("plan", Qos::State)?;
    let trajectory = bus.publisher::<JointTrajectory>("/joint_trajectory", Qos::Event)?;
    bus.subscribe("posterior", Qos::State, |message| Event::Posterior(Box::new(message)))?;
    bus.subscribe("query", Qos::State, |message| Event::Query(Box::new(message)))?;
    bus.subscribe("scene", Qos::State, |message| Event::Scene(Box::new(message)))?;
    bus.subscribe("lesson", Qos::State, Event::Lesson)?;
    let urdf = |message: std_msgs::String| Event::RobotDescription(message.data);
    bus.subscribe("/robot_description", Qos::State, urdf)?;
    bus.subscribe("/joint_states", Qos::Stream, Event::Joints)?;
    bus.every(Duration::from_secs_f64(settings.republish_period_s), || Event::Republish);
    let mut node = PlacementPlanner::new(settings);
    while let Some((now, event)) = bus.next() {
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
                Output::Trajectory(message) => {
                    log::info!("the lesson is taught: the arm moves, {} points", message.points.len());
                    trajectory.publish(&message)?;
                }
                Output::Warn(text) => log::warn!("{text}"),
            }
        }
    }
    Ok(())
}
