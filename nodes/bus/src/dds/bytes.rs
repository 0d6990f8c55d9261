//! CDR messages as bytes, header and all, through RustDDS's typed readers and writers.

use std::convert::Infallible;

use ros2_client::dds::rustdds::{
    RepresentationIdentifier,
    bytes::Bytes,
    no_key::{Decode, DefaultDecoder, DeserializerAdapter, SerializerAdapter},
};

/// The header of the encoding in which we write: little-endian CDR, version 1.
pub(crate) const CDR_LE: [u8; 4] = [0, 1, 0, 0];

/// A message in CDR: what follows the header, and the header's first two bytes.
pub(crate) struct RawCdr {
    /// The encoding.
    encoding: [u8; 2],
    /// What follows the header.
    body: Bytes,
}

impl RawCdr {
    /// From a message with its header. Only little-endian CDR version 1 can be written.
    pub(crate) fn to_send(cdr: Vec<u8>) -> Option<RawCdr> {
        if cdr.len() < 4 || cdr[..2] != CDR_LE[..2] {
            return None;
        }
        Some(RawCdr { encoding: [cdr[0], cdr[1]], body: Bytes::from(cdr).slice(4..) })
    }

    /// The message with its header.
    pub(crate) fn into_cdr(self) -> Vec<u8> {
        let mut cdr = Vec::with_capacity(4 + self.body.len());
        cdr.extend_from_slice(&[self.encoding[0], self.encoding[1], 0, 0]);
        cdr.extend_from_slice(&self.body);
        cdr
    }
}

/// Every encoding that may arrive, with the bytes that stand for it.
const ENCODINGS: &[(RepresentationIdentifier, [u8; 2])] = &[
    (RepresentationIdentifier::CDR_LE, [0, 1]),
    (RepresentationIdentifier::CDR_BE, [0, 0]),
    (RepresentationIdentifier::PL_CDR_BE, [0, 2]),
    (RepresentationIdentifier::PL_CDR_LE, [0, 3]),
    (RepresentationIdentifier::XCDR2_BE, [0, 6]),
    (RepresentationIdentifier::XCDR2_LE, [0, 7]),
    (RepresentationIdentifier::D_CDR2_BE, [0, 8]),
    (RepresentationIdentifier::D_CDR2_LE, [0, 9]),
];

/// The same, as RustDDS wants it.
const SUPPORTED: &[RepresentationIdentifier] = &[
    RepresentationIdentifier::CDR_LE,
    RepresentationIdentifier::CDR_BE,
    RepresentationIdentifier::PL_CDR_BE,
    RepresentationIdentifier::PL_CDR_LE,
    RepresentationIdentifier::XCDR2_BE,
    RepresentationIdentifier::XCDR2_LE,
    RepresentationIdentifier::D_CDR2_BE,
    RepresentationIdentifier::D_CDR2_LE,
];

/// Hands bytes through.
pub(crate) struct BytesAdapter;

/// Copies bytes out of the reader's buffer.
#[derive(Clone)]
pub(crate) struct BytesDecoder;

impl DeserializerAdapter<RawCdr> for BytesAdapter {
    type Error = Infallible;
    type Decoded = RawCdr;

    fn supported_encodings() -> &'static [RepresentationIdentifier] {
        SUPPORTED
    }

    fn transform_decoded(decoded: RawCdr) -> RawCdr {
        decoded
    }
}

impl Decode<'_, RawCdr> for BytesDecoder {
    type Error = Infallible;

    fn decode_bytes(self, input_bytes: &[u8], encoding: RepresentationIdentifier) -> Result<RawCdr, Infallible> {
        let encoding = ENCODINGS.iter().find(|(known, _)| *known == encoding).map_or([0, 1], |(_, bytes)| *bytes);
        Ok(RawCdr { encoding, body: Bytes::copy_from_slice(input_bytes) })
    }
}

impl DefaultDecoder<RawCdr> for BytesAdapter {
    type Decoder = BytesDecoder;
    const DECODER: BytesDecoder = BytesDecoder;
}

impl SerializerAdapter<RawCdr> for BytesAdapter {
    type Error = Infallible;

    fn output_encoding() -> RepresentationIdentifier {
        RepresentationIdentifier::CDR_LE
    }

    fn to_bytes(value: &RawCdr) -> Result<Bytes, Infallible> {
        Ok(value.body.clone())
    }
}
