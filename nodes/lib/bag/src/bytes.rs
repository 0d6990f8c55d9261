//! A bounded little-endian cursor over the bytes of one record.
//!
//! The `mcap` crate's own record parser reserves whatever length a string claims (up to 4 GiB) before it looks how
//! many bytes there are, so records from outside are parsed here.

use std::collections::BTreeMap;

/// Why a record's bytes could not be parsed.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub(crate) enum ParseError {
    #[error("{what} needs {needed} bytes, {available} are left in the record")]
    Short { what: &'static str, needed: u64, available: usize },
    #[error("{what} is not UTF-8")]
    NotUtf8 { what: &'static str },
    #[error("{0}")]
    Meaning(String),
}

/// Reads fields from the front of a slice.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Bytes<'a> {
    rest: &'a [u8],
}

impl<'a> Bytes<'a> {
    pub(crate) fn new(bytes: &'a [u8]) -> Bytes<'a> {
        Bytes { rest: bytes }
    }

    pub(crate) fn rest(&self) -> &'a [u8] {
        self.rest
    }

    pub(crate) fn take(&mut self, n: u64, what: &'static str) -> Result<&'a [u8], ParseError> {
        let short = ParseError::Short { what, needed: n, available: self.rest.len() };
        let n = usize::try_from(n).map_err(|_| short.clone())?;
        let (head, rest) = self.rest.split_at_checked(n).ok_or(short)?;
        self.rest = rest;
        Ok(head)
    }

    fn array<const N: usize>(&mut self, what: &'static str) -> Result<[u8; N], ParseError> {
        let mut bytes = [0; N];
        bytes.copy_from_slice(self.take(N as u64, what)?);
        Ok(bytes)
    }

    pub(crate) fn u8(&mut self, what: &'static str) -> Result<u8, ParseError> {
        self.array::<1>(what).map(|[byte]| byte)
    }

    pub(crate) fn u16(&mut self, what: &'static str) -> Result<u16, ParseError> {
        self.array(what).map(u16::from_le_bytes)
    }

    pub(crate) fn u32(&mut self, what: &'static str) -> Result<u32, ParseError> {
        self.array(what).map(u32::from_le_bytes)
    }

    pub(crate) fn u64(&mut self, what: &'static str) -> Result<u64, ParseError> {
        self.array(what).map(u64::from_le_bytes)
    }

    pub(crate) fn string(&mut self, what: &'static str) -> Result<String, ParseError> {
        let length = self.u32(what)?;
        let bytes = self.take(u64::from(length), what)?;
        std::str::from_utf8(bytes).map(str::to_owned).map_err(|_| ParseError::NotUtf8 { what })
    }

    pub(crate) fn string_map(&mut self, what: &'static str) -> Result<BTreeMap<String, String>, ParseError> {
        let length = self.u32(what)?;
        let mut inside = Bytes::new(self.take(u64::from(length), what)?);
        let mut map = BTreeMap::new();
        while !inside.rest.is_empty() {
            let key = inside.string(what)?;
            map.insert(key, inside.string(what)?);
        }
        Ok(map)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_string_that_claims_four_gigabytes_is_refused_without_reserving_them() {
        let error = Bytes::new(&[0xff, 0xff, 0xff, 0xff, b'x']).string("topic");
        assert_eq!(error, Err(ParseError::Short { what: "topic", needed: u64::from(u32::MAX), available: 1 }));
    }

    #[test]
    fn a_map_cannot_read_past_its_own_length() {
        // The map claims 5 bytes, its first key claims 4 of which only 1 is inside the map.
        let error = Bytes::new(&[5, 0, 0, 0, 4, 0, 0, 0, b'a', b'b', b'c', b'd']).string_map("metadata");
        assert!(matches!(error, Err(ParseError::Short { needed: 4, available: 1, .. })));
    }
}
