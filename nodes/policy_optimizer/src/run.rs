//! The node on the graph.

use crate::{Event, Output, PolicyOptimizer, Settings};
use apprentice_msgs::msg::{PolicyFrontier, PolicySet, RobustPolicy};
use bus::{Arguments, Bus, Graph, Level, NodeError, Qos};
use std::time::Duration;

/// Runs the node until it is asked to stop.
///
/// # Errors
/// When the parameters are bad or the graph cannot be joined.
pub fn run(graph: &Graph, arguments: &Arguments) -> Result<(), NodeError> {
    let settings: Settings = arguments.settings()?;
    let mut bus = Bus::open(graph, arguments, &settings)?;
    let policy = bus.publisher::<RobustPolicy>("robust_policy", Qos::State)?;
    let frontier = bus.publisher::<PolicyFrontier>("policy_frontier", Qos::State)?;
    let judge = bus.publisher::<PolicySet>("policies", Qos::State)?;
    bus.subscribe("posterior", Qos::State, |message| Event::Posterior(Box::new(message)))?;
    bus.subscribe("world", Qos::State, |message| Event::World(Box::new(message)))?;
    bus.subscribe("lesson_world", Qos::State, |message| Event::World(Box::new(message)))?;
    bus.subscribe("evidence", Qos::State, |message| Event::Evidence(Box::new(message)))?;
    bus.subscribe("risk_preference", Qos::State, |message| Event::Preference(Box::new(message)))?;
    bus.every(Duration::from_secs_f64(settings.republish_period_s), || Event::Republish);
    let compute = bus.sender();
    let mut node = PolicyOptimizer::new(settings);
    while let Some((now, event)) = bus.next() {
        for output in node.step(now, event) {
            match output {
                Output::Policy(message) => {
                    let level = if message.outcome == RobustPolicy::OPTIMAL { Level::Ok } else { Level::Warn };
                    let facts = [
                        ("revision", message.revision.to_string()),
                        ("lambda", message.lambda.to_string()),
                        ("expected_return", message.expected_return.to_string()),
                        ("conditional_value_at_risk", message.conditional_value_at_risk.to_string()),
                        ("gap", message.gap.to_string()),
                        ("n_draws", message.n_draws.to_string()),
                    ];
                    bus.status(level, message.reason.clone(), &facts);
                    policy.publish(&message)?;
                }
                Output::Frontier(message) => frontier.publish(&message)?,
                Output::Judge(message) => judge.publish(&message)?,
                Output::Compute => compute.send(Event::Compute),
                Output::Warn(text) => log::warn!("{text}"),
            }
        }
    }
    Ok(())
}
