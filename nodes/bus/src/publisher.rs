//! Publishers, of a known type and of any type.

use std::{
    marker::PhantomData,
    sync::{Arc, atomic::Ordering},
};

use apprentice_msgs::{Message, to_cdr};

use crate::{error::BusError, health::Counters, transport::Sink};

/// Publishes messages of one type on one topic. Clones are the same publisher.
///
/// A subscription that is not matched yet misses what is published with [`Qos::Event`](crate::Qos::Event) and
/// [`Qos::Stream`](crate::Qos::Stream); what must arrive is published again until it is acknowledged, or kept with
/// [`Qos::State`](crate::Qos::State) or [`Qos::Log`](crate::Qos::Log).
pub struct Publisher<M> {
    raw: RawPublisher,
    message: PhantomData<fn(&M)>,
}

impl<M> Clone for Publisher<M> {
    fn clone(&self) -> Self {
        Publisher { raw: self.raw.clone(), message: PhantomData }
    }
}

impl<M> std::fmt::Debug for Publisher<M> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_tuple("Publisher").field(&self.raw.topic).finish()
    }
}

impl<M: Message> Publisher<M> {
    /// Wraps a publisher of bytes.
    pub(crate) fn new(raw: RawPublisher) -> Publisher<M> {
        Publisher { raw, message: PhantomData }
    }

    /// Publishes one message.
    ///
    /// # Errors
    /// When DDS does not take it.
    pub fn publish(&self, message: &M) -> Result<(), BusError> {
        self.raw.send(to_cdr(message))
    }

    /// How many subscriptions are matched.
    pub fn subscriptions(&self) -> usize {
        self.raw.subscriptions()
    }

    /// The topic's absolute name.
    pub fn topic(&self) -> &str {
        self.raw.topic()
    }
}

/// Publishes CDR messages of any type on one topic. Clones are the same publisher.
#[derive(Clone)]
pub struct RawPublisher {
    sink: Arc<dyn Sink>,
    topic: Arc<str>,
    counters: Arc<Counters>,
}

impl std::fmt::Debug for RawPublisher {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_tuple("RawPublisher").field(&self.topic).finish()
    }
}

impl RawPublisher {
    /// Wraps the graph's end.
    pub(crate) fn new(sink: Arc<dyn Sink>, topic: &str, counters: Arc<Counters>) -> RawPublisher {
        RawPublisher { sink, topic: Arc::from(topic), counters }
    }

    /// Publishes one CDR message with its 4-byte header, as it was recorded.
    ///
    /// # Errors
    /// When the bytes are shorter than a header, or DDS does not take them.
    pub fn publish(&self, cdr: &[u8]) -> Result<(), BusError> {
        if cdr.len() < 4 {
            return Err(BusError::NoCdr { topic: self.topic.to_string(), got: cdr.len() });
        }
        self.send(cdr.to_vec())
    }

    /// Sends and counts.
    fn send(&self, cdr: Vec<u8>) -> Result<(), BusError> {
        self.sink.write(cdr)?;
        self.counters.published.fetch_add(1, Ordering::Relaxed);
        Ok(())
    }

    /// How many subscriptions are matched.
    pub fn subscriptions(&self) -> usize {
        self.sink.readers()
    }

    /// The topic's absolute name.
    pub fn topic(&self) -> &str {
        &self.topic
    }
}
