//! A node's place on the graph: its endpoints, its timers, and the events that reach it.

use std::{
    sync::{
        Arc,
        atomic::{AtomicU64, Ordering},
        mpsc::sync_channel,
    },
    time::{Duration, Instant},
};

use apprentice_msgs::{
    Message, Service, builtin_interfaces::Time, from_cdr, msg::NodeSettings as NodeSettingsMessage,
    rosgraph_msgs::Clock as ClockMessage, to_cdr,
};
use log::LevelFilter;

use crate::{
    arguments::Arguments,
    clock::{self, Clock},
    dds::{DdsTransport, Environment, Range},
    error::BusError,
    health::{Counters, Health, Level},
    housekeeping::Housekeeping,
    logging::{self, Attached},
    memory::MemoryGraph,
    names::NodeName,
    parameter::NodeSettings,
    parameter_services,
    publisher::{Publisher, RawPublisher},
    qos::{Durability, Qos, QosProfile, Reliability},
    queue::{self, Overflow, Popped, Queue},
    settings::{BusParameters, settings_to_yaml},
    signals,
    stop::Stopper,
    transport::{Guard, RawMessage, TopicInfo, Transport},
};

/// How long an ending node waits for its last messages to be acknowledged.
const FLUSH_LIMIT: Duration = Duration::from_millis(500);

/// Which graph a node joins. Clones are the same graph.
#[derive(Debug, Clone)]
pub enum Graph {
    /// ROS 2 over DDS, as the environment says.
    Dds,
    /// A graph within this process.
    Memory(MemoryGraph),
}

/// What waiting with a limit came to.
#[derive(Debug, Clone, PartialEq)]
pub enum Next<E> {
    /// An event, and the time at which the node takes it.
    Event(Time, E),
    /// Nothing happened in time.
    Timeout,
    /// The node was asked to end.
    Shutdown,
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
    guards: Vec<Guard>,
    overflow: Overflow,
    housekeeper: Option<std::thread::JoinHandle<()>>,
    log: Option<Attached>,
    memory: Option<MemoryGraph>,
    transport: Arc<dyn Transport>,
}

/// A periodic event.
struct Timer<E> {
    period_ns: i64,
    due_ns: i64,
    to_event: Box<dyn Fn() -> E + Send>,
}

