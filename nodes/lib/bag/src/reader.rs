//! Opening a file and saying what is in it, whether it was finished or not.

use std::collections::BTreeMap;
use std::io::{Read, Seek};

use crate::chunk::Segment;
use crate::contents::Contents;
use crate::messages::Messages;
use crate::record::{AttachmentRecord, PREFIX_BYTES, Statistics, opcode};
use crate::scan::{End, Scan, Source, Span, malformed, scan};
use crate::summary::read_summary;
use crate::table::Table;
use crate::{Attachment, BagError, Damage, Limits, MetadataRecord};

/// A bag file, opened for reading. Memory use is bounded by [`Limits`], not by the file.
pub struct BagReader<R> {
    pub(crate) source: Source<R>,
    pub(crate) limits: Limits,
    pub(crate) segments: Vec<Segment>,
    pub(crate) table: Table,
    contents: Contents,
    attachments: Vec<Span>,
    metadata: Vec<MetadataRecord>,
    pub(crate) damage: Vec<Damage>,
}

impl<R: Read + Seek> BagReader<R> {
    /// Opens a finished, undamaged file.
    ///
    /// # Errors
    /// When the file is no MCAP file, was not finished, or is damaged where opening looks: the record structure and the
    /// summary. Chunks are checked when their messages are read.
    pub fn open(input: R, limits: Limits) -> Result<BagReader<R>, BagError> {
        let mut source = Source::new(input)?;
        let mut found = scan(&mut source, &limits)?;
        let statistics = match found.end {
            End::Cut { error, .. } => return Err(error),
            End::Finished { summary } => read_summary(&mut source, summary, &mut found.table, &limits)?,
        };
        found.end = End::Finished { summary: 0 };
        let mut reader = BagReader::new(source, limits, found);
        let described = |s: &Statistics| s.channel_counts.keys().all(|id| reader.table.topic(*id).is_some());
        match statistics.filter(described) {
            Some(statistics) => reader.count_from(&statistics),
            None => reader.count_by_reading(false)?,
        }
        Ok(reader)
    }

    /// Opens whatever can be read of a file that may be unfinished or damaged; [`BagReader::damage`] says what is wrong.
    /// Every chunk is read and checked once.
    ///
    /// # Errors
    /// When the file is no MCAP file at all, or the system cannot read it.
    pub fn open_tolerant(input: R, limits: Limits) -> Result<BagReader<R>, BagError> {
        let mut source = Source::new(input)?;
        let mut found = scan(&mut source, &limits)?;
        let end = std::mem::replace(&mut found.end, End::Finished { summary: 0 });
        let mut damage = Vec::new();
        match end {
            End::Cut { error, offset } => damage.push(Damage { error, bytes_lost: found.file_bytes - offset }),
            End::Finished { summary } => {
                // Only channels come from the summary here, and a broken one costs nothing: all is counted anew.
                match read_summary(&mut source, summary, &mut found.table, &limits) {
                    Ok(_) => {}
                    Err(error @ BagError::Read { .. }) => return Err(error),
                    Err(error) => damage.push(Damage { error, bytes_lost: 0 }),
                }
            }
        }
        let mut reader = BagReader::new(source, limits, found);
        reader.damage = damage;
        reader.count_by_reading(true)?;
        Ok(reader)
    }

    fn new(source: Source<R>, limits: Limits, found: Scan) -> BagReader<R> {
        let contents = Contents {
            profile: found.header.profile,
            library: found.header.library,
            attachment_count: found.attachments.len() as u64,
            ..Contents::default()
        };
        BagReader {
            source,
            limits,
            segments: found.segments,
            table: found.table,
            contents,
            attachments: found.attachments,
            metadata: found.metadata,
            damage: Vec::new(),
        }
    }

    /// What is in the file.
    pub fn contents(&self) -> &Contents {
        &self.contents
    }

    /// What is wrong with the file; empty for a finished, undamaged one.
    pub fn damage(&self) -> &[Damage] {
        &self.damage
    }

    /// What is wrong with the file, for keeping once the reader is gone.
    pub fn into_damage(self) -> Vec<Damage> {
        self.damage
    }

    /// The file's metadata records, in file order.
    pub fn metadata(&self) -> &[MetadataRecord] {
        &self.metadata
    }

