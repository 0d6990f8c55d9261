//! What can be wrong with a bag, each with the byte offset where it is wrong.

use std::io;

/// Why a bag could not be read or written. Offsets count bytes from the start of the file.
#[derive(Debug, thiserror::Error)]
pub enum BagError {
    /// The file does not begin with MCAP's eight magic bytes.
    #[error("not an MCAP file: it starts with the bytes {got:02x?}, expected {expected:02x?}")]
    NotMcap {
        /// The first bytes of the file, at most eight.
        got: Vec<u8>,
        /// MCAP's magic.
        expected: &'static [u8],
    },
    /// A record claims more bytes than the file has left.
    #[error(
        "the file is cut short: the record at byte {offset} needs {needed} bytes, {available} are left; \
         `apprentice bag recover` keeps everything before it"
    )]
    Truncated {
        /// Where the cut record starts.
        offset: u64,
        /// Bytes the record claims, header included.
        needed: u64,
        /// Bytes there are.
        available: u64,
    },
    /// All records are whole, but the file was never finished (its writer was killed).
    #[error("the file was not finished: it ends at byte {offset} without a summary; `apprentice bag recover` adds one")]
    Unfinished {
        /// End of the last whole record.
        offset: u64,
    },
    /// A record or chunk is longer than the limit.
    #[error("the record at byte {offset} (opcode 0x{opcode:02x}) claims {bytes} bytes, the limit is {limit}")]
    TooLong {
        /// Where the record starts.
        offset: u64,
        /// MCAP opcode.
        opcode: u8,
        /// Bytes claimed.
        bytes: u64,
        /// [`crate::Limits::record_bytes`].
        limit: u64,
    },
    /// Chunks whose times overlap do not fit in memory together.
    #[error("the chunk at byte {offset} overlaps others that together need {bytes} bytes, the limit is {limit}")]
    TooMuchOverlap {
        /// Where the last of the chunks starts.
        offset: u64,
        /// Bytes needed.
        bytes: u64,
        /// [`crate::Limits::loaded_bytes`].
        limit: u64,
    },
    /// A record's contents make no sense.
    #[error("the record at byte {offset} (opcode 0x{opcode:02x}) is malformed: {why}")]
    Malformed {
        /// Where the record starts; for a record within a chunk, where the chunk starts.
        offset: u64,
        /// MCAP opcode.
        opcode: u8,
        /// What is wrong.
        why: String,
    },
    /// A checksum does not match.
    #[error("the {what} at byte {offset} is damaged: its checksum is {computed:08x}, expected {stored:08x}")]
    Checksum {
        /// "chunk", "attachment" or "summary".
        what: &'static str,
        /// Where it starts.
        offset: u64,
        /// Checksum in the file.
        stored: u32,
        /// Checksum of the bytes that are there.
        computed: u32,
    },
    /// A chunk is compressed in a way this crate does not know.
    #[error("the chunk at byte {offset} is compressed with '{name}', expected 'lz4', 'zstd' or none")]
    UnknownCompression {
        /// Where the chunk starts.
        offset: u64,
        /// The name in the file.
        name: String,
    },
    /// A chunk does not decompress to what its header says.
    #[error("the chunk at byte {offset} does not decompress: {why}")]
    Decompression {
        /// Where the chunk starts.
        offset: u64,
        /// What is wrong.
        why: String,
    },
    /// A message belongs to a channel that is not described.
    #[error("a message in the record at byte {offset} belongs to channel {channel}, which is not described before it")]
    UnknownChannel {
        /// Where the message, or the chunk that holds it, starts.
        offset: u64,
        /// The channel's number.
        channel: u16,
    },
    /// The statistics do not agree with the messages found.
    #[error("the summary counts {expected} messages, the file holds {got}")]
    CountMismatch {
        /// Messages read.
        got: u64,
        /// Messages by the statistics record.
        expected: u64,
    },
    /// A topic was added twice with different types, schemas or QoS.
    #[error("topic {name} is already in the bag with type {expected}, got another description with type {got}")]
    TopicConflict {
        /// The topic.
        name: String,
        /// Type of the second description.
        got: String,
        /// Type of the first description.
        expected: String,
    },
    /// MCAP numbers its channels and schemas with 16 bits.
    #[error("a bag holds at most {limit} topics")]
    TooManyTopics {
        /// How many it can hold.
        limit: usize,
    },
    /// A string, message or attachment is longer than the format can say.
    #[error("{what} is {bytes} bytes long, a bag can hold {limit}")]
    TooBigToWrite {
        /// What it is.
        what: String,
        /// Its length.
        bytes: u64,
        /// The longest possible.
        limit: u64,
    },
    /// Reading failed.
    #[error("reading at byte {offset} failed: {source}")]
    Read {
        /// Where.
        offset: u64,
        /// The system's reason.
        source: io::Error,
    },
    /// Writing failed.
    #[error("writing failed: {0}")]
    Write(#[source] io::Error),
    /// An earlier write failed, so that the file cannot be continued.
    #[error("the file cannot be continued because an earlier write failed")]
    WriterBroken,
}
