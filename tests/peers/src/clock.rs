//! CPU seconds, which other programs on the machine disturb less than they do the time of day.

use rustix::time::{ClockId, clock_gettime};

/// Runs `work`; gives what it gives, and the CPU seconds of all threads of this process.
pub fn timed<T>(work: impl FnOnce() -> T) -> (T, f64) {
    let start = seconds(ClockId::ProcessCPUTime);
    let outcome = work();
    (outcome, seconds(ClockId::ProcessCPUTime) - start)
}

/// The same with the seconds on the wall, for work on several threads.
pub fn timed_by_the_wall<T>(work: impl FnOnce() -> T) -> (T, f64) {
    let start = seconds(ClockId::Monotonic);
    let outcome = work();
    (outcome, seconds(ClockId::Monotonic) - start)
}

/// CPU seconds of this process until now.
pub fn cpu_seconds() -> f64 {
    seconds(ClockId::ProcessCPUTime)
}

fn seconds(clock: ClockId) -> f64 {
    let now = clock_gettime(clock);
    now.tv_sec as f64 + now.tv_nsec as f64 * 1e-9
}
