//! Publishing bytes over DDS.

use std::{
    sync::{
        Arc,
        atomic::{AtomicU64, Ordering},
    },
    time::{Duration, Instant},
};

use ros2_client::dds::rustdds::{RTPSEntity, Timestamp, dds::WriteError, no_key};

use crate::{
    dds::{
        bytes::{BytesAdapter, RawCdr},
        discovery::{Gid, LocalEndpoint},
        mangle,
        participant::{Shared, refused},
        policies,
    },
    error::BusError,
    qos::QosProfile,
    transport::Sink,
};

/// One DDS writer.
pub(crate) struct DdsSink {
    shared: Arc<Shared>,
    writer: no_key::DataWriter<RawCdr, BytesAdapter>,
    gid: Gid,
    topic: String,
    given_up: AtomicU64,
}

impl DdsSink {
    /// Makes a writer and tells the graph.
    pub(crate) fn new(
        shared: &Arc<Shared>,
        topic: &str,
        dds_type: &str,
        qos: &QosProfile,
    ) -> Result<DdsSink, BusError> {
        let policies = policies::for_writer(qos);
        let dds_name = mangle::topic(topic);
        let dds_topic = shared.topic(&dds_name, dds_type, &policies)?;
        let writer = shared
            .publisher
            .create_datawriter_no_key::<RawCdr, BytesAdapter>(&dds_topic, Some(policies))
            .map_err(|error| refused(format!("publish on {topic}"))(&error))?;
        let gid = writer.guid().to_bytes();
        shared.add(
            gid,
            LocalEndpoint { topic: dds_name, type_name: dds_type.to_owned(), qos: qos.clone(), writes: true },
        );
        Ok(DdsSink { shared: Arc::clone(shared), writer, gid, topic: topic.to_owned(), given_up: AtomicU64::new(0) })
    }

    /// Waits until every reader has acknowledged everything, at most `limit`. Returns what is left of the limit.
    #[expect(clippy::disallowed_methods, reason = "a limit on waiting is in real time")]
    pub(crate) fn wait_for_acknowledgments(&self, limit: Duration) -> Duration {
        if limit.is_zero() || self.readers() == 0 {
            return limit;
        }
        let start = Instant::now();
        // Not acknowledged in time: the reader is gone or slow, and the node is about to end.
        let _ = self.writer.wait_for_acknowledgments(limit);
        limit.saturating_sub(start.elapsed())
    }
}

impl Sink for DdsSink {
    fn write(&self, cdr: Vec<u8>) -> Result<(), BusError> {
        let got = cdr.first().copied().zip(cdr.get(1).copied());
        let Some(message) = RawCdr::to_send(cdr) else {
            return Err(BusError::Encoding {
                topic: self.topic.clone(),
                got: got
                    .map_or_else(|| "no header".to_owned(), |(first, second)| format!("{first:#04x} {second:#04x}")),
            });
        };
        match self.writer.write(message, Some(Timestamp::now())) {
            Ok(()) => Ok(()),
            Err(WriteError::WouldBlock { .. }) => {
                // As with ROS's KEEP_LAST: a reader that hangs must not bring its publishers down.
                let given_up = self.given_up.fetch_add(1, Ordering::Relaxed) + 1;
                if given_up == 1 || given_up.is_multiple_of(1000) {
                    log::warn!(
                        "{}: a subscription does not keep up or has died; {given_up} messages were given up",
                        self.topic
                    );
                }
                Ok(())
            }
            Err(error) => Err(BusError::Publish { topic: self.topic.clone(), reason: error.to_string() }),
        }
    }

    fn readers(&self) -> usize {
        self.shared.view.matched(self.gid)
    }
}

impl Drop for DdsSink {
    fn drop(&mut self) {
        self.shared.remove(self.gid);
    }
}
