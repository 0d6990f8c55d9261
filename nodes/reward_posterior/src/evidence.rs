//! Everything accepted so far, in order, and what of it is in force.

use crate::weights::Weights;
use apprentice_msgs::msg::{
    ActionDemonstration, EvidenceLog, EvidenceRecord, FeatureTrajectory, LearnerHistory, PlacementDemonstration,
    Posterior, QueryResponse, SegmentCritique, TableScene, TrajectoryPreference, WorldReference,
};
use apprentice_msgs::std_msgs::Header;
use apprentice_msgs::to_cdr;
use exchange::{ExchangeError, World, begins_lesson, in_force, record_header, record_id, scene_from_message};
use scene::{Rbf, Scene};
use std::collections::{HashMap, HashSet};
use std::sync::Arc;

/// What the lesson was about before the first event; whatever comes later is a record.
#[derive(Debug, Clone)]
enum Beginning {
    /// As the table stood then; what is moved later are records.
    Table(Box<TableScene>),
    World,
}

/// The evidence of a session. Records are only ever appended.
#[derive(Debug, Clone, Default)]
pub struct Evidence {
    weights: Weights,
    beginning: Option<Beginning>,
    task: Option<(TableScene, Scene)>,
    world: Option<Arc<World>>,
    offered: Option<Arc<World>>,
    records: Vec<EvidenceRecord>,
    by_id: HashMap<String, usize>,
    n_bytes: usize,
}

impl Evidence {
    /// The table that the lesson is about.
    pub fn task(&self) -> Option<&(TableScene, Scene)> {
        self.task.as_ref()
    }

    /// The world that the lesson is about.
    pub fn world(&self) -> Option<&World> {
        self.world.as_deref()
    }

    /// How messages name it; empty without one.
    pub fn world_reference(&self) -> WorldReference {
        self.world().map(World::reference).unwrap_or_default()
    }

    /// Whether nothing has been said yet, not even what the lesson is about.
    pub fn is_blank(&self) -> bool {
        self.records.is_empty() && self.beginning.is_none()
    }

    /// The table of the lesson, before anything else is known; later tables are records.
    ///
    /// # Errors
    /// A scene that cannot be used.
    pub fn begin_with_table(&mut self, message: TableScene) -> Result<(), ExchangeError> {
        self.set_task(message.clone())?;
        self.beginning = Some(Beginning::Table(Box::new(message)));
        Ok(())
    }

    /// The world of the lesson, before anything else is known; later worlds are records.
    pub fn begin_with_world(&mut self, world: Arc<World>) {
        self.set_world(world);
        self.beginning = Some(Beginning::World);
    }

    /// A world that a later record may name.
    pub fn offer_world(&mut self, world: Arc<World>) {
        self.offered = Some(world);
    }

    fn set_task(&mut self, message: TableScene) -> Result<(), ExchangeError> {
        let scene = scene_from_message(&message)?;
        let by = format!("the table '{}' with its objects and fixed centres", scene.id);
        self.weights.name(Rbf::names(&scene), by);
        self.task = Some((message, scene));
        Ok(())
    }

    fn set_world(&mut self, world: Arc<World>) {
        self.weights.name(world.feature_names.clone(), format!("the world '{}'", world.id));
        self.world = Some(world);
    }

    /// What each weight is about; empty while nothing has said so.
    pub fn feature_names(&self) -> &[String] {
        self.weights.names()
    }

    pub(crate) fn weights(&self) -> &Weights {
        &self.weights
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
        self.records.iter().flat_map(|record| &record.retraction).any(|retraction| retraction.evidence_id == id)
    }

    /// Number of accepted events, which is the revision of the posterior.
    pub fn revision(&self) -> u64 {
        self.records.len() as u64
    }

    /// Bytes of all records.
    pub fn n_bytes(&self) -> usize {
        self.n_bytes
    }

    /// Appends an accepted event.
    ///
    /// # Errors
    /// A record that does not follow: another sequence number, a table that cannot be used, or a world that is not known.
    /// Records were checked before they were accepted, so this means a damaged journal.
    pub fn append(&mut self, record: EvidenceRecord) -> Result<(), String> {
        let expected = self.revision() + 1;
        if record.sequence != expected {
            return Err(format!("it has sequence {}, {expected} was expected", record.sequence));
        }
        if let Some(scene) = record.scene.first() {
            self.set_task(scene.clone()).map_err(|error| error.to_string())?;
        }
        if let Some(reference) = record.world.first() {
            let world = self.offered.clone().filter(|world| world.reference() == *reference);
            let world = world.ok_or_else(|| format!("it names the world '{}', which is not known", reference.id))?;
            self.set_world(world);
        }
        if let Some(trajectory) = trajectories_of(&record).first() {
            self.weights.count(trajectory.features.len());
        }
        let id = record_id(&record);
        if !id.is_empty() {
            self.by_id.insert(id.to_owned(), self.records.len());
        }
        self.n_bytes += to_cdr(&record).len();
        self.records.push(record);
        Ok(())
    }

