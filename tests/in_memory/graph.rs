//! A lesson on a graph within this process: the nodes on threads, and the test as one more node that listens and speaks.

use apprentice_msgs::Message;
use apprentice_msgs::msg::{
    EvidenceLog, EvidenceReceipt, PerformanceBounds, PlacementDemonstration, PlacementQuery, PolicyBounds, Posterior,
    PosteriorPreview, QueryResponse, Retraction, TableScene,
};
use bus::{
    Arguments, Bus, Graph, MemoryGraph, Next, NodeError, NodeSettings, ParameterSpec, Publisher, Qos, TopicInfo,
};
use serde::{Deserialize, Serialize};
use std::thread::JoinHandle;
use std::time::{Duration, Instant};

/// Nothing in a test takes longer than this, unless it is broken.
const PATIENCE: Duration = Duration::from_secs(60);

/// The table of `evidence::table` as parameters of the simulated world.
const TABLE: [&str; 8] = [
    "object_ids:=[cup, plate]",
    "object_shapes:=[cylinder, cylinder]",
    "object_sizes_m:=[0.1, 0.1, 0.1, 0.1, 0.1, 0.1]",
    "object_positions_m:=[0.25, 0.25, 0.75, 0.7]",
    "target_id:=vase",
    "target_label:=vase",
    "target_shape:=cylinder",
    "target_size_m:=[0.1, 0.1, 0.1]",
];

/// What every node crate offers.
pub type Run = fn(&Graph, &Arguments) -> Result<(), NodeError>;

/// The test has no parameters.
#[derive(Debug, Clone, Default, Serialize, Deserialize)]
struct NoSettings {}

impl NodeSettings for NoSettings {
    const NODE: &'static str = "test";
    const ABOUT: &'static str = "The test itself";
    const PARAMETERS: &'static [ParameterSpec] = &[];
}

/// What the test hears.
#[derive(Debug, Clone)]
pub enum Heard {
    Receipt(EvidenceReceipt),
    Evidence(Box<EvidenceLog>),
    Posterior(Box<Posterior>),
    Bounds(Box<PerformanceBounds>),
    Query(Box<PlacementQuery>),
    Preview(Box<PosteriorPreview>),
    PolicyBounds(Box<PolicyBounds>),
}

/// A lesson on a graph of its own. Dropping it ends the nodes.
pub struct Lesson {
    pub graph: MemoryGraph,
    bus: Bus<Heard>,
    nodes: Vec<(&'static str, JoinHandle<Result<(), NodeError>>)>,
    heard: Vec<Heard>,
    namespace: String,
    folder: Option<tempfile::TempDir>,
    pub scene: Publisher<TableScene>,
    pub demonstration: Publisher<PlacementDemonstration>,
    pub retraction: Publisher<Retraction>,
    pub response: Publisher<QueryResponse>,
}

/// Arguments of a node in the namespace `/name`, with settings that make a lesson quick.
fn arguments(namespace: &str, parameters: &[&str]) -> Arguments {
    let mut words = vec!["--ros-args".to_owned(), "-r".to_owned(), format!("__ns:=/{namespace}")];
    for parameter in parameters {
        words.extend(["-p".to_owned(), (*parameter).to_owned()]);
    }
    Arguments::parse(&words).expect("these arguments are good")
}

impl Lesson {
    /// Joins an empty graph; topics lie in `/namespace`.
    pub fn new(namespace: &str) -> Lesson {
        crate::log_lines::keep();
        let graph = MemoryGraph::new();
        let mut bus: Bus<Heard> = Bus::open(&Graph::Memory(graph.clone()), &arguments(namespace, &[]), &NoSettings {})
            .expect("memory is free");
        let scene = bus.publisher("scene", Qos::State).expect("a good name");
        let demonstration = bus.publisher("demonstration", Qos::Event).expect("a good name");
        let retraction = bus.publisher("retraction", Qos::Event).expect("a good name");
        let response = bus.publisher("response", Qos::Event).expect("a good name");
        bus.subscribe("receipt", Qos::Event, Heard::Receipt).expect("a good name");
        bus.subscribe("evidence", Qos::State, |m| Heard::Evidence(Box::new(m))).expect("a good name");
        bus.subscribe("posterior", Qos::State, |m| Heard::Posterior(Box::new(m))).expect("a good name");
        bus.subscribe("bounds", Qos::State, |m| Heard::Bounds(Box::new(m))).expect("a good name");
        bus.subscribe("query", Qos::State, |m| Heard::Query(Box::new(m))).expect("a good name");
        bus.subscribe("posterior_preview", Qos::State, |m| Heard::Preview(Box::new(m))).expect("a good name");
        bus.subscribe("policy_bounds", Qos::State, |m| Heard::PolicyBounds(Box::new(m))).expect("a good name");
        Lesson {
            graph,
            bus,
            nodes: Vec::new(),
            heard: Vec::new(),
            namespace: namespace.to_owned(),
            folder: None,
            scene,
            demonstration,
            retraction,
            response,
        }
    }

