//! A table of numbers: features, draws, weights, losses.

use std::io::BufRead;
use std::path::Path;

use super::field::{Place, fields, number};
use super::lines::Lines;
use super::records::is_header;
use crate::OfflineError;

/// Tables of more columns are refused.
pub const MAX_COLUMNS: usize = 4096;
/// Tables of more numbers are refused.
pub const MAX_NUMBERS: usize = 1 << 26;

/// Rows of equally many finite numbers.
#[derive(Debug, Clone, PartialEq)]
pub struct Table {
    /// Name of the file.
    pub file: String,
    /// Columns, at least 1.
    pub n_columns: usize,
    /// Row by row; at least one row.
    pub values: Vec<f64>,
    /// Whether the first row reads 0, 1, 2, …, as the names of columns that have none.
    pub begins_with_counting: bool,
}

/// What a table must be.
#[derive(Debug, Clone, Copy)]
pub struct Wanted<'a> {
    /// What one number is: `feature`, `loss`, …
    pub name: &'a str,
    /// Columns and why so many; `None`: as many as the first row has.
    pub columns: Option<(usize, &'a str)>,
    /// Largest magnitude.
    pub largest: f64,
}

impl Table {
    /// Reads a table.
    ///
    /// # Errors
    /// What cannot be read, holds other things than finite numbers, is ragged, empty, or too large.
    pub fn read(path: &Path, wanted: &Wanted<'_>) -> Result<Self, OfflineError> {
        Self::parse(Lines::of(path)?, wanted)
    }

    /// Number of rows.
    pub fn n_rows(&self) -> usize {
        self.values.len() / self.n_columns
    }

    /// One row, an index below [`Table::n_rows`].
    pub fn row(&self, row: usize) -> &[f64] {
        &self.values[row * self.n_columns..(row + 1) * self.n_columns]
    }

    /// As [`Table::read`], from lines.
    pub(crate) fn parse<R: BufRead>(mut lines: Lines<R>, wanted: &Wanted<'_>) -> Result<Self, OfflineError> {
        let file = lines.file().to_owned();
        let mut values: Vec<f64> = Vec::new();
        let mut n_columns = wanted.columns.map(|(n, _)| n);
        let mut first = true;
        while let Some((line, text)) = lines.next_line()? {
            if first {
                first = false;
                let found: Vec<&str> = fields(text).collect();
                if is_header(&found) {
                    continue;
                }
            }
            let before = values.len();
            for (column, field) in fields(text).enumerate() {
                let place = Place { file: &file, line, column: column + 1, name: wanted.name };
                values.push(number(field, wanted.largest, &place)?);
            }
            let got = values.len() - before;
            if got > MAX_COLUMNS {
                return Err(OfflineError::TooMany { file, what: "columns", got, most: MAX_COLUMNS });
            }
            if values.len() > MAX_NUMBERS {
                let (got, most) = (values.len(), MAX_NUMBERS);
                return Err(OfflineError::TooMany { file, what: "numbers", got, most });
            }
            let expected = *n_columns.get_or_insert(got);
            if got != expected {
                let why = wanted.columns.map_or("as on the first line", |(_, why)| why).to_owned();
                return Err(OfflineError::FieldCount { file, line, got, expected: expected.to_string(), why });
            }
        }
        match n_columns {
            Some(n_columns) if !values.is_empty() => {
                let counting = n_columns > 1 && (0..n_columns).all(|column| values[column] == column as f64);
                Ok(Self { file, n_columns, values, begins_with_counting: counting })
            }
            _ => Err(OfflineError::Empty { file, expected: format!("a row of numbers ({})", wanted.name) }),
        }
    }

    /// What is suspicious about the table, in words.
    pub fn suspicion(&self) -> Option<String> {
        self.begins_with_counting.then(|| {
            format!(
                "{}: the first row reads 0, 1, 2, … and counts as data; if those are the names of columns, leave it out",
                self.file
            )
        })
    }
}

