//! What may become evidence: one rule after the other, each with the sentence a person reads when it is broken.

use crate::Evidence;
use crate::evidence::{demonstration_from_message, id_of};
use apprentice_msgs::msg::{EvidenceRecord, PlacementDemonstration, PlacementQuery, QueryResponse, Retraction};
use apprentice_msgs::std_msgs::Header;
use exchange::scene_from_message;
use scene::{Point, Rbf, Scene};

/// Longer ids are refused.
const MAX_ID: usize = 128;
/// Longer free texts are refused.
const MAX_TEXT: usize = 4096;
/// A session holds at most this many accepted events.
pub(crate) const MAX_RECORDS: usize = 10_000;

/// What is to be done with something that came in.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Verdict {
    /// It is evidence.
    Accept(Box<EvidenceRecord>),
    /// It was accepted before, as this revision.
    Duplicate(u64),
    /// It is not, for this reason.
    Refuse(String),
    /// It answers a question that has not been heard of: the question may still be on its way.
    Unknown(String),
}

/// Which question may be answered.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Open<'a> {
    /// The newest question, when it has not been answered.
    pub query: Option<&'a PlacementQuery>,
    /// Ids of questions heard of before.
    pub known: &'a [String],
}

/// Judges a demonstration.
pub(crate) fn demonstration(evidence: &Evidence, open: Open<'_>, message: &PlacementDemonstration) -> Verdict {
    let record = EvidenceRecord {
        sequence: evidence.revision() + 1,
        kind: EvidenceRecord::DEMONSTRATION,
        demonstration: vec![message.clone()],
        ..EvidenceRecord::default()
    };
    let checked = || -> Result<(), Verdict> {
        known(evidence, &record)?;
        texts(&[&message.source])?;
        if message.confidence > PlacementDemonstration::CONFIDENCE_GUESS {
            return refuse(format!(
                "its confidence is {}; 0 (sure), 1 (fairly) and 2 (a guess) are known",
                message.confidence
            ));
        }
        let core = demonstration_from_message(message).map_err(|error| Verdict::Refuse(error.to_string()))?;
        same_features(evidence, &core.scene)?;
        let at = Point::new(message.placement.x, message.placement.y);
        if let Some(obstruction) = core.scene.occupied().reason(at) {
            return refuse(format!(
                "the {} cannot be at ({}, {}) m: {obstruction}",
                core.scene.target.label, at.x, at.y
            ));
        }
        if !message.query_id.is_empty() {
            let query = is_open(open, &message.query_id)?;
            let asked = scene_from_message(&query.scene).map_err(|error| Verdict::Refuse(error.to_string()))?;
            if asked.objects != core.scene.objects || asked.target.shape != core.scene.target.shape {
                return refuse(format!("its scene is not the one that question '{}' asks about", query.id));
            }
        }
        Ok(())
    };
    checked().err().unwrap_or(Verdict::Accept(Box::new(record.clone())))
}

/// Judges a retraction.
pub(crate) fn retraction(evidence: &Evidence, message: &Retraction) -> Verdict {
    let record = EvidenceRecord {
        sequence: evidence.revision() + 1,
        kind: EvidenceRecord::RETRACTION,
        retraction: vec![message.clone()],
        ..EvidenceRecord::default()
    };
    let checked = || -> Result<(), Verdict> {
        known(evidence, &record)?;
        texts(&[&message.source, &message.reason])?;
        let id = shown(&message.evidence_id);
        match evidence.find(&message.evidence_id) {
            None => refuse(format!("'{id}', which it takes back, has not been accepted")),
            Some(record) if record.kind == EvidenceRecord::RETRACTION => {
                refuse(format!("'{id}' is itself a retraction; send the evidence again with a new id instead"))
            }
            Some(_) if evidence.is_retracted(&message.evidence_id) => {
                refuse(format!("'{id}' has been taken back before"))
            }
            Some(_) => Ok(()),
        }
    };
    checked().err().unwrap_or(Verdict::Accept(Box::new(record.clone())))
}

