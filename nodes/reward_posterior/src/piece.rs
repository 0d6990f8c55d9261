//! Whatever a person may say: evidence of every kind, and what takes it back.

use apprentice_msgs::msg::{
    ActionDemonstration, EvidenceRecord, LearnerHistory, PlacementDemonstration, QueryResponse, Retraction,
    SegmentCritique, TrajectoryPreference,
};
use apprentice_msgs::std_msgs::Header;

/// One message of a person.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Piece {
    Demonstration(Box<PlacementDemonstration>),
    Retraction(Box<Retraction>),
    Response(Box<QueryResponse>),
    Actions(Box<ActionDemonstration>),
    Preference(Box<TrajectoryPreference>),
    Critique(Box<SegmentCritique>),
    History(Box<LearnerHistory>),
}

impl Piece {
    pub(crate) fn header(&self) -> &Header {
        match self {
            Self::Demonstration(m) => &m.header,
            Self::Retraction(m) => &m.header,
            Self::Response(m) => &m.header,
            Self::Actions(m) => &m.header,
            Self::Preference(m) => &m.header,
            Self::Critique(m) => &m.header,
            Self::History(m) => &m.header,
        }
    }

    pub(crate) fn id(&self) -> &str {
        match self {
            Self::Demonstration(m) => &m.id,
            Self::Retraction(m) => &m.id,
            Self::Response(m) => &m.id,
            Self::Actions(m) => &m.id,
            Self::Preference(m) => &m.id,
            Self::Critique(m) => &m.id,
            Self::History(m) => &m.id,
        }
    }

    pub(crate) fn source(&self) -> &str {
        match self {
            Self::Demonstration(m) => &m.source,
            Self::Retraction(m) => &m.source,
            Self::Response(m) => &m.source,
            Self::Actions(m) => &m.source,
            Self::Preference(m) => &m.source,
            Self::Critique(m) => &m.source,
            Self::History(m) => &m.source,
        }
    }

    /// What it is, for people.
    pub(crate) fn what(&self) -> &'static str {
        match self {
            Self::Demonstration(_) => "demonstration",
            Self::Retraction(_) => "retraction",
            Self::Response(_) => "response",
            Self::Actions(_) => "demonstration of actions",
            Self::Preference(_) => "preference",
            Self::Critique(_) => "critique",
            Self::History(_) => "history",
        }
    }

    /// Free texts besides the id, which must not be without end.
    pub(crate) fn texts(&self) -> [&str; 3] {
        match self {
            Self::Retraction(m) => [&m.source, &m.reason, ""],
            Self::Response(m) => [&m.source, &m.reason, ""],
            Self::Preference(m) => [&m.source, &m.query_id, ""],
            Self::Critique(m) => [&m.source, &m.query_id, &m.world_id],
            Self::Actions(m) => [&m.source, &m.query_id, &m.world_id],
            Self::Demonstration(_) | Self::History(_) => [self.source(), "", ""],
        }
    }

    /// The record that accepts it.
    pub(crate) fn record(&self, sequence: u64) -> EvidenceRecord {
        let empty = EvidenceRecord { sequence, ..EvidenceRecord::default() };
        match self {
            Self::Demonstration(m) => {
                EvidenceRecord { kind: EvidenceRecord::DEMONSTRATION, demonstration: vec![(**m).clone()], ..empty }
            }
            Self::Retraction(m) => {
                EvidenceRecord { kind: EvidenceRecord::RETRACTION, retraction: vec![(**m).clone()], ..empty }
            }
            Self::Response(m) => {
                EvidenceRecord { kind: EvidenceRecord::RESPONSE, response: vec![(**m).clone()], ..empty }
            }
            Self::Actions(m) => EvidenceRecord { kind: EvidenceRecord::ACTIONS, actions: vec![(**m).clone()], ..empty },
            Self::Preference(m) => {
                EvidenceRecord { kind: EvidenceRecord::PREFERENCE, preference: vec![(**m).clone()], ..empty }
            }
            Self::Critique(m) => {
                EvidenceRecord { kind: EvidenceRecord::CRITIQUE, critique: vec![(**m).clone()], ..empty }
            }
            Self::History(m) => EvidenceRecord { kind: EvidenceRecord::HISTORY, history: vec![(**m).clone()], ..empty },
        }
    }
}

/// A record without what may differ when the same thing is said again: its number and its stamps.
pub(crate) fn unstamped(record: &EvidenceRecord) -> EvidenceRecord {
    let mut record = EvidenceRecord { sequence: 0, ..record.clone() };
    for m in &mut record.demonstration {
        m.header = Header::default();
        m.scene.header.stamp = Default::default();
    }
    record.retraction.iter_mut().for_each(|m| m.header = Header::default());
    record.response.iter_mut().for_each(|m| m.header = Header::default());
    record.actions.iter_mut().for_each(|m| m.header = Header::default());
    record.preference.iter_mut().for_each(|m| m.header = Header::default());
    record.critique.iter_mut().for_each(|m| m.header = Header::default());
    record.history.iter_mut().for_each(|m| m.header = Header::default());
    record
}

/// The same without what says nothing about rewards either: who said it, and in answer to what.
pub(crate) fn bare(record: &EvidenceRecord) -> EvidenceRecord {
    let mut record = unstamped(record);
    for m in &mut record.demonstration {
        (m.source, m.query_id) = (String::new(), String::new());
    }
    for m in &mut record.preference {
        (m.source, m.query_id) = (String::new(), String::new());
    }
    for m in &mut record.critique {
        (m.source, m.query_id) = (String::new(), String::new());
    }
    for m in &mut record.actions {
        (m.source, m.query_id) = (String::new(), String::new());
    }
    record.history.iter_mut().for_each(|m| m.source = String::new());
    record
}
