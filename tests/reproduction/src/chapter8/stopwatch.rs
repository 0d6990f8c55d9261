//! Time that this thread has worked, whatever else runs on the machine.

use rustix::time::{ClockId, clock_gettime};

/// Seconds of processor time of this thread.
pub fn cpu_seconds() -> f64 {
    let time = clock_gettime(ClockId::ThreadCPUTime);
    time.tv_sec as f64 + 1e-9 * time.tv_nsec as f64
}