/// Judges a response.
pub(crate) fn response(evidence: &Evidence, open: Open<'_>, message: &QueryResponse) -> Verdict {
    let record = EvidenceRecord {
        sequence: evidence.revision() + 1,
        kind: EvidenceRecord::RESPONSE,
        response: vec![message.clone()],
        ..EvidenceRecord::default()
    };
    let checked = || -> Result<(), Verdict> {
        known(evidence, &record)?;
        texts(&[&message.source, &message.reason])?;
        if message.kind > QueryResponse::STOP {
            return refuse(format!("its kind is {}; 0 (skip), 1 (can't tell) and 2 (stop) are known", message.kind));
        }
        // Stopping must work whatever is being asked.
        if message.kind != QueryResponse::STOP {
            is_open(open, &message.query_id)?;
        }
        Ok(())
    };
    checked().err().unwrap_or(Verdict::Accept(Box::new(record.clone())))
}

fn refuse<T>(reason: String) -> Result<T, Verdict> {
    Err(Verdict::Refuse(reason))
}

/// An id cut to what fits a message to a person.
fn shown(id: &str) -> String {
    id.chars().take(MAX_ID).collect()
}

fn known(evidence: &Evidence, record: &EvidenceRecord) -> Result<(), Verdict> {
    let id = id_of(record);
    if id.is_empty() || id.len() > MAX_ID {
        return refuse(format!("its id has {} characters; 1 to {MAX_ID} are allowed", id.len()));
    }
    if let Some(before) = evidence.find(id) {
        return if same(before, record) {
            Err(Verdict::Duplicate(before.sequence))
        } else {
            refuse(format!("its id '{id}' was used before for other evidence; ids must be unique"))
        };
    }
    if evidence.records().len() >= MAX_RECORDS {
        return refuse(format!("the session holds {MAX_RECORDS} events, which is all it takes; start a new session"));
    }
    Ok(())
}

/// Whether two records say the same; a sender may stamp a repetition anew.
fn same(a: &EvidenceRecord, b: &EvidenceRecord) -> bool {
    let plain = |record: &EvidenceRecord| {
        let mut record = record.clone();
        record.sequence = 0;
        for demonstration in &mut record.demonstration {
            demonstration.header = Header::default();
            demonstration.scene.header = Header::default();
        }
        for retraction in &mut record.retraction {
            retraction.header = Header::default();
        }
        for response in &mut record.response {
            response.header = Header::default();
        }
        record
    };
    plain(a) == plain(b)
}

fn texts(texts: &[&str]) -> Result<(), Verdict> {
    match texts.iter().find(|text| text.len() > MAX_TEXT) {
        None => Ok(()),
        Some(text) => refuse(format!("it holds a text of {} bytes; at most {MAX_TEXT} are allowed", text.len())),
    }
}

fn same_features(evidence: &Evidence, scene: &Scene) -> Result<(), Verdict> {
    let Some((_, task)) = evidence.task() else { return Ok(()) };
    if task.target.id != scene.target.id {
        return refuse(format!("it places '{}', but this lesson is about '{}'", scene.target.id, task.target.id));
    }
    if Rbf::names(task) == Rbf::names(scene) {
        return Ok(());
    }
    let ids = |scene: &Scene| scene.objects.iter().map(|object| object.id.as_str()).collect::<Vec<_>>().join(", ");
    refuse(format!("its scene has the objects [{}], but this lesson is about [{}]", ids(scene), ids(task)))
}

fn is_open<'a>(open: Open<'a>, id: &str) -> Result<&'a PlacementQuery, Verdict> {
    match open.query {
        Some(query) if query.id == id => Ok(query),
        other => {
            let now = match other {
                Some(query) => format!("; the open question is '{}'", query.id),
                None => "; no question is open".into(),
            };
            if open.known.iter().any(|known| known == id) {
                refuse(format!("question '{}' is no longer open{now}", shown(id)))
            } else {
                Err(Verdict::Unknown(format!("question '{}' was never asked{now}", shown(id))))
            }
        }
    }
}
