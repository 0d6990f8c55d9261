//! The MCAP records a reader needs, parsed from their bytes (<https://mcap.dev/spec>).

use std::collections::BTreeMap;

use crate::bytes::{Bytes, ParseError};
use crate::{Attachment, MetadataRecord};

/// Record opcodes.
pub(crate) mod opcode {
    pub(crate) use mcap::records::op::{
        ATTACHMENT, CHANNEL, CHUNK, DATA_END, FOOTER, HEADER, MESSAGE, METADATA, SCHEMA, STATISTICS,
    };
}

/// Opcode and length before every record.
pub(crate) const PREFIX_BYTES: u64 = 9;
/// Channel, sequence, log time and publish time before every message's bytes.
pub(crate) const MESSAGE_HEADER_BYTES: u64 = 22;
/// The fixed contents of a footer record.
pub(crate) const FOOTER_BYTES: u64 = 20;

#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Header {
    pub(crate) profile: String,
    pub(crate) library: String,
}

impl Header {
    pub(crate) fn parse(bytes: &[u8]) -> Result<Header, ParseError> {
        let mut bytes = Bytes::new(bytes);
        Ok(Header { profile: bytes.string("profile")?, library: bytes.string("library")? })
    }
}

#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Schema {
    pub(crate) id: u16,
    pub(crate) name: String,
    pub(crate) encoding: String,
    pub(crate) data: Vec<u8>,
}

impl Schema {
    pub(crate) fn parse(bytes: &[u8]) -> Result<Schema, ParseError> {
        let mut bytes = Bytes::new(bytes);
        let id = bytes.u16("schema number")?;
        let name = bytes.string("schema name")?;
        let encoding = bytes.string("schema encoding")?;
        let length = bytes.u32("schema length")?;
        let data = bytes.take(u64::from(length), "schema text")?.to_vec();
        if id == 0 {
            return Err(ParseError::Meaning(format!("schema {name} has number 0, which means no schema")));
        }
        Ok(Schema { id, name, encoding, data })
    }
}

#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Channel {
    pub(crate) id: u16,
    /// 0 for none.
    pub(crate) schema: u16,
    pub(crate) topic: String,
    pub(crate) message_encoding: String,
    pub(crate) metadata: BTreeMap<String, String>,
}

impl Channel {
    pub(crate) fn parse(bytes: &[u8]) -> Result<Channel, ParseError> {
        let mut bytes = Bytes::new(bytes);
        Ok(Channel {
            id: bytes.u16("channel number")?,
            schema: bytes.u16("schema number")?,
            topic: bytes.string("topic")?,
            message_encoding: bytes.string("message encoding")?,
            metadata: bytes.string_map("channel metadata")?,
        })
    }
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct MessageRecord<'a> {
    pub(crate) channel: u16,
    pub(crate) sequence: u32,
    pub(crate) log_time: u64,
    pub(crate) publish_time: u64,
    pub(crate) data: &'a [u8],
}

impl<'a> MessageRecord<'a> {
    pub(crate) fn parse(bytes: &'a [u8]) -> Result<MessageRecord<'a>, ParseError> {
        let mut bytes = Bytes::new(bytes);
        Ok(MessageRecord {
            channel: bytes.u16("channel number")?,
            sequence: bytes.u32("sequence")?,
            log_time: bytes.u64("log time")?,
            publish_time: bytes.u64("publish time")?,
            data: bytes.rest(),
        })
    }
}

#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct ChunkHeader {
    pub(crate) start: u64,
    pub(crate) end: u64,
    pub(crate) uncompressed_size: u64,
    pub(crate) uncompressed_crc: u32,
    pub(crate) compression: String,
    pub(crate) compressed_size: u64,
}

impl ChunkHeader {
    /// Longest header looked for: a compression name of more than 64 bytes is none that anybody writes.
    pub(crate) const MAX_BYTES: u64 = 8 + 8 + 8 + 4 + (4 + 64) + 8;

    /// Parses the header at the front of a chunk; `bytes` then holds what follows it.
    pub(crate) fn parse(bytes: &mut Bytes<'_>) -> Result<ChunkHeader, ParseError> {
        Ok(ChunkHeader {
            start: bytes.u64("chunk start time")?,
            end: bytes.u64("chunk end time")?,
            uncompressed_size: bytes.u64("uncompressed size")?,
            uncompressed_crc: bytes.u32("uncompressed checksum")?,
            compression: bytes.string("compression name")?,
            compressed_size: bytes.u64("compressed size")?,
        })
    }
}

#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Statistics {
    pub(crate) message_count: u64,
    pub(crate) start: u64,
    pub(crate) end: u64,
    pub(crate) channel_counts: BTreeMap<u16, u64>,
}

impl Statistics {
    pub(crate) fn parse(bytes: &[u8]) -> Result<Statistics, ParseError> {
        let mut bytes = Bytes::new(bytes);
        let message_count = bytes.u64("message count")?;
        bytes.u16("schema count")?;
        for what in ["channel count", "attachment count", "metadata count", "chunk count"] {
            bytes.u32(what)?;
        }
        let start = bytes.u64("start time")?;
        let end = bytes.u64("end time")?;
        let length = bytes.u32("message counts")?;
        let mut inside = Bytes::new(bytes.take(u64::from(length), "message counts")?);
        let mut channel_counts = BTreeMap::new();
        while !inside.rest().is_empty() {
            let channel = inside.u16("channel number")?;
            channel_counts.insert(channel, inside.u64("message count")?);
        }
        Ok(Statistics { message_count, start, end, channel_counts })
    }
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Footer {
    pub(crate) summary_start: u64,
    pub(crate) summary_crc: u32,
}

impl Footer {
    pub(crate) fn parse(bytes: &[u8]) -> Result<Footer, ParseError> {
        let mut bytes = Bytes::new(bytes);
        let summary_start = bytes.u64("summary start")?;
        bytes.u64("summary offset start")?;
        let summary_crc = bytes.u32("summary checksum")?;
        Ok(Footer { summary_start, summary_crc })
    }
}

impl MetadataRecord {
    pub(crate) fn parse(bytes: &[u8]) -> Result<MetadataRecord, ParseError> {
        let mut bytes = Bytes::new(bytes);
        Ok(MetadataRecord { name: bytes.string("metadata name")?, values: bytes.string_map("metadata values")? })
    }
}

/// An attachment with the checksums in the file (0 for none) and of its bytes.
pub(crate) struct AttachmentRecord {
    pub(crate) attachment: Attachment,
    pub(crate) stored_crc: u32,
    pub(crate) computed_crc: u32,
}

impl AttachmentRecord {
    pub(crate) fn parse(record: &[u8]) -> Result<AttachmentRecord, ParseError> {
        let mut bytes = Bytes::new(record);
        let log_time = bytes.u64("log time")?;
        let create_time = bytes.u64("create time")?;
        let name = bytes.string("attachment name")?;
        let media_type = bytes.string("media type")?;
        let length = bytes.u64("attachment length")?;
        let data = bytes.take(length, "attachment data")?.to_vec();
        let checked = record.len() - bytes.rest().len();
        Ok(AttachmentRecord {
            attachment: Attachment { log_time, create_time, name, media_type, data },
            stored_crc: bytes.u32("attachment checksum")?,
            computed_crc: crc32fast::hash(&record[..checked]),
        })
    }
}
