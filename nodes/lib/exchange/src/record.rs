//! Records of accepted events: what each kind has in common.

use apprentice_msgs::msg::EvidenceRecord;
use apprentice_msgs::std_msgs::Header;

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
