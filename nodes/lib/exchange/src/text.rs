//! Ids and names: neither empty nor without end.

use thiserror::Error;

/// Longer ids are refused, bytes.
pub const MAX_ID: usize = 128;

/// An id or a name that cannot be used.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[error("{what} has {got} characters; 1 to {MAX_ID} are allowed")]
pub struct TextError {
    /// Of what.
    pub what: &'static str,
    /// Got.
    pub got: usize,
}

/// Refuses an id that is empty or too long.
pub(crate) fn check_id(what: &'static str, id: &str) -> Result<(), TextError> {
    if id.is_empty() || id.len() > MAX_ID { Err(TextError { what, got: id.len() }) } else { Ok(()) }
}

/// A text cut to what fits a sentence to a person.
pub(crate) fn shown(text: &str) -> String {
    text.chars().take(MAX_ID).collect()
}
