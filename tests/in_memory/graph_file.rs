//! `config/graph.yaml` says who says what to whom; the nodes do just that.

use crate::graph::Lesson;
use bus::{Qos, QosProfile};
use serde::Deserialize;
use std::collections::{BTreeMap, BTreeSet};

#[derive(Deserialize)]
struct GraphFile {
    topics: BTreeMap<String, TopicEntry>,
    nodes: BTreeMap<String, NodeEntry>,
}

#[derive(Deserialize)]
struct TopicEntry {
    r#type: String,
    qos: String,
}

#[derive(Debug, Default, PartialEq, Deserialize)]
struct NodeEntry {
    takes: BTreeSet<String>,
    gives: BTreeSet<String>,
}

/// What every node says, and the file does not repeat.
const COMMON: [&str; 4] = ["settings", "heartbeat", "/rosout", "/diagnostics"];

fn profile(name: &str) -> QosProfile {
    match name {
        "stream" => Qos::Stream.profile(),
        "event" => Qos::Event.profile(),
        "state" => Qos::State.profile(),
        "log" => Qos::Log.profile(),
        other => panic!("graph.yaml: there is no quality of service '{other}'"),
    }
}

#[test]
fn the_nodes_take_and_give_what_the_graph_file_says() {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/config/graph.yaml");
    let text = std::fs::read_to_string(path).expect("it is shipped");
    let file: GraphFile = serde_saphyr::from_str(&text).expect("it is a graph file");
    let mut lesson = Lesson::new("graph_file");
    lesson.start_all();
    // The recorder finds the topics by itself; once it has, the graph is complete.
    lesson.query(0);
    // The lesson is about the table by now: the world has another number of weights and is left aside.
    lesson.start("simulated_world", simulated_world::run, &[]);
    lesson.start("policy_optimizer", policy_optimizer::run, &[]);
    let cup = ["object_ids:=[cup]", "object_shapes:=[cylinder]", "object_sizes_m:=[0.08,0.08,0.1]"];
    lesson.start("table_perception", table_perception::run, &cup);

    // The nodes that were started last may still be making their endpoints.
    let complete = |nodes: &BTreeMap<String, NodeEntry>| {
        file.nodes.iter().all(|(node, described)| node == "bringup" || nodes.get(node) == Some(described))
    };
    let mut nodes = on_the_graph(&lesson, &file);
    for _ in 0..200 {
        if complete(&nodes) {
            break;
        }
        std::thread::sleep(std::time::Duration::from_millis(50));
        nodes = on_the_graph(&lesson, &file);
    }
    for (node, described) in &file.nodes {
        // Bringup starts processes; it has no place in this one.
        if node != "bringup" {
            assert_eq!(nodes.get(node), Some(described), "{node}");
        }
    }
}

/// Who takes and gives what, by the graph itself; every name has to be in the file.
fn on_the_graph(lesson: &Lesson, file: &GraphFile) -> BTreeMap<String, NodeEntry> {
    let mut nodes: BTreeMap<String, NodeEntry> = BTreeMap::new();
    // The topics of actions are ROS's; the file names the actions.
    for topic in lesson.topics().into_iter().filter(|topic| !topic.name.contains("/_action/")) {
        let name = topic.name.strip_prefix("/graph_file/").unwrap_or(&topic.name).to_owned();
        let described = file.topics.get(&name);
        let own = |node: &Option<String>| Some(node.as_deref()?.strip_prefix("/graph_file/")?.to_owned());
        let ours = |node: &String| file.nodes.contains_key(node);
        for publisher in &topic.publishers {
            let Some(node) = own(&publisher.node).filter(ours) else { continue };
            let described = described.unwrap_or_else(|| panic!("graph.yaml lacks the topic {name} of {node}"));
            assert_eq!(topic.type_name, described.r#type, "{name}");
            assert_eq!(publisher.qos, profile(&described.qos), "{name} of {node}");
            if !COMMON.contains(&name.as_str()) {
                nodes.entry(node).or_default().gives.insert(name.clone());
            }
        }
        for subscription in &topic.subscriptions {
            let Some(node) = own(&subscription.node).filter(ours) else { continue };
            assert!(described.is_some(), "graph.yaml lacks the topic {name} that {node} takes");
            nodes.entry(node).or_default().takes.insert(name.clone());
        }
    }
    nodes
}
