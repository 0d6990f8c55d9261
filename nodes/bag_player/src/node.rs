//! Which messages go out when, as a function of the bag, the settings and `now`.

use std::collections::BTreeSet;
use std::sync::Arc;

use bag::{FilterError, Message, Topic, TopicContents, TopicFilter};

use crate::{Schedule, Settings};

/// Topic of simulated time.
const CLOCK: &str = "/clock";
/// Most messages that go out in one step, so that a fast replay still hears a pause.
const MAX_BURST: usize = 500;

/// A bag from its start, again for each round of a loop. Items are messages by log time, or why reading stopped.
pub type Source = Box<dyn FnMut() -> Box<dyn Iterator<Item = Result<Message, String>>>>;

/// What reaches the player.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Event {
    /// Time has passed.
    Tick,
    /// Somebody pauses or resumes.
    SetPaused(bool),
}

/// What the player wants done.
#[derive(Debug, Clone, PartialEq)]
pub enum Output {
    /// Publish the bytes on a topic.
    Publish {
        /// The topic.
        topic: Arc<Topic>,
        /// CDR with its 4-byte header.
        cdr: Vec<u8>,
    },
    /// Publish this time of the bag, in ns, on `/clock`.
    Clock(u64),
    /// Come again with a tick at this time at the latest; without one, nothing happens until an event.
    WakeAt(u64),
    /// Warn the person.
    Warn(String),
    /// The bag has ended.
    Finished(Summary),
    /// Reading the bag failed; what was played until then is in the summary.
    Failed(String, Summary),
}

/// What was played.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Summary {
    /// Messages published.
    pub messages: u64,
    /// Messages left out because they are no CDR.
    pub malformed: u64,
    /// Rounds through the bag that are complete.
    pub rounds: u64,
}

/// The player without files, threads and graph. Times of `step` are ns of a steady clock.
pub struct PlayerNode {
    schedule: Schedule,
    filter: TopicFilter,
    looping: bool,
    /// The bag's time from which messages are played.
    first: u64,
    open: Source,
    messages: Box<dyn Iterator<Item = Result<Message, String>>>,
    next: Option<Message>,
    /// Whether this round has played anything: an empty loop would never end.
    round_played: bool,
    clock_period: Option<u64>,
    clock_due: u64,
    summary: Summary,
    malformed: BTreeSet<String>,
    ended: bool,
}

impl PlayerNode {
    /// A player that starts `delay_s` after `now`. `bag_start` is the log time of the bag's first message in ns.
    ///
    /// # Errors
    /// When a pattern is no regular expression.
    pub fn new(settings: &Settings, bag_start: u64, mut open: Source, now: u64) -> Result<PlayerNode, FilterError> {
        let first = bag_start.saturating_add(nanoseconds(settings.start_offset_s));
        let starts_at = now.saturating_add(nanoseconds(settings.delay_s));
        Ok(PlayerNode {
            schedule: Schedule::new(first, starts_at, settings.rate, settings.paused),
            filter: TopicFilter::new(&settings.topics, &settings.exclude)?,
            looping: settings.r#loop,
            first,
            messages: open(),
            open,
            next: None,
            round_played: false,
            clock_period: (settings.clock_hz > 0.0).then(|| nanoseconds(1.0 / settings.clock_hz).max(1)),
            clock_due: now,
            summary: Summary::default(),
            malformed: BTreeSet::new(),
            ended: false,
        })
    }

    /// The topics that will be played.
    pub fn played<'a>(&self, topics: &'a [TopicContents]) -> Vec<&'a TopicContents> {
        topics.iter().filter(|found| self.takes(&found.topic.name)).collect()
    }

    /// Whether a topic is played; the bag's `/clock` is not when the player makes its own.
    fn takes(&self, topic: &str) -> bool {
        self.filter.takes(topic) && !(self.clock_period.is_some() && topic == CLOCK)
    }

    /// Whether it is paused.
    pub fn paused(&self) -> bool {
        self.schedule.paused()
    }

    /// What was played so far.
    pub fn summary(&self) -> Summary {
        self.summary
    }

    /// Takes an event at `now`.
    pub fn step(&mut self, now: u64, event: Event) -> Vec<Output> {
        let mut outputs = Vec::new();
        if let Event::SetPaused(paused) = event {
            self.schedule.set_paused(now, paused);
        }
        if self.ended {
            return outputs;
        }
        if let Some(period) = self.clock_period
            && now >= self.clock_due
        {
            outputs.push(Output::Clock(self.schedule.bag_time(now)));
            self.clock_due = now.saturating_add(period);
        }
        let wake = self.play(now, &mut outputs);
        let clock = self.clock_period.map(|_| self.clock_due);
        if !self.ended
            && let Some(at) = earliest(wake, clock)
        {
            outputs.push(Output::WakeAt(at));
        }
        outputs
    }

    /// Puts out everything that is due; gives when the next message is.
    fn play(&mut self, now: u64, outputs: &mut Vec<Output>) -> Option<u64> {
        for _ in 0..MAX_BURST {
            match self.advance() {
                Ok(true) => {}
                Ok(false) if self.looping && self.round_played => {
                    self.summary.rounds += 1;
                    self.round_played = false;
                    self.messages = (self.open)();
                    self.schedule.rewind(now);
                    continue;
                }
                Ok(false) => {
                    self.summary.rounds += 1;
                    self.ended = true;
                    outputs.push(Output::Finished(self.summary));
                    return None;
                }
                Err(error) => {
                    self.ended = true;
                    outputs.push(Output::Failed(error, self.summary));
                    return None;
                }
            }
            let due = self.next.as_ref().and_then(|next| self.schedule.due(next.log_time))?;
            if due > now {
                return Some(due);
            }
            if let Some(message) = self.next.take() {
                self.put_out(message, outputs);
            }
        }
        // More is due, but others come first.
        Some(now)
    }

    /// Reads on to the next message that is to be played; `false` at the end.
    fn advance(&mut self) -> Result<bool, String> {
        while self.next.is_none() {
            match self.messages.next().transpose()? {
                None => return Ok(false),
                Some(message) if message.log_time >= self.first && self.takes(&message.topic.name) => {
                    self.next = Some(message);
                }
                Some(_) => {}
            }
        }
        Ok(true)
    }

    fn put_out(&mut self, message: Message, outputs: &mut Vec<Output>) {
        self.round_played = true;
        let name = &message.topic.name;
        if message.topic.message_encoding != "cdr" || message.data.len() < 4 {
            self.summary.malformed += 1;
            if self.malformed.insert(name.clone()) {
                let (encoding, bytes) = (&message.topic.message_encoding, message.data.len());
                outputs.push(Output::Warn(format!(
                    "{name}: got a message of {bytes} bytes encoded as '{encoding}', expected CDR with its 4-byte \
                     header; such messages are left out"
                )));
            }
            return;
        }
        self.summary.messages += 1;
        outputs.push(Output::Publish { topic: message.topic, cdr: message.data });
    }
}

/// Seconds as ns.
fn nanoseconds(seconds: f64) -> u64 {
    (seconds * 1e9).round() as u64
}

fn earliest(a: Option<u64>, b: Option<u64>) -> Option<u64> {
    match (a, b) {
        (Some(a), Some(b)) => Some(a.min(b)),
        (a, b) => a.or(b),
    }
}
