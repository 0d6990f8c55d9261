//! A walk over the top-level records of a file, which skips the bytes of messages and chunks.

use std::io::{BufReader, Read, Seek, SeekFrom};

use crate::bytes::{Bytes, ParseError};
use crate::chunk::Segment;
use crate::record::{Channel, ChunkHeader, Header, MESSAGE_HEADER_BYTES, MessageRecord, PREFIX_BYTES, Schema, opcode};
use crate::table::Table;
use crate::{BagError, Limits, MetadataRecord};

/// Messages outside chunks are grouped into segments of about this many bytes.
const LOOSE_SEGMENT_BYTES: u64 = 1 << 20;

/// Where a record lies: offset of its opcode, and the length of its contents.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Span {
    pub(crate) offset: u64,
    pub(crate) length: u64,
}

/// How the data section ended.
#[derive(Debug)]
pub(crate) enum End {
    /// With a data-end record, after which the summary starts at this byte.
    Finished { summary: u64 },
    /// Too early, for this reason, at this byte.
    Cut { error: BagError, offset: u64 },
}

/// What a walk over the data section found.
#[derive(Debug)]
pub(crate) struct Scan {
    pub(crate) header: Header,
    pub(crate) segments: Vec<Segment>,
    pub(crate) attachments: Vec<Span>,
    pub(crate) metadata: Vec<MetadataRecord>,
    pub(crate) table: Table,
    pub(crate) end: End,
    /// Length of the file in bytes.
    pub(crate) file_bytes: u64,
}

/// A file with its length and a position that is always known.
pub(crate) struct Source<R> {
    input: BufReader<R>,
    pub(crate) position: u64,
    pub(crate) length: u64,
}

impl<R: Read + Seek> Source<R> {
    pub(crate) fn new(input: R) -> Result<Source<R>, BagError> {
        let mut input = BufReader::with_capacity(64 << 10, input);
        let length = input.seek(SeekFrom::End(0)).map_err(|source| BagError::Read { offset: 0, source })?;
        input.rewind().map_err(|source| BagError::Read { offset: 0, source })?;
        Ok(Source { input, position: 0, length })
    }

    pub(crate) fn seek(&mut self, to: u64) -> Result<(), BagError> {
        let offset = to;
        let failed = |source| BagError::Read { offset, source };
        match i64::try_from(i128::from(to) - i128::from(self.position)) {
            Ok(step) => self.input.seek_relative(step).map_err(failed)?,
            Err(_) => self.input.seek(SeekFrom::Start(to)).map(drop).map_err(failed)?,
        }
        self.position = to;
        Ok(())
    }

    /// Reads `n` bytes. Callers check `n` against the limit and the file's length first.
    pub(crate) fn read(&mut self, n: u64) -> Result<Vec<u8>, BagError> {
        let offset = self.position;
        let available = self.length.saturating_sub(offset);
        if n > available {
            return Err(BagError::Truncated { offset, needed: n, available });
        }
        let mut bytes = vec![0; usize::try_from(n).unwrap_or(usize::MAX)];
        self.input.read_exact(&mut bytes).map_err(|source| BagError::Read { offset, source })?;
        self.position += n;
        Ok(bytes)
    }

    /// Reads opcode and length of the record at the current position, and checks that it is whole.
    pub(crate) fn record(&mut self) -> Result<(u8, Span), BagError> {
        let offset = self.position;
        let available = self.length.saturating_sub(offset);
        if available < PREFIX_BYTES {
            return Err(BagError::Truncated { offset, needed: PREFIX_BYTES, available });
        }
        let prefix = self.read(PREFIX_BYTES)?;
        let mut prefix = Bytes::new(&prefix);
        let parsed = prefix.u8("opcode").and_then(|code| Ok((code, prefix.u64("length")?)));
        let (code, length) = parsed.map_err(|error| malformed(offset, 0, &error))?;
        if code == 0 {
            let why = "opcode 0 does not exist; was the disk full or the power lost?".to_owned();
            return Err(BagError::Malformed { offset, opcode: 0, why });
        }
        if length > available - PREFIX_BYTES {
            return Err(BagError::Truncated { offset, needed: length.saturating_add(PREFIX_BYTES), available });
        }
        Ok((code, Span { offset, length }))
    }