    /// Starts a node with parameters `name:=value` and waits until it is on the graph.
    pub fn start(&mut self, name: &'static str, run: Run, parameters: &[&str]) {
        let (graph, arguments) = (Graph::Memory(self.graph.clone()), arguments(&self.namespace, parameters));
        let thread = std::thread::spawn(move || run(&graph, &arguments));
        self.nodes.push((name, thread));
        let heartbeat = format!("/{}/heartbeat", self.namespace);
        let full = format!("/{}/{name}", self.namespace);
        let start = now();
        while !self.bus.topics().iter().any(|topic| {
            topic.name == heartbeat && topic.publishers.iter().any(|one| one.node.as_deref() == Some(full.as_str()))
        }) {
            self.check_nodes();
            assert!(start.elapsed() < PATIENCE, "{name} did not join the graph");
            std::thread::sleep(Duration::from_millis(2));
        }
    }

    /// Starts the three nodes that compute, with few draws.
    pub fn start_core(&mut self) {
        self.start("reward_posterior", reward_posterior::run, &["n_draws:=2000", "threads:=1"]);
        self.start("performance_bounds", performance_bounds::run, &["threads:=1"]);
        self.start("active_query", active_query::run, &["n_candidates:=5"]);
    }

    /// Starts every node of a lesson; the person does not answer.
    pub fn start_all(&mut self) {
        let recording = tempfile::tempdir().expect("a folder for the recorder");
        let output = format!("output:={}", recording.path().join("bag").display());
        self.folder = Some(recording);
        self.start("session_recorder", session_recorder::run, &[&output]);
        self.start("simulated_table", simulated_table::run, &TABLE);
        self.start_core();
        self.start("placement_planner", placement_planner::run, &[]);
        self.start("demonstrator", demonstrator::run, &["response_delay_s:=3600.0"]);
        self.start("operator_ui", operator_ui::run, &["port:=0"]);
    }

    /// One more topic that the test speaks on.
    pub fn publisher<M: Message>(&mut self, topic: &str, qos: Qos) -> Publisher<M> {
        self.bus.publisher(topic, qos).expect("a good name")
    }

    /// Every topic of the graph.
    pub fn topics(&self) -> Vec<TopicInfo> {
        self.bus.topics()
    }

    /// Panics when a node has ended.
    pub fn check_nodes(&mut self) {
        if let Some(at) = self.nodes.iter().position(|(_, thread)| thread.is_finished()) {
            let (name, thread) = self.nodes.swap_remove(at);
            match thread.join() {
                Ok(result) => panic!("{name} ended: {result:?}"),
                Err(_) => panic!("{name} panicked"),
            }
        }
    }

