//! How long a command took: on the wall, and of all its threads together.

use std::time::{Duration, Instant};

use rustix::time::{ClockId, clock_gettime};

/// Started with a command.
#[derive(Debug)]
pub(crate) struct Stopwatch {
    since: Instant,
}

impl Stopwatch {
    /// Starts.
    #[expect(clippy::disallowed_methods, reason = "what a command took is told, and decides nothing")]
    pub(crate) fn start() -> Self {
        Self { since: Instant::now() }
    }

    /// Seconds since the start.
    pub(crate) fn seconds(&self) -> f64 {
        self.since.elapsed().as_secs_f64()
    }

    /// Seconds of processor time of this process, its start included.
    pub(crate) fn cpu_seconds() -> f64 {
        let time = clock_gettime(ClockId::ProcessCPUTime);
        Duration::new(time.tv_sec.unsigned_abs(), u32::try_from(time.tv_nsec).unwrap_or(0)).as_secs_f64()
    }
}
