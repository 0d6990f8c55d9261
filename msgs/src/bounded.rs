//! Sequences and strings whose length the interface bounds: a longer one is refused when read.

use serde::de::Error;
use serde::{Deserialize, Deserializer};

/// What an interface bounds: elements of a sequence, bytes of a string.
pub(crate) trait Length {
    /// How many there are.
    fn length(&self) -> usize;
}

impl<T> Length for Vec<T> {
    fn length(&self) -> usize {
        self.len()
    }
}

impl Length for String {
    fn length(&self) -> usize {
        self.len()
    }
}

/// Reads a sequence of at most `N` elements, or a string of at most `N` bytes.
pub(crate) fn at_most<'de, D, T, const N: usize>(deserializer: D) -> Result<T, D::Error>
where
    D: Deserializer<'de>,
    T: Deserialize<'de> + Length,
{
    let value = T::deserialize(deserializer)?;
    if value.length() > N {
        let message = format!("got length {}, expected at most {N}", value.length());
        return Err(D::Error::custom(message));
    }
    Ok(value)
}

#[cfg(test)]
mod tests {
    use super::at_most;
    use serde::de::IntoDeserializer;
    use serde::de::value::{Error, SeqDeserializer, StrDeserializer};

    #[test]
    fn a_string_longer_than_its_bound_is_refused() {
        let read = |text: &'static str| {
            let deserializer: StrDeserializer<'_, Error> = text.into_deserializer();
            at_most::<_, String, 3>(deserializer)
        };
        assert_eq!(read("abc").as_deref(), Ok("abc"));
        let error = read("abcd").expect_err("too long").to_string();
        assert_eq!(error, "got length 4, expected at most 3");
    }

    #[test]
    fn a_sequence_longer_than_its_bound_is_refused() {
        let read = |elements: Vec<u8>| {
            let deserializer: SeqDeserializer<_, Error> = elements.into_deserializer();
            at_most::<_, Vec<u8>, 1>(deserializer)
        };
        assert_eq!(read(vec![7]), Ok(vec![7]));
        assert!(read(vec![7, 8]).is_err());
    }
}
