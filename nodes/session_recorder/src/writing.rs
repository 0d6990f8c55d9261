//! The thread that writes the tape, fed by a bounded queue.

use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::mpsc::{Receiver, RecvTimeoutError, SyncSender, TrySendError, sync_channel};
use std::sync::{Arc, Mutex, PoisonError};
use std::thread::JoinHandle;
use std::time::{Duration, Instant};

use bag::{BagMetadata, Topic};

use crate::{Tape, TapeError};

/// Most messages that wait for the disk, whatever their size.
const QUEUE_MESSAGES: usize = 200_000;

/// One thing to write.
enum Job {
    Describe(Topic),
    Write { topic: String, log_time: u64, publish_time: u64, cdr: Vec<u8> },
}

/// What the thread tells while it works.
#[derive(Debug, Default)]
pub(crate) struct Progress {
    /// Messages written.
    pub(crate) messages: AtomicU64,
    /// Bytes written.
    pub(crate) bytes: AtomicU64,
    /// Messages dropped because the disk could not keep up.
    pub(crate) dropped: AtomicU64,
    /// Bytes of messages that wait.
    waiting_bytes: AtomicU64,
    failed: Mutex<Option<String>>,
}

impl Progress {
    /// Why the thread gave up, once it has.
    pub(crate) fn failure(&self) -> Option<String> {
        self.failed.lock().unwrap_or_else(PoisonError::into_inner).clone()
    }
}

/// The writing thread and the queue to it.
pub(crate) struct Writing {
    queue: SyncSender<Job>,
    max_waiting_bytes: u64,
    progress: Arc<Progress>,
    thread: JoinHandle<Result<BagMetadata, TapeError>>,
}

impl Writing {
    /// Starts the thread. `failed` is called from it when writing fails.
    pub(crate) fn start(
        tape: Tape,
        flush_period: Duration,
        max_waiting_bytes: u64,
        failed: impl FnOnce() + Send + 'static,
    ) -> std::io::Result<Writing> {
        let (queue, jobs) = sync_channel(QUEUE_MESSAGES);
        let progress = Arc::new(Progress::default());
        let shared = Arc::clone(&progress);
        let thread = std::thread::Builder::new().name("bag writer".to_owned()).spawn(move || {
            let result = work(tape, &jobs, flush_period, &shared);
            if let Err(error) = &result {
                *shared.failed.lock().unwrap_or_else(PoisonError::into_inner) = Some(error.to_string());
                failed();
            }
            result
        })?;
        Ok(Writing { queue, max_waiting_bytes, progress, thread })
    }

    pub(crate) fn progress(&self) -> &Progress {
        &self.progress
    }

    /// Describes a topic; waits for the queue, since nothing of the topic could be kept without it.
    pub(crate) fn describe(&self, topic: Topic) {
        // An error means that the thread has ended, which `Progress::failure` tells.
        let _ = self.queue.send(Job::Describe(topic));
    }

    /// Hands a message over, or drops and counts it when too many wait. Gives whether it was taken.
    pub(crate) fn write(&self, topic: String, log_time: u64, publish_time: u64, cdr: Vec<u8>) -> bool {
        let bytes = cdr.len() as u64;
        let waiting = self.progress.waiting_bytes.fetch_add(bytes, Ordering::Relaxed);
        // One message alone is always taken, however long it is.
        let fits = waiting == 0 || waiting.saturating_add(bytes) <= self.max_waiting_bytes;
        let job = Job::Write { topic, log_time, publish_time, cdr };
        let taken =
            fits && !matches!(self.queue.try_send(job), Err(TrySendError::Full(_) | TrySendError::Disconnected(_)));
        if !taken {
            self.progress.waiting_bytes.fetch_sub(bytes, Ordering::Relaxed);
            self.progress.dropped.fetch_add(1, Ordering::Relaxed);
        }
        taken
    }

    /// Writes what waits, finishes the bag and ends the thread.
    pub(crate) fn finish(self) -> Result<BagMetadata, String> {
        drop(self.queue);
        match self.thread.join() {
            Ok(result) => result.map_err(|error| error.to_string()),
            Err(_) => Err("the writing thread died".to_owned()),
        }
    }
}

/// Writes until the queue's other end is gone, flushing every `flush_period`.
#[expect(clippy::disallowed_methods, reason = "flushing follows real time, whatever time the messages carry")]
fn work(
    mut tape: Tape,
    jobs: &Receiver<Job>,
    flush_period: Duration,
    progress: &Progress,
) -> Result<BagMetadata, TapeError> {
    let mut flush_at = Instant::now() + flush_period;
    let mut dirty = false;
    loop {
        match jobs.recv_timeout(flush_at.saturating_duration_since(Instant::now())) {
            Ok(Job::Describe(topic)) => {
                tape.describe(&topic)?;
                dirty = true;
            }
            Ok(Job::Write { topic, log_time, publish_time, cdr }) => {
                progress.waiting_bytes.fetch_sub(cdr.len() as u64, Ordering::Relaxed);
                tape.write(&topic, log_time, publish_time, &cdr)?;
                progress.messages.fetch_add(1, Ordering::Relaxed);
                progress.bytes.store(tape.bytes(), Ordering::Relaxed);
                dirty = true;
            }
            Err(RecvTimeoutError::Timeout) => {}
            Err(RecvTimeoutError::Disconnected) => return tape.finish(),
        }
        if Instant::now() >= flush_at {
            if dirty {
                tape.flush()?;
            }
            dirty = false;
            flush_at = Instant::now() + flush_period;
        }
    }
}
