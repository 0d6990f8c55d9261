//! The node on the graph.

use crate::{Event, Output, PerformanceBoundsNode, Settings};
use apprentice_msgs::msg::{PerformanceBounds, PlacementBound, PolicyBounds, RiskBound};
use bus::{Arguments, Bus, Graph, Level, NodeError, Qos};
use std::time::Duration;

/// Runs the node until it is asked to stop.
pub fn run(graph: &Graph, arguments: &Arguments) -> Result<(), NodeError> {
    let settings: Settings = arguments.settings()?;
    let mut bus = Bus::open(graph, arguments, &settings)?;
    let bounds = bus.publisher::<PerformanceBounds>("bounds", Qos::State)?;
    let policy_bounds = bus.publisher::<PolicyBounds>("policy_bounds", Qos::State)?;
    bus.subscribe("world", Qos::State, |message| Event::World(Box::new(message)))?;
    bus.subscribe("lesson_world", Qos::State, |message| Event::World(Box::new(message)))?;
    bus.subscribe("policies", Qos::State, |message| Event::Policies(Box::new(message)))?;
    bus.subscribe("posterior", Qos::State, |message| Event::Posterior(Box::new(message)))?;
    bus.subscribe("candidates", Qos::State, |message| Event::Candidates(Box::new(message)))?;
    bus.every(Duration::from_secs_f64(settings.republish_period_s), || Event::Republish);
    let mut node = PerformanceBoundsNode::new(settings);
    while let Some((now, event)) = bus.next() {
        for output in node.step(now, event) {
            match output {
                Output::Bounds(message) => {
                    let level = if message.outcome == PlacementBound::BOUND { Level::Ok } else { Level::Warn };
                    let facts = [
                        ("revision", message.revision.to_string()),
                        ("bound_m", message.bound_m.to_string()),
                        ("rhat_max", message.rhat_max.to_string()),
                        ("ess_min", message.ess_min.to_string()),
                    ];
                    bus.status(level, message.reason.clone(), &facts);
                    bounds.publish(&message)?;
                }
                Output::PolicyBounds(message) => {
                    let level = if message.outcome == RiskBound::BOUND { Level::Ok } else { Level::Warn };
                    let facts = [
                        ("revision", message.revision.to_string()),
                        ("policies", message.policies.len().to_string()),
                        ("rhat_max", message.rhat_max.to_string()),
                        ("ess_min", message.ess_min.to_string()),
                    ];
                    bus.status(level, message.reason.clone(), &facts);
                    policy_bounds.publish(&message)?;
                }
                Output::Warn(text) => log::warn!("{text}"),
            }
        }
    }
    Ok(())
}
