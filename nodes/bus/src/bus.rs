//! A node's place on the graph: its endpoints, its timers, and the events that reach it.

mod open;
mod wait;

use std::{
    sync::{Arc, atomic::Ordering},
    time::Duration,
};

use apprentice_msgs::{Message, Service, builtin_interfaces::Time, from_cdr, to_cdr};

use crate::{
    arguments::Arguments,
    clock::Clock,
    error::BusError,
    health::{Counters, Health, Level},
    logging::Attached,
    memory::MemoryGraph,
    names::NodeName,
    publisher::{Publisher, RawPublisher},
    qos::{Durability, Qos, QosProfile, Reliability},
    queue::{Overflow, Queue},
    signals,
    stop::Stopper,
    transport::{Answer, Answered, Caller, Deliver, Guard, RawMessage, TopicInfo, Transport},
};

use wait::Timer;
pub use wait::{EventSender, Next};

/// How long an ending node waits for its last messages to be acknowledged.
const FLUSH_LIMIT: Duration = Duration::from_millis(500);

/// Samples that a typed reliable subscription keeps until the node takes them, where its profile asks for fewer: a
/// burst must not be lost while the readers' thread is busy.
const BURST_DEPTH: usize = 10_000;

/// Which graph a node joins. Clones are the same graph.
#[derive(Debug, Clone)]
pub enum Graph {
    /// ROS 2 over DDS, as the environment says.
    Dds,
    /// A graph within this process.
    Memory(MemoryGraph),
}

/// One node on the graph; `E` is the node's event enum. Dropping it leaves the graph.
pub struct Bus<E> {
    name: NodeName,
    arguments: Arguments,
    clock: Clock,
    counters: Arc<Counters>,
    health: Arc<Health>,
    queue: Arc<Queue<E>>,
    stopper: Stopper,
    timers: Vec<Timer<E>>,
    timer_was_last: bool,
    guards: Vec<Guard>,
    overflow: Overflow,
    housekeeper: Option<std::thread::JoinHandle<()>>,
    log: Option<Attached>,
    memory: Option<MemoryGraph>,
    transport: Arc<dyn Transport>,
}

