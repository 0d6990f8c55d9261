//! Serving requests over DDS, in the two ways in which ROS 2 middlewares do it.
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
    transport::{Guard, Handler, split_type},
};

/// Bytes in front of the data in the Cyclone mapping.
const CYCLONE_HEADER: usize = 16;

/// Bytes of a CDR header.
const CDR_HEADER: usize = 4;

/// Offers a service; requests are answered one after the other on the readers' thread.
pub(crate) fn serve(
    shared: &Arc<Shared>,
    executor: &Executor<'static>,
    name: &str,
    type_name: &str,
    mut handler: Handler,
) -> Result<Guard, BusError> {
    let (package, _, service) = split_type(type_name, &["srv"])?;
    let qos = QosProfile::new(Reliability::Reliable, Durability::Volatile, 10);
    let (request_topic, reply_topic) = mangle::service(name);
    let request_type = format!("{package}::srv::dds_::{service}_Request_");
    let reply_type = format!("{package}::srv::dds_::{service}_Response_");
    let reader = reader::make(shared, &request_topic, &request_type, &qos)?;
    let policies = policies::for_writer(&qos);
    let topic = shared.topic(&reply_topic, &reply_type, &policies)?;
    let writer: DataWriter<RawCdr, BytesAdapter> = shared
        .publisher
        .create_datawriter_no_key(&topic, Some(policies))
        .map_err(|error| refused(format!("serve {name}"))(&error))?;
    let gids = vec![reader.guid().to_bytes(), writer.guid().to_bytes()];
    let endpoint = |topic, type_name, writes| LocalEndpoint { topic, type_name, qos: qos.clone(), writes };
    shared.add(gids[0], endpoint(request_topic, request_type, false));
    shared.add(gids[1], endpoint(reply_topic, reply_type, true));
    let mapping = shared.mapping;
    let name = name.to_owned();
    let task = executor.spawn(async move {
        let mut requests = std::pin::pin!(reader.as_async_stream());
        while let Some(request) = requests.next().await {
            let Ok(request) = request else { continue };
            let identity = identity(
                request.related_sample_identity(),
                SampleIdentity { writer_guid: request.writer_guid(), sequence_number: request.sequence_number },
            );
            let Some(reply) = answer(mapping, &request.into_value().into_cdr(), &mut handler).and_then(RawCdr::to_send)
            else {
                continue;
            };
            let options =
                WriteOptionsBuilder::new().source_timestamp(Timestamp::now()).related_sample_identity(identity).build();
            if let Err(error) = writer.write_with_options(reply, options) {
                log::warn!("{name}: an answer could not be sent: {error}");
            }
        }
    });
    Ok(Box::new(ReaderGuard::new(shared, gids, task)))
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

/// The reply to a request, both as CDR messages with their headers; `None` when the request is malformed.
fn answer(mapping: ServiceMapping, request: &[u8], handler: &mut Handler) -> Option<Vec<u8>> {
    match mapping {
        ServiceMapping::Enhanced => handler(request),
        ServiceMapping::Cyclone => {
            let (header, rest) = request.split_at_checked(CDR_HEADER)?;
            if header[..2] != CDR_LE[..2] {
                return None;
            }
            let (cyclone, body) = rest.split_at_checked(CYCLONE_HEADER)?;
            let reply = handler(&[header, body].concat())?;
            let body = reply.get(CDR_HEADER..)?;
            Some([&CDR_LE[..], cyclone, body].concat())
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_cyclone_header_is_repeated_in_the_reply() {
        let mut handler: Handler = Box::new(|request| {
            assert_eq!(request, [0, 1, 0, 0, 7]);
            Some(vec![0, 1, 0, 0, 8, 9])
        });
        let identity: Vec<u8> = (100..116).collect();
        let request = [&[0, 1, 0, 0][..], &identity, &[7]].concat();
        let reply = answer(ServiceMapping::Cyclone, &request, &mut handler);
        assert_eq!(reply, Some([&[0, 1, 0, 0][..], &identity, &[8, 9]].concat()));
        assert_eq!(answer(ServiceMapping::Cyclone, &request[..19], &mut handler), None);
        assert_eq!(answer(ServiceMapping::Cyclone, &[], &mut handler), None);
    }
}
