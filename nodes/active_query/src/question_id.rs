//! Ids of questions: unique within a session, since every accepted event makes a new revision; they say what a question is about and
//! whether it was drawn at random, which is how a log of evidence tells it.

use crate::settings::QuestionKind;
use apprentice_msgs::msg::{EvidenceRecord, Posterior, QueryResponse};
use sha2::{Digest, Sha256};

/// The id of a question about a table. Its letter is a capital when it was drawn at random to be held out.
pub(crate) fn table_query_id(revision: u64, is_held_out: bool, short_hash: &str) -> String {
    let letter = if is_held_out { 'Q' } else { 'q' };
    format!("{letter}{revision}-{short_hash}")
}

/// The id of a question about a world. Its second letter is a capital when it was drawn at random to be held out.
pub(crate) fn world_query_id(
    revision: u64,
    kind: QuestionKind,
    state: usize,
    is_held_out: bool,
    short_hash: &str,
) -> String {
    let letter = match (kind, is_held_out) {
        (QuestionKind::Action, false) => 'a',
        (QuestionKind::Critique, false) => 'k',
        (QuestionKind::Comparison, false) => 'c',
        (QuestionKind::Action, true) => 'A',
        (QuestionKind::Critique, true) => 'K',
        (QuestionKind::Comparison, true) => 'C',
    };
    format!("w{revision}-{letter}{state}-{short_hash}")
}

/// The part of an id that says what a question about a world is about.
pub(crate) fn world_subject(id: &str) -> Option<&str> {
    let mut parts = id.strip_prefix('w')?.split('-');
    let _revision: u64 = parts.next()?.parse().ok()?;
    parts.next()
}

/// Whether a record answers a question that was drawn at random to be held out.
pub(crate) fn asked_at_random(record: &EvidenceRecord) -> bool {
    let of_world = |id: &str| world_subject(id).is_some_and(|subject| subject.starts_with(['A', 'K', 'C']));
    question_answered(record).is_some_and(|id| id.starts_with('Q') || of_world(id))
}

/// The question that a record answers.
pub(crate) fn question_answered(record: &EvidenceRecord) -> Option<&String> {
    let id = None
        .or(record.actions.first().map(|m| &m.query_id))
        .or(record.preference.first().map(|m| &m.query_id))
        .or(record.critique.first().map(|m| &m.query_id));
    id.filter(|id| !id.is_empty())
}

/// The question that a record skips.
pub(crate) fn question_skipped(record: &EvidenceRecord) -> Option<&String> {
    let passed = [QueryResponse::SKIP, QueryResponse::CANT_TELL];
    record.response.first().filter(|m| passed.contains(&m.kind)).map(|m| &m.query_id).filter(|id| !id.is_empty())
}

/// Ties an id to the evidence.
pub(crate) fn short_hash(seed: i64, posterior: &Posterior) -> String {
    let mut hash = Sha256::new();
    hash.update(seed.to_le_bytes());
    hash.update(posterior.revision.to_le_bytes());
    hash.update(posterior.evidence_hash.as_bytes());
    hash.finalize().iter().take(4).map(|byte| format!("{byte:02x}")).collect()
}
