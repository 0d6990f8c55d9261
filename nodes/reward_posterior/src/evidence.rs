//! Everything accepted so far, in order, and what of it is in force.

use apprentice_msgs::msg::{EvidenceRecord, PlacementDemonstration, QueryResponse, TableScene};
use apprentice_msgs::std_msgs::Header;
use exchange::{ExchangeError, point_from_message, scene_from_message};
use posterior::{Confidence, Demonstration};
use scene::{Rbf, Scene};
use std::collections::{HashMap, HashSet};

/// The evidence of a session. Records are only ever appended.
#[derive(Debug, Clone, Default)]
pub struct Evidence {
    task: Option<(TableScene, Scene)>,
    records: Vec<EvidenceRecord>,
    by_id: HashMap<String, usize>,
    retracted: HashSet<String>,
}

impl Evidence {
    /// The first scene of the session.
    pub fn task(&self) -> Option<&(TableScene, Scene)> {
        self.task.as_ref()
    }

    /// Sets the first scene of the session; later scenes do not change what the weights are about.
    pub fn set_task(&mut self, message: TableScene) -> Result<(), ExchangeError> {
        let scene = scene_from_message(&message)?;
        self.task = Some((message, scene));
        Ok(())
    }

    /// What each weight is about; empty before the task is known.
    pub fn feature_names(&self) -> Vec<String> {
        self.task.as_ref().map(|(_, scene)| Rbf::names(scene)).unwrap_or_default()
    }

    /// Every accepted event.
    pub fn records(&self) -> &[EvidenceRecord] {
        &self.records
    }

    /// The accepted event with an id.
    pub fn find(&self, id: &str) -> Option<&EvidenceRecord> {
        self.by_id.get(id).map(|&index| &self.records[index])
    }

    /// Whether an accepted event has been taken back.
    pub fn is_retracted(&self, id: &str) -> bool {
        self.retracted.contains(id)
    }

    /// Number of accepted events, which is the revision of the posterior.
    pub fn revision(&self) -> u64 {
        self.records.len() as u64
    }

    /// Appends an accepted event; its sequence number must be the next.
    pub fn append(&mut self, record: EvidenceRecord) {
        debug_assert_eq!(record.sequence, self.revision() + 1);
        if let Some(retraction) = record.retraction.first() {
            self.retracted.insert(retraction.evidence_id.clone());
        }
        self.by_id.insert(id_of(&record).to_owned(), self.records.len());
        self.records.push(record);
    }

    /// The demonstrations in force, in accepted order.
    pub fn active(&self) -> impl Iterator<Item = &PlacementDemonstration> {
        let demonstrations = self.records.iter().filter_map(|record| record.demonstration.first());
        demonstrations.filter(|demonstration| !self.is_retracted(&demonstration.id))
    }

    /// The same for the core. Records were checked before they were accepted, so an error means a damaged journal.
    pub fn active_demonstrations(&self) -> Result<Vec<Demonstration>, ExchangeError> {
        self.active().map(demonstration_from_message).collect()
    }

    /// The scene of the newest demonstration in force, else the task's.
    pub fn newest_scene(&self) -> Option<&TableScene> {
        self.active().last().map(|d| &d.scene).or(self.task.as_ref().map(|(message, _)| message))
    }

    /// Questions answered or skipped, taken back or not.
    pub fn n_answers(&self) -> u64 {
        let answered = |record: &&EvidenceRecord| {
            record.demonstration.first().is_some_and(|d| !d.query_id.is_empty()) || !record.response.is_empty()
        };
        self.records.iter().filter(answered).count() as u64
    }

    /// Whether the person said that nothing is acceptable, and has not taken it back.
    pub fn stopped(&self) -> bool {
        let mut responses = self.records.iter().filter_map(|record| record.response.first());
        responses.any(|r| r.kind == QueryResponse::STOP && !self.is_retracted(&r.id))
    }

    /// Header of what is computed from the evidence: the stamp of the newest event, never a clock's.
    pub fn header(&self) -> Header {
        let newest =
            self.records.last().map(|record| match (&record.demonstration.first(), &record.retraction.first()) {
                (Some(demonstration), _) => &demonstration.header,
                (_, Some(retraction)) => &retraction.header,
                _ => &record.response.first().expect("a record holds one event").header,
            });
        let frame_id = self.task.as_ref().map(|(message, _)| message.header.frame_id.clone()).unwrap_or_default();
        let stamp = newest.or(self.task.as_ref().map(|(message, _)| &message.header)).map(|h| h.stamp);
        Header { stamp: stamp.unwrap_or_default(), frame_id }
    }
}

/// Id of the event in a record.
pub(crate) fn id_of(record: &EvidenceRecord) -> &str {
    let demonstration = record.demonstration.first().map(|d| &d.id);
    let retraction = record.retraction.first().map(|r| &r.id);
    let response = record.response.first().map(|r| &r.id);
    demonstration.or(retraction).or(response).map_or("", String::as_str)
}

/// A demonstration as the core takes it.
pub(crate) fn demonstration_from_message(message: &PlacementDemonstration) -> Result<Demonstration, ExchangeError> {
    let scene = scene_from_message(&message.scene)?;
    let placement_m = point_from_message("the placement", &message.placement)?;
    Ok(Demonstration {
        id: message.id.clone(),
        placement: scene.normalised(placement_m),
        scene,
        confidence: match message.confidence {
            PlacementDemonstration::CONFIDENCE_SURE => Confidence::Sure,
            PlacementDemonstration::CONFIDENCE_FAIRLY => Confidence::Fairly,
            _ => Confidence::Guess,
        },
    })
}
