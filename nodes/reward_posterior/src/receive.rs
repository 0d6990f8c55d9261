//! What may become evidence: one rule after the other, each with the sentence a person reads when it is broken.

use crate::inference::demonstration_from_message;
use crate::piece::{Piece, unstamped};
use crate::{Evidence, Settings};
use apprentice_msgs::msg::{
    ActionDemonstration, EvidenceRecord, FeatureTrajectory, PlacementDemonstration, PlacementQuery, QueryResponse,
    Retraction, SegmentCritique, TrajectoryPreference, WorldQuery, WorldTrajectory,
};
use apprentice_msgs::to_cdr;
use exchange::{
    MAX_ID, MAX_WEIGHTS, World, check_history, check_preference, confidence_from_message, marks_from_message,
    record_id, scene_from_message, steps_from_message,
};
use posterior::MAX_DEMONSTRATIONS;
use scene::{Point, Rbf, Scene};
use std::collections::HashMap;

/// Longer free texts are refused.
const MAX_TEXT: usize = 4096;
/// A session holds at most this many accepted events.
pub(crate) const MAX_RECORDS: usize = 10_000;
/// A session holds at most this many bytes of accepted events: all of them go out again with every new one.
pub(crate) const MAX_BYTES: usize = 8 << 20;
/// A session holds at most this many compared pairs of trajectories in force.
const MAX_PAIRS: usize = 200_000;

/// What is to be done with something that came in.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Verdict {
    /// It is evidence.
    Accept(Box<EvidenceRecord>),
    /// It was accepted before, as this revision.
    Duplicate(u64),
    /// It is not, for this reason.
    Refuse(String),
    /// It speaks of something that has not been heard of, which may still be on its way.
    Unknown(String),
}

/// Which question may be answered.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Open<'a> {
    /// The newest question about a table, when it has not been answered.
    pub query: Option<&'a PlacementQuery>,
    /// The newest question about a world, when it has not been answered.
    pub world_query: Option<&'a WorldQuery>,
    /// Ids of questions heard of before.
    pub known: &'a [String],
}

/// Judges what came in.
pub(crate) fn judge(settings: &Settings, evidence: &Evidence, open: Open<'_>, piece: &Piece) -> Verdict {
    let record = piece.record(evidence.revision() + 1);
    let checked = || -> Result<(), Verdict> {
        known(evidence, &record)?;
        texts(&piece.texts())?;
        match piece {
            Piece::Demonstration(message) => demonstration(evidence, open, message),
            Piece::Retraction(message) => retraction(evidence, message),
            Piece::Response(message) => response(open, message),
            Piece::Actions(message) => {
                steps_from_message(message, world(evidence)?).map_err(refusal)?;
                answers(open, &message.query_id, |query| is_action(query, message))
            }
            Piece::Critique(message) => {
                marks_from_message(message, world(evidence)?).map_err(refusal)?;
                answers(open, &message.query_id, |query| is_critique(query, message))
            }
            Piece::Preference(message) => {
                match open.query.filter(|query| query.id == message.query_id) {
                    Some(query) if is_of_options(query, message) => {}
                    Some(query) => return refuse(not_the_answer(&query.id)),
                    None => answers(open, &message.query_id, |query| is_comparison(query, message))?,
                }
                compared(evidence, &message.trajectories, |n| check_preference(message, n).map_err(refusal))?;
                is_expected(settings, message)?;
                named(evidence)
            }
            Piece::History(message) => {
                compared(evidence, &message.demonstrations, |n| check_history(message, n).map_err(refusal))?;
                named(evidence)
            }
        }
    };
    checked().err().unwrap_or(Verdict::Accept(Box::new(record.clone())))
}

fn demonstration(evidence: &Evidence, open: Open<'_>, message: &PlacementDemonstration) -> Result<(), Verdict> {
    confidence_from_message(message.confidence).map_err(refusal)?;
    if evidence.placements().count() >= MAX_DEMONSTRATIONS {
        return refuse(format!("the session holds {MAX_DEMONSTRATIONS} placements, which is all it takes"));
    }
    let core = demonstration_from_message(message).map_err(refusal)?;
    same_features(evidence, &core.scene)?;
    let at = Point::new(message.placement.x, message.placement.y);
    if let Some(obstruction) = core.scene.occupied().reason(at) {
        return refuse(format!("the {} cannot be at ({}, {}) m: {obstruction}", core.scene.target.label, at.x, at.y));
    }
    if !message.query_id.is_empty() {
        is_open(open, &message.query_id)?;
        let Some(query) = open.query.filter(|query| query.id == message.query_id) else {
            return refuse(format!("question '{}' does not ask for a place", shown(&message.query_id)));
        };
        let asked = scene_from_message(&query.scene).map_err(refusal)?;
        if asked.objects != core.scene.objects || asked.target.shape != core.scene.target.shape {
            return refuse(format!("its scene is not the one that question '{}' asks about", query.id));
        }
    }
    Ok(())
}

