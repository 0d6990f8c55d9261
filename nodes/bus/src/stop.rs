//! Asking a node to end, from wherever.

use std::sync::{
    Arc, Mutex, PoisonError,
    atomic::{AtomicBool, Ordering},
};

/// Called once when the node is asked to end.
type Waker = Box<dyn Fn() + Send + Sync>;

/// Asks one node to end; cheap to clone.
#[derive(Clone, Default)]
pub struct Stopper {
    inner: Arc<Inner>,
}

/// What the clones share.
#[derive(Default)]
struct Inner {
    stopped: AtomicBool,
    wakers: Mutex<Vec<Waker>>,
}

impl Stopper {
    /// Makes the node's `next` return `None`, at once and from then on.
    pub fn stop(&self) {
        self.inner.stopped.store(true, Ordering::SeqCst);
        let wakers = self.inner.wakers.lock().unwrap_or_else(PoisonError::into_inner);
        for waker in wakers.iter() {
            waker();
        }
    }

    /// Whether the node was asked to end.
    pub fn stopped(&self) -> bool {
        self.inner.stopped.load(Ordering::SeqCst)
    }

    /// Has `waker` called when the node is asked to end.
    pub(crate) fn on_stop(&self, waker: Waker) {
        self.inner.wakers.lock().unwrap_or_else(PoisonError::into_inner).push(waker);
    }

    /// Whether both ask the same node.
    pub(crate) fn same(&self, other: &Stopper) -> bool {
        Arc::ptr_eq(&self.inner, &other.inner)
    }
}

impl std::fmt::Debug for Stopper {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Stopper").field("stopped", &self.stopped()).finish_non_exhaustive()
    }
}
