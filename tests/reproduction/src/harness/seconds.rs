//! What a figure takes: told to a reader, part of no result.

use rustix::time::{ClockId, clock_gettime};

/// CPU seconds of all threads of this process.
pub fn of_cpu() -> f64 {
    read(ClockId::ProcessCPUTime)
}

/// Seconds on the wall, from some fixed time.
pub fn on_the_wall() -> f64 {
    read(ClockId::Monotonic)
}

fn read(clock: ClockId) -> f64 {
    let now = clock_gettime(clock);
    now.tv_sec as f64 + now.tv_nsec as f64 * 1e-9
}
