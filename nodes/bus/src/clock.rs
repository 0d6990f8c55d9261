//! The node's time: the system's, or the simulation's from `/clock`.

use std::{
    sync::{
        Arc,
        atomic::{AtomicI64, Ordering},
    },
    time::{Instant, SystemTime, UNIX_EPOCH},
};

use apprentice_msgs::builtin_interfaces::Time;

/// Where a node's time comes from; clones show the same time.
#[derive(Debug, Clone)]
pub(crate) struct Clock {
    /// Nanoseconds of the simulation; `None` for the system's time.
    simulated: Option<Arc<AtomicI64>>,
    /// When the clock was made.
    made: Instant,
}

impl Clock {
    /// A clock; the simulation's stands at zero until `/clock` says otherwise, as in ROS.
    #[expect(clippy::disallowed_methods, reason = "the bus is where time enters")]
    pub(crate) fn new(simulated: bool) -> Clock {
        Clock { simulated: simulated.then(|| Arc::new(AtomicI64::new(0))), made: Instant::now() }
    }

    /// Nanoseconds since the epoch of this clock.
    pub(crate) fn now_ns(&self) -> i64 {
        match &self.simulated {
            Some(time) => time.load(Ordering::SeqCst),
            None => system_ns(),
        }
    }

    /// Nanoseconds for timers: the simulation's, or real ones that never jump when the system's time is set.
    pub(crate) fn timer_ns(&self) -> i64 {
        match &self.simulated {
            Some(time) => time.load(Ordering::SeqCst),
            None => i64::try_from(self.made.elapsed().as_nanos()).unwrap_or(i64::MAX),
        }
    }

    /// The time as a message.
    pub(crate) fn now(&self) -> Time {
        to_time(self.now_ns())
    }

    /// Sets the simulation's time.
    pub(crate) fn set(&self, time: &Time) {
        if let Some(simulated) = &self.simulated {
            simulated.store(to_ns(time), Ordering::SeqCst);
        }
    }

    /// Whether the time is a simulation's.
    pub(crate) fn is_simulated(&self) -> bool {
        self.simulated.is_some()
    }
}

/// The system's time, nanoseconds since 1970.
#[expect(clippy::disallowed_methods, reason = "the bus is where time enters")]
pub(crate) fn system_ns() -> i64 {
    match SystemTime::now().duration_since(UNIX_EPOCH) {
        Ok(since) => i64::try_from(since.as_nanos()).unwrap_or(i64::MAX),
        Err(before) => i64::try_from(before.duration().as_nanos()).map_or(i64::MIN, |ns| -ns),
    }
}

/// A message from nanoseconds; seconds are clamped to the message's 32 bits.
pub(crate) fn to_time(ns: i64) -> Time {
    let sec = ns.div_euclid(1_000_000_000);
    let rest = u32::try_from(ns.rem_euclid(1_000_000_000)).expect("a remainder below 1e9");
    match i32::try_from(sec) {
        Ok(sec) => Time { sec, nanosec: rest },
        Err(_) if sec < 0 => Time { sec: i32::MIN, nanosec: 0 },
        Err(_) => Time { sec: i32::MAX, nanosec: 999_999_999 },
    }
}

/// Nanoseconds of a message.
pub(crate) fn to_ns(time: &Time) -> i64 {
    i64::from(time.sec) * 1_000_000_000 + i64::from(time.nanosec)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn times_go_there_and_back() {
        for ns in [0, 1, -1, 999_999_999, 1_000_000_000, -1_500_000_000, 1_700_000_000_123_456_789] {
            assert_eq!(to_ns(&to_time(ns)), ns);
        }
        assert_eq!(to_time(i64::MAX).sec, i32::MAX);
        assert_eq!(to_time(i64::MIN).sec, i32::MIN);
    }

    #[test]
    fn simulated_time_stands_until_set() {
        let clock = Clock::new(true);
        assert_eq!(clock.now_ns(), 0);
        clock.set(&Time { sec: 3, nanosec: 5 });
        assert_eq!(clock.clone().now_ns(), 3_000_000_005);
    }
}
