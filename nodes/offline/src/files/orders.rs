//! Orders of trajectories, a line each: rankings from worst to best, attempts of a learner from first to last.

use std::io::BufRead;
use std::path::Path;

use likelihood::preferences::MAX_ANSWERS;

use super::field::{Place, fields, index};
use super::lines::Lines;
use super::records::is_header;
use crate::OfflineError;

/// Reads orders of some of `n_items` trajectories.
///
/// # Errors
/// What cannot be read, unknown rows, a line of fewer than two or one that names a row twice, too many pairs.
pub fn read_orders(path: &Path, n_items: usize) -> Result<Vec<Vec<usize>>, OfflineError> {
    parse(Lines::of(path)?, n_items)
}

fn parse<R: BufRead>(mut lines: Lines<R>, n_items: usize) -> Result<Vec<Vec<usize>>, OfflineError> {
    let file = lines.file().to_owned();
    let mut orders = Vec::new();
    let mut n_pairs = 0_usize;
    let mut first = true;
    while let Some((line, text)) = lines.next_line()? {
        let found: Vec<&str> = fields(text).collect();
        if std::mem::take(&mut first) && is_header(&found) {
            continue;
        }
        if found.len() < 2 {
            let (got, why) = (found.len(), "rows of the features, in order".to_owned());
            return Err(OfflineError::FieldCount { file, line, got, expected: "at least 2".to_owned(), why });
        }
        n_pairs = n_pairs.saturating_add(found.len() * (found.len() - 1) / 2);
        if n_pairs > MAX_ANSWERS {
            return Err(OfflineError::TooMany { file, what: "pairs", got: n_pairs, most: MAX_ANSWERS });
        }
        let mut order: Vec<usize> = Vec::with_capacity(found.len());
        let mut seen = std::collections::HashSet::with_capacity(found.len());
        for (column, field) in found.iter().enumerate() {
            let place = Place { file: &file, line, column: column + 1, name: "row" };
            let item = index(field, n_items, "a row of the features", &place)?;
            if !seen.insert(item) {
                return Err(place.refuse(field, "every row once"));
            }
            order.push(item);
        }
        orders.push(order);
    }
    Ok(orders)
}

#[cfg(test)]
mod tests {
    use super::parse;
    use crate::files::lines::Lines;
    use proptest::prelude::{prop_assert, proptest};

    fn orders(text: &str) -> Result<Vec<Vec<usize>>, String> {
        parse(Lines::new("r".into(), text.as_bytes()), 4).map_err(|error| error.to_string())
    }

    #[test]
    fn lines_may_be_of_any_length_from_two() {
        assert_eq!(orders("worst,…,best\n0,1\n3,2,0,1\n"), Ok(vec![vec![0, 1], vec![3, 2, 0, 1]]));
        let refused = |text: &str| orders(text).expect_err("refused");
        assert_eq!(refused("0,1\n2\n"), "r, line 2: got 1 field, expected at least 2 (rows of the features, in order)");
        assert_eq!(refused("0,1,0\n"), "r, line 1, column 3 (row): got '0', expected every row once");
        assert!(refused("0,4\n").contains("line 1, column 2 (row): got '4'"));
        assert_eq!(orders(""), Ok(vec![]));
    }

    proptest! {
        #[test]
        fn any_text_gives_good_orders_or_an_error(text in "[0-4,\n]{0,30}") {
            for order in orders(&text).unwrap_or_default() {
                prop_assert!(order.len() >= 2 && order.iter().all(|item| *item < 4));
            }
        }
    }
}