impl<E: Send + 'static> Bus<E> {
    /// The absolute name of a topic or service after expansion and renaming.
    fn resolve(&self, name: &str) -> Result<String, BusError> {
        self.resolve_as("topic", name)
    }

    /// The same for another kind of thing, which an error names.
    pub(crate) fn resolve_as(&self, kind: &'static str, name: &str) -> Result<String, BusError> {
        Ok(self.arguments.resolve(&self.name, kind, name)?)
    }

    /// The node's name on the graph.
    pub fn name(&self) -> &NodeName {
        &self.name
    }

    /// Makes a publisher. A relative name lies in the node's namespace.
    ///
    /// # Errors
    /// On an illegal name, or when DDS refuses.
    pub fn publisher<M: Message>(&mut self, topic: &str, qos: Qos) -> Result<Publisher<M>, BusError> {
        Ok(Publisher::new(self.publisher_raw(topic, M::TYPE, qos.profile())?))
    }

    /// Makes a publisher of CDR messages of the type `pkg/msg/Name`.
    ///
    /// # Errors
    /// On an illegal name or type name, or when DDS refuses.
    pub fn publisher_raw(&mut self, topic: &str, type_name: &str, qos: QosProfile) -> Result<RawPublisher, BusError> {
        let topic = self.resolve(topic)?;
        self.publisher_absolute(&topic, type_name, Qos::Custom(qos))
    }

    /// The same on an absolute name that is not renamed.
    pub(crate) fn publisher_absolute(&self, topic: &str, type_name: &str, qos: Qos) -> Result<RawPublisher, BusError> {
        let sink = self.transport.publisher(topic, type_name, &qos.profile())?;
        Ok(RawPublisher::new(sink, topic, Arc::clone(&self.counters)))
    }

    /// Makes a subscription; each message that can be decoded becomes an event. Those that cannot are counted and
    /// reported (the first and each hundredth of a topic), and the node goes on.
    ///
    /// `to_event` runs on a thread of the graph and must neither wait nor publish.
    ///
    /// # Errors
    /// On an illegal name, or when DDS refuses.
    pub fn subscribe<M: Message>(
        &mut self,
        topic: &str,
        qos: Qos,
        to_event: impl Fn(M) -> E + Send + 'static,
    ) -> Result<(), BusError> {
        let name = self.resolve(topic)?;
        let mut profile = qos.profile();
        if (profile.reliability, profile.durability) == (Reliability::Reliable, Durability::Volatile) {
            profile.depth = profile.depth.max(BURST_DEPTH);
        }
        let mut push = self.pusher(&name, &profile);
        self.subscribe_decoded(&name, &profile, move |message| push(to_event(message)))
    }

    /// Hands every message of an absolute topic that can be decoded to `take`, and counts and reports the others.
    pub(crate) fn subscribe_decoded<M: Message>(
        &mut self,
        name: &str,
        profile: &QosProfile,
        mut take: impl FnMut(M) + Send + 'static,
    ) -> Result<(), BusError> {
        let counters = Arc::clone(&self.counters);
        let mut malformed: u64 = 0;
        let topic = name.to_owned();
        let guard = self.transport.subscribe(
            name,
            M::TYPE,
            profile,
            Box::new(move |raw| match from_cdr::<M>(&raw.cdr) {
                Ok(message) => take(message),
                Err(error) => {
                    counters.malformed.fetch_add(1, Ordering::Relaxed);
                    malformed += 1;
                    if malformed == 1 || malformed.is_multiple_of(100) {
                        log::warn!(
                            "{topic}: message {malformed} of the type {} in {} bytes is malformed and left out: {error}",
                            M::TYPE,
                            raw.cdr.len()
                        );
                    }
                }
            }),
        )?;
        self.guards.push(guard);
        Ok(())
    }

    /// Makes a subscription to CDR messages of the type `pkg/msg/Name`. Dropping the result ends it.
    ///
    /// To hear every publisher of a topic, ask for the [`TopicInfo::qos`] of it. At most `qos.depth` samples wait
    /// for this node (0: 1000), and as many are kept in memory.
    ///
    /// # Errors
    /// On an illegal name or type name, or when DDS refuses.
    pub fn subscribe_raw(
        &mut self,
        topic: &str,
        type_name: &str,
        qos: QosProfile,
        to_event: impl Fn(RawMessage) -> E + Send + 'static,
    ) -> Result<RawSubscription, BusError> {
        let name = self.resolve(topic)?;
        let mut push = self.pusher(&name, &qos);
        let guard = self.transport.subscribe(&name, type_name, &qos, Box::new(move |raw| push(to_event(raw))))?;
        Ok(RawSubscription { _guard: guard })
    }

    /// Puts events of one subscription into the queue, counts them, and reports those that were lost.
    fn pusher(&self, topic: &str, qos: &QosProfile) -> impl FnMut(E) + Send + use<E> {
        let queue = Arc::clone(&self.queue);
        let counters = Arc::clone(&self.counters);
        let overflow = match (qos.reliability, self.overflow) {
            (Reliability::BestEffort, Overflow::Block) => Overflow::DropOldest,
            (_, overflow) => overflow,
        };
        let topic = topic.to_owned();
        let mut lost_here: u64 = 0;
        move |event| {
            counters.received.fetch_add(1, Ordering::Relaxed);
            let lost = queue.push(event, overflow);
            if lost > 0 {
                counters.lost.fetch_add(lost as u64, Ordering::Relaxed);
                lost_here += lost as u64;
                if lost_here == 1 || lost_here.is_multiple_of(1000) {
                    log::warn!("{topic}: this node is too slow; {lost_here} old messages were left out");
                }
            }
        }
    }

    /// Offers a service. The handler runs on a thread of the graph.
    ///
    /// # Errors
    /// On an illegal name, or when DDS refuses.
    pub fn serve<S: Service>(
        &mut self,
        name: &str,
        mut handler: impl FnMut(S::Request) -> S::Response + Send + 'static,
    ) -> Result<(), BusError> {
        let name = self.resolve_as("service", name)?;
        let service = name.clone();
        self.serve_raw(&name, S::TYPE, move |bytes, answer| match from_cdr::<S::Request>(bytes) {
            Ok(request) => answer(to_cdr(&handler(request))),
            Err(error) => log::warn!("{service}: a malformed request is not answered: {error}"),
        })
    }

    /// Offers a service by its absolute name, in bytes and with answers whenever.
    pub(crate) fn serve_raw(
        &mut self,
        name: &str,
        type_name: &str,
        handler: impl FnMut(&[u8], Answer) + Send + 'static,
    ) -> Result<(), BusError> {
        let guard = self.transport.serve(name, type_name, Box::new(handler))?;
        self.guards.push(guard);
        Ok(())
    }

    /// Makes a client of a service by its absolute name, in bytes.
    pub(crate) fn client(
        &mut self,
        name: &str,
        type_name: &str,
        answered: Answered,
    ) -> Result<Arc<dyn Caller>, BusError> {
        self.transport.client(name, type_name, answered)
    }

    /// Hands the messages of an absolute topic to `deliver` as bytes, as long as the node lives.
    pub(crate) fn listen(
        &mut self,
        topic: &str,
        type_name: &str,
        profile: &QosProfile,
        deliver: Deliver,
    ) -> Result<(), BusError> {
        let guard = self.transport.subscribe(topic, type_name, profile, deliver)?;
        self.guards.push(guard);
        Ok(())
    }

    /// The node's clock.
    pub(crate) fn clock(&self) -> Clock {
        self.clock.clone()
    }

    /// Puts events into this node's queue from other threads.
    pub fn sender(&self) -> EventSender<E> {
        EventSender { queue: Arc::clone(&self.queue), overflow: self.overflow }
    }

    /// The node's time: the system's, or the simulation's with `use_sim_time`.
    pub fn now(&self) -> Time {
        self.clock.now()
    }

    /// What `/diagnostics` says of this node from now on.
    pub fn status(&self, level: Level, message: impl Into<String>, values: &[(&str, String)]) {
        self.health.set(level, message.into(), values);
    }

    /// Asks this node to end, from wherever.
    pub fn stopper(&self) -> Stopper {
        self.stopper.clone()
    }

    /// Every topic that is known on the graph.
    pub fn topics(&self) -> Vec<TopicInfo> {
        self.transport.topics()
    }
}

impl<E> Drop for Bus<E> {
    fn drop(&mut self) {
        self.stopper.stop();
        // The log's end closes the channel that the housekeeping thread waits on.
        self.log = None;
        if let Some(thread) = self.housekeeper.take() {
            let _ = thread.join();
        }
        self.transport.flush(FLUSH_LIMIT);
        self.guards.clear();
        signals::forget(&self.stopper);
        if let Some(memory) = &self.memory {
            memory.leave(&self.stopper);
        }
    }
}

impl<E> std::fmt::Debug for Bus<E> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Bus").field("name", &self.name).finish_non_exhaustive()
    }
}

/// A subscription to raw messages; dropping it ends it.
pub struct RawSubscription {
    _guard: Guard,
}

impl std::fmt::Debug for RawSubscription {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("RawSubscription").finish_non_exhaustive()
    }
}