    /// The first thing heard, from the start of the lesson on, that `wanted` takes.
    pub fn wait<T>(&mut self, what: &str, wanted: impl Fn(&Heard) -> Option<T>) -> T {
        let start = now();
        let mut from = 0;
        loop {
            if let Some(found) = self.heard[from..].iter().find_map(&wanted) {
                return found;
            }
            from = self.heard.len();
            self.check_nodes();
            assert!(start.elapsed() < PATIENCE, "waited in vain for {what}; heard {:#?}", self.heard);
            if let Next::Event(_, heard) = self.bus.next_timeout(Duration::from_millis(100)) {
                self.heard.push(heard);
            }
        }
    }

    /// Everything heard so far, in order.
    pub fn heard(&self) -> &[Heard] {
        &self.heard
    }

    /// What became of the evidence with an id.
    pub fn receipt(&mut self, id: &str) -> EvidenceReceipt {
        self.wait(&format!("the receipt of {id}"), |heard| match heard {
            Heard::Receipt(receipt) if receipt.id == id => Some(receipt.clone()),
            _ => None,
        })
    }

    /// Shows where the vase belongs, and waits until that is accepted.
    pub fn show(&mut self, message: &PlacementDemonstration) -> EvidenceReceipt {
        self.demonstration.publish(message).expect("memory takes everything");
        let receipt = self.receipt(&message.id);
        assert_eq!(receipt.outcome, EvidenceReceipt::ACCEPTED, "{}", receipt.reason);
        receipt
    }

    /// The posterior of a revision.
    pub fn posterior(&mut self, revision: u64) -> Posterior {
        self.wait(&format!("posterior {revision}"), |heard| match heard {
            Heard::Posterior(posterior) if posterior.revision == revision => Some((**posterior).clone()),
            _ => None,
        })
    }

    /// What became of evidence that must be accepted.
    pub fn accepted(&mut self, id: &str) -> u64 {
        let receipt = self.receipt(id);
        assert_eq!(receipt.outcome, EvidenceReceipt::ACCEPTED, "{id}: {}", receipt.reason);
        receipt.revision
    }

    /// The bounds on the policies of a set under the posterior of a revision.
    pub fn policy_bounds(&mut self, revision: u64, set_number: u64) -> PolicyBounds {
        self.wait(&format!("bounds {revision} on set {set_number}"), |heard| match heard {
            Heard::PolicyBounds(b) if (b.revision, b.set_number) == (revision, set_number) => Some((**b).clone()),
            _ => None,
        })
    }

    /// The preview of a revision.
    pub fn preview(&mut self, revision: u64) -> PosteriorPreview {
        self.wait(&format!("preview {revision}"), |heard| match heard {
            Heard::Preview(preview) if preview.revision == revision => Some((**preview).clone()),
            _ => None,
        })
    }

    /// The question of a revision.
    pub fn query(&mut self, revision: u64) -> PlacementQuery {
        self.wait(&format!("question {revision}"), |heard| match heard {
            Heard::Query(query) if query.revision == revision => Some((**query).clone()),
            _ => None,
        })
    }

    /// The bounds of a revision.
    pub fn bounds(&mut self, revision: u64) -> PerformanceBounds {
        self.wait(&format!("bounds {revision}"), |heard| match heard {
            Heard::Bounds(bounds) if bounds.revision == revision => Some((**bounds).clone()),
            _ => None,
        })
    }

    /// The log of evidence, when it holds that many records.
    pub fn evidence(&mut self, n_records: usize) -> EvidenceLog {
        self.wait(&format!("a log of {n_records} records"), |heard| match heard {
            Heard::Evidence(log) if log.records.len() == n_records => Some((**log).clone()),
            _ => None,
        })
    }
}

impl Drop for Lesson {
    fn drop(&mut self) {
        self.graph.shutdown();
        for (name, thread) in self.nodes.drain(..) {
            let ended = thread.join();
            if !std::thread::panicking() {
                assert!(matches!(ended, Ok(Ok(()))), "{name} did not end well: {ended:?}");
            }
        }
    }
}

#[expect(clippy::disallowed_methods, reason = "a test's patience is real time")]
fn now() -> Instant {
    Instant::now()
}
