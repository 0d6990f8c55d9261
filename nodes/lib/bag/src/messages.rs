//! Messages in the order of their log times, with only those chunks in memory whose times overlap.

use std::borrow::BorrowMut;
use std::cmp::Reverse;
use std::collections::{BTreeMap, BinaryHeap};
use std::io::{Read, Seek};
use std::marker::PhantomData;
use std::sync::Arc;

use crate::chunk::Segment;
use crate::record::opcode;
use crate::{BagError, BagReader, Message};

/// A loaded segment: its records, and where its messages lie, in the order in which they are due.
struct Loaded {
    records: Vec<u8>,
    due: Vec<(u64, usize)>,
    next: usize,
}

/// Iterator over a file's messages by log time, then file order. It ends after the first error.
///
/// `B` is the reader itself or a borrow of it.
pub struct Messages<B, R> {
    reader: B,
    input: PhantomData<R>,
    /// Segments still to be loaded, the earliest last.
    waiting: Vec<Segment>,
    /// Next message of every loaded segment: log time and offset of the segment, earliest on top.
    heap: BinaryHeap<Reverse<(u64, u64)>>,
    loaded: BTreeMap<u64, (Segment, Loaded)>,
    loaded_bytes: u64,
    given: u64,
    done: bool,
}

impl<B: BorrowMut<BagReader<R>>, R: Read + Seek> Messages<B, R> {
    pub(crate) fn new(reader: B) -> Messages<B, R> {
        let mut waiting = reader.borrow().segments.clone();
        waiting.sort_by_key(|segment| Reverse((segment.start, segment.span.offset)));
        Messages {
            reader,
            input: PhantomData,
            waiting,
            heap: BinaryHeap::new(),
            loaded: BTreeMap::new(),
            loaded_bytes: 0,
            given: 0,
            done: false,
        }
    }

    /// Loads every segment that may hold a message not later than the earliest one known.
    fn load_due(&mut self) -> Result<(), BagError> {
        while let Some(segment) = self.waiting.last() {
            if self.heap.peek().is_some_and(|Reverse((log_time, _))| *log_time < segment.start) {
                break;
            }
            if let Some(segment) = self.waiting.pop() {
                self.load(segment)?;
            }
        }
        Ok(())
    }

    fn load(&mut self, segment: Segment) -> Result<(), BagError> {
        let offset = segment.span.offset;
        let bytes = self.loaded_bytes.saturating_add(segment.uncompressed_size);
        let reader = self.reader.borrow_mut();
        if bytes > reader.limits.loaded_bytes {
            return Err(BagError::TooMuchOverlap { offset, bytes, limit: reader.limits.loaded_bytes });
        }
        let records = segment.load(&mut reader.source, &reader.limits)?;
        let mut due = Vec::new();
        segment.visit(&records, &mut reader.table, |table, at, message| {
            if table.topic(message.channel).is_none() {
                return Err(BagError::UnknownChannel { offset, channel: message.channel });
            }
            if message.log_time < segment.start || message.log_time > segment.end {
                let (time, start, end) = (message.log_time, segment.start, segment.end);
                let why = format!("a message of time {time} is in a chunk that says {start} to {end}");
                return Err(BagError::Malformed { offset, opcode: opcode::CHUNK, why });
            }
            due.push((message.log_time, at));
            Ok(())
        })?;
        due.sort_unstable();
        if let Some((log_time, _)) = due.first() {
            self.heap.push(Reverse((*log_time, offset)));
            self.loaded_bytes = bytes;
            self.loaded.insert(offset, (segment, Loaded { records, due, next: 0 }));
        }
        Ok(())
    }

    fn advance(&mut self) -> Result<Option<Message>, BagError> {
        self.load_due()?;
        let Some(Reverse((_, offset))) = self.heap.pop() else {
            let (got, expected) = (self.given, self.reader.borrow().contents().message_count);
            return if got == expected { Ok(None) } else { Err(BagError::CountMismatch { got, expected }) };
        };
        let (segment, loaded) = self.loaded.get_mut(&offset).expect("the heap only names loaded segments");
        let (_, at) = loaded.due[loaded.next];
        let record = segment.message_at(&loaded.records, at)?;
        let topic = self.reader.borrow().table.topic(record.channel).expect("loading checked every channel");
        let message = Message {
            topic: Arc::clone(topic),
            log_time: record.log_time,
            publish_time: record.publish_time,
            sequence: record.sequence,
            data: record.data.to_vec(),
        };
        loaded.next += 1;
        match loaded.due.get(loaded.next) {
            Some((log_time, _)) => self.heap.push(Reverse((*log_time, offset))),
            None => {
                self.loaded_bytes -= segment.uncompressed_size;
                self.loaded.remove(&offset);
            }
        }
        self.given += 1;
        Ok(Some(message))
    }
}

impl<B: BorrowMut<BagReader<R>>, R: Read + Seek> Iterator for Messages<B, R> {
    type Item = Result<Message, BagError>;

    fn next(&mut self) -> Option<Self::Item> {
        if self.done {
            return None;
        }
        let next = self.advance().transpose();
        self.done = !matches!(next, Some(Ok(_)));
        next
    }
}
