//! What was asked about a world before, by the answers in force: ids of questions say what they are about.

use crate::question_id::{question_answered, question_skipped, world_subject};
use crate::settings::QuestionKind;
use apprentice_msgs::msg::EvidenceLog;
use exchange::in_force;
use std::collections::BTreeSet;

/// A question that was answered comes again only after this many others.
const RESTS: usize = 8;

/// What a question is about.
type About = (QuestionKind, usize);

/// What need not be asked now.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub(crate) struct Rests {
    /// Questions whose answer is in force, skipped ones too.
    pub n: usize,
    /// Those that a person would not answer.
    skipped: BTreeSet<About>,
    /// The newest that were answered.
    answered: BTreeSet<About>,
}

impl Rests {
    /// From everything that a revision takes in; none until the log holds that.
    pub fn new(log: &EvidenceLog, revision: u64) -> Option<Self> {
        let records = log.records.get(..usize::try_from(revision).ok()?)?;
        let mut rests = Self::default();
        let mut answered = Vec::new();
        for record in in_force(records) {
            let skipped = question_skipped(record).and_then(|id| about(id));
            let answer = question_answered(record).and_then(|id| about(id));
            rests.n += usize::from(skipped.is_some() || answer.is_some());
            rests.skipped.extend(skipped);
            answered.extend(answer);
        }
        rests.answered = answered.into_iter().rev().take(RESTS).collect();
        Some(rests)
    }

    /// Takes it that one more question will have been answered.
    pub fn answer(&mut self, kind: QuestionKind, state: usize) {
        self.n += 1;
        self.answered.insert((kind, state));
    }

    /// Whether a question need not be asked now: level 0 leaves out what was answered lately or skipped, level 1 what was
    /// skipped, level 2 nothing.
    pub fn holds(&self, level: usize, kind: QuestionKind, state: usize) -> bool {
        (level < 2 && self.skipped.contains(&(kind, state))) || (level < 1 && self.answered.contains(&(kind, state)))
    }
}

/// What a question about a world is about, by its id.
fn about(id: &str) -> Option<About> {
    let subject = world_subject(id)?;
    let kind = match subject.chars().next()? {
        'a' | 'A' => QuestionKind::Action,
        'k' | 'K' => QuestionKind::Critique,
        'c' | 'C' => QuestionKind::Comparison,
        _ => return None,
    };
    Some((kind, subject[1..].parse().ok()?))
}

#[cfg(test)]
mod tests {
    use super::{RESTS, Rests, about};
    use crate::question_id::world_query_id;
    use crate::settings::QuestionKind;
    use apprentice_msgs::msg::{ActionDemonstration, EvidenceLog, EvidenceRecord, QueryResponse, Retraction};

    fn action(n: u64, state: usize) -> EvidenceRecord {
        let query_id = world_query_id(n - 1, QuestionKind::Action, state, false, "00ff");
        let actions = ActionDemonstration { id: format!("e{n}"), query_id, ..ActionDemonstration::default() };
        EvidenceRecord { sequence: n, actions: vec![actions], ..EvidenceRecord::default() }
    }

    #[test]
    fn ids_say_what_questions_are_about_and_other_ids_say_nothing() {
        for kind in [QuestionKind::Action, QuestionKind::Critique, QuestionKind::Comparison] {
            assert_eq!(about(&world_query_id(12, kind, 345, false, "00ff")), Some((kind, 345)));
        }
        for other in ["", "w", "w1", "w1-", "w1-x3-0", "q1-a3-0", "w-a3-0", "w1-a-0", "w1-é-0"] {
            assert_eq!(about(other), None, "{other}");
        }
    }

    #[test]
    fn an_answer_rests_for_a_while_a_skip_for_good_and_what_was_taken_back_not_at_all() {
        let skip = QueryResponse {
            id: "e2".into(),
            query_id: world_query_id(1, QuestionKind::Critique, 7, true, "00ff"),
            ..QueryResponse::default()
        };
        let mut records =
            vec![action(1, 5), EvidenceRecord { sequence: 2, response: vec![skip], ..EvidenceRecord::default() }];
        let log = EvidenceLog { records: records.clone(), ..EvidenceLog::default() };
        assert_eq!(Rests::new(&log, 3), None, "the log is older than the posterior");
        let rests = Rests::new(&log, 2).expect("it holds two");
        assert_eq!(rests.n, 2);
        assert!(rests.holds(0, QuestionKind::Action, 5) && rests.holds(0, QuestionKind::Critique, 7));
        assert!(!rests.holds(0, QuestionKind::Critique, 5) && !rests.holds(0, QuestionKind::Action, 7));
        assert!(!rests.holds(1, QuestionKind::Action, 5) && rests.holds(1, QuestionKind::Critique, 7));
        assert!(!rests.holds(2, QuestionKind::Critique, 7));
        records.extend((0..RESTS as u64).map(|i| action(3 + i, 100 + i as usize)));
        let n = records.len() as u64;
        let later = Rests::new(&EvidenceLog { records: records.clone(), ..EvidenceLog::default() }, n).expect("all");
        assert!(!later.holds(0, QuestionKind::Action, 5) && later.holds(0, QuestionKind::Critique, 7));
        for id in ["e1", "e2"] {
            let undo = Retraction { evidence_id: id.into(), ..Retraction::default() };
            records.push(EvidenceRecord { retraction: vec![undo], ..EvidenceRecord::default() });
        }
        let undone = Rests::new(&EvidenceLog { records, ..EvidenceLog::default() }, n + 2).expect("all");
        assert!(!undone.holds(0, QuestionKind::Critique, 7) && undone.n == RESTS);
    }
}
