//! Lines of named columns: by position, or in the order that a header line gives.

use std::io::BufRead;

use super::field::{Place, fields, is_number, shortened};
use super::lines::Lines;
use crate::OfflineError;

/// The columns that a file may have, the required ones first.
#[derive(Debug, Clone, Copy)]
pub struct Columns {
    /// Names, in the order they have without a header line.
    pub names: &'static [&'static str],
    /// How many of them every file has.
    pub n_required: usize,
}

/// One line.
#[derive(Debug)]
pub struct Record<'a> {
    columns: &'a Columns,
    file: &'a str,
    line: u64,
    fields: &'a [&'a str],
    /// Field of each column.
    positions: &'a [Option<usize>],
}

impl Record<'_> {
    /// The field of a column, and where it stands; empty where there is no such column.
    pub fn field(&self, column: usize) -> (&str, Place<'_>) {
        let position = self.positions[column];
        let place = Place {
            file: self.file,
            line: self.line,
            column: position.unwrap_or(0) + 1,
            name: self.columns.names[column],
        };
        (position.map_or("", |position| self.fields[position]), place)
    }
}

/// Calls `each` with every record of the file; gives which columns it has.
///
/// # Errors
/// What [`Lines`] refuses, unknown columns, lines of another number of fields than the first, and errors of `each`.
pub fn for_each_record<R: BufRead>(
    mut lines: Lines<R>,
    columns: &Columns,
    mut each: impl FnMut(&Record<'_>) -> Result<(), OfflineError>,
) -> Result<Vec<bool>, OfflineError> {
    let file = lines.file().to_owned();
    let mut positions: Option<Vec<Option<usize>>> = None;
    let mut width = 0;
    while let Some((line, text)) = lines.next_line()? {
        let found: Vec<&str> = fields(text).collect();
        let Some(positions) = &positions else {
            width = found.len();
            if is_header(&found) {
                positions = Some(named(columns, &file, line, &found)?);
                continue;
            }
            check_width(columns, &file, line, width)?;
            let in_order: Vec<Option<usize>> =
                (0..columns.names.len()).map(|column| (column < width).then_some(column)).collect();
            each(&Record { columns, file: &file, line, fields: &found, positions: &in_order })?;
            positions = Some(in_order);
            continue;
        };
        if found.len() != width {
            let (got, why) = (found.len(), "as on the first line".to_owned());
            return Err(OfflineError::FieldCount { file, line, got, expected: width.to_string(), why });
        }
        each(&Record { columns, file: &file, line, fields: &found, positions })?;
    }
    let held = positions.map(|positions| positions.iter().map(Option::is_some).collect());
    Ok(held.unwrap_or_else(|| vec![false; columns.names.len()]))
}

/// Whether a first line names columns: no field looks like a number, or like one that is missing.
pub fn is_header(fields: &[&str]) -> bool {
    let is_value = |field: &str| {
        let missing = ["na", "n/a", "null", "none", "?"].iter().any(|word| word.eq_ignore_ascii_case(field));
        missing || is_number(field) || field.starts_with(|first: char| first.is_ascii_digit() || "+-.".contains(first))
    };
    fields.iter().any(|field| !field.is_empty()) && !fields.iter().any(|field| is_value(field))
}

fn check_width(columns: &Columns, file: &str, line: u64, got: usize) -> Result<(), OfflineError> {
    let (least, most) = (columns.n_required, columns.names.len());
    if (least..=most).contains(&got) {
        return Ok(());
    }
    let expected = if least == most { least.to_string() } else { format!("{least} to {most}") };
    Err(OfflineError::FieldCount { file: file.to_owned(), line, got, expected, why: columns.names.join(",") })
}

/// Where each column stands under a header line.
fn named(columns: &Columns, file: &str, line: u64, header: &[&str]) -> Result<Vec<Option<usize>>, OfflineError> {
    let mut positions = vec![None; columns.names.len()];
    let refuse = |got: &str| OfflineError::Header {
        file: file.to_owned(),
        line,
        got: shortened(got),
        expected: columns.names.join(", "),
        n_required: columns.n_required,
    };
    for (position, name) in header.iter().enumerate() {
        // Some programs begin a header line with '#'.
        let name = name.trim_start_matches('#').trim();
        let column = columns.names.iter().position(|known| known.eq_ignore_ascii_case(name));
        match column {
            Some(column) if positions[column].is_none() => positions[column] = Some(position),
            _ => return Err(refuse(name)),
        }
    }
    if positions[..columns.n_required].contains(&None) {
        return Err(refuse(&header.join(",")));
    }
    Ok(positions)
}

#[cfg(test)]
mod tests {
    use super::{Columns, for_each_record, is_header};
    use crate::files::lines::Lines;

    const COLUMNS: Columns = Columns { names: &["less", "more", "confidence"], n_required: 2 };

    fn all(text: &str) -> Result<(Vec<bool>, Vec<[String; 3]>), String> {
        let mut found = Vec::new();
        let held = for_each_record(Lines::new("f".into(), text.as_bytes()), &COLUMNS, |record| {
            found.push([0, 1, 2].map(|column| record.field(column).0.to_owned()));
            Ok(())
        });
        held.map(|held| (held, found)).map_err(|error| error.to_string())
    }

    fn row(fields: [&str; 3]) -> [String; 3] {
        fields.map(str::to_owned)
    }

    #[test]
    fn columns_stand_in_their_order_or_in_that_of_the_header() {
        assert_eq!(all("1,2\n3,4\n"), Ok((vec![true, true, false], vec![row(["1", "2", ""]), row(["3", "4", ""])])));
        let named = Ok((vec![true, true, true], vec![row(["2", "1", "sure"])]));
        assert_eq!(all("# More,less,Confidence\n1,2,sure\n"), named);
        assert_eq!(all("less,more\n"), Ok((vec![true, true, false], vec![])));
        assert_eq!(all(""), Ok((vec![false, false, false], vec![])));
    }

    #[test]
    fn a_header_looks_nothing_like_numbers() {
        for names in [vec!["less", "more"], vec!["# speed", "m/s"], vec!["", "a"], vec!["worst", "…", "best"]] {
            assert!(is_header(&names), "{names:?}");
        }
        for values in
            [vec!["1"], vec!["a", "2"], vec!["nan"], vec!["N/A"], vec!["0.1 0.2"], vec!["1;2"], vec!["-x"], vec![""]]
        {
            assert!(!is_header(&values), "{values:?}");
        }
    }

    #[test]
    fn what_does_not_fit_is_named() {
        let refused = |text: &str| all(text).expect_err("refused");
        assert_eq!(refused("1\n"), "f, line 1: got 1 field, expected 2 to 3 (less,more,confidence)");
        assert_eq!(refused("1,2\n\n3,4,sure"), "f, line 3: got 3 fields, expected 2 (as on the first line)");
        assert!(refused("less,less\n").starts_with("f, line 1: got the column 'less'"));
        assert!(refused("less,better\n").contains("got the column 'better'"));
        assert!(refused("less,confidence\n").contains("got the column 'less,confidence'"));
    }
}
