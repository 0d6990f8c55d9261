//! Wires the node to the graph, and reads the robot's description.

use crate::{BUILT_IN_URDF, Event, Output, RobotError, Settings, SimulatedTableNode};
use bus::{Arguments, Bus, Graph, NodeError, Qos};
use std::io::Read;
use std::path::Path;
use std::time::Duration;

const JOINT_PERIOD: Duration = Duration::from_millis(50);
const SCENE_PERIOD: Duration = Duration::from_secs(2);

/// Runs the node until the graph is shut down or the process is asked to end.
///
/// # Errors
/// When the parameters or the robot's description are bad, or the graph cannot be joined.
pub fn run(graph: &Graph, arguments: &Arguments) -> Result<(), NodeError> {
    let settings: Settings = arguments.settings()?;
    let urdf = read_urdf(&settings.urdf).map_err(|error| NodeError::Start(error.to_string()))?;
    let mut node = SimulatedTableNode::new(&settings, urdf).map_err(|error| NodeError::Start(error.to_string()))?;
    let mut bus: Bus<Event> = Bus::open(graph, arguments, &settings)?;
    let scene = bus.publisher("scene", Qos::State)?;
    let description = bus.publisher("/robot_description", Qos::State)?;
    let transform = bus.publisher("/tf_static", Qos::State)?;
    let joints = bus.publisher("/joint_states", Qos::Stream)?;
    let target_pose = bus.publisher("target_pose", Qos::Stream)?;
    bus.subscribe("/joint_trajectory", Qos::Event, Event::Trajectory)?;
    bus.every(JOINT_PERIOD, || Event::Tick);
    bus.every(SCENE_PERIOD, || Event::Announce);
    // The first announcement does not wait for the timer.
    bus.sender().send(Event::Announce);
    while let Some((now, event)) = bus.next() {
        for output in node.step(now, event) {
            match output {
                Output::Scene(message) => scene.publish(&message)?,
                Output::RobotDescription(message) => description.publish(&message)?,
                Output::Transform(message) => transform.publish(&message)?,
                Output::TargetPose(message) => target_pose.publish(&message)?,
                Output::Joints(message) => joints.publish(&message)?,
                Output::Warning(text) => log::warn!("{text}"),
            }
        }
    }
    Ok(())
}

/// The text of a URDF file; an empty path stands for the arm built in.
fn read_urdf(path: &str) -> Result<String, RobotError> {
    if path.is_empty() {
        return Ok(BUILT_IN_URDF.to_owned());
    }
    let path = Path::new(path);
    let unreadable = |source| RobotError::Read { path: path.to_owned(), source };
    let file = std::fs::File::open(path).map_err(unreadable)?;
    let got = file.metadata().map_err(unreadable)?.len();
    if got > arm::MAX_BYTES as u64 {
        return Err(RobotError::Size { path: path.to_owned(), got });
    }
    let mut text = String::new();
    file.take(arm::MAX_BYTES as u64).read_to_string(&mut text).map_err(unreadable)?;
    Ok(text)
}
