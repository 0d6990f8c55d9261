//! Serving requests over DDS (clients are in `client`), in the two ways in which ROS 2 middlewares do it.
//!
//! Enhanced (DDS-RPC 1.0, section 7.8.2): the request's identity travels in the inline QoS. Cyclone: sixteen bytes in
//! front of the data, the second half of the client's GUID and a sequence number, which the reply repeats.

use std::sync::Arc;

use futures::StreamExt;
use ros2_client::dds::rustdds::{
    RTPSEntity, SampleIdentity, SequenceNumber, Timestamp, WriteOptionsBuilder, no_key::DataWriter,
};
use smol::Executor;

use crate::{
    dds::{
        bytes::{BytesAdapter, CDR_LE, RawCdr},
        discovery::LocalEndpoint,
        environment::ServiceMapping,
        mangle,
        participant::{Shared, refused},
        policies, reader,
        reader::ReaderGuard,
    },
    error::BusError,
    qos::{Durability, QosProfile, Reliability},
    transport::{Answer, Guard, Handler, split_type},
};

/// Bytes in front of the data in the Cyclone mapping.
pub(super) const CYCLONE_HEADER: usize = 16;

/// Bytes of a CDR header.
const CDR_HEADER: usize = 4;

/// Offers a service; requests are handed over one after the other on the readers' thread.
pub(crate) fn serve(
    shared: &Arc<Shared>,
    executor: &Executor<'static>,
    name: &str,
    type_name: &str,
    mut handler: Handler,
) -> Result<Guard, BusError> {
    let names = Names::new(name, type_name)?;
    let qos = qos();
    let reader = reader::make(shared, &names.request_topic, &names.request_type, &qos)?;
    let policies = policies::for_writer(&qos);
    let topic = shared.topic(&names.reply_topic, &names.reply_type, &policies)?;
    let writer: DataWriter<RawCdr, BytesAdapter> = shared
        .publisher
        .create_datawriter_no_key(&topic, Some(policies))
        .map_err(|error| refused(format!("serve {name}"))(&error))?;
    let gids = vec![reader.guid().to_bytes(), writer.guid().to_bytes()];
    shared.add(gids[0], names.request_endpoint(false));
    shared.add(gids[1], names.reply_endpoint(true));
    let mapping = shared.mapping;
    let name: Arc<str> = Arc::from(name);
    let writer = Arc::new(writer);
    let task = executor.spawn(async move {
        let mut requests = std::pin::pin!(reader.as_async_stream());
        while let Some(request) = requests.next().await {
            let Ok(request) = request else { continue };
            let identity = identity(
                request.related_sample_identity(),
                SampleIdentity { writer_guid: request.writer_guid(), sequence_number: request.sequence_number },
            );
            let Some((header, request)) = unwrap(mapping, request.into_value().into_cdr()) else { continue };
            let (writer, name) = (Arc::clone(&writer), Arc::clone(&name));
            let answer: Answer = Box::new(move |reply| {
                let Some(reply) = wrap(&header, reply).and_then(RawCdr::to_send) else { return };
                let options = WriteOptionsBuilder::new()
                    .source_timestamp(Timestamp::now())
                    .related_sample_identity(identity)
                    .build();
                if let Err(error) = writer.write_with_options(reply, options) {
                    log::warn!("{name}: an answer could not be sent: {error}");
                }
            });
            handler(&request, answer);
        }
    });
    Ok(Box::new(ReaderGuard::new(shared, gids, task)))
}

/// The quality of service of both topics, that of ROS.
pub(super) fn qos() -> QosProfile {
    QosProfile::new(Reliability::Reliable, Durability::Volatile, 10)
}

/// The two topics of a service and their types on DDS.
pub(super) struct Names {
    pub request_topic: String,
    pub request_type: String,
    pub reply_topic: String,
    pub reply_type: String,
}

impl Names {
    /// Of a service of the type `pkg/srv/Name` or `pkg/action/Name_Half`.
    pub(super) fn new(name: &str, type_name: &str) -> Result<Self, BusError> {
        let (package, kind, service) = split_type(type_name, &["srv", "action"])?;
        let (request_topic, reply_topic) = mangle::service(name);
        Ok(Self {
            request_topic,
            request_type: format!("{package}::{kind}::dds_::{service}_Request_"),
            reply_topic,
            reply_type: format!("{package}::{kind}::dds_::{service}_Response_"),
        })
    }

    pub(super) fn request_endpoint(&self, writes: bool) -> LocalEndpoint {
        LocalEndpoint { topic: self.request_topic.clone(), type_name: self.request_type.clone(), qos: qos(), writes }
    }

    pub(super) fn reply_endpoint(&self, writes: bool) -> LocalEndpoint {
        LocalEndpoint { topic: self.reply_topic.clone(), type_name: self.reply_type.clone(), qos: qos(), writes }
    }
}

/// Which request a reply is for. Fast DDS leaves the sequence number of the inline QoS unknown, others leave the
/// inline QoS out; both mean the sample itself.
fn identity(inline: Option<SampleIdentity>, sample: SampleIdentity) -> SampleIdentity {
    match inline {
        None => sample,
        Some(inline) if inline.sequence_number == SequenceNumber::UNKNOWN => {
            SampleIdentity { writer_guid: inline.writer_guid, sequence_number: sample.sequence_number }
        }
        Some(inline) => inline,
    }
}

/// A message as it travels into what stands in front of the data and the CDR message itself, with its header; `None` when it
/// is malformed.
pub(super) fn unwrap(mapping: ServiceMapping, cdr: Vec<u8>) -> Option<(Vec<u8>, Vec<u8>)> {
    match mapping {
        ServiceMapping::Enhanced => Some((Vec::new(), cdr)),
        ServiceMapping::Cyclone => {
            let (header, rest) = cdr.split_at_checked(CDR_HEADER)?;
            if header[..2] != CDR_LE[..2] {
                return None;
            }
            let (cyclone, body) = rest.split_at_checked(CYCLONE_HEADER)?;
            Some((cyclone.to_vec(), [header, body].concat()))
        }
    }
}

/// The other way round.
pub(super) fn wrap(in_front: &[u8], cdr: Vec<u8>) -> Option<Vec<u8>> {
    if in_front.is_empty() {
        return Some(cdr);
    }
    Some([&CDR_LE[..], in_front, cdr.get(CDR_HEADER..)?].concat())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_cyclone_header_stands_between_the_header_and_the_data() {
        let identity: Vec<u8> = (100..116).collect();
        let request = [&[0, 1, 0, 0][..], &identity, &[7]].concat();
        let (in_front, message) = unwrap(ServiceMapping::Cyclone, request.clone()).expect("well formed");
        assert_eq!((in_front.as_slice(), message.as_slice()), (identity.as_slice(), &[0, 1, 0, 0, 7][..]));
        assert_eq!(wrap(&in_front, message), Some(request.clone()));
        assert_eq!(unwrap(ServiceMapping::Cyclone, request[..19].to_vec()), None);
        assert_eq!(unwrap(ServiceMapping::Cyclone, Vec::new()), None);
        assert_eq!(wrap(&identity, vec![0, 1]), None);
        assert_eq!(unwrap(ServiceMapping::Enhanced, vec![1, 2]), Some((Vec::new(), vec![1, 2])));
        assert_eq!(wrap(&[], vec![1, 2]), Some(vec![1, 2]));
    }
}
