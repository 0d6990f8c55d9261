//! Wires the node to the graph.

use crate::{Event, Output, Settings, SimulatedWorldNode};
use bus::{Arguments, Bus, Graph, NodeError, Qos};
use std::time::Duration;

const PERIOD: Duration = Duration::from_secs(2);

/// Runs the node until the graph is shut down or the process is asked to end.
///
/// # Errors
/// When the parameters make no world, or the graph cannot be joined.
pub fn run(graph: &Graph, arguments: &Arguments) -> Result<(), NodeError> {
    let settings: Settings = arguments.settings()?;
    let mut node = SimulatedWorldNode::new(&settings).map_err(|error| NodeError::Start(error.to_string()))?;
    let mut bus: Bus<Event> = Bus::open(graph, arguments, &settings)?;
    let world = bus.publisher("world", Qos::State)?;
    bus.every(PERIOD, || Event::Announce);
    // The first announcement does not wait for the timer.
    bus.sender().send(Event::Announce);
    while let Some((now, event)) = bus.next() {
        for output in node.step(now, event) {
            match output {
                Output::World(message) => world.publish(&*message)?,
            }
        }
    }
    Ok(())
}
