//! Every node that the executable holds.

use bringup::NodeInfo;
use bus::{Arguments, Graph, NodeError, NodeSettings};

/// A node: what bringup knows of it, and how it runs.
#[derive(Clone, Copy)]
pub struct Node {
    /// Name, purpose and parameters.
    pub info: NodeInfo,
    /// Runs it until it is asked to end.
    pub run: fn(&Graph, &Arguments) -> Result<(), NodeError>,
}

/// Every node but bringup, which starts them.
pub fn nodes() -> Vec<Node> {
    vec![
        node::<active_query::Settings>(active_query::run),
        node::<bag_player::Settings>(bag_player::run),
        node::<demonstrator::Settings>(demonstrator::run),
        node::<operator_ui::Settings>(operator_ui::run),
        node::<performance_bounds::Settings>(performance_bounds::run),
        node::<placement_planner::Settings>(placement_planner::run),
        node::<policy_optimizer::Settings>(policy_optimizer::run),
        node::<reward_posterior::Settings>(reward_posterior::run),
        node::<session_recorder::Settings>(session_recorder::run),
        node::<simulated_table::Settings>(simulated_table::run),
        node::<simulated_world::Settings>(simulated_world::run),
        node::<table_perception::Settings>(table_perception::run),
    ]
}

fn node<S: NodeSettings>(run: fn(&Graph, &Arguments) -> Result<(), NodeError>) -> Node {
    let check = |arguments: &Arguments| arguments.settings::<S>().map(drop);
    Node { info: NodeInfo { name: S::NODE, about: S::ABOUT, parameters: S::PARAMETERS, check }, run }
}
