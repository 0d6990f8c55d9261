//! What a graph does for a node: bytes in, bytes out. Implemented over DDS and in memory.

use std::{sync::Arc, time::Duration};

use apprentice_msgs::builtin_interfaces::Time;

use crate::{error::BusError, qos::QosProfile};

/// One message as it travelled.
#[derive(Debug, Clone, PartialEq)]
pub struct RawMessage {
    /// When it reached this process.
    pub received: Time,
    /// When the publisher sent it, if it told.
    pub source_timestamp: Option<Time>,
    /// The CDR message with its 4-byte header.
    pub cdr: Vec<u8>,
}

/// Takes each message of a subscription, in order, on a thread of the graph.
pub(crate) type Deliver = Box<dyn FnMut(RawMessage) + Send>;

/// Sends the answer (a CDR message) to one request, now or later, from any thread. Dropping it leaves the request without one.
pub(crate) type Answer = Box<dyn FnOnce(Vec<u8>) + Send>;

/// Takes the requests of a service: each CDR message with the way to answer it.
pub(crate) type Handler = Box<dyn FnMut(&[u8], Answer) + Send>;

/// Takes the answers to a client's requests: the number of the request and the CDR message.
pub(crate) type Answered = Box<dyn FnMut(u64, &[u8]) + Send>;

/// Sends the requests of one client.
pub(crate) trait Caller: Send + Sync {
    /// Sends one request under a number of the caller's choice. Like any request it may be lost, and its answer too.
    fn call(&self, number: u64, cdr: Vec<u8>) -> Result<(), BusError>;

    /// How many servers are matched both ways.
    fn servers(&self) -> usize;
}

/// Sends the messages of one publisher.
pub(crate) trait Sink: Send + Sync {
    /// Sends one CDR message with its 4-byte header.
    fn write(&self, cdr: Vec<u8>) -> Result<(), BusError>;

    /// How many subscriptions are matched.
    fn readers(&self) -> usize;
}

/// Ends a subscription or a service when it is dropped.
pub(crate) type Guard = Box<dyn Send>;

/// A graph as one node sees it. Names are absolute, types are `pkg/msg/Name`.
pub(crate) trait Transport: Send + Sync {
    /// Makes a publisher.
    fn publisher(&self, topic: &str, type_name: &str, qos: &QosProfile) -> Result<Arc<dyn Sink>, BusError>;

    /// Makes a subscription.
    fn subscribe(&self, topic: &str, type_name: &str, qos: &QosProfile, deliver: Deliver) -> Result<Guard, BusError>;

    /// Offers a service of the type `pkg/srv/Name`, or of a half of an action.
    fn serve(&self, name: &str, type_name: &str, handler: Handler) -> Result<Guard, BusError>;

    /// Makes a client of such a service.
    fn client(&self, name: &str, type_name: &str, answered: Answered) -> Result<Arc<dyn Caller>, BusError>;

    /// What is known of the graph.
    fn topics(&self) -> Vec<TopicInfo>;

    /// Waits until what was published has arrived, at most `limit`.
    fn flush(&self, limit: Duration);
}

/// One topic on the graph, with one type (a topic with two types is listed twice).
#[derive(Debug, Clone, PartialEq)]
pub struct TopicInfo {
    /// Absolute ROS name.
    pub name: String,
    /// `pkg/msg/Name`.
    pub type_name: String,
    /// What a subscription should ask for to hear every publisher; depth 0: unknown.
    pub qos: QosProfile,
    /// Its publishers.
    pub publishers: Vec<EndpointInfo>,
    /// Its subscriptions.
    pub subscriptions: Vec<EndpointInfo>,
}

/// One publisher or subscription on the graph.
#[derive(Debug, Clone, PartialEq)]
pub struct EndpointInfo {
    /// Fully qualified name of its node, if known.
    pub node: Option<String>,
    /// Unique on the graph.
    pub gid: [u8; 16],
    /// What it offers or asks for.
    pub qos: QosProfile,
}

/// The weakest of the offered profiles: a subscription asking for it hears every publisher.
pub(crate) fn weakest(publishers: &[EndpointInfo]) -> Option<QosProfile> {
    let mut profiles = publishers.iter().map(|endpoint| &endpoint.qos);
    let mut weakest = profiles.next()?.clone();
    for profile in profiles {
        weakest.reliability = weakest.reliability.min(profile.reliability);
        weakest.durability = weakest.durability.min(profile.durability);
        weakest.depth = weakest.depth.max(profile.depth);
        weakest.deadline = None;
        weakest.lifespan = None;
        weakest.liveliness_lease = None;
    }
    Some(weakest)
}

/// Checks a `pkg/kind/Name` type name; gives package and name.
pub(crate) fn split_type<'a>(type_name: &'a str, kinds: &[&str]) -> Result<(&'a str, &'a str, &'a str), BusError> {
    let refuse = || BusError::TypeName { got: crate::yaml::shorten(type_name) };
    let good = |part: &str| {
        !part.is_empty() && part.len() < 200 && part.bytes().all(|byte| byte.is_ascii_alphanumeric() || byte == b'_')
    };
    let mut parts = type_name.split('/');
    match (parts.next(), parts.next(), parts.next(), parts.next()) {
        (Some(package), Some(kind), Some(name), None) if good(package) && kinds.contains(&kind) && good(name) => {
            Ok((package, kind, name))
        }
        _ => Err(refuse()),
    }
}
