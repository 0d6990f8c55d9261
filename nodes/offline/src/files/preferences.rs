//! Preferences: `less,more[,confidence[,verdict]]`, rows of trajectories.

use std::io::BufRead;
use std::path::Path;

use likelihood::preferences::{Answer, MAX_ANSWERS, Verdict};

use super::field::{confidence, index};
use super::lines::Lines;
use super::records::{Columns, for_each_record};
use crate::OfflineError;

const COLUMNS: Columns = Columns { names: &["less", "more", "confidence", "verdict"], n_required: 2 };

/// The answers of a file.
#[derive(Debug, Clone, PartialEq)]
pub struct Preferences {
    /// In the order of the file.
    pub answers: Vec<Answer>,
    /// Whether the file has a column of verdicts: the person could say "about equal".
    pub has_verdicts: bool,
}

impl Preferences {
    /// Reads preferences about `n_items` trajectories.
    ///
    /// # Errors
    /// What cannot be read, unknown rows, confidences or verdicts, a trajectory compared with itself, too many answers.
    pub fn read(path: &Path, n_items: usize) -> Result<Self, OfflineError> {
        Self::parse(Lines::of(path)?, n_items)
    }

    fn parse<R: BufRead>(lines: Lines<R>, n_items: usize) -> Result<Self, OfflineError> {
        let file = lines.file().to_owned();
        let mut answers = Vec::new();
        let held = for_each_record(lines, &COLUMNS, |record| {
            let item = |column| {
                let (field, place) = record.field(column);
                index(field, n_items, "a row of the features", &place)
            };
            let (less, more) = (item(0)?, item(1)?);
            if less == more {
                let (field, place) = record.field(1);
                return Err(place.refuse(field, "another row than less"));
            }
            let (field, place) = record.field(2);
            let factor = confidence(field, &place)?;
            let (field, place) = record.field(3);
            let verdict = match field.to_ascii_lowercase().as_str() {
                "" | "strict" => Verdict::Strict,
                "equal" => Verdict::Equal,
                "cant-tell" => Verdict::CantTell,
                _ => return Err(place.refuse(field, "strict, equal or cant-tell")),
            };
            if answers.len() == MAX_ANSWERS {
                let (got, most) = (MAX_ANSWERS + 1, MAX_ANSWERS);
                return Err(OfflineError::TooMany { file: file.clone(), what: "answers", got, most });
            }
            answers.push(Answer { less, more, factor, verdict });
            Ok(())
        })?;
        Ok(Self { answers, has_verdicts: held[3] })
    }
}

#[cfg(test)]
mod tests {
    use super::Preferences;
    use crate::files::lines::Lines;
    use likelihood::preferences::{Answer, Verdict};
    use proptest::prelude::{prop_assert, proptest};

    fn parse(text: &str) -> Result<Preferences, String> {
        Preferences::parse(Lines::new("p".into(), text.as_bytes()), 4).map_err(|error| error.to_string())
    }

    #[test]
    fn each_line_is_an_answer() {
        let answer = |less, more, factor, verdict| Answer { less, more, factor, verdict };
        let strict = answer(0, 3, 1.0, Verdict::Strict);
        assert_eq!(parse("less,more\n0,3\n"), Ok(Preferences { answers: vec![strict], has_verdicts: false }));
        let answers = vec![
            answer(0, 3, 0.5, Verdict::Strict),
            answer(2, 1, 0.25, Verdict::Equal),
            answer(1, 2, 1.0, Verdict::CantTell),
            answer(3, 0, 0.2, Verdict::Strict),
        ];
        let text = "0,3,fairly,strict\n2,1,0.25,equal\n1,2,,Cant-Tell\n3,0,guess,\n";
        assert_eq!(parse(text), Ok(Preferences { answers, has_verdicts: true }));
        let named = parse("less,more,verdict\n0,1,equal\n").expect("good");
        assert_eq!(named.answers, [answer(0, 1, 1.0, Verdict::Equal)]);
        assert_eq!(parse(""), Ok(Preferences { answers: vec![], has_verdicts: false }));
    }

    #[test]
    fn bad_answers_are_named() {
        let refused = |text: &str| parse(text).expect_err("refused");
        assert_eq!(
            refused("0,1\n0,4\n"),
            "p, line 2, column 2 (more): got '4', expected a row of the features: a whole number from 0 to 3"
        );
        assert_eq!(refused("1,1\n"), "p, line 1, column 2 (more): got '1', expected another row than less");
        assert!(refused("0,1,equal\n").contains("column 3 (confidence): got 'equal', expected sure, fairly, guess"));
        assert!(refused("0,1,sure,maybe\n").contains("(verdict): got 'maybe', expected strict, equal or cant-tell"));
        assert!(refused("less,more,verdict\n0,1,x\n").contains("line 2, column 3 (verdict)"));
    }

    proptest! {
        #[test]
        fn any_text_gives_good_answers_or_an_error(text in "([0-5,.\n-]|less|more|verdict|equal|sure|strict|\r\n){0,40}") {
            if let Ok(preferences) = parse(&text) {
                for answer in preferences.answers {
                    prop_assert!(answer.less < 4 && answer.more < 4 && answer.less != answer.more);
                    prop_assert!(answer.factor > 0.0 && answer.factor <= 1.0);
                }
            }
        }
    }
}