fn retraction(evidence: &Evidence, message: &Retraction) -> Result<(), Verdict> {
    let id = shown(&message.evidence_id);
    match evidence.find(&message.evidence_id) {
        None => refuse(format!("'{id}', which it takes back, has not been accepted")),
        Some(record) if record.kind == EvidenceRecord::RETRACTION => {
            refuse(format!("'{id}' is itself a retraction; send the evidence again with a new id instead"))
        }
        Some(_) if evidence.is_retracted(&message.evidence_id) => refuse(format!("'{id}' has been taken back before")),
        Some(_) => Ok(()),
    }
}

fn response(open: Open<'_>, message: &QueryResponse) -> Result<(), Verdict> {
    match message.kind {
        QueryResponse::SKIP | QueryResponse::CANT_TELL => is_open(open, &message.query_id),
        // A word about the lesson must be heard whatever is being asked.
        QueryResponse::STOP
        | QueryResponse::PAUSE
        | QueryResponse::START
        | QueryResponse::FINISH
        | QueryResponse::NEW_LESSON => Ok(()),
        unknown => refuse(format!(
            "its kind is {unknown}; known are 0 (skip), 1 (can't tell), 2 (stop), 3 (pause), 4 (start), 5 (finish) and 6 (new \
             lesson)"
        )),
    }
}

fn world(evidence: &Evidence) -> Result<&World, Verdict> {
    evidence.world().ok_or_else(|| Verdict::Unknown("no world has been received that it could be about".into()))
}

/// Trajectories that can be compared with each other and with those of the evidence in force.
fn compared(
    evidence: &Evidence,
    trajectories: &[FeatureTrajectory],
    check: impl Fn(usize) -> Result<(), Verdict>,
) -> Result<(), Verdict> {
    // The first trajectories of a session count its weights.
    let counted = trajectories.first().map_or(1, |trajectory| trajectory.features.len());
    let names = evidence.feature_names();
    if names.is_empty() && !(1..=MAX_WEIGHTS).contains(&counted) {
        return refuse(format!("its trajectories have {counted} features; 1 to {MAX_WEIGHTS} are supported"));
    }
    check(if names.is_empty() { counted } else { names.len() })?;
    let same: HashMap<&str, &FeatureTrajectory> =
        evidence.trajectories().map(|known| (known.id.as_str(), known)).collect();
    if let Some(other) =
        trajectories.iter().find(|new| same.get(new.id.as_str()).is_some_and(|known| known.features != new.features))
    {
        return refuse(format!(
            "trajectory '{}' had other features before; ids of trajectories must be unique",
            other.id
        ));
    }
    let pairs = |n: usize| n * (n - 1) / 2;
    let held: usize = evidence.preferences().map(|m| pairs(m.trajectories.len())).sum::<usize>()
        + evidence.histories().map(|m| pairs(m.demonstrations.len())).sum::<usize>();
    if held + pairs(trajectories.len()) > MAX_PAIRS {
        return refuse(format!(
            "it compares {} pairs of trajectories and the session holds {held}; at most {MAX_PAIRS} are supported",
            pairs(trajectories.len())
        ));
    }
    Ok(())
}

/// An answer that the settings leave no probability for would rule every reward out.
fn is_expected(settings: &Settings, message: &TrajectoryPreference) -> Result<(), Verdict> {
    let (words, parameter, value) = match message.answer {
        TrajectoryPreference::EQUAL => ("about equal", "equal_threshold", settings.equal_threshold),
        TrajectoryPreference::CANT_TELL => ("can't tell", "cant_tell", settings.cant_tell),
        _ => return Ok(()),
    };
    if value > 0.0 {
        return Ok(());
    }
    refuse(format!("it says '{words}', which is not expected while {parameter} is 0"))
}

/// Trajectories may be the first to tell how many weights there are, but a table or a world may still be on its way.
fn named(evidence: &Evidence) -> Result<(), Verdict> {
    if evidence.weights().are_known() {
        return Ok(());
    }
    Err(Verdict::Unknown("neither a table nor a world has named the weights".into()))
}

fn refusal(error: impl std::fmt::Display) -> Verdict {
    Verdict::Refuse(error.to_string())
}

fn refuse<T>(reason: String) -> Result<T, Verdict> {
    Err(Verdict::Refuse(reason))
}

/// An id cut to what fits a message to a person.
fn shown(id: &str) -> String {
    id.chars().take(MAX_ID).collect()
}

fn known(evidence: &Evidence, record: &EvidenceRecord) -> Result<(), Verdict> {
    let id = record_id(record);
    if id.is_empty() || id.len() > MAX_ID {
        return refuse(format!("its id has {} characters; 1 to {MAX_ID} are allowed", id.len()));
    }
    if let Some(before) = evidence.find(id) {
        // A sender may stamp a repetition anew.
        return if unstamped(before) == unstamped(record) {
            Err(Verdict::Duplicate(before.sequence))
        } else {
            refuse(format!("its id '{id}' was used before for other evidence; ids must be unique"))
        };
    }
    has_room(evidence, record)
}

