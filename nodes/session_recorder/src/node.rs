//! Which topics are recorded, decided from what is on the graph.

use std::collections::{BTreeMap, BTreeSet};

use bag::{Durability, FilterError, History, Liveliness, OfferedQos, QosSpan, Reliability, Topic, TopicFilter};
use bus::{QosProfile, RawMessage, Time, TopicInfo};

use crate::{Definitions, Settings};

/// Fewest samples a subscription asks to have kept, so that bursts are not lost.
const MIN_DEPTH: usize = 1_000;

/// What reaches the recorder.
#[derive(Debug, Clone, PartialEq)]
pub enum Event {
    /// Every topic on the graph.
    Graph(Vec<TopicInfo>),
    /// A message of a topic that is recorded.
    Message {
        /// The topic.
        topic: String,
        /// The message as it travelled.
        message: RawMessage,
    },
}

/// What the recorder wants done.
#[derive(Debug, Clone, PartialEq)]
pub enum Output {
    /// Describe a topic in the bag; comes before its first message.
    Describe(Topic),
    /// Subscribe to a topic, replacing an earlier subscription to it.
    Subscribe {
        /// The topic.
        topic: String,
        /// `pkg/msg/Name`.
        type_name: String,
        /// What to ask for.
        qos: QosProfile,
    },
    /// Write a message.
    Write {
        /// The topic.
        topic: String,
        /// When it was received, ns since 1970.
        log_time: u64,
        /// When it was published, ns since 1970.
        publish_time: u64,
        /// CDR with its 4-byte header.
        cdr: Vec<u8>,
    },
    /// Tell the person.
    Info(String),
    /// Warn the person.
    Warn(String),
}

/// The recorder without files, threads and graph.
#[derive(Debug)]
pub struct RecorderNode {
    filter: TopicFilter,
    definitions: Definitions,
    /// Type and QoS of each topic that is subscribed to.
    recorded: BTreeMap<String, (String, QosProfile)>,
    /// Topics seen with a second type, of which that was said.
    conflicts: BTreeSet<(String, String)>,
    /// Types without a schema, of which that was said.
    unknown_types: BTreeSet<String>,
}

impl RecorderNode {
    /// A recorder that has seen nothing yet.
    ///
    /// # Errors
    /// When a pattern is no regular expression.
    pub fn new(settings: &Settings, definitions: Definitions) -> Result<RecorderNode, FilterError> {
        Ok(RecorderNode {
            filter: TopicFilter::new(&settings.topics, &settings.exclude)?,
            definitions,
            recorded: BTreeMap::new(),
            conflicts: BTreeSet::new(),
            unknown_types: BTreeSet::new(),
        })
    }

    /// Takes an event; `now` stands in for times a message lacks.
    pub fn step(&mut self, now: Time, event: Event) -> Vec<Output> {
        match event {
            Event::Graph(topics) => topics.iter().flat_map(|topic| self.see(topic)).collect(),
            Event::Message { topic, message } => {
                let received = nanoseconds(&message.received).or_else(|| nanoseconds(&now)).unwrap_or(0);
                let published = message.source_timestamp.as_ref().and_then(nanoseconds).unwrap_or(received);
                vec![Output::Write { topic, log_time: received, publish_time: published, cdr: message.cdr }]
            }
        }
    }

    /// Topics recorded so far.
    pub fn topic_count(&self) -> usize {
        self.recorded.len()
    }

    fn see(&mut self, found: &TopicInfo) -> Vec<Output> {
        if found.publishers.is_empty() || is_hidden(&found.name) || !self.filter.takes(&found.name) {
            return Vec::new();
        }
        match self.recorded.get(&found.name) {
            None => self.begin(found),
            Some((type_name, _)) if *type_name != found.type_name => {
                if !self.conflicts.insert((found.name.clone(), found.type_name.clone())) {
                    return Vec::new();
                }
                vec![Output::Warn(format!(
                    "{} is published with type {} too, but is recorded with type {type_name}; the other is left out",
                    found.name, found.type_name
                ))]
            }
            // A publisher came that offers less than was asked for.
            Some((_, asked)) if !asked.accepts(&found.qos) => vec![self.subscribe(found)],
            Some(_) => Vec::new(),
        }
    }

    fn begin(&mut self, found: &TopicInfo) -> Vec<Output> {
        let mut outputs = Vec::new();
        let schema = self.definitions.schema(&found.type_name).unwrap_or_else(|error| {
            if self.unknown_types.insert(found.type_name.clone()) {
                outputs.push(Output::Warn(format!(
                    "{} is recorded without a schema: {error}; message_definition_path can name folders with definitions",
                    found.name
                )));
            }
            String::new()
        });
        let offered: Vec<_> = found.publishers.iter().map(|publisher| offered_qos(&publisher.qos)).collect();
        outputs.push(Output::Describe(Topic::ros2(&found.name, &found.type_name, &schema, &distinct(offered))));
        outputs.push(self.subscribe(found));
        outputs.push(Output::Info(format!("recording {} ({})", found.name, found.type_name)));
        outputs
    }

    fn subscribe(&mut self, found: &TopicInfo) -> Output {
        let qos = QosProfile::new(found.qos.reliability, found.qos.durability, found.qos.depth.max(MIN_DEPTH));
        self.recorded.insert(found.name.clone(), (found.type_name.clone(), qos.clone()));
        Output::Subscribe { topic: found.name.clone(), type_name: found.type_name.clone(), qos }
    }
}

/// The profiles without repetitions, in order.
fn distinct(profiles: Vec<OfferedQos>) -> Vec<OfferedQos> {
    let mut distinct = Vec::new();
    for profile in profiles {
        if !distinct.contains(&profile) {
            distinct.push(profile);
        }
    }
    distinct
}

/// A publisher's QoS as rosbag2 keeps it. Discovery does not tell the depth, which rosbag2 writes as unknown.
fn offered_qos(qos: &QosProfile) -> OfferedQos {
    let span = |duration: Option<std::time::Duration>| {
        duration.map_or(QosSpan::INFINITE, |d| QosSpan { sec: d.as_secs(), nsec: u64::from(d.subsec_nanos()) })
    };
    OfferedQos {
        history: if qos.depth == 0 { History::Unknown } else { History::KeepLast },
        depth: qos.depth as u64,
        reliability: match qos.reliability {
            bus::Reliability::Reliable => Reliability::Reliable,
            bus::Reliability::BestEffort => Reliability::BestEffort,
        },
        durability: match qos.durability {
            bus::Durability::TransientLocal => Durability::TransientLocal,
            bus::Durability::Volatile => Durability::Volatile,
        },
        deadline: span(qos.deadline),
        lifespan: span(qos.lifespan),
        liveliness: Liveliness::Automatic,
        liveliness_lease_duration: span(qos.liveliness_lease),
        avoid_ros_namespace_conventions: false,
    }
}

/// Nanoseconds since the epoch; `None` for the zero and negative times of clocks that are not set.
fn nanoseconds(time: &Time) -> Option<u64> {
    let seconds = u64::try_from(time.sec).ok()?;
    let ns = seconds * 1_000_000_000 + u64::from(time.nanosec);
    (ns > 0).then_some(ns)
}

/// Whether a part of a name starts with an underscore, as the topics of actions do. rosbag2 leaves those out too.
fn is_hidden(name: &str) -> bool {
    name.split('/').any(|part| part.starts_with('_'))
}
