//! How much memory a reader may use for a file it does not trust.

/// Limits on what is held in memory while reading; a file that asks for more is refused.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Limits {
    /// Longest record, and longest chunk before and after decompression, in bytes.
    pub record_bytes: u64,
    /// All chunks held at once because their times overlap, in bytes.
    pub loaded_bytes: u64,
}

impl Default for Limits {
    /// 256 MiB a record, 1 GiB of overlapping chunks.
    fn default() -> Limits {
        Limits { record_bytes: 256 << 20, loaded_bytes: 1 << 30 }
    }
}
