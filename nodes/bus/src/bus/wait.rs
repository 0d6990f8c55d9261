//! Waiting for what reaches a node: events in order, and timers.

use std::{
    sync::Arc,
    time::{Duration, Instant},
};

use apprentice_msgs::builtin_interfaces::Time;

use crate::{
    bus::Bus,
    queue::{Overflow, Popped, Queue},
};

/// What waiting with a limit came to.
#[derive(Debug, Clone, PartialEq)]
pub enum Next<E> {
    /// An event, and the time at which the node takes it.
    Event(Time, E),
    /// Nothing happened in time.
    Timeout,
    /// The node was asked to end.
    Shutdown,
}

/// A periodic event.
pub(super) struct Timer<E> {
    period_ns: i64,
    due_ns: i64,
    to_event: Box<dyn Fn() -> E + Send>,
}

impl<E: Send + 'static> Bus<E> {
    /// Makes an event each `period`, by the node's time; periods that were missed are skipped. The first comes
    /// after one period.
    pub fn every(&mut self, period: Duration, to_event: impl Fn() -> E + Send + 'static) {
        let period_ns = i64::try_from(period.as_nanos()).unwrap_or(i64::MAX).max(1);
        self.timers.push(Timer {
            period_ns,
            due_ns: self.clock.timer_ns().saturating_add(period_ns),
            to_event: Box::new(to_event),
        });
    }

    /// Waits for the next event; `None` once the node was asked to end.
    #[expect(
        clippy::should_implement_trait,
        reason = "a bus is no iterator: it can be waited on with a limit, and used in between"
    )]
    pub fn next(&mut self) -> Option<(Time, E)> {
        match self.wait(None) {
            Next::Event(time, event) => Some((time, event)),
            Next::Timeout | Next::Shutdown => None,
        }
    }

    /// Waits for the next event, at most `timeout` of real time.
    #[expect(clippy::disallowed_methods, reason = "a limit on waiting is in real time")]
    pub fn next_timeout(&mut self, timeout: Duration) -> Next<E> {
        self.wait(Instant::now().checked_add(timeout))
    }

    /// Waits for a timer or an event.
    #[expect(clippy::disallowed_methods, reason = "a limit on waiting is in real time")]
    fn wait(&mut self, until: Option<Instant>) -> Next<E> {
        if let Some(log) = &self.log {
            log.enter();
        }
        // Timers that are always due must not keep events away: after a timer, an event has its turn.
        if std::mem::take(&mut self.timer_was_last)
            && let Popped::Event(event) = self.queue.pop(0, Some(Duration::ZERO))
        {
            return Next::Event(self.now(), event);
        }
        loop {
            if self.stopper.stopped() {
                return Next::Shutdown;
            }
            let wakes = self.queue.wakes();
            let now_ns = self.clock.timer_ns();
            if let Some(event) = self.due_timer(now_ns) {
                self.timer_was_last = true;
                return Next::Event(self.now(), event);
            }
            let left = until.map(|until| until.saturating_duration_since(Instant::now()));
            let timer = self.until_timer(now_ns);
            let limit = match (left, timer) {
                (Some(left), Some(timer)) => Some(left.min(timer)),
                (left, timer) => left.or(timer),
            };
            match self.queue.pop(wakes, limit) {
                Popped::Event(event) => return Next::Event(self.now(), event),
                Popped::Stopped => return Next::Shutdown,
                Popped::Nothing => {
                    if until.is_some_and(|until| Instant::now() >= until) {
                        return Next::Timeout;
                    }
                }
            }
        }
    }

    /// The event of the timer that is longest due, if one is.
    fn due_timer(&mut self, now_ns: i64) -> Option<E> {
        let timer = self.timers.iter_mut().filter(|timer| timer.due_ns <= now_ns).min_by_key(|timer| timer.due_ns)?;
        let missed = (now_ns - timer.due_ns) / timer.period_ns;
        timer.due_ns = timer.due_ns.saturating_add(timer.period_ns.saturating_mul(missed.saturating_add(1)));
        Some((timer.to_event)())
    }

    /// How long until the next timer; `None` without timers, or in simulated time, where `/clock` wakes the node.
    fn until_timer(&self, now_ns: i64) -> Option<Duration> {
        if self.clock.is_simulated() {
            return None;
        }
        let due = self.timers.iter().map(|timer| timer.due_ns).min()?;
        Some(Duration::from_nanos(u64::try_from(due.saturating_sub(now_ns)).unwrap_or(0)))
    }
}

/// Puts events into a node's queue from other threads; waits while it is full.
pub struct EventSender<E> {
    pub(super) queue: Arc<Queue<E>>,
    pub(super) overflow: Overflow,
}

impl<E> Clone for EventSender<E> {
    fn clone(&self) -> Self {
        EventSender { queue: Arc::clone(&self.queue), overflow: self.overflow }
    }
}

impl<E: Send + 'static> EventSender<E> {
    /// Adds an event; without effect once the node was asked to end.
    pub fn send(&self, event: E) {
        self.queue.push(event, self.overflow);
    }
}

impl<E> std::fmt::Debug for EventSender<E> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("EventSender").finish_non_exhaustive()
    }
}
