//! The messages of several files as one stream, with only those files open whose times overlap.

use std::cmp::Reverse;
use std::collections::{BTreeMap, BinaryHeap};
use std::fs::File;
use std::path::PathBuf;

use bag::{BagReader, Message, Messages};

use crate::open::open_file;
use crate::{BagFile, BagFilesError};

/// A file that is being read, and its next message.
struct Current {
    path: PathBuf,
    messages: Messages<BagReader<File>, File>,
    next: Message,
}

/// Iterator over all files' messages by log time, then file, then place in the file. It ends after the first error.
pub struct BagMessages {
    /// Files still to be opened: start, number, path; the earliest last.
    waiting: Vec<(u64, usize, PathBuf)>,
    /// Next message of every open file: log time and number of the file.
    heap: BinaryHeap<Reverse<(u64, usize)>>,
    open: BTreeMap<usize, Current>,
    done: bool,
}

impl BagMessages {
    pub(crate) fn new(files: &[BagFile]) -> BagMessages {
        let starts =
            files.iter().enumerate().filter_map(|(i, file)| Some((file.contents.start?, i, file.path.clone())));
        let mut waiting: Vec<_> = starts.collect();
        waiting.sort_by(|a, b| b.cmp(a));
        BagMessages { waiting, heap: BinaryHeap::new(), open: BTreeMap::new(), done: false }
    }

    fn open_due(&mut self) -> Result<(), BagFilesError> {
        while let Some((start, ..)) = self.waiting.last() {
            if self.heap.peek().is_some_and(|Reverse((log_time, _))| log_time < start) {
                break;
            }
            if let Some((_, index, path)) = self.waiting.pop() {
                let messages = open_file(&path)?.into_messages();
                self.advance(index, path, messages)?;
            }
        }
        Ok(())
    }

    /// Takes a file's next message; a file that has no more is closed.
    fn advance(
        &mut self,
        index: usize,
        path: PathBuf,
        mut messages: Messages<BagReader<File>, File>,
    ) -> Result<(), BagFilesError> {
        if let Some(next) = messages.next() {
            let next = next.map_err(BagFilesError::bag(&path))?;
            self.heap.push(Reverse((next.log_time, index)));
            self.open.insert(index, Current { path, messages, next });
        }
        Ok(())
    }

    fn take(&mut self) -> Result<Option<Message>, BagFilesError> {
        self.open_due()?;
        let Some(Reverse((_, index))) = self.heap.pop() else {
            return Ok(None);
        };
        let Current { path, messages, next } = self.open.remove(&index).expect("the heap only names open files");
        self.advance(index, path, messages)?;
        Ok(Some(next))
    }
}

impl Iterator for BagMessages {
    type Item = Result<Message, BagFilesError>;

    fn next(&mut self) -> Option<Self::Item> {
        if self.done {
            return None;
        }
        let next = self.take().transpose();
        self.done = !matches!(next, Some(Ok(_)));
        next
    }
}
