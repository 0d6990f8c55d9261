//! config/graph.yaml agrees with the interface package, with the nodes' sources, and with the layouts that name topics.

use regex::Regex;
use serde::Deserialize;
use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Graph {
    topics: BTreeMap<String, Topic>,
    outside: BTreeSet<String>,
    nodes: BTreeMap<String, Node>,
    actions: BTreeMap<String, Action>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Topic {
    r#type: String,
    qos: String,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Action {
    r#type: String,
    server: String,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Node {
    takes: BTreeSet<String>,
    gives: BTreeSet<String>,
}

/// What every node gives by way of the bus.
const OF_THE_BUS: [&str; 5] = ["settings", "heartbeat", "/rosout", "/diagnostics", "/clock"];

fn top() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

fn read(path: &str) -> String {
    std::fs::read_to_string(top().join(path)).unwrap_or_else(|error| panic!("{path}: {error}"))
}

fn graph() -> Graph {
    serde_saphyr::from_str(&read("config/graph.yaml")).expect("config/graph.yaml is in order")
}

#[test]
fn every_type_is_in_the_interface_package_and_every_quality_of_service_is_a_known_kind() {
    for (name, topic) in graph().topics {
        assert!(apprentice_msgs::schema(&topic.r#type).is_some(), "{name}: there is no type {}", topic.r#type);
        assert!(["stream", "event", "state", "log"].contains(&topic.qos.as_str()), "{name}: {}", topic.qos);
    }
}

#[test]
fn every_action_is_served_by_the_node_that_the_graph_says() {
    let server = Regex::new(r#"action_server::<(\w+)>\(\s*"([^"]+)""#).expect("a pattern");
    let graph = graph();
    let mut served = BTreeMap::new();
    for name in graph.nodes.keys() {
        for entry in std::fs::read_dir(top().join("nodes").join(name).join("src")).expect("a node's folder").flatten() {
            let source = std::fs::read_to_string(entry.path()).unwrap_or_default();
            for found in server.captures_iter(&source) {
                served.insert(found[2].to_owned(), (format!("apprentice_msgs/action/{}", &found[1]), name.clone()));
            }
        }
    }
    let said: BTreeMap<String, (String, String)> =
        graph.actions.into_iter().map(|(name, action)| (name, (action.r#type, action.server))).collect();
    assert_eq!(said, served);
    assert!(said.values().all(|(of_type, _)| apprentice_msgs::all_actions().contains(&of_type.as_str())));
}

#[test]
fn every_topic_is_taken_or_given_and_every_name_is_a_topic() {
    let graph = graph();
    let named: BTreeSet<&String> = graph.nodes.values().flat_map(|node| node.takes.union(&node.gives)).collect();
    let bus = OF_THE_BUS.map(String::from);
    let all: BTreeSet<&String> = named.into_iter().chain(&bus).collect();
    assert_eq!(graph.topics.keys().collect::<BTreeSet<_>>(), all);
    for (name, node) in &graph.nodes {
        for topic in node.takes.iter().filter(|topic| !OF_THE_BUS.contains(&topic.as_str())) {
            assert!(
                graph.outside.contains(topic) != graph.nodes.values().any(|other| other.gives.contains(topic)),
                "{name} takes {topic}: a node gives it, or somebody outside"
            );
        }
    }
}

#[test]
fn the_nodes_take_and_give_what_the_graph_says_with_the_quality_it_says() {
    let endpoint =
        Regex::new(r#"\.(publisher|subscribe)(?:::<[^>]*>)?\(\s*"([^"]+)",\s*Qos::(\w+)"#).expect("a pattern");
    let graph = graph();
    for (name, node) in &graph.nodes {
        let (mut takes, mut gives) = (BTreeSet::new(), BTreeSet::new());
        for entry in std::fs::read_dir(top().join("nodes").join(name).join("src")).expect("a node's folder").flatten() {
            let source = std::fs::read_to_string(entry.path()).unwrap_or_default();
            for found in endpoint.captures_iter(&source) {
                let (topic, qos) = (found[2].to_owned(), found[3].to_lowercase());
                let known = graph.topics.get(&topic).unwrap_or_else(|| panic!("{name}: {topic} is not in graph.yaml"));
                assert_eq!(known.qos, qos, "{name}: {topic}");
                if &found[1] == "publisher" {
                    gives.insert(topic)
                } else {
                    takes.insert(topic)
                };
            }
        }
        assert_eq!(takes, node.takes, "what {name} takes");
        assert_eq!(gives, node.gives, "what {name} gives");
    }
}

#[test]
fn the_layouts_show_topics_that_exist() {
    let topics: BTreeSet<String> = graph()
        .topics
        .keys()
        .map(|name| if name.starts_with('/') { name.clone() } else { format!("/apprentice/{name}") })
        .collect();
    let layout: serde_json::Value = serde_json::from_str(&read("config/foxglove/apprentice.json")).expect("JSON");
    let panels: BTreeSet<&String> = layout["configById"].as_object().expect("panels").keys().collect();
    let mut placed = BTreeSet::new();
    leaves(&layout["layout"], &mut placed);
    assert_eq!(panels, placed.iter().collect(), "each panel is placed once and configured");
    let rviz = ["apprentice", "world"].map(|name| -> serde_json::Value {
        serde_saphyr::from_str(&read(&format!("config/rviz/{name}.rviz"))).expect("YAML")
    });
    // Displays of interactive markers name the namespace of their topics.
    let namespaces: BTreeSet<&str> = topics.iter().filter_map(|name| name.strip_suffix("/update")).collect();
    let named = Regex::new(r#""(/[a-z_]+(?:/[a-z_]+)?)[".]"#).expect("a pattern");
    let mut n_named = 0;
    for text in [layout.to_string(), rviz[0].to_string(), rviz[1].to_string()] {
        for found in named.captures_iter(&text) {
            assert!(topics.contains(&found[1]) || namespaces.contains(&found[1]), "there is no topic {}", &found[1]);
            n_named += 1;
        }
    }
    assert!(n_named >= 8, "{n_named}");
}

/// Names of the panels in a Foxglove layout.
fn leaves(layout: &serde_json::Value, into: &mut BTreeSet<String>) {
    match layout {
        serde_json::Value::String(name) => assert!(into.insert(name.clone()), "{name} is placed twice"),
        other => ["first", "second"].iter().for_each(|side| leaves(&other[side], into)),
    }
}

#[test]
fn the_launch_files_are_well_formed_and_start_nodes_that_exist() {
    let known = graph().nodes;
    let exists = |name: &str| known.contains_key(name) || name == "session_recorder";
    let xml = read("config/launch/apprentice.launch.xml");
    let mut reader = quick_xml::Reader::from_str(&xml);
    let mut started = Vec::new();
    loop {
        match reader.read_event().expect("well-formed XML") {
            quick_xml::events::Event::Empty(element) if element.name().as_ref() == b"executable" => {
                let attribute = element.try_get_attribute("cmd").expect("good attributes").expect("a command");
                let command = String::from_utf8(attribute.value.to_vec()).expect("UTF-8");
                started.push(command.split_whitespace().nth(2).expect("$(var executable) NODE").to_owned());
            }
            quick_xml::events::Event::Eof => break,
            _ => {}
        }
    }
    assert!(started.len() == 10 && started.iter().all(|name| exists(name)), "{started:?}");
    let python = read("config/launch/apprentice.launch.py");
    for name in &started {
        assert!(python.contains(&format!("\"{name}\"")), "the Python launch file does not start {name}");
    }
    let syntax = std::process::Command::new("python3")
        .args(["-c", "import ast, sys; ast.parse(sys.stdin.read())"])
        .stdin(std::fs::File::open(top().join("config/launch/apprentice.launch.py")).expect("a file"))
        .output();
    // Without Python there is nobody to launch it either.
    if let Ok(output) = syntax {
        assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    }
}
