//! The recorder on the graph: looks for topics, subscribes, and hands messages to the writing thread.

use std::collections::BTreeMap;
use std::path::PathBuf;
use std::sync::atomic::Ordering;
use std::time::{Duration, Instant};

use bag_files::utc_stamp;
use bus::{Arguments, Bus, Graph, Level, Next, NodeError, RawSubscription, Time};

use crate::writing::Writing;
use crate::{Compression, Definitions, Event, Output, RecorderNode, Settings, Tape, TapeSettings};

/// Between two reports of the state.
const STATUS_PERIOD: Duration = Duration::from_secs(1);

/// Runs the recorder until it is asked to end; the bag is finished then.
///
/// # Errors
/// On bad arguments, when the bag's folder cannot be used, and when writing fails.
pub fn run(graph: &Graph, arguments: &Arguments) -> Result<(), NodeError> {
    let settings: Settings = arguments.settings()?;
    let mut bus: Bus<Event> = Bus::open(graph, arguments, &settings)?;
    let folder = folder(&settings);
    let (tape, notes) = Tape::start(TapeSettings {
        folder: folder.clone(),
        compression: match settings.compression {
            Compression::None => bag::Compression::None,
            Compression::Lz4 => bag::Compression::Lz4,
        },
        max_bytes_per_file: settings.max_bytes_per_file.unsigned_abs(),
        commit: std::env::var("APPRENTICE_COMMIT").unwrap_or_else(|_| "unknown".to_owned()),
        start_ns: system_ns(),
    })
    .map_err(|error| NodeError::Start(error.to_string()))?;
    notes.iter().for_each(|note| log::warn!("{note}"));
    log::info!("recording into {}", folder.display());

    let stopper = bus.stopper();
    let flush_period = Duration::from_secs_f64(settings.flush_period_s);
    let max_waiting = settings.queue_mb.unsigned_abs().saturating_mul(1_000_000);
    let writing = Writing::start(tape, flush_period, max_waiting, move || stopper.stop())
        .map_err(|error| NodeError::Start(format!("cannot start the writing thread: {error}")))?;

    let definitions =
        Definitions::new(&settings.message_definition_path, &std::env::var("AMENT_PREFIX_PATH").unwrap_or_default());
    let node = RecorderNode::new(&settings, definitions).map_err(|error| NodeError::Start(error.to_string()))?;
    let period = Duration::from_secs_f64(settings.discovery_period_s);
    Recording { node, writing: &writing, subscriptions: BTreeMap::new(), warned_of_drops: false }.run(&mut bus, period);

    let failure = writing.progress().failure();
    let dropped = writing.progress().dropped.load(Ordering::Relaxed);
    if let Some(failure) = failure {
        return Err(NodeError::Failed(failure));
    }
    let bag = writing.finish().map_err(NodeError::Failed)?;
    log::info!(
        "{}: {} messages on {} topics in {:.1} s, {dropped} dropped",
        folder.display(),
        bag.message_count,
        bag.topics.len(),
        bag.duration as f64 / 1e9
    );
    Ok(())
}

/// What the loop works with.
struct Recording<'a> {
    node: RecorderNode,
    writing: &'a Writing,
    subscriptions: BTreeMap<String, RawSubscription>,
    warned_of_drops: bool,
}

impl Recording<'_> {
    /// Takes events until the bus stops.
    #[expect(clippy::disallowed_methods, reason = "topics are looked for in real time, also under use_sim_time")]
    fn run(mut self, bus: &mut Bus<Event>, period: Duration) {
        let (mut look_at, mut status_at) = (Instant::now(), Instant::now());
        loop {
            if Instant::now() >= look_at {
                look_at = Instant::now() + period;
                let topics = bus.topics();
                let now = bus.now();
                self.take(bus, now, Event::Graph(topics));
            }
            if Instant::now() >= status_at {
                status_at = Instant::now() + STATUS_PERIOD;
                self.status(bus);
            }
            match bus.next_timeout(look_at.saturating_duration_since(Instant::now())) {
                Next::Event(now, event) => self.take(bus, now, event),
                Next::Timeout => {}
                Next::Shutdown => return,
            }
        }
    }

    fn take(&mut self, bus: &mut Bus<Event>, now: Time, event: Event) {
        for output in self.node.step(now, event) {
            match output {
                Output::Describe(topic) => self.writing.describe(topic),
                Output::Write { topic, log_time, publish_time, cdr } => {
                    if !self.writing.write(topic, log_time, publish_time, cdr) && !self.warned_of_drops {
                        self.warned_of_drops = true;
                        log::warn!("the disk is too slow: messages are dropped; the count is in /diagnostics");
                    }
                }
                Output::Subscribe { topic, type_name, qos } => {
                    // The old subscription goes first, so that no message is recorded twice.
                    self.subscriptions.remove(&topic);
                    let name = topic.clone();
                    let to_event = move |message| Event::Message { topic: name.clone(), message };
                    match bus.subscribe_raw(&topic, &type_name, qos, to_event) {
                        Ok(subscription) => drop(self.subscriptions.insert(topic, subscription)),
                        Err(error) => log::warn!("{topic} is not recorded: {error}"),
                    }
                }
                Output::Info(text) => log::info!("{text}"),
                Output::Warn(text) => log::warn!("{text}"),
            }
        }
    }

    fn status(&self, bus: &Bus<Event>) {
        let progress = self.writing.progress();
        let [messages, bytes, dropped] =
            [&progress.messages, &progress.bytes, &progress.dropped].map(|count| count.load(Ordering::Relaxed));
        let values = [
            ("messages", messages.to_string()),
            ("bytes", bytes.to_string()),
            ("dropped", dropped.to_string()),
            ("topics", self.node.topic_count().to_string()),
        ];
        if dropped > 0 {
            bus.status(Level::Warn, format!("{dropped} messages dropped: the disk is too slow"), &values);
        } else {
            bus.status(Level::Ok, "recording", &values);
        }
    }
}

/// The folder to record into.
fn folder(settings: &Settings) -> PathBuf {
    if settings.output.is_empty() {
        PathBuf::from("bags").join(utc_stamp(system_ns()))
    } else {
        PathBuf::from(&settings.output)
    }
}

/// The system's time, ns since 1970.
#[expect(clippy::disallowed_methods, reason = "a recording is named after the real time at which it starts")]
fn system_ns() -> u64 {
    let since = std::time::SystemTime::now().duration_since(std::time::UNIX_EPOCH);
    since.map_or(0, |since| u64::try_from(since.as_nanos()).unwrap_or(u64::MAX))
}
