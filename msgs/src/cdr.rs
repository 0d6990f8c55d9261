//! Messages to bytes and back: XCDR version 1, as every ROS 2 middleware speaks it.

use byteorder::{BigEndian, LittleEndian};
use thiserror::Error;

use crate::Message;

/// Bytes of the encapsulation header: two of representation, two of options.
const HEADER_BYTES: usize = 4;
const CDR_BE: [u8; 2] = [0, 0];
const CDR_LE: [u8; 2] = [0, 1];
/// Bytes that may follow a message: writers pad to a multiple of 4, some to 8.
const MAX_PADDING: usize = 7;

/// Why bytes are not a message.
#[derive(Debug, Error)]
pub enum CdrError {
    /// Shorter than the encapsulation header.
    #[error("{type_name}: got {got} bytes, expected at least the {HEADER_BYTES} of a CDR header")]
    NoHeader {
        /// The expected message.
        type_name: &'static str,
        /// Bytes received.
        got: usize,
    },
    /// Not plain XCDR1: parameter lists and XCDR2 are not what ROS 2 sends.
    #[error("{type_name}: got CDR representation {got:#06x}, expected 0x0000 (CDR_BE) or 0x0001 (CDR_LE)")]
    Representation {
        /// The expected message.
        type_name: &'static str,
        /// First two bytes of the header, as a number.
        got: u16,
    },
    /// The bytes end early, or hold what the type cannot.
    #[error("{type_name}: {got} bytes do not hold the message: {problem}")]
    Malformed {
        /// The expected message.
        type_name: &'static str,
        /// Bytes received, header counted.
        got: usize,
        /// What the decoder met.
        problem: String,
    },
    /// More bytes than the message has: probably a message of another type.
    #[error("{type_name}: got {got} bytes after the message, expected at most {MAX_PADDING} of padding")]
    Trailing {
        /// The expected message.
        type_name: &'static str,
        /// Bytes left over.
        got: usize,
    },
}

/// `message` in little-endian CDR, after its 4-byte header.
///
/// Lengths that the interface bounds are not checked here, only when a message is read.
pub fn to_cdr<M: Message>(message: &M) -> Vec<u8> {
    let mut bytes = Vec::with_capacity(256);
    bytes.extend(CDR_LE);
    bytes.extend([0, 0]);
    cdr_encoding::to_writer::<M, LittleEndian, _>(&mut bytes, message)
        .expect("generated types have only members that CDR can hold, and a Vec takes every byte");
    bytes
}

/// The message that `bytes`, with their 4-byte header, hold.
///
/// Never panics. Takes memory in proportion to `bytes`, whatever lengths they declare.
pub fn from_cdr<M: Message>(bytes: &[u8]) -> Result<M, CdrError> {
    let type_name = M::TYPE;
    let Some((header, body)) = bytes.split_at_checked(HEADER_BYTES) else {
        return Err(CdrError::NoHeader { type_name, got: bytes.len() });
    };
    let representation = [header[0], header[1]];
    let decoded = match representation {
        CDR_LE => cdr_encoding::from_bytes::<M, LittleEndian>(body),
        CDR_BE => cdr_encoding::from_bytes::<M, BigEndian>(body),
        _ => {
            return Err(CdrError::Representation { type_name, got: u16::from_be_bytes(representation) });
        }
    };
    let (message, consumed) =
        decoded.map_err(|error| CdrError::Malformed { type_name, got: bytes.len(), problem: error.to_string() })?;
    let left = body.len().saturating_sub(consumed);
    if left > MAX_PADDING {
        return Err(CdrError::Trailing { type_name, got: left });
    }
    Ok(message)
}