    /// The records in force, in accepted order.
    pub fn in_force(&self) -> impl DoubleEndedIterator<Item = &EvidenceRecord> {
        in_force(&self.records)
    }

    /// Ids of what is in force.
    pub(crate) fn ids_in_force(&self) -> HashSet<String> {
        self.in_force().map(|record| record_id(record).to_owned()).collect()
    }

    /// The same lesson with nothing but those records in force that `keep` takes.
    pub(crate) fn with_only(&self, keep: impl Fn(&str) -> bool) -> Self {
        let records = self.in_force().filter(|record| keep(record_id(record))).cloned().collect();
        Self {
            weights: self.weights.clone(),
            beginning: self.beginning.clone(),
            task: self.task.clone(),
            world: self.world.clone(),
            records,
            ..Self::default()
        }
    }

    /// The placements in force, in accepted order.
    pub fn placements(&self) -> impl Iterator<Item = &PlacementDemonstration> {
        self.in_force().filter_map(|record| record.demonstration.first())
    }

    /// The demonstrated actions in force, in accepted order.
    pub fn actions(&self) -> impl Iterator<Item = &ActionDemonstration> {
        self.in_force().filter_map(|record| record.actions.first())
    }

    /// The preferences in force, in accepted order.
    pub fn preferences(&self) -> impl Iterator<Item = &TrajectoryPreference> {
        self.in_force().filter_map(|record| record.preference.first())
    }

    /// The critiques in force, in accepted order.
    pub fn critiques(&self) -> impl Iterator<Item = &SegmentCritique> {
        self.in_force().filter_map(|record| record.critique.first())
    }

    /// The learners' histories in force, in accepted order.
    pub fn histories(&self) -> impl Iterator<Item = &LearnerHistory> {
        self.in_force().filter_map(|record| record.history.first())
    }

    /// Every trajectory that evidence in force is about, repeats among them.
    pub(crate) fn trajectories(&self) -> impl Iterator<Item = &FeatureTrajectory> {
        self.in_force().flat_map(trajectories_of)
    }

    /// The scene of the newest placement in force, else the task's.
    pub fn newest_scene(&self) -> Option<&TableScene> {
        self.placements().last().map(|d| &d.scene).or(self.task.as_ref().map(|(message, _)| message))
    }

    /// Questions of this lesson answered or skipped, taken back or not.
    pub fn n_answers(&self) -> u64 {
        let answered = |record: &&EvidenceRecord| {
            let query_ids = [
                record.demonstration.first().map(|m| &m.query_id),
                record.actions.first().map(|m| &m.query_id),
                record.preference.first().map(|m| &m.query_id),
                record.critique.first().map(|m| &m.query_id),
            ];
            let answers = [QueryResponse::SKIP, QueryResponse::CANT_TELL, QueryResponse::STOP];
            query_ids.into_iter().flatten().any(|id| !id.is_empty())
                || record.response.iter().any(|response| answers.contains(&response.kind))
        };
        let begins = self.in_force().rfind(|record| begins_lesson(record)).map_or(0, |record| record.sequence);
        self.records.iter().filter(|record| record.sequence > begins).filter(answered).count() as u64
    }

    /// What the person wants of the lesson itself, as in [`Posterior`]: to stop counts before to finish, that before the newest of
    /// to pause and to start.
    pub fn wish(&self) -> u8 {
        let mut wish = Posterior::NO_WISH;
        for response in self.in_force().filter_map(|record| record.response.first()) {
            wish = match response.kind {
                QueryResponse::STOP => return Posterior::STOP,
                QueryResponse::FINISH => Posterior::FINISH,
                QueryResponse::PAUSE if wish != Posterior::FINISH => Posterior::PAUSE,
                QueryResponse::START if wish != Posterior::FINISH => Posterior::START,
                _ => wish,
            };
        }
        wish
    }

    /// Header of what is computed from the evidence: the stamp of the newest event, never a clock's.
    pub fn header(&self) -> Header {
        let newest = self.records.iter().rev().find_map(record_header);
        let task = self.task.as_ref().map(|(message, _)| &message.header);
        let frame_id = task.map(|header| header.frame_id.clone()).unwrap_or_default();
        Header { stamp: newest.or(task).map(|header| header.stamp).unwrap_or_default(), frame_id }
    }

    /// The log of everything accepted.
    pub fn log(&self) -> EvidenceLog {
        let (task, world) = match &self.beginning {
            Some(Beginning::Table(task)) => ((**task).clone(), WorldReference::default()),
            Some(Beginning::World) => (TableScene::default(), self.world_reference()),
            None => (TableScene::default(), WorldReference::default()),
        };
        EvidenceLog { header: self.header(), task, world, records: self.records.clone() }
    }
}

/// The trajectories that a record compares.
fn trajectories_of(record: &EvidenceRecord) -> &[FeatureTrajectory] {
    match (record.preference.first(), record.history.first()) {
        (Some(preference), _) => &preference.trajectories,
        (None, Some(history)) => &history.demonstrations,
        (None, None) => &[],
    }
}
