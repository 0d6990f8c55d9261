//! Text files of limited size.

use std::fs::File;
use std::io::{self, Read};
use std::path::{Path, PathBuf};
use thiserror::Error;

/// Why a text file cannot be used.
#[derive(Debug, Error)]
pub enum TextError {
    /// It cannot be read.
    #[error("{}: {source}", path.display())]
    Read {
        /// The file.
        path: PathBuf,
        /// Why not.
        source: io::Error,
    },
    /// A folder, a pipe or a device.
    #[error("{}: this is no regular file", path.display())]
    NoFile {
        /// The path.
        path: PathBuf,
    },
    /// Beyond the cap.
    #[error("{}: more than {max} bytes", path.display())]
    TooLarge {
        /// The file.
        path: PathBuf,
        /// Bytes.
        max: usize,
    },
    /// Not text.
    #[error("{}: byte {at} is not UTF-8: is this a text file?", path.display())]
    NotText {
        /// The file.
        path: PathBuf,
        /// Where.
        at: usize,
    },
}

/// Reads a text file of at most `max` bytes.
///
/// # Errors
/// A file that is not there, too large, or no text.
pub fn read_text(path: &Path, max: usize) -> Result<String, TextError> {
    let bytes = read_bytes(path, max)?;
    String::from_utf8(bytes)
        .map_err(|error| TextError::NotText { path: path.to_owned(), at: error.utf8_error().valid_up_to() })
}

/// Reads a regular file of at most `max` bytes: what it says of its size is not relied on.
pub(crate) fn read_bytes(path: &Path, max: usize) -> Result<Vec<u8>, TextError> {
    let failed = |source| TextError::Read { path: path.to_owned(), source };
    // Opening a pipe would wait for its other end.
    if !std::fs::metadata(path).map_err(failed)?.is_file() {
        return Err(TextError::NoFile { path: path.to_owned() });
    }
    let mut bytes = Vec::new();
    let file = File::open(path).map_err(failed)?;
    file.take(max as u64 + 1).read_to_end(&mut bytes).map_err(failed)?;
    if bytes.len() > max {
        return Err(TextError::TooLarge { path: path.to_owned(), max });
    }
    Ok(bytes)
}
