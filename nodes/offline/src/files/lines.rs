//! Lines of a text file, numbered, one at a time: of bounded length, UTF-8, whatever ends them.

use std::fs::File;
use std::io::{BufRead, BufReader, ErrorKind, Read};
use std::path::Path;

use crate::OfflineError;

/// Larger files are refused, in bytes.
pub const MAX_FILE_BYTES: u64 = 2 << 30;
/// Longer lines are refused, in bytes.
pub const MAX_LINE_BYTES: usize = 1 << 20;

const BUFFER_BYTES: usize = 1 << 18;

/// The lines of one file.
#[derive(Debug)]
pub struct Lines<R> {
    file: String,
    reader: R,
    buffer: Vec<u8>,
    number: u64,
    bytes: u64,
}

/// Opens a file, or a pipe, to read. A directory is refused.
///
/// # Errors
/// What cannot be opened.
pub fn open(path: &Path) -> Result<File, OfflineError> {
    let name = || path.display().to_string();
    let unreadable = |source| OfflineError::Unreadable { file: name(), source };
    let file = File::open(path).map_err(unreadable)?;
    if file.metadata().map_err(unreadable)?.is_dir() {
        return Err(OfflineError::Directory { file: name() });
    }
    Ok(file)
}

impl Lines<BufReader<File>> {
    /// The lines of the file at `path`.
    ///
    /// # Errors
    /// As [`open`].
    pub fn of(path: &Path) -> Result<Self, OfflineError> {
        Ok(Self::new(path.display().to_string(), BufReader::with_capacity(BUFFER_BYTES, open(path)?)))
    }
}

impl<R: BufRead> Lines<R> {
    /// The lines of what `reader` gives; `file` names it in errors.
    pub fn new(file: String, reader: R) -> Self {
        Self { file, reader, buffer: Vec::new(), number: 0, bytes: 0 }
    }

    /// Name of the file.
    pub fn file(&self) -> &str {
        &self.file
    }

    /// The next line that is not blank, without what ends it, with its number from 1. A byte order mark is no part of it.
    ///
    /// # Errors
    /// What cannot be read, is no UTF-8, or larger than allowed.
    pub fn next_line(&mut self) -> Result<Option<(u64, &str)>, OfflineError> {
        loop {
            self.buffer.clear();
            let mut part = self.reader.by_ref().take(MAX_LINE_BYTES as u64 + 1);
            let read = part.read_until(b'\n', &mut self.buffer).map_err(|source| match source.kind() {
                ErrorKind::IsADirectory => OfflineError::Directory { file: self.file.clone() },
                _ => OfflineError::Unreadable { file: self.file.clone(), source },
            })?;
            if read == 0 {
                return Ok(None);
            }
            self.number += 1;
            self.bytes += read as u64;
            self.check_sizes()?;
            if self.number == 1 {
                self.take_byte_order_mark()?;
            }
            if !self.buffer.trim_ascii().is_empty() {
                break;
            }
        }
        let text = std::str::from_utf8(self.buffer.trim_ascii()).map_err(|_| OfflineError::NotText {
            file: self.file.clone(),
            line: self.number,
            got: "bytes that are not UTF-8",
        })?;
        if text.bytes().any(|byte| byte == b'\r' || byte == 0) {
            let got = if text.contains('\0') { "a zero byte" } else { "a carriage return within a line" };
            return Err(OfflineError::NotText { file: self.file.clone(), line: self.number, got });
        }
        Ok(Some((self.number, text)))
    }

    fn check_sizes(&self) -> Result<(), OfflineError> {
        if self.buffer.len() > MAX_LINE_BYTES {
            return Err(OfflineError::LongLine { file: self.file.clone(), line: self.number });
        }
        if self.bytes > MAX_FILE_BYTES {
            return Err(OfflineError::LargeFile { file: self.file.clone(), most: MAX_FILE_BYTES });
        }
        Ok(())
    }

    fn take_byte_order_mark(&mut self) -> Result<(), OfflineError> {
        if self.buffer.starts_with(&[0xff, 0xfe]) || self.buffer.starts_with(&[0xfe, 0xff]) {
            return Err(OfflineError::NotText { file: self.file.clone(), line: 1, got: "UTF-16" });
        }
        if self.buffer.starts_with(&[0xef, 0xbb, 0xbf]) {
            self.buffer.drain(..3);
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::{Lines, MAX_LINE_BYTES};

    fn all(bytes: &[u8]) -> Result<Vec<(u64, String)>, String> {
        let mut lines = Lines::new("f".into(), bytes);
        let mut found = Vec::new();
        while let Some((number, line)) = lines.next_line().map_err(|error| error.to_string())? {
            found.push((number, line.to_owned()));
        }
        Ok(found)
    }

    #[test]
    fn lines_keep_their_numbers_whatever_ends_them() {
        let want = vec![(1, "a".to_owned()), (4, "b".to_owned()), (5, "c".to_owned())];
        assert_eq!(all(b"a\n\n \t\nb\nc\n"), Ok(want.clone()));
        assert_eq!(all(b"\xef\xbb\xbfa\r\n\r\n\r\nb\r\nc"), Ok(want));
        assert_eq!(all(b""), Ok(vec![]));
        assert_eq!(all(b"\xef\xbb\xbf"), Ok(vec![]));
    }

    #[test]
    fn what_is_no_text_is_refused() {
        let refused = |bytes: &[u8]| all(bytes).expect_err("refused");
        assert_eq!(refused(b"1\n\xff\xff\n"), "f, line 2: holds bytes that are not UTF-8, expected UTF-8 text");
        assert_eq!(refused(b"\xff\xfe1\0\n\0"), "f, line 1: holds UTF-16, expected UTF-8 text");
        assert_eq!(refused(b"1\0"), "f, line 1: holds a zero byte, expected UTF-8 text");
        assert!(refused(b"1\r2\r3").contains("a carriage return within a line"));
        assert!(refused(&vec![b'1'; MAX_LINE_BYTES + 1]).starts_with("f, line 1: is longer than"));
    }
}
