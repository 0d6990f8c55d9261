//! What was lost in a bag that could only be read in part.

use crate::BagError;

/// One thing that is wrong with a file, and what it costs.
#[derive(Debug)]
pub struct Damage {
    /// What is wrong, with its byte offset.
    pub error: BagError,
    /// Bytes of the file that could not be used because of it.
    pub bytes_lost: u64,
}

impl Damage {
    /// Whether messages may be missing. A file that merely was not finished has lost nothing.
    pub fn loses_messages(&self) -> bool {
        self.bytes_lost > 0
    }
}

impl std::fmt::Display for Damage {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        if self.bytes_lost == 0 {
            write!(f, "{}; nothing is lost", self.error)
        } else {
            write!(f, "{}; {} bytes are lost", self.error, self.bytes_lost)
        }
    }
}
