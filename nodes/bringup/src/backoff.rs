//! How long a node that died waits before it is started again.

use std::time::Duration;

/// The first wait.
pub const SHORTEST: Duration = Duration::from_millis(200);
/// No wait is longer.
pub const LONGEST: Duration = Duration::from_secs(10);
/// A node that lived this long begins anew with the shortest wait.
pub const HEALTHY_AFTER: Duration = Duration::from_secs(30);

/// The waits of one node: each twice the one before, up to [`LONGEST`].
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Backoff {
    next: Duration,
}

impl Default for Backoff {
    fn default() -> Self {
        Self { next: SHORTEST }
    }
}

impl Backoff {
    /// The wait after a death; `lived` is how long the process had run.
    pub fn after(&mut self, lived: Duration) -> Duration {
        if lived >= HEALTHY_AFTER {
            self.next = SHORTEST;
        }
        let wait = self.next;
        self.next = (2 * wait).min(LONGEST);
        wait
    }
}

#[cfg(test)]
mod tests {
    use super::{Backoff, HEALTHY_AFTER, LONGEST, SHORTEST};
    use std::time::Duration;

    #[test]
    fn waits_double_to_the_longest_and_start_over_after_a_healthy_life() {
        let mut backoff = Backoff::default();
        let waits: Vec<u128> = (0..8).map(|_| backoff.after(Duration::ZERO).as_millis()).collect();
        assert_eq!(waits, [200, 400, 800, 1600, 3200, 6400, 10_000, 10_000]);
        assert_eq!(backoff.after(HEALTHY_AFTER - Duration::from_nanos(1)), LONGEST);
        assert_eq!(backoff.after(HEALTHY_AFTER), SHORTEST);
        assert_eq!(backoff.after(Duration::ZERO), 2 * SHORTEST);
    }
}
