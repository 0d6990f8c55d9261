//! The node on the graph.

use crate::worlds::TICKS_PER_SECOND;
use crate::{ActiveQuery, Event, Output, Settings};
use apprentice_msgs::msg::{Candidates, LessonStatus, PlacementQuery, WorldQuery};
use bus::{Arguments, Bus, Graph, Level, NodeError, Qos};
use std::time::Duration;

/// Runs the node until it is asked to stop.
pub fn run(graph: &Graph, arguments: &Arguments) -> Result<(), NodeError> {
    let settings: Settings = arguments.settings()?;
    let mut bus = Bus::open(graph, arguments, &settings)?;
    let candidates = bus.publisher::<Candidates>("candidates", Qos::State)?;
    let query = bus.publisher::<PlacementQuery>("query", Qos::State)?;
    let world_query = bus.publisher::<WorldQuery>("world_query", Qos::State)?;
    let lesson = bus.publisher::<LessonStatus>("lesson", Qos::State)?;
    bus.subscribe("posterior", Qos::State, |message| Event::Posterior(Box::new(message)))?;
    bus.subscribe("reach", Qos::State, |message| Event::Reach(Box::new(message)))?;
    bus.subscribe("bounds", Qos::State, |message| Event::Bounds(Box::new(message)))?;
    bus.subscribe("policy_bounds", Qos::State, |message| Event::PolicyBounds(Box::new(message)))?;
    bus.subscribe("robust_policy", Qos::State, |message| Event::Policy(Box::new(message)))?;
    bus.subscribe("world", Qos::State, |message| Event::World(Box::new(message)))?;
    bus.subscribe("lesson_world", Qos::State, |message| Event::World(Box::new(message)))?;
    bus.subscribe("evidence", Qos::State, |message| Event::Evidence(Box::new(message)))?;
    bus.every(Duration::from_secs_f64(settings.republish_period_s), || Event::Republish);
    if settings.next_within_s > 0.0 {
        bus.every(Duration::from_secs_f64(1.0 / TICKS_PER_SECOND), || Event::Tick);
    }
    let later = bus.sender();
    let mut node = ActiveQuery::new(settings);
    while let Some((now, event)) = bus.next() {
        for output in node.step(now, event) {
            match output {
                Output::Candidates(message) => candidates.publish(&message)?,
                Output::Query(message) => query.publish(&message)?,
                Output::WorldQuery(message) => world_query.publish(&message)?,
                Output::LookAhead => later.send(Event::LookAhead),
                Output::Lesson(message) => {
                    let state = [("state", message.state.to_string()), ("query", message.query_id.clone())];
                    bus.status(Level::Ok, message.reason.clone(), &state);
                    lesson.publish(&message)?;
                }
                Output::Warn(text) => log::warn!("{text}"),
            }
        }
    }
    Ok(())
}
