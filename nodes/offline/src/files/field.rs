//! One field of a CSV line: a number, an index, a word.

use crate::OfflineError;

/// Where a field stands.
#[derive(Debug, Clone, Copy)]
pub struct Place<'a> {
    /// Name of the file.
    pub file: &'a str,
    /// From 1.
    pub line: u64,
    /// From 1.
    pub column: usize,
    /// What the column holds: `less`, `feature`, …
    pub name: &'a str,
}

impl Place<'_> {
    /// The error of a field that holds something else than `expected`.
    pub fn refuse(&self, got: &str, expected: impl Into<String>) -> OfflineError {
        let mut expected = expected.into();
        // The usual slips of an export, each told from the field as it was cut at commas.
        let inner = got.trim();
        if inner.contains(';') || inner.contains('\t') || inner.contains(' ') {
            expected.push_str("; fields are separated by commas");
        }
        OfflineError::Field {
            file: self.file.to_owned(),
            line: self.line,
            column: self.column,
            name: self.name.to_owned(),
            got: shortened(got),
            expected,
        }
    }
}

/// At most 40 characters, so that an error stays readable whatever a file holds.
pub fn shortened(text: &str) -> String {
    let mut shown: String = text.chars().take(40).flat_map(char::escape_debug).collect();
    if text.chars().nth(40).is_some() {
        shown.push('…');
    }
    shown
}

/// The fields of a line, trimmed and without the quotes around them.
pub fn fields(line: &str) -> impl Iterator<Item = &str> {
    line.split(',').map(|field| {
        let field = field.trim();
        field.strip_prefix('"').and_then(|inner| inner.strip_suffix('"')).map_or(field, str::trim)
    })
}

/// Whether a field is a number, finite or not.
pub fn is_number(field: &str) -> bool {
    field.parse::<f64>().is_ok()
}

/// A finite number of magnitude at most `largest`.
///
/// # Errors
/// Anything else.
pub fn number(field: &str, largest: f64, place: &Place<'_>) -> Result<f64, OfflineError> {
    match field.parse::<f64>() {
        Ok(value) if value.abs() <= largest => Ok(value),
        _ if largest < f64::MAX => Err(place.refuse(field, format!("a number of magnitude at most {largest:e}"))),
        _ => Err(place.refuse(field, "a finite number")),
    }
}

/// An index from 0 and below `below`, which counts what `what` names. Written as a whole number, `3` or `3.0e0`.
///
/// # Errors
/// Anything else.
pub fn index(field: &str, below: usize, what: &str, place: &Place<'_>) -> Result<usize, OfflineError> {
    let value = field.parse::<usize>().ok().or_else(|| {
        // Programs that know only floating point numbers write indices that way.
        let value = field.parse::<f64>().ok()?;
        (value >= 0.0 && value <= 2_f64.powi(53) && value.fract() == 0.0).then_some(value as usize)
    });
    match value {
        Some(value) if value < below => Ok(value),
        _ if below == 0 => Err(place.refuse(field, format!("{what}, but there are none"))),
        _ => Err(place.refuse(field, format!("{what}: a whole number from 0 to {}", below - 1))),
    }
}

/// A factor on β: `sure` (also when empty), `fairly`, `guess`, or a number above 0 and at most 1.
///
/// # Errors
/// Anything else.
pub fn confidence(field: &str, place: &Place<'_>) -> Result<f64, OfflineError> {
    if let Some((_, factor)) = CONFIDENCES.iter().find(|(word, _)| word.eq_ignore_ascii_case(field)) {
        return Ok(*factor);
    }
    match field.parse::<f64>() {
        Ok(factor) if factor > 0.0 && factor <= 1.0 => Ok(factor),
        _ => Err(place.refuse(field, "sure, fairly, guess, or a number above 0 and at most 1")),
    }
}

/// Words for factors on β; an empty field says nothing against being sure.
const CONFIDENCES: [(&str, f64); 4] = [("", 1.0), ("sure", 1.0), ("fairly", 0.5), ("guess", 0.2)];

#[cfg(test)]
mod tests {
    use super::{Place, confidence, fields, index, number};

    const PLACE: Place<'static> = Place { file: "f", line: 3, column: 2, name: "less" };

    fn refused<T: std::fmt::Debug>(result: Result<T, crate::OfflineError>) -> String {
        result.expect_err("refused").to_string()
    }

    #[test]
    fn fields_lose_spaces_and_quotes() {
        assert_eq!(fields(" 1, \"2\" ,\" a \",,\"").collect::<Vec<_>>(), ["1", "2", "a", "", "\""]);
    }

    #[test]
    fn numbers_are_finite_and_bounded() {
        assert_eq!(number("-1.5e-3", f64::MAX, &PLACE).expect("a number"), -1.5e-3);
        assert_eq!(
            refused(number("nan", f64::MAX, &PLACE)),
            "f, line 3, column 2 (less): got 'nan', expected a finite number"
        );
        assert!(refused(number("1e999", f64::MAX, &PLACE)).ends_with("expected a finite number"));
        assert!(refused(number("1e200", 1e100, &PLACE)).ends_with("expected a number of magnitude at most 1e100"));
        assert!(refused(number("1;2", f64::MAX, &PLACE)).ends_with("fields are separated by commas"));
    }

    #[test]
    fn indices_are_whole_and_in_range() {
        assert_eq!(index("7", 8, "a row", &PLACE).expect("an index"), 7);
        assert_eq!(index("3.000000000000000000e+00", 8, "a row", &PLACE).expect("an index"), 3);
        for bad in ["8", "-1", "1.5", "", "x", "nan", "1e300", "18446744073709551616"] {
            assert!(
                refused(index(bad, 8, "a row", &PLACE)).ends_with("expected a row: a whole number from 0 to 7"),
                "{bad}"
            );
        }
        assert!(refused(index("0", 0, "a row", &PLACE)).ends_with("expected a row, but there are none"));
    }

    #[test]
    fn confidence_is_a_word_or_a_share() {
        for (text, factor) in [("sure", 1.0), ("Fairly", 0.5), ("guess", 0.2), ("", 1.0), ("0.35", 0.35), ("1", 1.0)] {
            assert_eq!(confidence(text, &PLACE).expect("a confidence"), factor);
        }
        for bad in ["0", "1.1", "-0.5", "nan", "very"] {
            assert!(refused(confidence(bad, &PLACE)).contains("expected sure, fairly, guess"), "{bad}");
        }
    }
}
