//! Questions that were chosen while the person thought, for when the robot has not learned from the last answer in time.

use crate::question_id::{question_answered, question_skipped};
use apprentice_msgs::msg::{EvidenceLog, WorldQuery};

/// The open question with those that may follow it, and how long the person has waited for the next.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Ahead {
    /// The first was asked by the posterior of its revision, each further one is of the revision that an answer makes.
    queries: Vec<WorldQuery>,
    /// Of these, so many have been asked.
    asked: usize,
    /// Ticks since the last of them was answered.
    waited: u32,
}

impl Ahead {
    /// With the open question alone: what may follow is not known yet.
    pub fn new(open: WorldQuery) -> Self {
        Self { queries: vec![open], asked: 1, waited: 0 }
    }

    /// The open question, while nothing is known of what may follow it.
    pub fn bare(&self) -> Option<&WorldQuery> {
        self.queries.first().filter(|_| self.queries.len() == 1)
    }

    /// Takes what follows the open question.
    pub fn follow(&mut self, queries: Vec<WorldQuery>) {
        if queries.first().is_some_and(|first| first.id == self.queries[0].id) {
            self.queries = queries;
        }
    }

    /// One more tick has passed: the question to ask now, once the person has waited for `patience` of them. All that were asked
    /// must have been answered, and nothing else must have been said since.
    pub fn tick(&mut self, log: &EvidenceLog, patience: u32) -> Option<WorldQuery> {
        let before = usize::try_from(self.queries[0].revision).ok()?;
        let answers = log.records.get(before..)?;
        let is_answered = answers.len() == self.asked
            && answers
                .iter()
                .zip(&self.queries)
                .all(|(record, query)| question_answered(record).or(question_skipped(record)) == Some(&query.id));
        if !is_answered {
            self.waited = 0;
            return None;
        }
        self.waited += 1;
        let next = self.queries.get(self.asked).filter(|_| self.waited >= patience)?.clone();
        self.asked += 1;
        self.waited = 0;
        Some(next)
    }
}

#[cfg(test)]
mod tests {
    use super::Ahead;
    use apprentice_msgs::msg::{
        ActionDemonstration, EvidenceLog, EvidenceRecord, QueryResponse, Retraction, WorldQuery,
    };

    fn query(revision: u64) -> WorldQuery {
        WorldQuery { id: format!("w{revision}"), revision, ..WorldQuery::default() }
    }

    fn act(query_id: &str) -> EvidenceRecord {
        let shown = ActionDemonstration { query_id: query_id.into(), ..ActionDemonstration::default() };
        EvidenceRecord { actions: vec![shown], ..EvidenceRecord::default() }
    }

    fn respond(query_id: &str, kind: u8) -> EvidenceRecord {
        let response = QueryResponse { query_id: query_id.into(), kind, ..QueryResponse::default() };
        EvidenceRecord { response: vec![response], ..EvidenceRecord::default() }
    }

    fn log(records: &[EvidenceRecord]) -> EvidenceLog {
        EvidenceLog { records: records.to_vec(), ..EvidenceLog::default() }
    }

    fn ahead() -> Ahead {
        let mut ahead = Ahead::new(query(1));
        ahead.follow(vec![query(1), query(2), query(3)]);
        ahead
    }

    #[test]
    fn each_comes_after_the_answer_to_the_one_before_and_a_wait_and_none_comes_twice() {
        let mut ahead = ahead();
        let mut records = vec![act("")];
        assert_eq!(ahead.tick(&log(&records), 1), None, "the open question waits for its answer");
        records.push(act("w1"));
        assert_eq!(ahead.tick(&log(&records), 2), None);
        assert_eq!(ahead.tick(&log(&records), 2), Some(query(2)));
        assert!((0..5).all(|_| ahead.tick(&log(&records), 2).is_none()), "asked once");
        records.push(respond("w2", QueryResponse::SKIP));
        assert_eq!(ahead.tick(&log(&records), 1), Some(query(3)));
        records.push(act("w3"));
        assert!((0..5).all(|_| ahead.tick(&log(&records), 1).is_none()), "there are no more");
    }

    #[test]
    fn whatever_else_is_said_ends_them() {
        let undo = EvidenceRecord { retraction: vec![Retraction::default()], ..EvidenceRecord::default() };
        for other in [undo, act(""), act("w9"), respond("w1", QueryResponse::PAUSE), respond("", QueryResponse::SKIP)] {
            let mut ahead = ahead();
            assert_eq!(ahead.tick(&log(&[act(""), other.clone()]), 1), None, "{other:?}");
            assert_eq!(ahead.tick(&log(&[act(""), act("w1"), other.clone()]), 1), None, "{other:?}");
        }
        assert_eq!(ahead().tick(&log(&[]), 1), None, "a log from before");
    }

    #[test]
    fn what_follows_another_question_is_not_taken() {
        let mut ahead = Ahead::new(query(1));
        ahead.follow(vec![query(7), query(8)]);
        assert_eq!(ahead.bare(), Some(&query(1)));
        assert_eq!(ahead.tick(&log(&[act(""), act("w1")]), 1), None);
    }
}
