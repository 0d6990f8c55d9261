//! The open pages, and the way of texts to them.

use crate::event::Told;
use axum::extract::ws::Utf8Bytes;
use std::collections::BTreeMap;
use std::sync::{Arc, Mutex, MutexGuard};
use tokio::sync::mpsc::{Receiver, Sender, channel};

/// A page that lags behind by more texts is cut off; it connects again and gets the state as it is then.
const BACKLOG: usize = 64;

/// Names one connection.
pub type PageId = u64;

/// The open pages. Clones are the same hub.
#[derive(Debug, Clone)]
pub struct Hub {
    max_pages: usize,
    pages: Arc<Mutex<Pages>>,
}

#[derive(Debug, Default)]
struct Pages {
    next: PageId,
    open: BTreeMap<PageId, Sender<Utf8Bytes>>,
}

impl Hub {
    /// A hub for at most so many pages at once.
    pub fn new(max_pages: usize) -> Self {
        Self { max_pages, pages: Arc::default() }
    }

    fn pages(&self) -> MutexGuard<'_, Pages> {
        // Nothing in here can panic half-way, so a poisoned lock guards sound data.
        self.pages.lock().unwrap_or_else(std::sync::PoisonError::into_inner)
    }

    /// Takes a page in; `None` when there are enough.
    pub(crate) fn join(&self) -> Option<(PageId, Receiver<Utf8Bytes>)> {
        let mut pages = self.pages();
        if pages.open.len() >= self.max_pages {
            return None;
        }
        let (sender, receiver) = channel(BACKLOG);
        let id = pages.next;
        pages.next += 1;
        pages.open.insert(id, sender);
        Some((id, receiver))
    }

    /// Lets a page go.
    pub(crate) fn leave(&self, id: PageId) {
        self.pages().open.remove(&id);
    }

    /// How many pages are open.
    pub fn len(&self) -> usize {
        self.pages().open.len()
    }

    /// Whether no page is open.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Sends a text on its way; never waits.
    pub fn tell(&self, told: Told) {
        let text = Utf8Bytes::from(told.text);
        let mut pages = self.pages();
        match told.to {
            Some(id) => {
                if pages.open.get(&id).is_some_and(|page| page.try_send(text).is_err()) {
                    pages.open.remove(&id);
                }
            }
            None => pages.open.retain(|_, page| page.try_send(text.clone()).is_ok()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{BACKLOG, Hub};
    use crate::event::Told;

    #[test]
    fn a_page_that_does_not_read_is_cut_off_and_the_others_are_not_held_up() {
        let hub = Hub::new(2);
        let (_, mut lazy) = hub.join().expect("there is room");
        let (_, mut keen) = hub.join().expect("there is room");
        assert!(hub.join().is_none());
        for i in 0..=BACKLOG {
            hub.tell(Told { to: None, text: i.to_string() });
            assert_eq!(keen.try_recv().expect("it was told").as_str(), i.to_string());
        }
        assert_eq!(hub.len(), 1);
        let read = std::iter::from_fn(|| lazy.try_recv().ok()).count();
        assert_eq!(read, BACKLOG);
        assert!(lazy.is_closed());
    }
}
