//! Writing a bag file that rosbag2, Foxglove and the MCAP tools open.

use std::collections::BTreeMap;
use std::io::{self, Write};
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};

use mcap::records::MessageHeader;
use mcap::write::NoSeek;
use mcap::{McapError, WriteOptions, Writer};

use crate::{Attachment, BagError, Compression, Contents, MetadataRecord, Topic};

/// Longest string, message or schema: lengths in MCAP are 32-bit.
const MAX_FIELD_BYTES: u64 = u32::MAX as u64 - 64;

/// How a new bag is written.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct WriterOptions {
    /// Compression of the chunks.
    pub compression: Compression,
    /// A chunk is closed once it holds this many bytes.
    pub chunk_bytes: u64,
    /// Who writes, for the file's header.
    pub library: String,
}

impl Default for WriterOptions {
    /// Uncompressed chunks of 1 MiB.
    fn default() -> WriterOptions {
        WriterOptions {
            compression: Compression::None,
            chunk_bytes: 1 << 20,
            library: concat!("apprentice/", env!("CARGO_PKG_VERSION")).to_owned(),
        }
    }
}

/// Names a topic of one [`BagWriter`].
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct TopicId(u16);

struct Written {
    topic: Arc<Topic>,
    messages: u64,
}

/// Writes one bag file to `W`, append only: what is flushed stays readable however the process ends.
///
/// Chunks are gathered in memory and written whole, so that a file which was cut short ends within one record.
pub struct BagWriter<W: Write> {
    writer: Writer<NoSeek<Counting<W>>>,
    topics: BTreeMap<TopicId, Written>,
    ids: BTreeMap<String, TopicId>,
    contents: Contents,
    /// Bytes of messages since the last flush, which are in memory only.
    pending_bytes: u64,
    written_bytes: Arc<AtomicU64>,
    broken: bool,
}

impl<W: Write> BagWriter<W> {
    /// Starts a file: writes magic and header.
    ///
    /// # Errors
    /// When `output` cannot be written.
    pub fn new(output: W, options: &WriterOptions) -> Result<BagWriter<W>, BagError> {
        let written_bytes = Arc::new(AtomicU64::new(0));
        let output = Counting { output, bytes: Arc::clone(&written_bytes) };
        let writer = WriteOptions::new()
            .profile("ros2")
            .library(options.library.as_str())
            .compression(match options.compression {
                Compression::None => None,
                Compression::Lz4 => Some(mcap::Compression::Lz4),
            })
            .chunk_size(Some(options.chunk_bytes))
            .disable_seeking(true)
            .create(NoSeek::new(output))
            .map_err(write_error)?;
        Ok(BagWriter {
            writer,
            topics: BTreeMap::new(),
            ids: BTreeMap::new(),
            contents: Contents { profile: "ros2".to_owned(), library: options.library.clone(), ..Contents::default() },
            pending_bytes: 0,
            written_bytes,
            broken: false,
        })
    }

    /// Adds a topic, or finds it again when the same description was added before.
    ///
    /// # Errors
    /// When the topic is there with another description, when there are too many, or when writing fails.
    pub fn add_topic(&mut self, topic: &Topic) -> Result<TopicId, BagError> {
        if let Some(id) = self.ids.get(&topic.name) {
            let known = &self.topics[id].topic;
            if **known == *topic {
                return Ok(*id);
            }
            return Err(BagError::TopicConflict {
                name: topic.name.clone(),
                got: topic.type_name.clone(),
                expected: known.type_name.clone(),
            });
        }
        let metadata_bytes: usize = topic.metadata.iter().map(|(key, value)| key.len() + value.len() + 8).sum();
        let longest = topic.name.len().max(topic.type_name.len()).max(topic.schema.len()).max(metadata_bytes);
        check_length(&format!("the description of {}", topic.name), longest as u64, MAX_FIELD_BYTES)?;
        let id = self.guard(|this| {
            // A topic of others may have no schema (0); ours always have one, if only an empty text.
            let schema = if topic.type_name.is_empty() && topic.schema_encoding.is_empty() {
                0
            } else {
                this.writer.add_schema(&topic.type_name, &topic.schema_encoding, &topic.schema)?
            };
            this.writer.add_channel(schema, &topic.name, &topic.message_encoding, &topic.metadata)
        })?;
        let id = TopicId(id);
        self.ids.insert(topic.name.clone(), id);
        self.topics.insert(id, Written { topic: Arc::new(topic.clone()), messages: 0 });
        Ok(id)
    }

    /// The topic of that name, if it was added.
    pub fn topic_id(&self, name: &str) -> Option<TopicId> {
        self.ids.get(name).copied()
    }

