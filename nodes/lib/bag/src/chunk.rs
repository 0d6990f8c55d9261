//! A stretch of the data section that is read at once: a chunk, or some messages outside chunks.

use std::io::{Read, Seek};

use crate::bytes::Bytes;
use crate::compression::decompress;
use crate::record::{Channel, ChunkHeader, MessageRecord, PREFIX_BYTES, Schema, opcode};
use crate::scan::{Source, Span, malformed};
use crate::table::Table;
use crate::{BagError, Limits};

/// Where a segment lies, and the log times it says it holds.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Segment {
    /// For a chunk, its record; for loose messages, offset and length of all of them with their prefixes.
    pub(crate) span: Span,
    /// First log time, in ns.
    pub(crate) start: u64,
    /// Last log time, in ns.
    pub(crate) end: u64,
    loose: bool,
    /// Bytes once decompressed, as claimed.
    pub(crate) uncompressed_size: u64,
}

impl Segment {
    pub(crate) fn chunk(span: Span, header: &ChunkHeader) -> Segment {
        Segment {
            span,
            start: header.start,
            end: header.end,
            loose: false,
            uncompressed_size: header.uncompressed_size,
        }
    }

    pub(crate) fn loose(span: Span, log_time: u64) -> Segment {
        Segment { span, start: log_time, end: log_time, loose: true, uncompressed_size: span.length }
    }

    pub(crate) fn is_loose(&self) -> bool {
        self.loose
    }

    /// Reads the segment's records: decompressed, with the chunk's checksum checked.
    pub(crate) fn load<R: Read + Seek>(&self, source: &mut Source<R>, limits: &Limits) -> Result<Vec<u8>, BagError> {
        let offset = self.span.offset;
        if self.loose {
            source.seek(offset)?;
            return source.contents(opcode::MESSAGE, self.span, limits);
        }
        source.seek(offset + PREFIX_BYTES)?;
        let record = source.contents(opcode::CHUNK, self.span, limits)?;
        let mut bytes = Bytes::new(&record);
        let bad = |error| malformed(offset, opcode::CHUNK, &error);
        let header = ChunkHeader::parse(&mut bytes).map_err(bad)?;
        if header.uncompressed_size > limits.record_bytes {
            let limit = limits.record_bytes;
            return Err(BagError::TooLong { offset, opcode: opcode::CHUNK, bytes: header.uncompressed_size, limit });
        }
        let data = bytes.take(header.compressed_size, "chunk records").map_err(bad)?;
        let records = decompress(&header.compression, data, header.uncompressed_size, offset)?;
        let computed = crc32fast::hash(&records);
        if header.uncompressed_crc != 0 && header.uncompressed_crc != computed {
            return Err(BagError::Checksum { what: "chunk", offset, stored: header.uncompressed_crc, computed });
        }
        Ok(records)
    }

    /// Goes through the loaded `records`: new channels enter `table`, and `visit` gets every message with its position
    /// in `records`.
    ///
    /// # Errors
    /// When a record is cut or malformed.
    pub(crate) fn visit<'a>(
        &self,
        records: &'a [u8],
        table: &mut Table,
        mut visit: impl FnMut(&Table, usize, MessageRecord<'a>) -> Result<(), BagError>,
    ) -> Result<(), BagError> {
        let offset = self.span.offset;
        let mut bytes = Bytes::new(records);
        while !bytes.rest().is_empty() {
            let bad_record = |error| malformed(offset, opcode::CHUNK, &error);
            let at = records.len() - bytes.rest().len();
            let code = bytes.u8("opcode").map_err(bad_record)?;
            let length = bytes.u64("record length").map_err(bad_record)?;
            let contents = bytes.take(length, "record").map_err(bad_record)?;
            let bad = |error| malformed(offset, code, &error);
            match code {
                opcode::SCHEMA => table.add_schema(Schema::parse(contents).map_err(bad)?),
                opcode::CHANNEL => table.add_channel(Channel::parse(contents).map_err(bad)?),
                opcode::MESSAGE => visit(table, at, MessageRecord::parse(contents).map_err(bad)?)?,
                _ => {}
            }
        }
        Ok(())
    }

    /// The message whose record starts at `at` in the loaded `records`; `at` comes from [`Segment::visit`].
    pub(crate) fn message_at<'a>(&self, records: &'a [u8], at: usize) -> Result<MessageRecord<'a>, BagError> {
        let bad = |error| malformed(self.span.offset, opcode::MESSAGE, &error);
        let mut bytes = Bytes::new(records.get(at..).unwrap_or_default());
        bytes.u8("opcode").map_err(bad)?;
        let length = bytes.u64("record length").map_err(bad)?;
        MessageRecord::parse(bytes.take(length, "record").map_err(bad)?).map_err(bad)
    }
}
