//! State–action pairs: `state,action[,verdict[,confidence[,trajectory]]]`.

use std::collections::HashMap;
use std::io::BufRead;
use std::path::Path;

use likelihood::actions::{Choice, ChoiceVerdict};
use mdp::Mdp;

use super::field::{confidence, index};
use super::lines::Lines;
use super::records::{Columns, Record, for_each_record};
use crate::OfflineError;

/// More pairs are refused.
pub const MAX_CHOICES: usize = 1_000_000;

const NAMES: [&str; 5] = ["state", "action", "verdict", "confidence", "trajectory"];
const DEMONSTRATIONS: Columns = Columns { names: &NAMES, n_required: 2 };
const CRITIQUES: Columns = Columns { names: &NAMES, n_required: 3 };

/// Reads what was shown: pairs that were taken where nothing else is said.
///
/// # Errors
/// What cannot be read, states and actions out of range, unknown verdicts or confidences, too many pairs.
pub fn read_demonstrations(path: &Path, mdp: &Mdp) -> Result<Vec<Choice>, OfflineError> {
    parse(Lines::of(path)?, mdp, &DEMONSTRATIONS)
}

/// Reads what was judged: each pair is good or bad.
///
/// # Errors
/// As [`read_demonstrations`]; a pair without a verdict.
pub fn read_critiques(path: &Path, mdp: &Mdp) -> Result<Vec<Choice>, OfflineError> {
    parse(Lines::of(path)?, mdp, &CRITIQUES)
}

fn parse<R: BufRead>(lines: Lines<R>, mdp: &Mdp, columns: &Columns) -> Result<Vec<Choice>, OfflineError> {
    let file = lines.file().to_owned();
    let judged = columns.n_required > 2;
    let mut choices = Vec::new();
    for_each_record(lines, columns, |record| {
        let (state, action) = pair(record, mdp)?;
        let (field, place) = record.field(2);
        let verdict = match field.to_ascii_lowercase().as_str() {
            "good" => ChoiceVerdict::Good,
            "bad" => ChoiceVerdict::Bad,
            "" | "taken" if !judged => ChoiceVerdict::Taken,
            _ if judged => return Err(place.refuse(field, "good or bad")),
            _ => return Err(place.refuse(field, "taken, good or bad")),
        };
        if verdict == ChoiceVerdict::Bad && mdp.n_actions() == 1 {
            return Err(place.refuse(field, "good: there is no other action to take"));
        }
        let (field, place) = record.field(3);
        let factor = confidence(field, &place)?;
        if choices.len() == MAX_CHOICES {
            let (got, most) = (MAX_CHOICES + 1, MAX_CHOICES);
            return Err(OfflineError::TooMany { file: file.clone(), what: "pairs", got, most });
        }
        choices.push(Choice { state, action, verdict, factor });
        Ok(())
    })?;
    Ok(choices)
}

/// Reads what was shown as trajectories, each in the order of time: those that the column `trajectory` names, or a single one.
///
/// # Errors
/// As [`read_demonstrations`]; a pair that was judged rather than taken, or that cannot follow the one before.
pub fn read_trajectories(path: &Path, mdp: &Mdp) -> Result<Vec<Vec<(usize, usize)>>, OfflineError> {
    trajectories(Lines::of(path)?, mdp)
}

fn trajectories<R: BufRead>(lines: Lines<R>, mdp: &Mdp) -> Result<Vec<Vec<(usize, usize)>>, OfflineError> {
    let file = lines.file().to_owned();
    let mut numbers: HashMap<String, usize> = HashMap::new();
    let mut found: Vec<Vec<(usize, usize)>> = Vec::new();
    let mut n = 0;
    for_each_record(lines, &DEMONSTRATIONS, |record| {
        let (state, action) = pair(record, mdp)?;
        let (field, place) = record.field(2);
        if !(field.is_empty() || field.eq_ignore_ascii_case("taken")) {
            return Err(place.refuse(field, "taken: what was judged is no demonstration"));
        }
        let (field, _) = record.field(4);
        let number = *numbers.entry(field.to_owned()).or_insert(found.len());
        if number == found.len() {
            found.push(Vec::new());
        }
        if let Some(&(before, by)) = found[number].last()
            && !mdp.successors(before, by).any(|(target, _)| target == state)
        {
            let (field, place) = record.field(0);
            let expected = format!(
                "a state that action {by} in state {before} leads to; the column trajectory tells demonstrations apart"
            );
            return Err(place.refuse(field, expected));
        }
        n += 1;
        if n > MAX_CHOICES {
            return Err(OfflineError::TooMany { file: file.clone(), what: "pairs", got: n, most: MAX_CHOICES });
        }
        found[number].push((state, action));
        Ok(())
    })?;
    if found.is_empty() {
        return Err(OfflineError::Empty { file, expected: "a demonstration".to_owned() });
    }
    Ok(found)
}

