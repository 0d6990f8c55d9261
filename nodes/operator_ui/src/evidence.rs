//! What pages send to the posterior, and how its answers are shown.

use crate::protocol::{AnswerView, Confidence, Fate, Kind};
use crate::view::{finite, scene_view};
use apprentice_msgs::msg::{
    ActionDemonstration, CritiqueSegment, EvidenceRecord, LearnerHistory, PlacementDemonstration, QueryResponse,
    Retraction, SegmentCritique, TrajectoryPreference,
};
use apprentice_msgs::std_msgs::Header;

/// Something for the posterior.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Evidence {
    Demonstration(Box<PlacementDemonstration>),
    Actions(Box<ActionDemonstration>),
    Critique(Box<SegmentCritique>),
    Comparison(Box<TrajectoryPreference>),
    History(Box<LearnerHistory>),
    Retraction(Box<Retraction>),
    Response(Box<QueryResponse>),
}

impl Evidence {
    pub fn id(&self) -> &str {
        match self {
            Self::Demonstration(message) => &message.id,
            Self::Actions(message) => &message.id,
            Self::Critique(message) => &message.id,
            Self::Comparison(message) => &message.id,
            Self::History(message) => &message.id,
            Self::Retraction(message) => &message.id,
            Self::Response(message) => &message.id,
        }
    }

    /// What a record holds that a page could have sent, retractions excepted.
    pub fn of_record(record: &EvidenceRecord) -> Option<Self> {
        None.or_else(|| record.demonstration.first().map(|m| Self::Demonstration(Box::new(m.clone()))))
            .or_else(|| record.actions.first().map(|m| Self::Actions(Box::new(m.clone()))))
            .or_else(|| record.critique.first().map(|m| Self::Critique(Box::new(m.clone()))))
            .or_else(|| record.preference.first().map(|m| Self::Comparison(Box::new(m.clone()))))
            .or_else(|| record.history.first().map(|m| Self::History(Box::new(m.clone()))))
            .or_else(|| record.response.first().map(|m| Self::Response(Box::new(m.clone()))))
    }

    /// Who said it.
    pub fn source(&self) -> &str {
        match self {
            Self::Demonstration(message) => &message.source,
            Self::Actions(message) => &message.source,
            Self::Critique(message) => &message.source,
            Self::Comparison(message) => &message.source,
            Self::History(message) => &message.source,
            Self::Retraction(message) => &message.source,
            Self::Response(message) => &message.source,
        }
    }

    /// The same given once more under another id, in answer to `query_id`.
    pub fn again(mut self, header: Header, new_id: String, new_query_id: String, new_source: String) -> Self {
        let (stamp, id, query_id, source) = match &mut self {
            Self::Demonstration(m) => (&mut m.header.stamp, &mut m.id, &mut m.query_id, &mut m.source),
            Self::Actions(m) => (&mut m.header.stamp, &mut m.id, &mut m.query_id, &mut m.source),
            Self::Critique(m) => (&mut m.header.stamp, &mut m.id, &mut m.query_id, &mut m.source),
            Self::Comparison(m) => (&mut m.header.stamp, &mut m.id, &mut m.query_id, &mut m.source),
            Self::Response(m) => (&mut m.header.stamp, &mut m.id, &mut m.query_id, &mut m.source),
            Self::History(m) => {
                (m.header.stamp, m.id, m.source) = (header.stamp, new_id, new_source);
                return self;
            }
            Self::Retraction(_) => return self,
        };
        (*stamp, *id, *query_id, *source) = (header.stamp, new_id, new_query_id, new_source);
        self
    }

    /// As an answer in the list; none for a retraction, which shows on what it takes back.
    pub fn view(&self) -> Option<AnswerView> {
        let blank = |kind, id: &str, query_id: &str, source: &str| AnswerView {
            id: id.to_owned(),
            kind,
            query_id: query_id.to_owned(),
            source: source.to_owned(),
            mine: false,
            scene: None,
            x_m: None,
            y_m: None,
            confidence: None,
            n: None,
            step: None,
            said: None,
            marked: None,
            state: Fate::Pending,
            revision: None,
            reason: String::new(),
            undo: None,
        };
        let count = |n: usize| u32::try_from(n).ok();
        Some(match self {
            Self::Demonstration(m) => AnswerView {
                scene: scene_view(&m.scene).ok(),
                x_m: finite(m.placement.x),
                y_m: finite(m.placement.y),
                confidence: Some(confidence(m.confidence)),
                ..blank(Kind::Placement, &m.id, &m.query_id, &m.source)
            },
            Self::Actions(m) => AnswerView {
                n: count(m.states.len()),
                step: match (m.states.as_slice(), m.actions.as_slice()) {
                    (&[state], &[action]) => Some([state, action]),
                    _ => None,
                },
                confidence: Some(confidence(m.confidence)),
                ..blank(Kind::Actions, &m.id, &m.query_id, &m.source)
            },
            Self::Critique(m) => {
                let steps = |verdict| {
                    let of = m.segments.iter().filter(|segment| segment.verdict == verdict);
                    of.map(|segment| segment.end.saturating_sub(segment.start)).fold(0, u32::saturating_add)
                };
                AnswerView {
                    n: count(m.segments.len()),
                    marked: Some([steps(CritiqueSegment::GOOD), steps(CritiqueSegment::BAD)]),
                    confidence: Some(confidence(m.confidence)),
                    ..blank(Kind::Critique, &m.id, &m.query_id, &m.source)
                }
            }
            Self::Comparison(m) => AnswerView {
                n: count(m.trajectories.len()),
                said: Some(match m.answer {
                    TrajectoryPreference::RANKED => "ranked",
                    TrajectoryPreference::EQUAL => "equal",
                    _ => "cant_tell",
                }),
                confidence: Some(confidence(m.confidence)),
                ..blank(Kind::Preference, &m.id, &m.query_id, &m.source)
            },
            Self::Response(m) => {
                let kind = match m.kind {
                    QueryResponse::SKIP => Kind::Skip,
                    QueryResponse::CANT_TELL => Kind::CantTell,
                    QueryResponse::PAUSE => Kind::Pause,
                    QueryResponse::START => Kind::Start,
                    QueryResponse::FINISH => Kind::Finish,
                    QueryResponse::NEW_LESSON => Kind::NewLesson,
                    _ => Kind::Stop,
                };
                blank(kind, &m.id, &m.query_id, &m.source)
            }
            Self::History(m) => return history_view(m),
            Self::Retraction(_) => return None,
        })
    }
}

/// A learner's attempts in the list.
fn history_view(message: &LearnerHistory) -> Option<AnswerView> {
    let shown = TrajectoryPreference {
        id: message.id.clone(),
        source: message.source.clone(),
        trajectories: message.demonstrations.clone(),
        ..TrajectoryPreference::default()
    };
    let view = Evidence::Comparison(Box::new(shown)).view()?;
    Some(AnswerView { kind: Kind::History, said: None, ..view })
}

/// How sure a person was, by the numbers that all messages share.
fn confidence(number: u8) -> Confidence {
    match number {
        PlacementDemonstration::CONFIDENCE_SURE => Confidence::Sure,
        PlacementDemonstration::CONFIDENCE_FAIRLY => Confidence::Fairly,
        _ => Confidence::Guess,
    }
}
