//! A graph within the process, with a node that publishes and a recorder beside it.
#![allow(dead_code, reason = "each test file uses a part")]
#![expect(clippy::disallowed_methods, reason = "tests wait in real time")]

use std::path::Path;
use std::thread::JoinHandle;
use std::time::{Duration, Instant};

use bag::Message;
use bag_files::open_bag;
use bus::{Arguments, Bus, Graph, MemoryGraph, NodeError, NodeSettings, ParameterSpec, RawPublisher};
use serde::{Deserialize, Serialize};

/// A node without parameters.
#[derive(Debug, Clone, Default, Serialize, Deserialize)]
pub struct Talker {}

impl NodeSettings for Talker {
    const NODE: &'static str = "talker";
    const ABOUT: &'static str = "Publishes what a test wants.";
    const PARAMETERS: &'static [ParameterSpec] = &[];
}

pub fn arguments(parameters: &[(&str, &str)]) -> Arguments {
    let none = Arguments::parse(&[]).expect("there are none");
    parameters.iter().fold(none, |arguments, (name, value)| {
        arguments.with_parameter(name, value).expect("the parameter is well formed")
    })
}

pub fn talker(graph: &MemoryGraph) -> Bus<()> {
    Bus::open(&Graph::Memory(graph.clone()), &arguments(&[]), &Talker {}).expect("the graph is in memory")
}

/// Starts a recorder into `folder`.
pub fn record(graph: &MemoryGraph, folder: &Path, more: &[(&str, &str)]) -> JoinHandle<Result<(), NodeError>> {
    let graph = Graph::Memory(graph.clone());
    let output = folder.display().to_string();
    let mut parameters = vec![("output", output.as_str()), ("flush_period_s", "0.05"), ("discovery_period_s", "0.02")];
    parameters.extend_from_slice(more);
    let arguments = arguments(&parameters);
    std::thread::spawn(move || session_recorder::run(&graph, &arguments))
}

/// Waits until `done` holds; fails the test after ten seconds.
pub fn wait(what: &str, mut done: impl FnMut() -> bool) {
    let limit = Instant::now() + Duration::from_secs(10);
    while !done() {
        assert!(Instant::now() < limit, "waited in vain for {what}");
        std::thread::sleep(Duration::from_millis(5));
    }
}

/// Waits until the recorder listens.
pub fn wait_for_recorder(publisher: &RawPublisher) {
    wait("the recorder", || publisher.subscriptions() > 0);
}

/// The messages of a topic that are in the bag by now.
pub fn recorded(folder: &Path, topic: &str) -> Vec<Message> {
    let Ok(bag) = open_bag(folder) else { return Vec::new() };
    bag.messages().map_while(Result::ok).filter(|message| message.topic.name == topic).collect()
}

/// Waits until a topic has so many messages on disk.
pub fn wait_for_messages(folder: &Path, topic: &str, count: usize) {
    wait(topic, || recorded(folder, topic).len() >= count);
}