/// State and action of a record.
fn pair(record: &Record<'_>, mdp: &Mdp) -> Result<(usize, usize), OfflineError> {
    let (field, place) = record.field(0);
    let state = index(field, mdp.n_states(), "a state", &place)?;
    let (field, place) = record.field(1);
    Ok((state, index(field, mdp.n_actions(), "an action", &place)?))
}

#[cfg(test)]
mod tests {
    use super::{CRITIQUES, DEMONSTRATIONS, parse, trajectories};
    use crate::files::lines::Lines;
    use likelihood::actions::{Choice, ChoiceVerdict};
    use mdp::{Features, Mdp, MdpParts};
    use proptest::prelude::{prop_assert, proptest};

    /// Three states in a row and two actions: on, and back; the last state is terminal.
    fn process() -> Mdp {
        Mdp::new(MdpParts {
            gamma: 0.9,
            n_states: 3,
            n_actions: 2,
            n_features: 1,
            initial: vec![1.0, 0.0, 0.0],
            transitions: vec![(0, 0, 1, 1.0), (0, 1, 0, 1.0), (1, 0, 2, 1.0), (1, 1, 0, 1.0)],
            features: Features::State(vec![0.0, 1.0, 2.0]),
            actions: vec![],
            shape: None,
        })
        .expect("a process")
    }

    fn demonstrations(text: &str) -> Result<Vec<Choice>, String> {
        let lines = Lines::new("d".into(), text.as_bytes());
        parse(lines, &process(), &DEMONSTRATIONS).map_err(|error| error.to_string())
    }

    #[test]
    fn pairs_are_taken_good_or_bad() {
        let choice = |state, action, verdict, factor| Choice { state, action, verdict, factor };
        assert_eq!(demonstrations("state,action\n2,1\n"), Ok(vec![choice(2, 1, ChoiceVerdict::Taken, 1.0)]));
        let text = "0,0,taken,sure\n1,1,good,fairly\n2,0,bad,0.3\n0,1,,\n";
        let want = vec![
            choice(0, 0, ChoiceVerdict::Taken, 1.0),
            choice(1, 1, ChoiceVerdict::Good, 0.5),
            choice(2, 0, ChoiceVerdict::Bad, 0.3),
            choice(0, 1, ChoiceVerdict::Taken, 1.0),
        ];
        assert_eq!(demonstrations(text), Ok(want));
        let refused = |text: &str| demonstrations(text).expect_err("refused");
        assert!(refused("3,0\n").contains("column 1 (state): got '3', expected a state: a whole number from 0 to 2"));
        assert!(
            refused("0,2\n").contains("column 2 (action): got '2', expected an action: a whole number from 0 to 1")
        );
        assert!(refused("0,1,meh\n").contains("expected taken, good or bad"));
    }

    #[test]
    fn critiques_need_a_verdict() {
        let critiques = |text: &str| {
            parse(Lines::new("c".into(), text.as_bytes()), &process(), &CRITIQUES).map_err(|error| error.to_string())
        };
        assert_eq!(critiques("0,1,bad\n").map(|choices| choices.len()), Ok(1));
        assert!(critiques("0,1\n").expect_err("refused").contains("got 2 fields, expected 3 to 5"));
        assert!(critiques("0,1,taken\n").expect_err("refused").contains("expected good or bad"));
    }

    #[test]
    fn trajectories_are_possible_ways_through_the_process() {
        let read = |text: &str| {
            trajectories(Lines::new("d".into(), text.as_bytes()), &process()).map_err(|error| error.to_string())
        };
        assert_eq!(read("0,0\n1,1\n0,0\n1,0\n2,0\n"), Ok(vec![vec![(0, 0), (1, 1), (0, 0), (1, 0), (2, 0)]]));
        let told_apart = read("state,action,trajectory\n0,0,a\n1,0,b\n1,0,a\n2,1,b\n");
        assert_eq!(told_apart, Ok(vec![vec![(0, 0), (1, 0)], vec![(1, 0), (2, 1)]]));
        let refused = read("0,0\n0,0\n").expect_err("refused");
        assert!(
            refused.contains("line 2, column 1 (state): got '0', expected a state that action 0 in state 0 leads to")
        );
        assert!(read("0,0,bad\n").expect_err("refused").contains("what was judged is no demonstration"));
        assert_eq!(read("state,action\n").expect_err("refused"), "d: holds nothing, expected a demonstration");
    }

    proptest! {
        #[test]
        fn any_text_gives_good_pairs_or_an_error(text in "([0-4,.\n]|state|action|taken|good|bad|sure){0,40}") {
            for choice in demonstrations(&text).unwrap_or_default() {
                prop_assert!(choice.state < 3 && choice.action < 2 && choice.factor > 0.0);
            }
        }
    }
}
