//! The node on the graph.

use crate::{Event, Output, Settings, TablePerceptionNode};
use apprentice_msgs::geometry_msgs::PoseStamped;
use apprentice_msgs::msg::TableScene;
use bus::{Arguments, Bus, Graph, Level, NodeError, Qos};
use std::time::Duration;

const TICK: Duration = Duration::from_millis(500);

/// Runs the node until it is asked to stop.
///
/// # Errors
/// When the parameters are bad, or the graph cannot be joined.
pub fn run(graph: &Graph, arguments: &Arguments) -> Result<(), NodeError> {
    let settings: Settings = arguments.settings()?;
    let mut bus: Bus<Event> = Bus::open(graph, arguments, &settings)?;
    let scene = bus.publisher::<TableScene>("scene", Qos::State)?;
    let target_pose = bus.publisher::<PoseStamped>("target_pose", Qos::Stream)?;
    bus.subscribe("detections", Qos::Stream, |message| Event::Detections(Box::new(message)))?;
    bus.subscribe("/tf", Qos::Event, |message| Event::Transforms(Box::new(message)))?;
    bus.subscribe("/tf_static", Qos::State, |message| Event::Transforms(Box::new(message)))?;
    for (i, topic) in settings.pose_topics.iter().enumerate().filter(|(_, topic)| !topic.is_empty()) {
        bus.subscribe(topic, Qos::Stream, move |message| Event::Pose(i, Box::new(message)))?;
    }
    if !settings.target_pose_topic.is_empty() {
        bus.subscribe(&settings.target_pose_topic, Qos::Stream, |message| Event::TargetPose(Box::new(message)))?;
    }
    bus.every(TICK, || Event::Tick);
    let mut node = TablePerceptionNode::new(settings).map_err(|error| NodeError::Start(error.to_string()))?;
    while let Some((now, event)) = bus.next() {
        for output in node.step(now, event) {
            match output {
                Output::Scene(message) => scene.publish(&message)?,
                Output::TargetPose(message) => target_pose.publish(&message)?,
                Output::Status(is_well, text) => {
                    if is_well {
                        log::info!("{text}");
                    } else {
                        log::warn!("{text}");
                    }
                    bus.status(if is_well { Level::Ok } else { Level::Warn }, text, &[]);
                }
            }
        }
    }
    Ok(())
}
