//! Joining the graph, and what every node does from the start.

use std::sync::{
    Arc,
    atomic::{AtomicU64, Ordering},
    mpsc::{Receiver, sync_channel},
};

use apprentice_msgs::{msg::NodeSettings as NodeSettingsMessage, rosgraph_msgs::Clock as ClockMessage};
use log::LevelFilter;

use crate::{
    arguments::Arguments,
    bus::{Bus, Graph},
    clock::{self, Clock},
    dds::{DdsTransport, Environment, Range},
    error::BusError,
    health::{Counters, Health},
    housekeeping::Housekeeping,
    logging::{self, Attached, LogLine},
    memory::MemoryGraph,
    parameter::NodeSettings,
    parameter_services,
    qos::{Durability, Qos, QosProfile, Reliability},
    queue::{self, Overflow, Queue},
    settings::{BusParameters, settings_to_yaml},
    signals,
    stop::Stopper,
    transport::Transport,
};

impl<E: Send + 'static> Bus<E> {
    /// Joins the graph under the name that settings and arguments give, publishes the settings, and starts the
    /// heartbeat, the diagnostics, the log and the parameter services.
    ///
    /// # Errors
    /// On an illegal name, a wrong environment variable, or when DDS cannot start.
    pub fn open<S: NodeSettings>(graph: &Graph, arguments: &Arguments, settings: &S) -> Result<Bus<E>, BusError> {
        let name = arguments.node_name(S::NODE)?;
        let parameters = BusParameters::from_given(&arguments.given(S::NODE)?)?;
        let stopper = Stopper::default();
        let queue = Queue::new(queue::CAPACITY, stopper.clone());
        let (lines_in, lines) = sync_channel(1000);
        let level = arguments.level(&name).unwrap_or(LevelFilter::Info);
        let rosout = arguments.rosout();
        let log = logging::attach(&name.logger(), level, arguments.stderr(), Some(lines_in));
        let (transport, memory, overflow): (Arc<dyn Transport>, _, _) = match graph {
            Graph::Memory(memory) => (Arc::new(memory.join(&name, &stopper)), Some(memory.clone()), Overflow::Grow),
            Graph::Dds => {
                signals::stop_on_signals(&stopper)?;
                let environment = Environment::read(&parameters.service_mapping)?;
                for warning in &environment.warnings {
                    log::warn!("{warning}");
                }
                if environment.range == Range::Off {
                    log::warn!("ROS_AUTOMATIC_DISCOVERY_RANGE=OFF: this node neither hears nor is heard");
                    let alone = MemoryGraph::new();
                    (Arc::new(alone.join(&name, &stopper)), Some(alone), Overflow::Grow)
                } else {
                    let transport = DdsTransport::join(&environment, &name, log.id(), &stopper)?;
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
            timer_was_last: false,
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
        let profile = QosProfile::new(Reliability::BestEffort, Durability::Volatile, 1);
        self.subscribe_decoded(&topic, &profile, move |message: ClockMessage| {
            clock.set(&message.clock);
            queue.wake();
        })
    }

    /// Starts the thread that publishes heartbeat, diagnostics and log lines.
    fn start_housekeeping(&mut self, rosout: bool, lines: Receiver<LogLine>) -> Result<(), BusError> {
        let queue = Arc::clone(&self.queue);
        let rosout_qos = Qos::Custom(QosProfile::new(Reliability::Reliable, Durability::TransientLocal, 1000));
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
            .map_err(|source| BusError::System { what: "a thread", source })?;
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
            commit: std::env::var("APPRENTICE_COMMIT").unwrap_or_else(|_| "unknown".to_owned()),
            parameters: settings_to_yaml(settings),
        })?;
        self.guards.push(Box::new(publisher));
        Ok(())
    }
}

/// A text that is new at every start.
fn instance() -> String {
    static STARTED: AtomicU64 = AtomicU64::new(0);
    format!("{:x}-{:x}-{}", clock::system_ns(), std::process::id(), STARTED.fetch_add(1, Ordering::Relaxed))
}
