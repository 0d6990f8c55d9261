//! The append-only journal of accepted evidence: what makes a killed node come back as it was.
//!
//! A file is the eight bytes of [`MAGIC`], then frames: kind (1 byte), length (u32, little endian), CRC-32 of the payload
//! (u32), payload (CDR). A frame cut short by a crash is the last one, and is dropped.

use apprentice_msgs::msg::{EvidenceRecord, TableScene, TabularWorld};
use apprentice_msgs::{from_cdr, to_cdr};
use thiserror::Error;

/// First bytes of every journal.
pub const MAGIC: &[u8; 8] = b"APJRNL01";
/// Frames above this are damage, not evidence.
pub(crate) const MAX_FRAME: usize = 64 << 20;
const TASK: u8 = 0;
const RECORD: u8 = 1;
const WORLD: u8 = 2;
const HEADER: usize = 9;

/// One frame.
#[derive(Debug, Clone, PartialEq)]
pub enum Entry {
    /// The table that the session began with.
    Task(Box<TableScene>),
    /// A world: the one that the session began with, or the one that the next record names.
    World(Box<TabularWorld>),
    /// One accepted event.
    Record(Box<EvidenceRecord>),
}

/// Why a journal cannot be used.
#[derive(Debug, Error, PartialEq)]
pub enum JournalError {
    /// Some other file.
    #[error("the journal does not start with {MAGIC:?}: it is not a journal of this program")]
    Magic,
    /// Damage in the middle, not a cut-off end.
    #[error("the journal is damaged at byte {at}: {what}; move it away to start a new session, or restore a copy")]
    Damaged {
        /// Offset of the frame.
        at: usize,
        /// What is wrong.
        what: String,
    },
}

impl Entry {
    /// The bytes to append.
    pub fn to_bytes(&self) -> Vec<u8> {
        let (kind, payload) = match self {
            Self::Task(scene) => (TASK, to_cdr(scene.as_ref())),
            Self::World(world) => (WORLD, to_cdr(world.as_ref())),
            Self::Record(record) => (RECORD, to_cdr(record.as_ref())),
        };
        let length = u32::try_from(payload.len()).expect("evidence is far below 4 GiB");
        let mut frame = vec![kind];
        frame.extend(length.to_le_bytes());
        frame.extend(crc32fast::hash(&payload).to_le_bytes());
        frame.extend(payload);
        frame
    }
}

/// The whole frames of a journal, and how many of its bytes they take: an unfinished last frame is to be cut off.
pub fn read_journal(bytes: &[u8]) -> Result<(Vec<Entry>, usize), JournalError> {
    if bytes.len() < MAGIC.len() {
        return if MAGIC.starts_with(bytes) { Ok((Vec::new(), 0)) } else { Err(JournalError::Magic) };
    }
    if !bytes.starts_with(MAGIC) {
        return Err(JournalError::Magic);
    }
    let mut entries = Vec::new();
    let mut at = MAGIC.len();
    while let Some(header) = bytes.get(at..at + HEADER) {
        let word = |i: usize| u32::from_le_bytes([header[i], header[i + 1], header[i + 2], header[i + 3]]);
        let (length, crc) = (word(1) as usize, word(5));
        let damaged = |what: String| JournalError::Damaged { at, what };
        if length > MAX_FRAME {
            return Err(damaged(format!("a frame of {length} bytes")));
        }
        let Some(payload) = bytes.get(at + HEADER..at + HEADER + length) else { break };
        let last = at + HEADER + length == bytes.len();
        if crc32fast::hash(payload) != crc {
            // A torn write can leave the right length with the wrong content, but only at the very end.
            if last {
                break;
            }
            return Err(damaged("the checksum does not match".into()));
        }
        entries.push(match header[0] {
            TASK => Entry::Task(Box::new(from_cdr(payload).map_err(|error| damaged(error.to_string()))?)),
            WORLD => Entry::World(Box::new(from_cdr(payload).map_err(|error| damaged(error.to_string()))?)),
            RECORD => Entry::Record(Box::new(from_cdr(payload).map_err(|error| damaged(error.to_string()))?)),
            kind => return Err(damaged(format!("unknown kind {kind}"))),
        });
        at += HEADER + length;
    }
    Ok((entries, at))
}

#[cfg(test)]
mod tests {
    use super::{Entry, JournalError, MAGIC, read_journal};
    use apprentice_msgs::msg::{EvidenceRecord, TableScene, TabularWorld};

    fn journal() -> (Vec<Entry>, Vec<u8>) {
        let task = TableScene { id: "t".into(), ..TableScene::default() };
        let world = TabularWorld { id: "w".into(), gamma: 0.5, ..TabularWorld::default() };
        let entries: Vec<Entry> = [Entry::Task(Box::new(task)), Entry::World(Box::new(world))]
            .into_iter()
            .chain(
                (1..4)
                    .map(|sequence| Entry::Record(Box::new(EvidenceRecord { sequence, ..EvidenceRecord::default() }))),
            )
            .collect();
        let bytes = MAGIC.iter().copied().chain(entries.iter().flat_map(Entry::to_bytes)).collect();
        (entries, bytes)
    }

    #[test]
    fn what_was_written_is_read_and_any_cut_loses_only_the_last_frame() {
        let (entries, bytes) = journal();
        assert_eq!(read_journal(&bytes), Ok((entries.clone(), bytes.len())));
        for cut in 0..bytes.len() {
            let (read, used) = read_journal(&bytes[..cut]).expect("a cut is no damage");
            assert!(used <= cut && entries.starts_with(&read));
        }
    }

    #[test]
    fn damage_in_the_middle_is_told_with_its_place() {
        let (entries, mut bytes) = journal();
        let at = MAGIC.len();
        bytes[at + 20] ^= 1;
        assert!(matches!(read_journal(&bytes), Err(JournalError::Damaged { at: 8, .. })));
        bytes[0] = 0;
        assert_eq!(read_journal(&bytes), Err(JournalError::Magic));
        let last = entries.last().expect("there are five").to_bytes().len();
        let (_, mut bytes) = journal();
        let end = bytes.len() - 1;
        bytes[end] ^= 1;
        assert_eq!(read_journal(&bytes).map(|(read, used)| (read.len(), used)), Ok((4, bytes.len() - last)));
    }
}
