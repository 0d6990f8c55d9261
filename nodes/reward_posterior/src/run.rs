//! The node on the graph, and its journal on disk.

use crate::journal::{MAGIC, read_journal};
use crate::{Due, Event, Output, RewardPosterior, Settings, Work, Worked};
use apprentice_msgs::msg::{EvidenceLog, EvidenceReceipt, Posterior, PosteriorPreview, TabularWorld};
use bus::{Arguments, Bus, EventSender, Graph, Level, NodeError, Publisher, Qos};
use std::fs::{File, OpenOptions};
use std::io::{Read, Write};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{Sender, channel};
use std::time::Duration;

/// A journal above this is not read.
const MAX_JOURNAL: u64 = 256 << 20;

/// Runs the node until it is asked to stop.
pub fn run(graph: &Graph, arguments: &Arguments) -> Result<(), NodeError> {
    let settings: Settings = arguments.settings()?;
    let mut node = RewardPosterior::new(settings.clone());
    let (journal, restored) = open_journal(&settings.journal, &mut node)?;
    let mut bus = Bus::open(graph, arguments, &settings)?;
    let mut out = Out {
        journal,
        path: settings.journal.clone(),
        receipt: bus.publisher("receipt", Qos::Event)?,
        evidence: bus.publisher("evidence", Qos::State)?,
        world: bus.publisher("lesson_world", Qos::State)?,
        preview: bus.publisher("posterior_preview", Qos::State)?,
        posterior: bus.publisher("posterior", Qos::State)?,
    };
    bus.subscribe("scene", Qos::State, |message| Event::Scene(Box::new(message)))?;
    bus.subscribe("query", Qos::State, |message| Event::Query(Box::new(message)))?;
    bus.subscribe("world_query", Qos::State, |message| Event::WorldQuery(Box::new(message)))?;
    bus.subscribe("world", Qos::State, |message| Event::World(Box::new(message)))?;
    bus.subscribe("demonstration", Qos::Event, |message| Event::Demonstration(Box::new(message)))?;
    bus.subscribe("action_demonstration", Qos::Event, |message| Event::Actions(Box::new(message)))?;
    bus.subscribe("preference", Qos::Event, |message| Event::Preference(Box::new(message)))?;
    bus.subscribe("critique", Qos::Event, |message| Event::Critique(Box::new(message)))?;
    bus.subscribe("learner_history", Qos::Event, |message| Event::History(Box::new(message)))?;
    bus.subscribe("retraction", Qos::Event, |message| Event::Retraction(Box::new(message)))?;
    bus.subscribe("response", Qos::Event, |message| Event::Response(Box::new(message)))?;
    bus.every(Duration::from_secs(1), || Event::Tick);
    if node.evidence().revision() > 0 {
        log::info!("{} accepted events were restored from the journal", node.evidence().revision());
    }
    let recompute = bus.sender();
    let mut send = |bus: &Bus<Event>, outputs: Vec<Output>| -> Result<(), NodeError> {
        for output in outputs {
            match output {
                Output::Recompute => recompute.send(Event::Recompute),
                other => out.send(bus, other)?,
            }
        }
        Ok(())
    };
    send(&bus, restored)?;
    let sampler = sampler(bus.sender())?;
    let mut sampling: Option<([u8; 32], Arc<AtomicBool>)> = None;
    while let Some((now, event)) = bus.next() {
        let outputs = match (event, &sampling) {
            // Whoever says something while a posterior is computed is answered at once, and is not kept waiting for what is outdated.
            (Event::Recompute, Some((digest, stop))) => {
                stop.fetch_or(!node.wants(digest), Ordering::Relaxed);
                node.preview_due().into_iter().collect()
            }
            (Event::Recompute, None) => match node.due() {
                Due::Nothing => Vec::new(),
                Due::Preview(preview) => vec![*preview, Output::Recompute],
                Due::Posterior(work) => {
                    sampling = Some((work.digest, Arc::clone(&work.stop)));
                    sampler.send(work).map_err(|_| NodeError::Failed("sampling has ended".into()))?;
                    Vec::new()
                }
            },
            (Event::Worked(worked), stopped) => {
                let is_given_up = stopped.as_ref().is_some_and(|(_, stop)| stop.load(Ordering::Relaxed));
                sampling = None;
                if is_given_up { vec![Output::Recompute] } else { node.step(now, Event::Worked(worked)) }
            }
            (event, _) => node.step(now, event),
        };
        send(&bus, outputs)?;
    }
    Ok(())
}

