//! When a moment of the bag is due: rate, start offset, pause and rewinding, as a function of `now`.

/// Maps the bag's time to the time of a steady clock. All times in ns; the two clocks have different origins.
///
/// While it runs, `bag time = anchor.bag + (now - anchor.now) · rate`; while it is paused, the bag's time stands.
#[derive(Debug, Clone, PartialEq)]
pub struct Schedule {
    rate: f64,
    /// The bag's time at which every run through the bag starts.
    first: u64,
    bag: u64,
    now: u64,
    paused: bool,
}

impl Schedule {
    /// Starts at time `first` of the bag when the clock shows `starts_at`. `rate` is in bag seconds per clock second and
    /// must be positive.
    pub fn new(first: u64, starts_at: u64, rate: f64, paused: bool) -> Schedule {
        Schedule { rate, first, bag: first, now: starts_at, paused }
    }

    /// The time the bag has reached; before the start, the start.
    pub fn bag_time(&self, now: u64) -> u64 {
        if self.paused {
            return self.bag;
        }
        self.bag.saturating_add(scaled(now.saturating_sub(self.now), self.rate))
    }

    /// When the bag's time `log_time` is reached; `None` while it is paused.
    pub fn due(&self, log_time: u64) -> Option<u64> {
        let ahead = log_time.saturating_sub(self.bag);
        (!self.paused).then(|| self.now.saturating_add(scaled(ahead, 1.0 / self.rate)))
    }

    /// Whether `log_time` is reached at `now`.
    pub fn is_due(&self, log_time: u64, now: u64) -> bool {
        self.due(log_time).is_some_and(|due| due <= now)
    }

    /// Pauses or resumes at `now`.
    pub fn set_paused(&mut self, now: u64, paused: bool) {
        if paused && !self.paused {
            self.bag = self.bag_time(now);
        }
        if paused != self.paused {
            // Whoever resumes before the start still waits for the start.
            self.now = self.now.max(now);
        }
        self.paused = paused;
    }

    /// Whether it is paused.
    pub fn paused(&self) -> bool {
        self.paused
    }

    /// Starts over at `now`.
    pub fn rewind(&mut self, now: u64) {
        self.bag = self.first;
        self.now = now;
    }
}

/// `ns · factor`, rounded up, so that a wait until then is long enough.
fn scaled(ns: u64, factor: f64) -> u64 {
    // Exact at rate 1, where it matters that nothing is rounded; elsewhere 2⁵³ ns (104 days) stay exact to 1 ns.
    if factor == 1.0 { ns } else { (ns as f64 * factor).ceil() as u64 }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::{prop_assert, prop_assert_eq, proptest};

    const S: u64 = 1_000_000_000;

    #[test]
    fn at_double_rate_everything_is_due_in_half_the_time() {
        let schedule = Schedule::new(100 * S, 7 * S, 2.0, false);
        assert_eq!(schedule.due(100 * S), Some(7 * S));
        assert_eq!(schedule.due(110 * S), Some(12 * S));
        assert_eq!(schedule.bag_time(12 * S), 110 * S);
        assert_eq!(schedule.bag_time(0), 100 * S, "before the start the bag stands at its start");
    }

    #[test]
    fn a_pause_shifts_everything_after_it_by_its_length() {
        let mut schedule = Schedule::new(0, 0, 1.0, false);
        schedule.set_paused(3 * S, true);
        assert_eq!((schedule.due(4 * S), schedule.bag_time(50 * S)), (None, 3 * S));
        schedule.set_paused(5 * S, true);
        schedule.set_paused(10 * S, false);
        assert_eq!(schedule.due(4 * S), Some(11 * S));
        assert_eq!(schedule.bag_time(10 * S), 3 * S);
    }

    #[test]
    fn starting_paused_waits_for_the_first_resume_but_never_shortens_the_delay() {
        let mut schedule = Schedule::new(0, 2 * S, 1.0, true);
        assert_eq!(schedule.due(0), None);
        schedule.set_paused(S, false);
        assert_eq!(schedule.due(0), Some(2 * S));
        let mut late = Schedule::new(0, 2 * S, 1.0, true);
        late.set_paused(9 * S, false);
        assert_eq!(late.due(S), Some(10 * S));
    }

    #[test]
    fn rewinding_plays_the_same_times_again() {
        let mut schedule = Schedule::new(5 * S, 0, 1.0, false);
        schedule.rewind(20 * S);
        assert_eq!((schedule.due(5 * S), schedule.due(6 * S)), (Some(20 * S), Some(21 * S)));
    }

    proptest! {
        /// Whatever is paused and resumed when: a message is due exactly when the bag's time has reached it.
        #[test]
        fn due_and_bag_time_agree(
            rate in 0.01..100.0_f64,
            toggles in proptest::collection::vec(1..5_000_000_000_u64, 0..10),
            ahead in 0..10_000_000_000_u64,
        ) {
            let mut schedule = Schedule::new(1_000 * S, 0, rate, false);
            let mut now = 0;
            let mut paused = false;
            let mut reached = 0;
            for step in toggles {
                now += step;
                paused = !paused;
                schedule.set_paused(now, paused);
                prop_assert!(schedule.bag_time(now) >= reached, "the bag's time never runs back");
                reached = schedule.bag_time(now);
            }
            schedule.set_paused(now, false);
            let log_time = schedule.bag_time(now) + ahead;
            let due = schedule.due(log_time).expect("it runs");
            prop_assert!(schedule.bag_time(due) >= log_time);
            prop_assert!(schedule.is_due(log_time, due));
            prop_assert_eq!(due > now && schedule.is_due(log_time, due - 1), false);
        }
    }
}