/// Whether a session takes one event more.
pub(crate) fn has_room(evidence: &Evidence, record: &EvidenceRecord) -> Result<(), Verdict> {
    if evidence.records().len() >= MAX_RECORDS {
        return refuse(format!("the session holds {MAX_RECORDS} events, which is all it takes; start a new session"));
    }
    let n_bytes = to_cdr(record).len();
    // A person can always take something back, or stop.
    let is_small = [EvidenceRecord::RETRACTION, EvidenceRecord::RESPONSE].contains(&record.kind);
    if evidence.n_bytes() + n_bytes > MAX_BYTES && !is_small {
        return refuse(format!(
            "it has {n_bytes} bytes and the session holds {}; {MAX_BYTES} are all it takes",
            evidence.n_bytes()
        ));
    }
    Ok(())
}

fn texts(texts: &[&str]) -> Result<(), Verdict> {
    match texts.iter().find(|text| text.len() > MAX_TEXT) {
        None => Ok(()),
        Some(text) => refuse(format!("it holds a text of {} bytes; at most {MAX_TEXT} are allowed", text.len())),
    }
}

/// Whether a table has the features that this lesson's weights are about.
pub(crate) fn same_features(evidence: &Evidence, scene: &Scene) -> Result<(), Verdict> {
    let Some((_, task)) = evidence.task() else {
        let n = Rbf::new(scene).n();
        return evidence
            .weights()
            .fit(n)
            .map_err(|reason| Verdict::Refuse(format!("its table does not fit: {reason}")));
    };
    if task.target.id != scene.target.id {
        return refuse(format!("it places '{}', but this lesson is about '{}'", scene.target.id, task.target.id));
    }
    if Rbf::names(task) == Rbf::names(scene) {
        return Ok(());
    }
    let ids = |scene: &Scene| scene.objects.iter().map(|object| object.id.as_str()).collect::<Vec<_>>().join(", ");
    refuse(format!("its scene has the objects [{}], but this lesson is about [{}]", ids(scene), ids(task)))
}

fn is_open(open: Open<'_>, id: &str) -> Result<(), Verdict> {
    let asked = [open.query.map(|query| &query.id), open.world_query.map(|query| &query.id)];
    if asked.into_iter().flatten().any(|known| known == id) {
        return Ok(());
    }
    let now = match asked.into_iter().flatten().next() {
        Some(other) => format!("; the open question is '{}'", shown(other)),
        None => "; no question is open".into(),
    };
    if open.known.iter().any(|known| known == id) {
        refuse(format!("question '{}' is no longer open{now}", shown(id)))
    } else {
        Err(Verdict::Unknown(format!("question '{}' was never asked{now}", shown(id))))
    }
}

/// Evidence about a world that names a question of ours answers it while it is open, and nothing else. Others may ask, too:
/// their questions are not known here.
fn answers(open: Open<'_>, id: &str, is_answer: impl Fn(&WorldQuery) -> bool) -> Result<(), Verdict> {
    match open.world_query.filter(|query| query.id == id) {
        Some(query) if is_answer(query) => Ok(()),
        Some(_) => refuse(not_the_answer(id)),
        None if open.known.iter().any(|known| known == id) => is_open(open, id),
        None => Ok(()),
    }
}

fn not_the_answer(query_id: &str) -> String {
    format!("it does not answer what question '{}' asks", shown(query_id))
}

fn is_action(query: &WorldQuery, message: &ActionDemonstration) -> bool {
    query.kind == WorldQuery::ACTION && message.states == [query.state]
}

fn is_critique(query: &WorldQuery, message: &SegmentCritique) -> bool {
    let is_it = |shown: &WorldTrajectory| (&shown.states, &shown.actions) == (&message.states, &message.actions);
    query.kind == WorldQuery::CRITIQUE && query.trajectories.first().is_some_and(is_it)
}

/// The two that were shown, in either order.
fn is_comparison(query: &WorldQuery, message: &TrajectoryPreference) -> bool {
    let shown = query.trajectories.iter().map(|shown| (&shown.id, &shown.features));
    query.kind == WorldQuery::COMPARISON && are(shown, message)
}

/// The same of two places.
fn is_of_options(query: &PlacementQuery, message: &TrajectoryPreference) -> bool {
    are(query.options.iter().map(|option| (&option.trajectory.id, &option.trajectory.features)), message)
}

fn are<'a>(shown: impl Iterator<Item = (&'a String, &'a Vec<f64>)> + Clone, message: &TrajectoryPreference) -> bool {
    let is_shown = |of: &FeatureTrajectory| shown.clone().any(|shown| shown == (&of.id, &of.features));
    message.trajectories.len() == 2 && message.trajectories.iter().all(is_shown)
}
