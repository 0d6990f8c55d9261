//! What can be wrong with an interface definition, and where.

use thiserror::Error;

/// A definition that cannot be read: the file, the line, and what is wrong there.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[error("{file}:{line}: {problem}")]
pub struct InterfaceError {
    /// Name of the file, or of the type, as the caller gave it.
    pub file: String,
    /// 1-based; 0: the file as a whole.
    pub line: usize,
    /// What is wrong.
    pub problem: Problem,
}

/// What is wrong with a line, or with a file.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
pub enum Problem {
    /// The text is longer than this reader accepts.
    #[error("got {got} bytes of text, expected at most {expected}")]
    TooLong {
        /// Bytes in the text.
        got: usize,
        /// Bytes allowed.
        expected: usize,
    },
    /// More fields or constants than this reader accepts.
    #[error("got more than {expected} fields or constants, expected at most that many")]
    TooManyMembers {
        /// Members allowed.
        expected: usize,
    },
    /// Something other than what the grammar allows at this place.
    #[error("got `{got}`, expected {expected}")]
    Syntax {
        /// The text in question, shortened.
        got: String,
        /// What may stand there.
        expected: &'static str,
    },
    /// A value that its type cannot hold.
    #[error("got value `{got}`, expected a value of type {expected}")]
    Value {
        /// The value as written, shortened.
        got: String,
        /// The type as written.
        expected: String,
    },
    /// Two members of one message with one name.
    #[error("got `{got}` a second time, expected every name once")]
    Duplicate {
        /// The name.
        got: String,
    },
    /// Wrong number of `---` lines.
    #[error("got {got} sections separated by `---`, expected {expected}")]
    Sections {
        /// Sections found.
        got: usize,
        /// Sections that this kind of file has.
        expected: usize,
    },
}

/// `text`, cut to a length that fits into one line of a terminal.
pub(super) fn excerpt(text: &str) -> String {
    const LONGEST: usize = 60;
    let mut out: String = text.chars().take(LONGEST).collect();
    if text.chars().nth(LONGEST).is_some() {
        out.push('…');
    }
    out
}
