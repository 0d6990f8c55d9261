//! The one queue through which everything reaches a node.

use std::{
    collections::VecDeque,
    sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError},
    time::Duration,
};

use crate::stop::Stopper;

/// Most events that wait in a node on a DDS graph.
pub(crate) const CAPACITY: usize = 10_000;

/// What happens to an event that meets a full queue.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Overflow {
    /// Its sender waits.
    Block,
    /// The oldest event that may be lost makes room; if there is none, the new one is lost.
    DropOldest,
    /// The queue grows (in-memory graphs, where sender and receiver may share a thread).
    Grow,
}

/// The queue of one node.
pub(crate) struct Queue<E> {
    inner: Mutex<Inner<E>>,
    filled: Condvar,
    emptied: Condvar,
    capacity: usize,
    stopper: Stopper,
}

/// What the lock guards.
struct Inner<E> {
    items: VecDeque<Item<E>>,
    /// Bumped by [`Queue::wake`].
    wakes: u64,
}

/// One waiting event.
struct Item<E> {
    may_be_lost: bool,
    event: E,
}

/// What waiting for an event came to.
#[derive(Debug, PartialEq, Eq)]
pub(crate) enum Popped<E> {
    /// The oldest event.
    Event(E),
    /// Woken, or nothing came in time.
    Nothing,
    /// The node was asked to end.
    Stopped,
}

impl<E: Send + 'static> Queue<E> {
    /// An empty queue that lets go of everybody once `stopper` stops.
    pub(crate) fn new(capacity: usize, stopper: Stopper) -> Arc<Queue<E>> {
        let queue = Arc::new(Queue {
            inner: Mutex::new(Inner { items: VecDeque::new(), wakes: 0 }),
            filled: Condvar::new(),
            emptied: Condvar::new(),
            capacity,
            stopper: stopper.clone(),
        });
        let weak = Arc::downgrade(&queue);
        stopper.on_stop(Box::new(move || {
            if let Some(queue) = weak.upgrade() {
                queue.wake();
                queue.emptied.notify_all();
            }
        }));
        queue
    }

    /// Takes the lock; a panic elsewhere leaves the queue usable.
    fn lock(&self) -> MutexGuard<'_, Inner<E>> {
        self.inner.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Adds an event. Returns how many events were lost over it.
    pub(crate) fn push(&self, event: E, overflow: Overflow) -> usize {
        let mut inner = self.lock();
        let mut lost = 0;
        match overflow {
            Overflow::Grow => {}
            Overflow::Block => {
                while inner.items.len() >= self.capacity && !self.stopper.stopped() {
                    inner = self.emptied.wait(inner).unwrap_or_else(PoisonError::into_inner);
                }
            }
            Overflow::DropOldest => {
                if inner.items.len() >= self.capacity {
                    lost = 1;
                    match inner.items.iter().position(|item| item.may_be_lost) {
                        Some(oldest) => {
                            inner.items.remove(oldest);
                        }
                        None => return lost,
                    }
                }
            }
        }
        if self.stopper.stopped() {
            return lost;
        }
        inner.items.push_back(Item { may_be_lost: overflow == Overflow::DropOldest, event });
        self.filled.notify_one();
        lost
    }

    /// How often the queue was woken so far; to be taken before looking at what a wake-up is about.
    pub(crate) fn wakes(&self) -> u64 {
        self.lock().wakes
    }

    /// Takes the oldest event, waiting until there is one, or a wake-up after the first `wakes`, or `timeout` (for
    /// ever without one).
    pub(crate) fn pop(&self, wakes: u64, timeout: Option<Duration>) -> Popped<E> {
        let mut inner = self.lock();
        let quiet = |inner: &mut Inner<E>| inner.items.is_empty() && inner.wakes == wakes && !self.stopper.stopped();
        inner = match timeout {
            None => self.filled.wait_while(inner, quiet).unwrap_or_else(PoisonError::into_inner),
            Some(timeout) => {
                self.filled.wait_timeout_while(inner, timeout, quiet).unwrap_or_else(PoisonError::into_inner).0
            }
        };
        if self.stopper.stopped() {
            return Popped::Stopped;
        }
        match inner.items.pop_front() {
            Some(item) => {
                self.emptied.notify_one();
                Popped::Event(item.event)
            }
            None => Popped::Nothing,
        }
    }

    /// Lets a waiting `pop` return, so that timers are looked at again.
    pub(crate) fn wake(&self) {
        self.lock().wakes += 1;
        self.filled.notify_all();
    }

    /// How many events wait.
    pub(crate) fn len(&self) -> usize {
        self.lock().items.len()
    }
}

#[cfg(test)]
mod tests {
    use std::{thread, time::Duration};

    use super::*;

    #[test]
    fn a_full_queue_blocks_until_there_is_room_and_keeps_the_order() {
        let queue = Queue::new(4, Stopper::default());
        let sender = {
            let queue = Arc::clone(&queue);
            thread::spawn(move || {
                for event in 0..100 {
                    assert_eq!(queue.push(event, Overflow::Block), 0);
                }
            })
        };
        for wanted in 0..100 {
            assert_eq!(queue.pop(0, None), Popped::Event(wanted));
            assert!(queue.len() <= 4);
        }
        sender.join().expect("the sender ends");
    }

    #[test]
    fn only_events_that_may_be_lost_make_room() {
        let queue = Queue::new(3, Stopper::default());
        queue.push("reliable", Overflow::Block);
        queue.push("old", Overflow::DropOldest);
        queue.push("new", Overflow::DropOldest);
        assert_eq!(queue.push("newest", Overflow::DropOldest), 1);
        for wanted in ["reliable", "new", "newest"] {
            assert_eq!(queue.pop(0, None), Popped::Event(wanted));
        }
    }

    #[test]
    fn stopping_frees_both_sides() {
        let stopper = Stopper::default();
        let queue = Queue::new(1, stopper.clone());
        queue.push(1, Overflow::Block);
        let sender = {
            let queue = Arc::clone(&queue);
            thread::spawn(move || queue.push(2, Overflow::Block))
        };
        thread::sleep(Duration::from_millis(20));
        stopper.stop();
        sender.join().expect("the sender ends");
        assert_eq!(queue.pop(0, None), Popped::Stopped);
    }
}
