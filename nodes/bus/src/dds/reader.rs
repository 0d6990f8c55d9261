//! Subscribing to bytes over DDS.

use std::{collections::HashMap, sync::Arc};

use futures::StreamExt;
use ros2_client::dds::rustdds::{
    GUID,
    no_key::{DeserializedCacheChange, SimpleDataReader},
};
use smol::{Executor, Task, future::yield_now};

use crate::{
    clock,
    dds::{
        bytes::{BytesAdapter, RawCdr},
        discovery::{Gid, LocalEndpoint},
        mangle,
        participant::{Shared, refused},
        policies,
    },
    error::BusError,
    qos::QosProfile,
    transport::{Deliver, Guard, RawMessage},
};

/// Messages that one reader hands over before the others get their turn.
const TURN: u32 = 64;

/// A DDS reader of bytes.
pub(crate) type BytesReader = SimpleDataReader<RawCdr, BytesAdapter>;

/// Ends a reader when it is dropped.
pub(crate) struct ReaderGuard {
    shared: Arc<Shared>,
    gids: Vec<Gid>,
    _task: Task<()>,
}

impl ReaderGuard {
    /// Keeps a task and the endpoints that it serves.
    pub(crate) fn new(shared: &Arc<Shared>, gids: Vec<Gid>, task: Task<()>) -> ReaderGuard {
        ReaderGuard { shared: Arc::clone(shared), gids, _task: task }
    }
}

impl Drop for ReaderGuard {
    fn drop(&mut self) {
        for gid in &self.gids {
            self.shared.remove(*gid);
        }
    }
}

/// Makes a reader, tells the graph, and hands its messages to `deliver` on the readers' thread.
pub(crate) fn subscribe(
    shared: &Arc<Shared>,
    executor: &Executor<'static>,
    topic: &str,
    dds_type: &str,
    qos: &QosProfile,
    mut deliver: Deliver,
) -> Result<Guard, BusError> {
    let dds_name = mangle::topic(topic);
    let reader = make(shared, &dds_name, dds_type, qos)?;
    let gid = reader.guid().to_bytes();
    shared.add(gid, LocalEndpoint { topic: dds_name, type_name: dds_type.to_owned(), qos: qos.clone(), writes: false });
    let mut writers = WriterTypes::new(shared, dds_type);
    let topic = topic.to_owned();
    let task = executor.spawn(async move {
        let mut messages = std::pin::pin!(reader.as_async_stream());
        let mut unreadable: u64 = 0;
        let mut turn = 0;
        while let Some(message) = messages.next().await {
            match message {
                Ok(message) if writers.fits(message.writer_guid()) => deliver(to_raw(message)),
                Ok(_) => {}
                Err(error) => {
                    unreadable += 1;
                    if unreadable == 1 || unreadable.is_multiple_of(100) {
                        log::warn!("{topic}: message {unreadable} that DDS cannot read is left out: {error}");
                    }
                }
            }
            turn += 1;
            if turn >= TURN {
                turn = 0;
                yield_now().await;
            }
        }
    });
    Ok(Box::new(ReaderGuard::new(shared, vec![gid], task)))
}

/// Makes a reader.
pub(crate) fn make(shared: &Shared, dds_name: &str, dds_type: &str, qos: &QosProfile) -> Result<BytesReader, BusError> {
    let policies = policies::for_reader(qos);
    let topic = shared.topic(dds_name, dds_type, &policies)?;
    shared
        .subscriber
        .create_simple_datareader_no_key::<RawCdr, BytesAdapter>(&topic, Some(policies))
        .map_err(|error| refused(format!("subscribe to {dds_name}"))(&error))
}

/// A message with its times.
fn to_raw(message: DeserializedCacheChange<RawCdr>) -> RawMessage {
    RawMessage {
        received: policies::to_time(message.receive_instant).unwrap_or_else(|| clock::to_time(clock::system_ns())),
        source_timestamp: message.source_timestamp().and_then(policies::to_time),
        cdr: message.into_value().into_cdr(),
    }
}

/// Which writers have the reader's type. RustDDS matches endpoints of different types, and would deliver garbage.
struct WriterTypes {
    shared: Arc<Shared>,
    dds_type: String,
    known: HashMap<GUID, bool>,
}

impl WriterTypes {
    /// Nothing known yet.
    fn new(shared: &Arc<Shared>, dds_type: &str) -> WriterTypes {
        WriterTypes { shared: Arc::clone(shared), dds_type: dds_type.to_owned(), known: HashMap::new() }
    }

    /// Whether a writer has the reader's type; one that discovery does not know (this node itself) has.
    fn fits(&mut self, writer: GUID) -> bool {
        if let Some(fits) = self.known.get(&writer) {
            return *fits;
        }
        let fits = self.shared.writer_type(writer.to_bytes()).is_none_or(|other| other == self.dds_type);
        if self.known.len() > 1000 {
            self.known.clear();
        }
        self.known.insert(writer, fits);
        fits
    }
}
