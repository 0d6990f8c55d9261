//! Making a finished bag of one that was cut short or damaged.

use std::io::{Read, Seek, Write};

use crate::record::opcode;
use crate::{BagError, BagReader, BagWriter, Contents, Damage, Limits, WriterOptions};

/// What a recovery kept and what it could not.
#[derive(Debug)]
pub struct RecoverReport {
    /// What is in the new file.
    pub contents: Contents,
    /// What was wrong with the old one.
    pub damage: Vec<Damage>,
}

impl RecoverReport {
    /// Whether everything the file's writer had flushed was kept.
    pub fn complete(&self) -> bool {
        !self.damage.iter().any(Damage::loses_messages)
    }
}

/// Copies everything that can be read in `input` to a new, finished bag in `output`, messages in file order.
///
/// # Errors
/// When `input` is no MCAP file, cannot be read, or `output` cannot be written. Damage is no error but in the report.
pub fn recover<R: Read + Seek, W: Write>(
    input: R,
    output: W,
    limits: Limits,
    options: &WriterOptions,
) -> Result<RecoverReport, BagError> {
    let mut reader = BagReader::open_tolerant(input, limits)?;
    let mut writer = BagWriter::new(output, options)?;
    for topic in reader.contents().topics.clone() {
        writer.add_topic(&topic.topic)?;
    }
    for segment in reader.segments.clone() {
        let records = segment.load(&mut reader.source, &reader.limits)?;
        segment.visit(&records, &mut reader.table, |table, _, message| {
            let unknown = BagError::UnknownChannel { offset: segment.span.offset, channel: message.channel };
            let topic = table.topic(message.channel).ok_or(unknown)?;
            let id = writer.add_topic(topic).or_else(|error| match error {
                // Channels that share a topic but not a description: the first one's stands for all.
                BagError::TopicConflict { .. } => writer.topic_id(&topic.name).ok_or(BagError::Malformed {
                    offset: segment.span.offset,
                    opcode: opcode::CHANNEL,
                    why: format!("topic {} has no channel", topic.name),
                }),
                other => Err(other),
            })?;
            writer.write(id, message.log_time, message.publish_time, message.data)
        })?;
    }
    for attachment in reader.attachments()? {
        writer.attach(&attachment)?;
    }
    for record in reader.metadata() {
        writer.add_metadata(record)?;
    }
    let (_, contents) = writer.finish()?;
    Ok(RecoverReport { contents, damage: reader.damage })
}