    /// Writes a message: times in ns, `cdr` with its 4-byte header.
    ///
    /// # Errors
    /// When `topic` is of another writer, the message is over 4 GiB, or writing fails.
    pub fn write(&mut self, topic: TopicId, log_time: u64, publish_time: u64, cdr: &[u8]) -> Result<(), BagError> {
        let written = self.topics.get_mut(&topic).ok_or(BagError::UnknownChannel { offset: 0, channel: topic.0 })?;
        check_length(&format!("a message on {}", written.topic.name), cdr.len() as u64, MAX_FIELD_BYTES)?;
        // rosbag2 has 32 bits for the sequence too; it wraps.
        let sequence = (written.messages & u64::from(u32::MAX)) as u32;
        written.messages += 1;
        let header = MessageHeader { channel_id: topic.0, sequence, log_time, publish_time };
        self.guard(|this| this.writer.write_to_known_channel(&header, cdr))?;
        self.contents.message_count += 1;
        self.contents.start = Some(self.contents.start.map_or(log_time, |start| start.min(log_time)));
        self.contents.end = Some(self.contents.end.map_or(log_time, |end| end.max(log_time)));
        self.pending_bytes += cdr.len() as u64;
        Ok(())
    }

    /// Adds an attachment.
    ///
    /// # Errors
    /// When writing fails.
    pub fn attach(&mut self, attachment: &Attachment) -> Result<(), BagError> {
        let longest = attachment.name.len().max(attachment.media_type.len());
        check_length("an attachment's name", longest as u64, MAX_FIELD_BYTES)?;
        let attachment = mcap::Attachment {
            log_time: attachment.log_time,
            create_time: attachment.create_time,
            name: attachment.name.clone(),
            media_type: attachment.media_type.clone(),
            data: attachment.data.as_slice().into(),
        };
        self.guard(|this| this.writer.attach(&attachment))?;
        self.contents.attachment_count += 1;
        Ok(())
    }

    /// Adds a metadata record.
    ///
    /// # Errors
    /// When writing fails.
    pub fn add_metadata(&mut self, record: &MetadataRecord) -> Result<(), BagError> {
        let bytes: usize = record.values.iter().map(|(key, value)| key.len() + value.len() + 8).sum();
        check_length("a metadata record", (bytes + record.name.len()) as u64, MAX_FIELD_BYTES)?;
        let record = mcap::records::Metadata { name: record.name.clone(), metadata: record.values.clone() };
        self.guard(|this| this.writer.write_metadata(&record))
    }

    /// Closes the chunk in progress and flushes `W`: everything so far can be read even if nothing follows.
    ///
    /// # Errors
    /// When writing fails.
    pub fn flush(&mut self) -> Result<(), BagError> {
        self.guard(|this| this.writer.flush())?;
        self.pending_bytes = 0;
        Ok(())
    }

    /// Bytes written, with those still in memory counted before compression.
    pub fn bytes(&self) -> u64 {
        self.written_bytes.load(Ordering::Relaxed) + self.pending_bytes
    }

    /// What is in the file so far.
    pub fn contents(&self) -> Contents {
        let mut contents = self.contents.clone();
        for written in self.topics.values() {
            contents.add_topic(&written.topic, written.messages);
        }
        contents
    }

    /// Writes the summary and gives `W` back with what is in the file.
    ///
    /// # Errors
    /// When writing fails; the file is then unfinished, and readable up to its last whole chunk.
    pub fn finish(mut self) -> Result<(W, Contents), BagError> {
        self.guard(|this| this.writer.finish())?;
        let contents = self.contents();
        let mut output = self.writer.into_inner().into_inner().output;
        output.flush().map_err(BagError::Write)?;
        Ok((output, contents))
    }

    /// Runs one operation of the writer, and none after one that failed.
    fn guard<T>(&mut self, operation: impl FnOnce(&mut Self) -> Result<T, McapError>) -> Result<T, BagError> {
        if self.broken {
            return Err(BagError::WriterBroken);
        }
        operation(self).map_err(|error| {
            self.broken = !matches!(error, McapError::TooManyChannels | McapError::TooManySchemas);
            write_error(error)
        })
    }
}

fn check_length(what: &str, bytes: u64, limit: u64) -> Result<(), BagError> {
    if bytes > limit {
        return Err(BagError::TooBigToWrite { what: what.to_owned(), bytes, limit });
    }
    Ok(())
}

fn write_error(error: McapError) -> BagError {
    match error {
        McapError::Io(error) => BagError::Write(error),
        McapError::TooManyChannels | McapError::TooManySchemas => BagError::TooManyTopics { limit: 65_535 },
        McapError::AttemptedWriteAfterFailure => BagError::WriterBroken,
        other => BagError::Write(io::Error::other(other)),
    }
}

/// Counts the bytes that pass through.
struct Counting<W> {
    output: W,
    bytes: Arc<AtomicU64>,
}

impl<W: Write> Write for Counting<W> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let n = self.output.write(bytes)?;
        self.bytes.fetch_add(n as u64, Ordering::Relaxed);
        Ok(n)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.output.flush()
    }
}