impl<E: Send + 'static> Bus<E> {
    /// Joins the graph under the name that settings and arguments give, publishes the settings, and starts the
    /// heartbeat, the diagnostics, the log and the parameter services.
    ///
    /// # Errors
    /// On an illegal name, a wrong environment variable, or when DDS cannot start.
    pub fn open<S: NodeSettings>(
        graph: &Graph,
        arguments: &Arguments,
        settings: &S,
    ) -> Result<Bus<E>, BusError> {
        let name = arguments.node_name(S::NODE)?;
        let parameters = BusParameters::from_given(&arguments.given(S::NODE)?)?;
        let stopper = Stopper::default();
        let queue = Queue::new(queue::CAPACITY, stopper.clone());
        let (lines_in, lines) = sync_channel(1000);
        let level = arguments.level(&name).unwrap_or(LevelFilter::Info);
        let rosout = arguments.rosout();
        let log = logging::attach(
            &name.logger(),
            level,
            arguments.stderr(),
            Some(lines_in),
        );
        let (transport, memory, overflow): (Arc<dyn Transport>, _, _) = match graph {
            Graph::Memory(memory) => (
                Arc::new(memory.join(&name, &stopper)),
                Some(memory.clone()),
                Overflow::Grow,
            ),
            Graph::Dds => {
                signals::stop_on_signals(&stopper)?;
                let environment = Environment::read(&parameters.service_mapping)?;
                for warning in &environment.warnings {
                    log::warn!("{warning}");
                }
                if environment.range == Range::Off {
                    log::warn!("ROS_AUTOMATIC_DISCOVERY_RANGE=OFF: this node neither hears nor is heard");
                    let alone = MemoryGraph::new();
                    (Arc::new(alone.join(&name, &stopper)), Some(alone), Overflow::Block)
                } else {
                    let transport = DdsTransport::join(&environment, &name, log.id())?;
                    (Arc::new(transport), None, Overflow::Block)
                }
            }
        };
        let mut bus = Bus {
            name,
            arguments: arguments.clone(),
            clock: Clock::new(parameters.use_sim_time),
            counters: Arc::new(Counters::default()),
            health: Arc::new(Health::default()),
            queue,
            stopper,
            timers: Vec::new(),
            guards: Vec::new(),
            overflow,
            housekeeper: None,
            log: Some(log),
            memory,
            transport,
        };
        if bus.clock.is_simulated() {
            bus.follow_clock()?;
        }
        bus.start_housekeeping(rosout, lines)?;
        bus.publish_settings(settings)?;
        parameter_services::serve(&mut bus, settings, &parameters)?;
        for unused in &parameters.qos_overrides {
            log::warn!("the parameter `{unused}` is taken but has no effect: this node's QoS is fixed");
        }
        Ok(bus)
    }

    /// Sets the time from `/clock`.
    fn follow_clock(&mut self) -> Result<(), BusError> {
        let clock = self.clock.clone();
        let queue = Arc::clone(&self.queue);
        let topic = self.resolve("/clock")?;
        let guard = self.transport.subscribe(
            &topic,
            ClockMessage::TYPE,
            &QosProfile::new(Reliability::BestEffort, Durability::Volatile, 1),
            Box::new(move |raw| {
                if let Ok(message) = from_cdr::<ClockMessage>(&raw.cdr) {
                    clock.set(&message.clock);
                    queue.wake();
                }
            }),
        )?;
        self.guards.push(guard);
        Ok(())
    }

    /// Starts the thread that publishes heartbeat, diagnostics and log lines.
    fn start_housekeeping(
        &mut self,
        rosout: bool,
        lines: std::sync::mpsc::Receiver<logging::LogLine>,
    ) -> Result<(), BusError> {
        let queue = Arc::clone(&self.queue);
        let rosout_qos = Qos::Custom(QosProfile::new(
            Reliability::Reliable,
            Durability::TransientLocal,
            1000,
        ));
        let housekeeping = Housekeeping {
            node: self.name.full(),
            logger: self.name.logger(),
            instance: instance(),
            clock: self.clock.clone(),
            counters: Arc::clone(&self.counters),
            health: Arc::clone(&self.health),
            waiting: Box::new(move || queue.len()),
            heartbeat: self.publisher("heartbeat", Qos::Event)?,
            diagnostics: self.publisher("/diagnostics", Qos::Event)?,
            rosout: match rosout {
                true => Some(self.publisher("/rosout", rosout_qos)?),
                false => None,
            },
            lines,
            log_id: self.log.as_ref().map_or(0, Attached::id),
        };
        let thread = std::thread::Builder::new()
            .name("housekeeping".to_owned())
            .spawn(move || housekeeping.run())
            .map_err(|source| BusError::System {
                what: "a thread",
                source,
            })?;
        self.housekeeper = Some(thread);
        Ok(())
    }

    /// Publishes what the node was started with.
    fn publish_settings<S: NodeSettings>(&mut self, settings: &S) -> Result<(), BusError> {
        let publisher = self.publisher::<NodeSettingsMessage>("settings", Qos::Log)?;
        publisher.publish(&NodeSettingsMessage {
            node: S::NODE.to_owned(),
            name: self.name.full(),
            seed: settings.seed(),
            version: env!("CARGO_PKG_VERSION").to_owned(),
            commit: option_env!("APPRENTICE_COMMIT").unwrap_or("unknown").to_owned(),
            parameters: settings_to_yaml(settings),
        })?;
        self.guards.push(Box::new(publisher));
        Ok(())
    }

    /// The absolute name of a topic or service after expansion and renaming.
    fn resolve(&self, name: &str) -> Result<String, BusError> {
        Ok(self.arguments.resolve(&self.name, "topic", name)?)
    }

    /// The node's name on the graph.
    pub fn name(&self) -> &NodeName {
        &self.name
    }

    /// Makes a publisher. A relative name lies in the node's namespace.
    ///
    /// # Errors
    /// On an illegal name, or when DDS refuses.
    pub fn publisher<M: Message>(
        &mut self,
        topic: &str,
        qos: Qos,
    ) -> Result<Publisher<M>, BusError> {
        Ok(Publisher::new(self.publisher_raw(
            topic,
            M::TYPE,
            qos.profile(),
        )?))
    }

    /// Makes a publisher of CDR messages of the type `pkg/msg/Name`.
    ///
    /// # Errors
    /// On an illegal name or type name, or when DDS refuses.
    pub fn publisher_raw(
        &mut self,
        topic: &str,
        type_name: &str,
        qos: QosProfile,
    ) -> Result<RawPublisher, BusError> {
        let topic = self.resolve(topic)?;
        let sink = self.transport.publisher(&topic, type_name, &qos)?;
        Ok(RawPublisher::new(sink, &topic, Arc::clone(&self.counters)))
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
        let profile = qos.profile();
        let counters = Arc::clone(&self.counters);
        let mut push = self.pusher(&name, &profile);
        let mut malformed: u64 = 0;
        let topic = name.clone();
        let guard = self.transport.subscribe(
            &name,
            M::TYPE,
            &profile,
            Box::new(move |raw| match from_cdr::<M>(&raw.cdr) {
                Ok(message) => push(to_event(message)),
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
        let guard = self.transport.subscribe(
            &name,
            type_name,
            &qos,
            Box::new(move |raw| push(to_event(raw))),
        )?;
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

    /// Makes an event each `period`, by the node's time; periods that were missed are skipped. The first comes
    /// after one period.
    pub fn every(&mut self, period: Duration, to_event: impl Fn() -> E + Send + 'static) {
        let period_ns = i64::try_from(period.as_nanos()).unwrap_or(i64::MAX).max(1);
        self.timers.push(Timer {
            period_ns,
            due_ns: self.clock.now_ns().saturating_add(period_ns),
            to_event: Box::new(to_event),
        });
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
        let name = self.arguments.resolve(&self.name, "service", name)?;
        let service = name.clone();
        let guard = self.transport.serve(
            &name,
            S::TYPE,
            Box::new(move |bytes| match from_cdr::<S::Request>(bytes) {
                Ok(request) => Some(to_cdr(&handler(request))),
                Err(error) => {
                    log::warn!("{service}: a malformed request is not answered: {error}");
                    None
                }
            }),
        )?;
        self.guards.push(guard);
        Ok(())
    }

    /// Puts events into this node's queue from other threads.
    pub fn sender(&self) -> EventSender<E> {
        EventSender {
            queue: Arc::clone(&self.queue),
            overflow: self.overflow,
        }
    }

    /// Waits for the next event; `None` once the node was asked to end.
    pub fn next(&mut self) -> Option<(Time, E)> {
        match self.wait(None) {
            Next::Event(time, event) => Some((time, event)),
            Next::Timeout | Next::Shutdown => None,
        }
    }

    /// Waits for the next event, at most `timeout` of real time.
    #[expect(clippy::disallowed_methods, reason = "a limit on waiting is in real time")]
    pub fn next_timeout(&mut self, timeout: Duration) -> Next<E> {
        self.wait(Instant::now().checked_add(timeout))
    }

    /// Waits for a timer or an event.
    #[expect(clippy::disallowed_methods, reason = "a limit on waiting is in real time")]
    fn wait(&mut self, until: Option<Instant>) -> Next<E> {
        if let Some(log) = &self.log {
            log.enter();
        }
        loop {
            if self.stopper.stopped() {
                return Next::Shutdown;
            }
            let now_ns = self.clock.now_ns();
            if let Some(event) = self.due_timer(now_ns) {
                return Next::Event(clock::to_time(now_ns), event);
            }
            let left = until.map(|until| until.saturating_duration_since(Instant::now()));
            let timer = self.until_timer(now_ns);
            let limit = match (left, timer) {
                (Some(left), Some(timer)) => Some(left.min(timer)),
                (left, timer) => left.or(timer),
            };
            match self.queue.pop(limit) {
                Popped::Event(event) => return Next::Event(self.now(), event),
                Popped::Stopped => return Next::Shutdown,
                Popped::Nothing => {
                    if until.is_some_and(|until| Instant::now() >= until) {
                        return Next::Timeout;
                    }
                }
            }
        }
    }

    /// The event of the timer that is longest due, if one is.
    fn due_timer(&mut self, now_ns: i64) -> Option<E> {
        let timer = self
            .timers
            .iter_mut()
            .filter(|timer| timer.due_ns <= now_ns)
            .min_by_key(|timer| timer.due_ns)?;
        let missed = (now_ns - timer.due_ns) / timer.period_ns;
        timer.due_ns = timer
            .due_ns
            .saturating_add(timer.period_ns.saturating_mul(missed.saturating_add(1)));
        Some((timer.to_event)())
    }

    /// How long until the next timer; `None` without timers, or in simulated time, where `/clock` wakes the node.
    fn until_timer(&self, now_ns: i64) -> Option<Duration> {
        if self.clock.is_simulated() {
            return None;
        }
        let due = self.timers.iter().map(|timer| timer.due_ns).min()?;
        Some(Duration::from_nanos(
            u64::try_from(due.saturating_sub(now_ns)).unwrap_or(0),
        ))
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

/// A text that is new at every start.
fn instance() -> String {
    static STARTED: AtomicU64 = AtomicU64::new(0);
    format!(
        "{:x}-{:x}-{}",
        clock::system_ns(),
        std::process::id(),
        STARTED.fetch_add(1, Ordering::Relaxed)
    )
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

/// Puts events into a node's queue from other threads; waits while it is full.
pub struct EventSender<E> {
    queue: Arc<Queue<E>>,
    overflow: Overflow,
}

impl<E> Clone for EventSender<E> {
    fn clone(&self) -> Self {
        EventSender {
            queue: Arc::clone(&self.queue),
            overflow: self.overflow,
        }
    }
}

impl<E: Send + 'static> EventSender<E> {
    /// Adds an event; without effect once the node was asked to end.
    pub fn send(&self, event: E) {
        self.queue.push(event, self.overflow);
    }
}

impl<E> std::fmt::Debug for EventSender<E> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("EventSender").finish_non_exhaustive()
    }
}