#[cfg(test)]
mod tests {
    use super::{MAX_COLUMNS, Table, Wanted};
    use crate::files::lines::Lines;
    use proptest::prelude::{any, prop_assert, prop_assert_eq, proptest};

    const ANY: Wanted<'static> = Wanted { name: "feature", columns: None, largest: f64::MAX };

    fn parse(text: &[u8], wanted: &Wanted<'_>) -> Result<Table, String> {
        Table::parse(Lines::new("f".into(), text), wanted).map_err(|error| error.to_string())
    }

    #[test]
    fn headers_blank_lines_and_line_ends_do_not_matter() {
        let want =
            Table { file: "f".into(), n_columns: 2, values: vec![0.5, -1e-3, 7.0, 2.0], begins_with_counting: false };
        for text in ["0.5,-1e-3\n7,2\n", "\u{feff}a,b\r\n0.5, -0.001\r\n\r\n7,2", "# a, b\n\n\"0.5\",-1E-3\n7.0,+2\n"] {
            assert_eq!(parse(text.as_bytes(), &ANY), Ok(want.clone()), "{text:?}");
        }
    }

    #[test]
    fn what_is_no_table_is_refused_with_its_place() {
        let refused = |text: &str| parse(text.as_bytes(), &ANY).expect_err("refused");
        assert_eq!(refused("1,2\n3\n"), "f, line 2: got 1 field, expected 2 (as on the first line)");
        assert_eq!(refused("a,b\n1,x\n"), "f, line 2, column 2 (feature): got 'x', expected a finite number");
        assert_eq!(refused("1,inf\n"), "f, line 1, column 2 (feature): got 'inf', expected a finite number");
        assert_eq!(refused("1,2\n3,\n"), "f, line 2, column 2 (feature): got '', expected a finite number");
        assert_eq!(refused("a,b\n"), "f: holds nothing, expected a row of numbers (feature)");
        assert!(refused(&"0,".repeat(MAX_COLUMNS + 1).replace("0,", "1,")).contains("got ''"));
        let wide = vec!["1"; MAX_COLUMNS + 1].join(",");
        assert_eq!(refused(&wide), "f: holds 4097 columns, but at most 4096 are supported");
        let losses = Wanted { name: "loss", columns: Some((1, "one loss a line")), largest: f64::MAX };
        assert_eq!(
            parse(b"1\n2,3\n", &losses),
            Err("f, line 2: got 2 fields, expected 1 (one loss a line)".to_owned())
        );
    }

    #[test]
    fn a_row_of_column_numbers_is_suspicious() {
        assert!(parse(b"0,1,2\n5,6,7\n", &ANY).expect("a table").suspicion().is_some());
        assert!(parse(b"0\n1\n", &ANY).expect("a table").suspicion().is_none());
    }

    proptest! {
        #[test]
        fn any_bytes_give_a_table_or_an_error(bytes in proptest::collection::vec(any::<u8>(), 0..200)) {
            if let Ok(table) = parse(&bytes, &ANY) {
                prop_assert_eq!(table.values.len() % table.n_columns, 0);
                prop_assert!(table.values.iter().all(|value| value.is_finite()));
            }
        }

        #[test]
        fn near_tables_give_a_table_or_an_error(text in "([0-9.eE+,\" \r\n;-]|nan|inf|x){0,80}") {
            if let Ok(table) = parse(text.as_bytes(), &ANY) {
                prop_assert!(table.n_rows() >= 1 && table.values.iter().all(|value| value.is_finite()));
            }
        }

        #[test]
        fn numbers_read_back_as_the_same_bits(values in proptest::collection::vec(any::<f64>(), 1..40)) {
            let values: Vec<f64> = values.into_iter().filter(|value| value.is_finite()).collect();
            let text: String = values.iter().map(|value| format!("{value:?}\n")).collect();
            if !values.is_empty() {
                let table = parse(text.as_bytes(), &ANY).expect("a table");
                let bits = |values: &[f64]| values.iter().map(|value| value.to_bits()).collect::<Vec<_>>();
                prop_assert_eq!(bits(&table.values), bits(&values));
            }
        }
    }
}
