//! A graph within one process, for tests and replays: the same bytes, the same matching, no sockets.

use std::{
    collections::{BTreeMap, VecDeque},
    sync::{Arc, Mutex, MutexGuard, PoisonError, Weak, mpsc},
    time::Duration,
};

use apprentice_msgs::{Service, from_cdr, to_cdr};

use crate::{
    clock,
    error::BusError,
    names::NodeName,
    qos::{Durability, QosProfile},
    stop::Stopper,
    transport::{
        Answer, Answered, Caller, Deliver, EndpointInfo, Guard, Handler, RawMessage, Sink, TopicInfo, Transport,
        split_type, weakest,
    },
};

/// A graph within this process. Clones are the same graph.
///
/// A message is handed over on the publisher's thread before `publish` returns, so one thread that drives several
/// nodes sees a fixed order. Late joiners get what transient-local publishers that still live have kept.
#[derive(Clone, Default)]
pub struct MemoryGraph {
    inner: Arc<Mutex<Inner>>,
}

/// What the lock guards.
#[derive(Default)]
struct Inner {
    publishers: Vec<Publisher>,
    subscriptions: Vec<Subscription>,
    services: BTreeMap<String, Served>,
    stoppers: Vec<Stopper>,
    stopped: bool,
    next_id: u64,
}

/// One publisher and what it keeps for late joiners.
struct Publisher {
    id: u64,
    node: String,
    topic: String,
    type_name: String,
    qos: QosProfile,
    kept: VecDeque<RawMessage>,
}

/// One subscription.
struct Subscription {
    id: u64,
    node: String,
    topic: String,
    type_name: String,
    qos: QosProfile,
    deliver: Deliver,
}

/// One service.
struct Served {
    id: u64,
    type_name: String,
    handler: Arc<Mutex<Handler>>,
}

impl MemoryGraph {
    /// An empty graph.
    pub fn new() -> MemoryGraph {
        MemoryGraph::default()
    }

    /// Asks every node on the graph to end, and those that join later too.
    pub fn shutdown(&self) {
        let stoppers = {
            let mut inner = self.lock();
            inner.stopped = true;
            std::mem::take(&mut inner.stoppers)
        };
        for stopper in stoppers {
            stopper.stop();
        }
    }

    /// Hands bytes to every subscription of an absolute topic name and type, as a foreign publisher might.
    /// Returns how many subscriptions took them.
    pub fn inject_raw(&self, topic: &str, type_name: &str, bytes: &[u8]) -> usize {
        let message = message(bytes.to_vec());
        let mut inner = self.lock();
        let mut taken = 0;
        for subscription in &mut inner.subscriptions {
            if subscription.topic == topic && subscription.type_name == type_name {
                (subscription.deliver)(message.clone());
                taken += 1;
            }
        }
        taken
    }

    /// Calls a service by its absolute name and waits for the answer; `None` when nobody offers it, it is not answered or
    /// the answer cannot be decoded.
    pub fn call<S: Service>(&self, name: &str, request: &S::Request) -> Option<S::Response> {
        let handler = Arc::clone(&self.lock().services.get(name)?.handler);
        let (answer, answered) = mpsc::channel();
        let request = to_cdr(request);
        handler.lock().unwrap_or_else(PoisonError::into_inner)(
            &request,
            Box::new(move |cdr| {
                // Nobody waits any more when the call has returned.
                let _ = answer.send(cdr);
            }),
        );
        from_cdr(&answered.recv().ok()?).ok()
    }

    /// The graph as the node `node` sees it.
    pub(crate) fn join(&self, node: &NodeName, stopper: &Stopper) -> MemoryTransport {
        let stopped = {
            let mut inner = self.lock();
            inner.stoppers.push(stopper.clone());
            inner.stopped
        };
        if stopped {
            stopper.stop();
        }
        MemoryTransport { graph: self.clone(), node: node.full() }
    }

    /// Forgets a node's stopper.
    pub(crate) fn leave(&self, stopper: &Stopper) {
        self.lock().stoppers.retain(|other| !other.same(stopper));
    }

    /// Takes the lock; a panic in a node leaves the graph usable.
    fn lock(&self) -> MutexGuard<'_, Inner> {
        self.inner.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl std::fmt::Debug for MemoryGraph {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("MemoryGraph").finish_non_exhaustive()
    }
}

impl Inner {
    /// A number never given before.
    fn fresh_id(&mut self) -> u64 {
        self.next_id += 1;
        self.next_id
    }
}