    /// Every message in the order of log times; those of equal time in file order.
    pub fn messages(&mut self) -> Messages<&mut BagReader<R>, R> {
        Messages::new(self)
    }

    /// The same, keeping the reader within the iterator.
    pub fn into_messages(self) -> Messages<BagReader<R>, R> {
        Messages::new(self)
    }

    /// Every attachment, in file order.
    ///
    /// # Errors
    /// When one is malformed or its checksum does not match.
    pub fn attachments(&mut self) -> Result<Vec<Attachment>, BagError> {
        let spans = self.attachments.clone();
        spans.into_iter().map(|span| self.attachment(span)).collect()
    }

    fn attachment(&mut self, span: Span) -> Result<Attachment, BagError> {
        self.source.seek(span.offset + PREFIX_BYTES)?;
        let bytes = self.source.contents(opcode::ATTACHMENT, span, &self.limits)?;
        let record = AttachmentRecord::parse(&bytes).map_err(|e| malformed(span.offset, opcode::ATTACHMENT, &e))?;
        let (stored, computed) = (record.stored_crc, record.computed_crc);
        if stored != 0 && stored != computed {
            return Err(BagError::Checksum { what: "attachment", offset: span.offset, stored, computed });
        }
        Ok(record.attachment)
    }

    fn count_from(&mut self, statistics: &Statistics) {
        for (id, topic) in self.table.topics() {
            let count = statistics.channel_counts.get(&id).copied().unwrap_or(0);
            self.contents.add_topic(topic, count);
        }
        self.contents.message_count = statistics.message_count;
        if statistics.message_count > 0 {
            self.contents.start = Some(statistics.start);
            self.contents.end = Some(statistics.end);
        }
    }

    /// Loads every segment once. With `tolerant`, segments and attachments that cannot be read are dropped and noted.
    fn count_by_reading(&mut self, tolerant: bool) -> Result<(), BagError> {
        let mut counts = BTreeMap::new();
        let mut whole = Vec::with_capacity(self.segments.len());
        for mut segment in std::mem::take(&mut self.segments) {
            match self.count_segment(&mut segment) {
                Ok(found) => {
                    for (id, count) in found {
                        *counts.entry(id).or_insert(0) += count;
                    }
                    whole.push(segment);
                }
                Err(error) => self.note(error, segment.span, tolerant)?,
            }
        }
        self.segments = whole;
        if tolerant {
            for span in std::mem::take(&mut self.attachments) {
                match self.attachment(span) {
                    Ok(_) => self.attachments.push(span),
                    Err(error) => self.note(error, span, tolerant)?,
                }
            }
            self.contents.attachment_count = self.attachments.len() as u64;
        }
        for (id, topic) in self.table.topics() {
            self.contents.add_topic(topic, counts.get(&id).copied().unwrap_or(0));
        }
        self.contents.message_count = counts.values().sum();
        let with_messages = || self.segments.iter().filter(|s| s.start <= s.end);
        self.contents.start = with_messages().map(|s| s.start).min();
        self.contents.end = with_messages().map(|s| s.end).max();
        Ok(())
    }

    fn note(&mut self, error: BagError, span: Span, tolerant: bool) -> Result<(), BagError> {
        if !tolerant || matches!(error, BagError::Read { .. }) {
            return Err(error);
        }
        self.damage.push(Damage { error, bytes_lost: span.length });
        Ok(())
    }

    /// Counts a segment's messages by channel and corrects its times; one without messages gets start > end.
    fn count_segment(&mut self, segment: &mut Segment) -> Result<BTreeMap<u16, u64>, BagError> {
        let records = segment.load(&mut self.source, &self.limits)?;
        let mut counts = BTreeMap::new();
        let (mut start, mut end) = (u64::MAX, 0);
        let offset = segment.span.offset;
        segment.visit(&records, &mut self.table, |table, _, message| {
            if table.topic(message.channel).is_none() {
                return Err(BagError::UnknownChannel { offset, channel: message.channel });
            }
            *counts.entry(message.channel).or_insert(0) += 1;
            start = start.min(message.log_time);
            end = end.max(message.log_time);
            Ok(())
        })?;
        (segment.start, segment.end) = (start, end);
        Ok(counts)
    }
}
