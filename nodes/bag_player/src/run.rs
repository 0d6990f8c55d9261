//! The player on the graph: opens the bag, makes its publishers, and publishes what is due.

use std::collections::BTreeMap;
use std::path::PathBuf;
use std::sync::Arc;
use std::time::{Duration, Instant};

use apprentice_msgs::builtin_interfaces::Time;
use apprentice_msgs::rosgraph_msgs::Clock;
use apprentice_msgs::srv::{SetPaused, SetPausedResponse};
use apprentice_msgs::std_msgs::Bool;
use bag_files::{OpenBag, open_bag};
use bus::{Arguments, Bus, Graph, Level, Next, NodeError, Publisher, Qos, RawPublisher};

use crate::{Event, Output, PlayerNode, Settings, Source, replay_qos};

/// How long the player stays after the last message, so that it reaches every subscription.
const LINGER: Duration = Duration::from_millis(500);
/// Longest sleep without anything to do, after which the state is reported again.
const MAX_SLEEP: Duration = Duration::from_secs(1);

/// Plays a bag until its end, or until the node is asked to end.
///
/// # Errors
/// On bad arguments, when the bag cannot be opened, and when it turns out damaged on the way.
#[expect(clippy::disallowed_methods, reason = "a replay follows real time")]
pub fn run(graph: &Graph, arguments: &Arguments) -> Result<(), NodeError> {
    let settings: Settings = arguments.settings()?;
    if settings.bag.is_empty() {
        return Err(NodeError::Start("`bag` is empty; expected a bag to play, as `-p bag:=FOLDER`".to_owned()));
    }
    let start = |error: String| NodeError::Start(error);
    let bag = Arc::new(open_bag(&PathBuf::from(&settings.bag)).map_err(|error| start(error.to_string()))?);
    let mut bus: Bus<Event> = Bus::open(graph, arguments, &settings)?;
    for (path, damage) in bag.damage() {
        log::warn!("{}: {damage}", path.display());
    }

    let began = Instant::now();
    let now = || u64::try_from(began.elapsed().as_nanos()).unwrap_or(u64::MAX);
    let bag_start = bag.metadata.start.unwrap_or(0);
    let mut node =
        PlayerNode::new(&settings, bag_start, source(&bag), now()).map_err(|error| start(error.to_string()))?;

    let topics = bag.topics();
    let played = node.played(&topics);
    if played.is_empty() {
        return Err(start(format!("{} has no topic that `topics` and `exclude` leave", settings.bag)));
    }
    let mut outlets = Outlets { topics: BTreeMap::new(), clock: None, refused: 0 };
    for found in played {
        let (qos, problem) = replay_qos(&found.topic);
        if let Some(problem) = problem {
            log::warn!("{}: {problem}; it is played reliable and volatile", found.topic.name);
        }
        match bus.publisher_raw(&found.topic.name, &found.topic.type_name, qos) {
            Ok(publisher) => drop(outlets.topics.insert(found.topic.name.clone(), publisher)),
            Err(error) => log::warn!("{} is not played: {error}", found.topic.name),
        }
    }
    if settings.clock_hz > 0.0 {
        outlets.clock = Some(bus.publisher("/clock", Qos::Stream)?);
    }
    let sender = bus.sender();
    bus.serve::<SetPaused>("~/set_paused", move |request| {
        sender.send(Event::SetPaused(request.paused));
        let message = if request.paused { "paused" } else { "playing" };
        SetPausedResponse { paused: request.paused, message: message.to_owned() }
    })?;
    bus.subscribe("~/paused", Qos::Event, |message: Bool| Event::SetPaused(message.data))?;
    log::info!(
        "playing {}: {} messages on {} topics, {:.1} s at rate {}",
        settings.bag,
        bag.metadata.message_count,
        outlets.topics.len(),
        bag.metadata.duration as f64 / 1e9,
        settings.rate
    );

    let mut event = Event::Tick;
    loop {
        if let Event::SetPaused(paused) = event {
            log::info!("{}", if paused { "paused" } else { "playing" });
        }
        let mut wake_at = None;
        for output in node.step(now(), event) {
            match output {
                Output::WakeAt(at) => wake_at = Some(at),
                Output::Finished(_) => {
                    report(&bus, &node);
                    linger(&mut bus);
                    return Ok(());
                }
                Output::Failed(error, summary) => {
                    let messages = summary.messages;
                    return Err(NodeError::Failed(format!("stopped after {messages} messages: {error}")));
                }
                other => outlets.put_out(other),
            }
        }
        status(&bus, &node);
        let sleep = wake_at.map_or(MAX_SLEEP, |at| Duration::from_nanos(at.saturating_sub(now())).min(MAX_SLEEP));
        event = match bus.next_timeout(sleep) {
            Next::Event(_, event) => event,
            Next::Timeout => Event::Tick,
            Next::Shutdown => {
                report(&bus, &node);
                return Ok(());
            }
        };
    }
}

/// The bag, again from its start at each call.
fn source(bag: &Arc<OpenBag>) -> Source {
    let bag = Arc::clone(bag);
    Box::new(move || Box::new(bag.messages().map(|message| message.map_err(|error| error.to_string()))))
}

/// The publishers.
struct Outlets {
    topics: BTreeMap<String, RawPublisher>,
    clock: Option<Publisher<Clock>>,
    /// Messages the graph did not take.
    refused: u64,
}

impl Outlets {
    fn put_out(&mut self, output: Output) {
        let result = match output {
            Output::Publish { topic, cdr } => self.topics.get(&topic.name).map_or(Ok(()), |one| one.publish(&cdr)),
            Output::Clock(ns) => self.clock.as_ref().map_or(Ok(()), |clock| clock.publish(&clock_message(ns))),
            Output::Warn(text) => {
                log::warn!("{text}");
                Ok(())
            }
            Output::WakeAt(_) | Output::Finished(_) | Output::Failed(..) => Ok(()),
        };
        if let Err(error) = result {
            self.refused += 1;
            if self.refused == 1 || self.refused.is_multiple_of(1_000) {
                log::warn!("{error} ({} messages so far)", self.refused);
            }
        }
    }
}

fn clock_message(ns: u64) -> Clock {
    let sec = i32::try_from(ns / 1_000_000_000).unwrap_or(i32::MAX);
    let nanosec = u32::try_from(ns % 1_000_000_000).expect("a remainder below 1e9");
    Clock { clock: Time { sec, nanosec } }
}

fn report(bus: &Bus<Event>, node: &PlayerNode) {
    let summary = node.summary();
    status(bus, node);
    log::info!(
        "played {} messages, {} rounds complete, {} left out as malformed",
        summary.messages,
        summary.rounds,
        summary.malformed
    );
}

fn status(bus: &Bus<Event>, node: &PlayerNode) {
    let summary = node.summary();
    let values = [("messages", summary.messages.to_string()), ("rounds", summary.rounds.to_string())];
    bus.status(Level::Ok, if node.paused() { "paused" } else { "playing" }, &values);
}

/// Waits a little for what was published last.
#[expect(clippy::disallowed_methods, reason = "delivery takes real time")]
fn linger(bus: &mut Bus<Event>) {
    let until = Instant::now() + LINGER;
    while let Some(left) = until.checked_duration_since(Instant::now()).filter(|left| !left.is_zero()) {
        if bus.next_timeout(left) == Next::Shutdown {
            return;
        }
    }
}
