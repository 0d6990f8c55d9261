//! A lesson taken up from a recording: everything that was in force there is said once more.

use crate::evidence::Evidence;
use apprentice_msgs::msg::{EvidenceLog, QueryResponse};
use apprentice_msgs::std_msgs::Header;
use bus::Time;
use exchange::in_force;

/// What has to be said to take up a recording. Ids come from that of the command, so that the same command says the same. Who said
/// it is kept; the questions it answered are not, since they are not open here.
///
/// # Errors
/// In a sentence, when nothing in it counts.
pub(crate) fn said_once_more(id: &str, now: Time, log: &EvidenceLog) -> Result<Vec<Evidence>, String> {
    let pieces = in_force(&log.records).filter_map(Evidence::of_record);
    let shown = pieces.filter(|piece| !matches!(piece, Evidence::Response(_)));
    let again = shown.enumerate().map(|(n, piece)| {
        let source = piece.source().to_owned();
        piece.again(Header { stamp: now, frame_id: String::new() }, format!("{id}-{}", n + 1), String::new(), source)
    });
    let all: Vec<Evidence> = again.collect();
    if all.is_empty() { Err("nothing in it counts any more".into()) } else { Ok(all) }
}

/// The word that begins a new lesson.
pub(crate) fn new_lesson(id: &str, now: Time, source: &str, name: &str) -> Evidence {
    Evidence::Response(Box::new(QueryResponse {
        header: Header { stamp: now, frame_id: String::new() },
        id: id.to_owned(),
        source: source.to_owned(),
        kind: QueryResponse::NEW_LESSON,
        reason: format!("taken up from '{name}'"),
        ..QueryResponse::default()
    }))
}