    /// Reads the contents of a record that [`Source::record`] just found.
    pub(crate) fn contents(&mut self, code: u8, span: Span, limits: &Limits) -> Result<Vec<u8>, BagError> {
        if span.length > limits.record_bytes {
            let limit = limits.record_bytes;
            return Err(BagError::TooLong { offset: span.offset, opcode: code, bytes: span.length, limit });
        }
        self.read(span.length)
    }
}

pub(crate) fn malformed(offset: u64, opcode: u8, error: &ParseError) -> BagError {
    BagError::Malformed { offset, opcode, why: error.to_string() }
}

/// Walks the data section. What cannot be read ends the walk and is told in [`Scan::end`].
///
/// # Errors
/// When the file is not MCAP at all, or cannot be read.
pub(crate) fn scan<R: Read + Seek>(source: &mut Source<R>, limits: &Limits) -> Result<Scan, BagError> {
    source.seek(0)?;
    let magic = source.read(source.length.min(mcap::MAGIC.len() as u64))?;
    if magic != mcap::MAGIC {
        return Err(BagError::NotMcap { got: magic, expected: mcap::MAGIC });
    }
    let mut scan = Scan {
        header: Header { profile: String::new(), library: String::new() },
        segments: Vec::new(),
        attachments: Vec::new(),
        metadata: Vec::new(),
        table: Table::default(),
        end: End::Finished { summary: 0 },
        file_bytes: source.length,
    };
    loop {
        let offset = source.position;
        if offset == source.length {
            scan.end = End::Cut { error: BagError::Unfinished { offset }, offset };
            return Ok(scan);
        }
        match step(source, limits, &mut scan) {
            Ok(true) => {}
            Ok(false) => {
                scan.end = End::Finished { summary: source.position };
                return Ok(scan);
            }
            Err(error @ BagError::Read { .. }) => return Err(error),
            Err(error) => {
                scan.end = End::Cut { error, offset };
                return Ok(scan);
            }
        }
    }
}

/// Takes one record; `false` at the end of the data section.
fn step<R: Read + Seek>(source: &mut Source<R>, limits: &Limits, scan: &mut Scan) -> Result<bool, BagError> {
    let (code, span) = source.record()?;
    let bad = |error: ParseError| malformed(span.offset, code, &error);
    match code {
        opcode::HEADER => scan.header = Header::parse(&source.contents(code, span, limits)?).map_err(bad)?,
        opcode::SCHEMA => {
            let schema = Schema::parse(&source.contents(code, span, limits)?).map_err(bad)?;
            scan.table.add_schema(schema);
        }
        opcode::CHANNEL => {
            let channel = Channel::parse(&source.contents(code, span, limits)?).map_err(bad)?;
            scan.table.add_channel(channel);
        }
        opcode::METADATA => {
            let record = MetadataRecord::parse(&source.contents(code, span, limits)?).map_err(bad)?;
            scan.metadata.push(record);
        }
        opcode::ATTACHMENT => scan.attachments.push(span),
        opcode::MESSAGE => {
            let header = source.read(span.length.min(MESSAGE_HEADER_BYTES))?;
            let log_time = MessageRecord::parse(&header).map_err(bad)?.log_time;
            add_loose_message(&mut scan.segments, span, log_time);
        }
        opcode::CHUNK => {
            let front = source.read(span.length.min(ChunkHeader::MAX_BYTES))?;
            let header = ChunkHeader::parse(&mut Bytes::new(&front)).map_err(bad)?;
            scan.segments.push(Segment::chunk(span, &header));
        }
        opcode::DATA_END => {
            source.seek(span.offset + PREFIX_BYTES + span.length)?;
            return Ok(false);
        }
        opcode::FOOTER => {
            let why = "a footer before the end of the data section".to_owned();
            return Err(BagError::Malformed { offset: span.offset, opcode: code, why });
        }
        _ => {}
    }
    source.seek(span.offset + PREFIX_BYTES + span.length)?;
    Ok(true)
}

/// Appends a message outside chunks to the last segment, or starts one.
fn add_loose_message(segments: &mut Vec<Segment>, span: Span, log_time: u64) {
    let whole = PREFIX_BYTES + span.length;
    if let Some(last) = segments.last_mut()
        && last.is_loose()
        && last.span.offset + last.span.length == span.offset
        && last.span.length + whole <= LOOSE_SEGMENT_BYTES
    {
        last.span.length += whole;
        last.start = last.start.min(log_time);
        last.end = last.end.max(log_time);
        return;
    }
    segments.push(Segment::loose(Span { offset: span.offset, length: whole }, log_time));
}