/// A message that was sent and received now.
fn message(cdr: Vec<u8>) -> RawMessage {
    let now = clock::to_time(clock::system_ns());
    RawMessage { received: now, source_timestamp: Some(now), cdr }
}

/// The graph as one node sees it.
pub(crate) struct MemoryTransport {
    graph: MemoryGraph,
    node: String,
}

/// A client's end.
struct MemoryCaller {
    graph: MemoryGraph,
    name: String,
    type_name: String,
    answered: Arc<Mutex<Answered>>,
}

impl MemoryCaller {
    fn handler(&self) -> Option<Arc<Mutex<Handler>>> {
        let inner = self.graph.lock();
        let service = inner.services.get(&self.name).filter(|service| service.type_name == self.type_name)?;
        Some(Arc::clone(&service.handler))
    }
}

impl Caller for MemoryCaller {
    fn call(&self, number: u64, cdr: Vec<u8>) -> Result<(), BusError> {
        // Without a server a request is lost, as over DDS.
        let Some(handler) = self.handler() else { return Ok(()) };
        let answered = Arc::downgrade(&self.answered);
        let answer: Answer = Box::new(move |cdr| {
            if let Some(answered) = answered.upgrade() {
                answered.lock().unwrap_or_else(PoisonError::into_inner)(number, &cdr);
            }
        });
        handler.lock().unwrap_or_else(PoisonError::into_inner)(&cdr, answer);
        Ok(())
    }

    fn servers(&self) -> usize {
        usize::from(self.handler().is_some())
    }
}

/// A publisher's end.
struct MemorySink {
    graph: MemoryGraph,
    id: u64,
}

/// Runs when a subscription or service goes.
struct OnDrop {
    graph: Weak<Mutex<Inner>>,
    id: u64,
}

impl Drop for OnDrop {
    fn drop(&mut self) {
        let Some(inner) = self.graph.upgrade() else { return };
        let mut inner = inner.lock().unwrap_or_else(PoisonError::into_inner);
        let gone = inner.subscriptions.extract_if(.., |subscription| subscription.id == self.id).collect::<Vec<_>>();
        let ended = inner.services.extract_if(.., |_, service| service.id == self.id).collect::<Vec<_>>();
        // What handlers own may be publishers of this graph, whose end takes the lock too.
        drop(inner);
        drop((gone, ended));
    }
}

impl Drop for MemorySink {
    fn drop(&mut self) {
        self.graph.lock().publishers.retain(|publisher| publisher.id != self.id);
    }
}

/// Whether samples flow, with a warning when only the type or the quality of service is in the way.
fn matched(publisher: &Publisher, subscription: &Subscription) -> bool {
    publisher.topic == subscription.topic
        && publisher.type_name == subscription.type_name
        && subscription.qos.accepts(&publisher.qos)
}

/// One clear line for a pair that meets but does not match.
fn warn_mismatch(publisher: &Publisher, subscription: &Subscription) {
    if publisher.topic != subscription.topic {
        return;
    }
    if publisher.type_name != subscription.type_name {
        log::warn!(
            "{}: {} publishes {} but {} expects {}; nothing is delivered",
            publisher.topic,
            publisher.node,
            publisher.type_name,
            subscription.node,
            subscription.type_name
        );
    } else if let Some(policy) = subscription.qos.incompatibility(&publisher.qos) {
        log::warn!(
            "{}: {} asks for more {policy} than {} offers; nothing is delivered",
            publisher.topic,
            subscription.node,
            publisher.node
        );
    }
}

impl Sink for MemorySink {
    fn write(&self, cdr: Vec<u8>) -> Result<(), BusError> {
        let message = message(cdr);
        let mut inner = self.graph.lock();
        let Inner { publishers, subscriptions, .. } = &mut *inner;
        let Some(publisher) = publishers.iter_mut().find(|publisher| publisher.id == self.id) else {
            return Ok(());
        };
        if publisher.qos.durability == Durability::TransientLocal {
            while publisher.kept.len() >= publisher.qos.depth.max(1) {
                publisher.kept.pop_front();
            }
            publisher.kept.push_back(message.clone());
        }
        for subscription in subscriptions {
            if matched(publisher, subscription) {
                (subscription.deliver)(message.clone());
            }
        }
        Ok(())
    }