/// A thread that computes one posterior after the other.
fn sampler(events: EventSender<Event>) -> Result<Sender<Box<Work>>, NodeError> {
    let (work, received) = channel::<Box<Work>>();
    let compute = move || {
        for work in received {
            let digest = work.digest;
            let worked = catch_unwind(AssertUnwindSafe(|| work.run())).unwrap_or_else(|_| Worked {
                digest,
                draws: Err("sampling ended in an error of its own; the log of the node says which".into()),
            });
            events.send(Event::Worked(Box::new(worked)));
        }
    };
    let thread = std::thread::Builder::new().name("sampling".into()).spawn(compute);
    thread.map_err(|error| NodeError::Start(format!("posteriors cannot be computed: {error}")))?;
    Ok(work)
}

struct Out {
    journal: Option<File>,
    path: String,
    receipt: Publisher<EvidenceReceipt>,
    evidence: Publisher<EvidenceLog>,
    world: Publisher<TabularWorld>,
    preview: Publisher<PosteriorPreview>,
    posterior: Publisher<Posterior>,
}

impl Out {
    fn send(&mut self, bus: &Bus<Event>, output: Output) -> Result<(), NodeError> {
        match output {
            Output::Journal(bytes) => {
                if let Some(file) = &mut self.journal {
                    // Evidence that is not safe must not be acknowledged: better no node than a forgetful one.
                    file.write_all(&bytes).and_then(|()| file.sync_data()).map_err(|error| {
                        NodeError::Failed(format!("evidence cannot be written to the journal '{}': {error}", self.path))
                    })?;
                }
            }
            Output::Receipt(message) => self.receipt.publish(&message)?,
            Output::Evidence(message) => self.evidence.publish(&message)?,
            Output::World(message) => self.world.publish(&message)?,
            Output::Preview(message) => self.preview.publish(&message)?,
            Output::Posterior(message) => {
                let level = if message.outcome == Posterior::READY { Level::Ok } else { Level::Warn };
                let facts = [
                    ("revision", message.revision.to_string()),
                    ("evidence", message.rationalities.iter().map(|of| of.n).sum::<u64>().to_string()),
                    ("preference_cycles", message.cycles.len().to_string()),
                    ("rhat_max", message.rhat_max.to_string()),
                    ("ess_bulk_min", message.ess_bulk_min.to_string()),
                    ("acceptance", message.acceptance.to_string()),
                ];
                bus.status(level, format!("revision {} {}", message.revision, message.reason), &facts);
                self.posterior.publish(&message)?;
            }
            Output::Warn(text) => log::warn!("{text}"),
            Output::Recompute => {}
        }
        Ok(())
    }
}

/// Opens the journal, restores the node from it and cuts an unfinished last frame off.
fn open_journal(path: &str, node: &mut RewardPosterior) -> Result<(Option<File>, Vec<Output>), NodeError> {
    if path.is_empty() {
        return Ok((None, Vec::new()));
    }
    let failed =
        |what: &str, error: &dyn std::fmt::Display| NodeError::Start(format!("journal '{path}': {what}{error}"));
    let mut file = OpenOptions::new()
        .read(true)
        .append(true)
        .create(true)
        .open(path)
        .map_err(|error| failed("it cannot be opened: ", &error))?;
    let length = file.metadata().map_err(|error| failed("", &error))?.len();
    if length > MAX_JOURNAL {
        return Err(failed("", &format!("it has {length} bytes; at most {MAX_JOURNAL} are read")));
    }
    let mut bytes = Vec::new();
    (&mut file).take(MAX_JOURNAL).read_to_end(&mut bytes).map_err(|error| failed("it cannot be read: ", &error))?;
    let (entries, used) = read_journal(&bytes).map_err(|error| failed("", &error))?;
    if used < bytes.len() {
        log::warn!("journal '{path}': the last {} bytes were cut off by a crash and are dropped", bytes.len() - used);
        file.set_len(used as u64).map_err(|error| failed("it cannot be shortened: ", &error))?;
    }
    if used == 0 {
        file.write_all(MAGIC)
            .and_then(|()| file.sync_all())
            .map_err(|error| failed("it cannot be written: ", &error))?;
    }
    let restored = node.restore(entries).map_err(|error| failed("", &error))?;
    Ok((Some(file), restored))
}
