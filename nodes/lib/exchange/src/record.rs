//! Records of accepted events: what each kind has in common.

use apprentice_msgs::msg::{EvidenceRecord, QueryResponse};
use apprentice_msgs::std_msgs::Header;
use std::collections::HashSet;

/// Id of the event in a record; empty for a table or a world, which are no evidence.
pub fn record_id(record: &EvidenceRecord) -> &str {
    let id: Option<&String> = None
        .or(record.demonstration.first().map(|m| &m.id))
        .or(record.retraction.first().map(|m| &m.id))
        .or(record.response.first().map(|m| &m.id))
        .or(record.actions.first().map(|m| &m.id))
        .or(record.preference.first().map(|m| &m.id))
        .or(record.critique.first().map(|m| &m.id))
        .or(record.history.first().map(|m| &m.id));
    id.map_or("", String::as_str)
}

/// Header of the event in a record; none for a world, which is named by reference.
pub fn record_header(record: &EvidenceRecord) -> Option<&Header> {
    let header: Option<&Header> = None
        .or(record.demonstration.first().map(|m| &m.header))
        .or(record.retraction.first().map(|m| &m.header))
        .or(record.response.first().map(|m| &m.header))
        .or(record.actions.first().map(|m| &m.header))
        .or(record.preference.first().map(|m| &m.header))
        .or(record.critique.first().map(|m| &m.header))
        .or(record.history.first().map(|m| &m.header))
        .or(record.scene.first().map(|m| &m.header));
    header
}

/// The records in force among all that were accepted, in accepted order: what has not been taken back, is no retraction itself,
/// and was not said before the newest lesson began. Tables and worlds stay: they say what the lesson is about.
pub fn in_force(records: &[EvidenceRecord]) -> impl DoubleEndedIterator<Item = &EvidenceRecord> {
    let retracted: HashSet<&str> =
        records.iter().flat_map(|record| &record.retraction).map(|undo| undo.evidence_id.as_str()).collect();
    let counts = move |record: &EvidenceRecord| {
        record.kind != EvidenceRecord::RETRACTION
            && record.retraction.is_empty()
            && !retracted.contains(record_id(record))
    };
    let begins = records.iter().rposition(|record| begins_lesson(record) && counts(record)).unwrap_or(0);
    let is_subject = |record: &EvidenceRecord| [EvidenceRecord::SCENE, EvidenceRecord::WORLD].contains(&record.kind);
    let kept = move |(at, record): &(usize, &EvidenceRecord)| counts(record) && (*at >= begins || is_subject(record));
    records.iter().enumerate().filter(kept).map(|(_, record)| record)
}

/// Whether a record says that what came before it counts no more.
pub fn begins_lesson(record: &EvidenceRecord) -> bool {
    record.response.first().is_some_and(|response| response.kind == QueryResponse::NEW_LESSON)
}

#[cfg(test)]
mod tests {
    use super::{in_force, record_id};
    use apprentice_msgs::msg::{ActionDemonstration, EvidenceRecord, QueryResponse, Retraction, TableScene};

    fn record(sequence: u64) -> EvidenceRecord {
        EvidenceRecord { sequence, ..EvidenceRecord::default() }
    }

    fn said(sequence: u64) -> EvidenceRecord {
        let actions = ActionDemonstration { id: format!("e{sequence}"), ..ActionDemonstration::default() };
        EvidenceRecord { kind: EvidenceRecord::ACTIONS, actions: vec![actions], ..record(sequence) }
    }

    fn anew(sequence: u64) -> EvidenceRecord {
        let (id, kind) = (format!("e{sequence}"), QueryResponse::NEW_LESSON);
        let response = vec![QueryResponse { id, kind, ..QueryResponse::default() }];
        EvidenceRecord { kind: EvidenceRecord::RESPONSE, response, ..record(sequence) }
    }

    fn back(sequence: u64, of: u64) -> EvidenceRecord {
        let (id, evidence_id) = (format!("e{sequence}"), format!("e{of}"));
        let retraction = vec![Retraction { id, evidence_id, ..Retraction::default() }];
        EvidenceRecord { kind: EvidenceRecord::RETRACTION, retraction, ..record(sequence) }
    }

    #[test]
    fn a_new_lesson_counts_nothing_said_before_it_until_it_is_taken_back() {
        let table = EvidenceRecord { kind: EvidenceRecord::SCENE, scene: vec![TableScene::default()], ..record(2) };
        let mut records = vec![said(1), table, said(3), anew(4), said(5)];
        let ids = |records: &[EvidenceRecord]| -> Vec<String> {
            in_force(records).map(|record| record_id(record).to_owned()).collect()
        };
        assert_eq!(ids(&records), ["", "e4", "e5"], "the table stays");
        records.extend([anew(6), said(7)]);
        assert_eq!(ids(&records), ["", "e6", "e7"]);
        records.push(back(8, 6));
        assert_eq!(ids(&records), ["", "e4", "e5", "e7"]);
        records.extend([back(9, 4), back(10, 3)]);
        assert_eq!(ids(&records), ["e1", "", "e5", "e7"]);
        assert_eq!(ids(&[]), Vec::<String>::new());
    }
}
