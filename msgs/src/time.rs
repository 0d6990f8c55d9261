//! Arithmetic of `builtin_interfaces/Time` and `Duration`.

use std::cmp::Ordering;

use crate::builtin_interfaces::{Duration, Time};

const NANOSECONDS: i128 = 1_000_000_000;

/// Seconds (rounded down) and the nanoseconds beyond them, held within what the message can carry.
fn split(nanoseconds: i128) -> (i32, u32) {
    let least = i128::from(i32::MIN) * NANOSECONDS;
    let greatest = i128::from(i32::MAX) * NANOSECONDS + (NANOSECONDS - 1);
    let nanoseconds = nanoseconds.clamp(least, greatest);
    let sec = i32::try_from(nanoseconds.div_euclid(NANOSECONDS)).expect("clamped above");
    let nanosec = u32::try_from(nanoseconds.rem_euclid(NANOSECONDS)).expect("below 10^9");
    (sec, nanosec)
}

fn join(sec: i32, nanosec: u32) -> i128 {
    i128::from(sec) * NANOSECONDS + i128::from(nanosec)
}

impl Time {
    /// The time `nanoseconds` after the epoch; held within 32-bit seconds.
    pub fn from_nanoseconds(nanoseconds: i128) -> Time {
        let (sec, nanosec) = split(nanoseconds);
        Time { sec, nanosec }
    }

    /// Nanoseconds since the epoch.
    pub fn nanoseconds(&self) -> i128 {
        join(self.sec, self.nanosec)
    }

    /// Nanoseconds since the epoch as logs count them; 0 before the epoch.
    pub fn nanoseconds_u64(&self) -> u64 {
        u64::try_from(self.nanoseconds().max(0)).expect("32-bit seconds fit into 64-bit nanoseconds")
    }

    /// Nanoseconds from `earlier` to this time; negative when `earlier` is later.
    pub fn nanoseconds_since(&self, earlier: &Time) -> i128 {
        self.nanoseconds() - earlier.nanoseconds()
    }

    /// Seconds since the epoch, to the precision of an `f64`.
    pub fn seconds(&self) -> f64 {
        f64::from(self.sec) + f64::from(self.nanosec) * 1e-9
    }

    /// True for the time 0, which stands for "no stamp".
    pub fn is_zero(&self) -> bool {
        self.nanoseconds() == 0
    }
}

impl Duration {
    /// A duration of `nanoseconds`; held within 32-bit seconds.
    pub fn from_nanoseconds(nanoseconds: i128) -> Duration {
        let (sec, nanosec) = split(nanoseconds);
        Duration { sec, nanosec }
    }

    /// Its length in nanoseconds.
    pub fn nanoseconds(&self) -> i128 {
        join(self.sec, self.nanosec)
    }

    /// Its length in seconds, to the precision of an `f64`.
    pub fn seconds(&self) -> f64 {
        f64::from(self.sec) + f64::from(self.nanosec) * 1e-9
    }

    /// A duration of `seconds`; NaN counts as 0, anything too long is held within 32-bit seconds.
    pub fn from_seconds(seconds: f64) -> Duration {
        // A float-to-integer `as` saturates, and takes NaN to 0.
        Duration::from_nanoseconds((seconds * 1e9).round() as i128)
    }
}

impl Ord for Time {
    fn cmp(&self, other: &Time) -> Ordering {
        (self.sec, self.nanosec).cmp(&(other.sec, other.nanosec))
    }
}

impl PartialOrd for Time {
    fn partial_cmp(&self, other: &Time) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Duration {
    fn cmp(&self, other: &Duration) -> Ordering {
        (self.sec, self.nanosec).cmp(&(other.sec, other.nanosec))
    }
}

impl PartialOrd for Duration {
    fn partial_cmp(&self, other: &Duration) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn a_time_before_the_epoch_rounds_its_seconds_down() {
        let time = Time::from_nanoseconds(-1);
        assert_eq!((time.sec, time.nanosec), (-1, 999_999_999));
        assert_eq!(time.nanoseconds_u64(), 0);
    }

    #[test]
    fn seconds_that_no_message_can_carry_are_held_at_the_ends() {
        assert_eq!(Duration::from_seconds(f64::INFINITY).sec, i32::MAX);
        assert_eq!(Duration::from_seconds(f64::NEG_INFINITY).sec, i32::MIN);
        assert_eq!(Duration::from_seconds(f64::NAN), Duration::default());
        assert_eq!(Duration::from_seconds(1.5).nanoseconds(), 1_500_000_000);
    }

    proptest! {
        #[test]
        fn nanoseconds_round_trip_and_keep_their_order(a: i64, b: i64) {
            let bound = i128::from(i32::MAX) * NANOSECONDS;
            let (a, b) = (i128::from(a) % bound, i128::from(b) % bound);
            let (time_a, time_b) = (Time::from_nanoseconds(a), Time::from_nanoseconds(b));
            prop_assert_eq!(time_a.nanoseconds(), a);
            prop_assert_eq!(time_a.cmp(&time_b), a.cmp(&b));
            prop_assert_eq!(time_a.nanoseconds_since(&time_b), a - b);
        }
    }
}
