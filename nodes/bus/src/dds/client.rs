//! Sending requests over DDS; see `service` for the two ways in which they travel.

use std::{
    collections::BTreeMap,
    sync::{Arc, Mutex, PoisonError},
};

use futures::StreamExt;
use ros2_client::dds::rustdds::{GUID, RTPSEntity, SampleIdentity, Timestamp, WriteOptionsBuilder, no_key::DataWriter};
use smol::Executor;

use crate::{
    dds::{
        bytes::{BytesAdapter, RawCdr},
        discovery::Gid,
        environment::ServiceMapping,
        participant::{Shared, refused},
        policies, reader,
        reader::ReaderGuard,
        service::{self, CYCLONE_HEADER, Names},
    },
    error::BusError,
    transport::{Answered, Caller},
};

/// Requests without an answer that are remembered; the oldest are given up.
const MOST_OPEN: usize = 1000;

/// One client.
pub(crate) struct DdsCaller {
    shared: Arc<Shared>,
    writer: DataWriter<RawCdr, BytesAdapter>,
    name: String,
    open: Arc<Mutex<Open>>,
    request_gid: Gid,
    reply_gid: Gid,
    _guard: ReaderGuard,
}

/// Requests that wait for an answer: the number that the caller gave each, by the number that it travels under.
#[derive(Default)]
struct Open {
    numbers: BTreeMap<i64, u64>,
    next: i64,
}

impl DdsCaller {
    /// Makes a client; answers to its own requests go to `answered`, those to others are left out.
    pub(crate) fn new(
        shared: &Arc<Shared>,
        executor: &Executor<'static>,
        name: &str,
        type_name: &str,
        mut answered: Answered,
    ) -> Result<DdsCaller, BusError> {
        let names = Names::new(name, type_name)?;
        let qos = service::qos();
        let reader = reader::make(shared, &names.reply_topic, &names.reply_type, &qos)?;
        let policies = policies::for_writer(&qos);
        let topic = shared.topic(&names.request_topic, &names.request_type, &policies)?;
        let writer: DataWriter<RawCdr, BytesAdapter> = shared
            .publisher
            .create_datawriter_no_key(&topic, Some(policies))
            .map_err(|error| refused(format!("call {name}"))(&error))?;
        let guid = writer.guid();
        let (request_gid, reply_gid) = (guid.to_bytes(), reader.guid().to_bytes());
        shared.add(request_gid, names.request_endpoint(true));
        shared.add(reply_gid, names.reply_endpoint(false));
        let open = Arc::new(Mutex::new(Open::default()));
        let (mapping, waiting) = (shared.mapping, Arc::clone(&open));
        let task = executor.spawn(async move {
            let mut replies = std::pin::pin!(reader.as_async_stream());
            while let Some(reply) = replies.next().await {
                let Ok(reply) = reply else { continue };
                let inline = reply.related_sample_identity();
                let Some((in_front, cdr)) = service::unwrap(mapping, reply.into_value().into_cdr()) else { continue };
                let sequence = match mapping {
                    ServiceMapping::Enhanced => of_inline(inline, guid),
                    ServiceMapping::Cyclone => of_header(&in_front, guid),
                };
                let number = sequence.and_then(|sequence| {
                    waiting.lock().unwrap_or_else(PoisonError::into_inner).numbers.remove(&sequence)
                });
                if let Some(number) = number {
                    answered(number, &cdr);
                }
            }
        });
        let _guard = ReaderGuard::new(shared, vec![request_gid, reply_gid], task);
        Ok(DdsCaller {
            shared: Arc::clone(shared),
            writer,
            name: name.to_owned(),
            open,
            request_gid,
            reply_gid,
            _guard,
        })
    }
}

impl Caller for DdsCaller {
    fn call(&self, number: u64, cdr: Vec<u8>) -> Result<(), BusError> {
        let failed = |reason: String| BusError::Publish { topic: self.name.clone(), reason };
        // Held while writing, so that no answer comes before the request is known.
        let mut open = self.open.lock().unwrap_or_else(PoisonError::into_inner);
        open.next += 1;
        let in_front = match self.shared.mapping {
            ServiceMapping::Enhanced => Vec::new(),
            ServiceMapping::Cyclone => header(self.writer.guid(), open.next),
        };
        let request = service::wrap(&in_front, cdr)
            .and_then(RawCdr::to_send)
            .ok_or_else(|| failed("the request is no little-endian CDR message".to_owned()))?;
        let options = WriteOptionsBuilder::new().source_timestamp(Timestamp::now()).build();
        let sent = self.writer.write_with_options(request, options).map_err(|error| failed(error.to_string()))?;
        let sequence = match self.shared.mapping {
            ServiceMapping::Enhanced => i64::from(sent.sequence_number),
            ServiceMapping::Cyclone => open.next,
        };
        open.numbers.insert(sequence, number);
        while open.numbers.len() > MOST_OPEN {
            open.numbers.pop_first();
        }
        Ok(())
    }

    fn servers(&self) -> usize {
        // A server whose reply could not come back is none.
        self.shared.view.matched(self.request_gid).min(self.shared.view.matched(self.reply_gid))
    }
}

/// Enhanced: the reply names the request in its inline QoS.
fn of_inline(inline: Option<SampleIdentity>, own: GUID) -> Option<i64> {
    inline.filter(|inline| inline.writer_guid == own).map(|inline| i64::from(inline.sequence_number))
}

/// Cyclone: the reply repeats what stood in front of the request.
fn of_header(in_front: &[u8], own: GUID) -> Option<i64> {
    let (guid, sequence) = in_front.split_at_checked(CYCLONE_HEADER / 2)?;
    (guid == &own.to_bytes()[8..]).then(|| sequence.try_into().ok().map(i64::from_le_bytes))?
}

/// The second half of the client's GUID, and the number of the request.
fn header(own: GUID, sequence: i64) -> Vec<u8> {
    [&own.to_bytes()[8..], &sequence.to_le_bytes()].concat()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn replies_to_others_are_left_out() {
        let own = GUID::new_participant_guid();
        let other = GUID::from_bytes([7; 16]);
        assert_eq!(of_header(&header(own, 42), own), Some(42));
        assert_eq!(of_header(&header(other, 42), own), None);
        assert_eq!(of_header(&[], own), None);
        assert_eq!(of_inline(None, own), None);
        let inline = |writer_guid| SampleIdentity { writer_guid, sequence_number: 9.into() };
        assert_eq!(of_inline(Some(inline(own)), own), Some(9));
        assert_eq!(of_inline(Some(inline(other)), own), None);
    }
}
