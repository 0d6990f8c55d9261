//! Wires the node to the graph.

use crate::{DemonstratorNode, Event, Output, Settings};
use apprentice_msgs::msg::{ActionDemonstration, PlacementDemonstration, SegmentCritique, TrajectoryPreference};
use bus::{Arguments, Bus, Graph, NodeError, Qos};
use std::time::Duration;

/// Questions are answered and answers repeated at this resolution.
const TICK: Duration = Duration::from_millis(50);

/// Runs the node until the graph is shut down or the process is asked to end.
///
/// # Errors
/// When the parameters are bad or the graph cannot be joined.
pub fn run(graph: &Graph, arguments: &Arguments) -> Result<(), NodeError> {
    let settings: Settings = arguments.settings()?;
    let mut bus: Bus<Event> = Bus::open(graph, arguments, &settings)?;
    let demonstration = bus.publisher::<PlacementDemonstration>("demonstration", Qos::Event)?;
    let response = bus.publisher("response", Qos::Event)?;
    let actions = bus.publisher::<ActionDemonstration>("action_demonstration", Qos::Event)?;
    let preference = bus.publisher::<TrajectoryPreference>("preference", Qos::Event)?;
    let critique = bus.publisher::<SegmentCritique>("critique", Qos::Event)?;
    bus.subscribe("receipt", Qos::Event, Event::Receipt)?;
    bus.subscribe("query", Qos::State, |message| Event::Query(Box::new(message)))?;
    bus.subscribe("world_query", Qos::State, |message| Event::WorldQuery(Box::new(message)))?;
    bus.subscribe("world", Qos::State, |message| Event::World(Box::new(message)))?;
    bus.subscribe("lesson", Qos::State, |message| Event::Lesson(Box::new(message)))?;
    bus.every(TICK, || Event::Tick);
    let mut node = DemonstratorNode::new(&settings);
    while let Some((now, event)) = bus.next() {
        for output in node.step(now, event) {
            match output {
                Output::Demonstration(message) => demonstration.publish(&*message)?,
                Output::Response(message) => response.publish(&message)?,
                Output::Actions(message) => actions.publish(&message)?,
                Output::Preference(message) => preference.publish(&message)?,
                Output::Critique(message) => critique.publish(&*message)?,
                Output::Warning(text) => log::warn!("{text}"),
            }
        }
    }
    Ok(())
}