    fn readers(&self) -> usize {
        let inner = self.graph.lock();
        let Some(publisher) = inner.publishers.iter().find(|publisher| publisher.id == self.id) else {
            return 0;
        };
        inner.subscriptions.iter().filter(|subscription| matched(publisher, subscription)).count()
    }
}

impl Transport for MemoryTransport {
    fn publisher(&self, topic: &str, type_name: &str, qos: &QosProfile) -> Result<Arc<dyn Sink>, BusError> {
        split_type(type_name, &["msg", "srv", "action"])?;
        let mut inner = self.graph.lock();
        let id = inner.fresh_id();
        let publisher = Publisher {
            id,
            node: self.node.clone(),
            topic: topic.to_owned(),
            type_name: type_name.to_owned(),
            qos: qos.clone(),
            kept: VecDeque::new(),
        };
        for subscription in &inner.subscriptions {
            warn_mismatch(&publisher, subscription);
        }
        inner.publishers.push(publisher);
        Ok(Arc::new(MemorySink { graph: self.graph.clone(), id }))
    }

    fn subscribe(&self, topic: &str, type_name: &str, qos: &QosProfile, deliver: Deliver) -> Result<Guard, BusError> {
        split_type(type_name, &["msg", "srv", "action"])?;
        let mut inner = self.graph.lock();
        let id = inner.fresh_id();
        let mut subscription = Subscription {
            id,
            node: self.node.clone(),
            topic: topic.to_owned(),
            type_name: type_name.to_owned(),
            qos: qos.clone(),
            deliver,
        };
        for publisher in &inner.publishers {
            warn_mismatch(publisher, &subscription);
            if matched(publisher, &subscription) && subscription.qos.durability == Durability::TransientLocal {
                let skipped = publisher.kept.len().saturating_sub(subscription.qos.depth.max(1));
                for message in publisher.kept.iter().skip(skipped) {
                    (subscription.deliver)(message.clone());
                }
            }
        }
        inner.subscriptions.push(subscription);
        Ok(Box::new(OnDrop { graph: Arc::downgrade(&self.graph.inner), id }))
    }

    fn serve(&self, name: &str, type_name: &str, handler: Handler) -> Result<Guard, BusError> {
        split_type(type_name, &["srv", "action"])?;
        let mut inner = self.graph.lock();
        let id = inner.fresh_id();
        let service = Served { id, type_name: type_name.to_owned(), handler: Arc::new(Mutex::new(handler)) };
        inner.services.insert(name.to_owned(), service);
        Ok(Box::new(OnDrop { graph: Arc::downgrade(&self.graph.inner), id }))
    }

    fn client(&self, name: &str, type_name: &str, answered: Answered) -> Result<Arc<dyn Caller>, BusError> {
        split_type(type_name, &["srv", "action"])?;
        Ok(Arc::new(MemoryCaller {
            graph: self.graph.clone(),
            name: name.to_owned(),
            type_name: type_name.to_owned(),
            answered: Arc::new(Mutex::new(answered)),
        }))
    }

    fn topics(&self) -> Vec<TopicInfo> {
        let inner = self.graph.lock();
        let mut topics: BTreeMap<(String, String), TopicInfo> = BTreeMap::new();
        let publishers =
            inner.publishers.iter().map(|one| (true, one.id, &one.node, &one.topic, &one.type_name, &one.qos));
        let subscriptions =
            inner.subscriptions.iter().map(|one| (false, one.id, &one.node, &one.topic, &one.type_name, &one.qos));
        for (publishes, id, node, name, type_name, qos) in publishers.chain(subscriptions) {
            let topic = topics.entry((name.clone(), type_name.clone())).or_insert_with(|| TopicInfo {
                name: name.clone(),
                type_name: type_name.clone(),
                qos: qos.clone(),
                publishers: Vec::new(),
                subscriptions: Vec::new(),
            });
            let mut gid = [0; 16];
            gid[..8].copy_from_slice(&id.to_le_bytes());
            let endpoint = EndpointInfo { node: Some(node.clone()), gid, qos: qos.clone() };
            if publishes {
                topic.publishers.push(endpoint);
            } else {
                topic.subscriptions.push(endpoint);
            }
        }
        let mut topics: Vec<TopicInfo> = topics.into_values().collect();
        for topic in &mut topics {
            if let Some(qos) = weakest(&topic.publishers) {
                topic.qos = qos;
            }
        }
        topics
    }

    fn flush(&self, _limit: Duration) {
        // Messages have arrived when `publish` returns.
    }
}
