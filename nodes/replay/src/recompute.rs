//! The session computed anew: the same state machines, fed the same evidence.

use crate::{Recording, ReplayError};
use active_query::ActiveQuery;
use apprentice_msgs::builtin_interfaces::Time;
use apprentice_msgs::msg::{
    Candidates, EvidenceRecord, LessonStatus, PerformanceBounds, PlacementPlan, PlacementQuery, PolicyBounds,
    PolicySet, Posterior, PosteriorPreview,
};
use bus::NodeSettings;
use exchange::{World, is_about_a_table, world_from_message};
use performance_bounds::{PerformanceBoundsNode, judge_policies};
use placement_planner::{PlacementPlanner, Request, RobotFiles, is_task};
use reward_posterior::{Entry, RewardPosterior};
use std::collections::{BTreeMap, BTreeSet};

/// What the nodes say to one revision.
#[derive(Debug, Clone, PartialEq)]
pub struct Round {
    /// The posterior.
    pub posterior: Posterior,
    /// What is said of tables, in a lesson about one.
    pub table: Option<TableRound>,
}

/// What is said of tables.
#[derive(Debug, Clone, PartialEq)]
pub struct TableRound {
    /// The tables to judge.
    pub candidates: Candidates,
    /// The bounds on them.
    pub bounds: PerformanceBounds,
    /// The question, unless the lesson is over.
    pub query: Option<PlacementQuery>,
    /// The state of the lesson.
    pub lesson: LessonStatus,
}

/// A session computed anew.
pub struct Lesson {
    /// One round per revision for which there is a posterior, ascending: from 0, unless only the first evidence said what the
    /// weights are about.
    pub rounds: Vec<Round>,
    /// Previews that were recorded, computed anew, by revision and base revision.
    pub previews: BTreeMap<(u64, u64), PosteriorPreview>,
    bounds: performance_bounds::Settings,
    planner: Option<placement_planner::Settings>,
    /// Of the nodes that a lesson about a world takes, as far as they were there.
    pub(crate) optimizer: Option<policy_optimizer::Settings>,
    pub(crate) query: Option<active_query::Settings>,
    planners: BTreeMap<String, PlacementPlanner>,
    robots: BTreeMap<String, String>,
    semantics: BTreeSet<String>,
    pub(crate) worlds: BTreeMap<String, World>,
}

/// Computes every revision of a recording; `threads` overrides the recorded number and must not matter.
/// `progress` is told each revision as it is done.
pub fn recompute(
    recording: &Recording,
    threads: Option<i64>,
    mut progress: impl FnMut(&Round),
) -> Result<Lesson, ReplayError> {
    let mut posterior: reward_posterior::Settings = settings(recording)?;
    let mut bounds: performance_bounds::Settings = settings(recording)?;
    if let Some(threads) = threads {
        posterior.threads = threads;
        bounds.threads = threads;
    }
    let mut node = RewardPosterior::new(posterior);
    let mut tables: Option<(ActiveQuery, PerformanceBoundsNode)> = None;
    let (mut rounds, mut previews) = (Vec::new(), BTreeMap::new());
    let records = &recording.evidence.records;
    for revision in 0..=records.len() as u64 {
        let wrong = |reason: String| ReplayError::Compute { revision, reason };
        node.restore(entries(recording, revision)?).map_err(wrong)?;
        let Some(posterior) = node.posterior().map_err(wrong)? else { continue };
        for preview in recorded_previews(recording, revision) {
            let until = usize::try_from(preview.revision).unwrap_or(usize::MAX).min(records.len());
            let later = records.get(revision as usize..until).unwrap_or_default();
            if let Some(preview) = node.preview_after(later).map_err(wrong)? {
                previews.insert((preview.revision, revision), preview);
            }
        }
        let table = if is_about_a_table(&posterior) {
            if tables.is_none() {
                tables = Some((ActiveQuery::new(settings(recording)?), PerformanceBoundsNode::new(bounds.clone())));
            }
            let (query, bounds) = tables.as_mut().expect("they were just put there");
            Some(table_round(&posterior, query, bounds).map_err(wrong)?)
        } else {
            None
        };
        let round = Round { posterior, table };
        progress(&round);
        rounds.push(round);
    }
    let mut optimizer: Option<policy_optimizer::Settings> = settings_if_any(recording)?;
    if let (Some(optimizer), Some(threads)) = (&mut optimizer, threads) {
        optimizer.threads = threads;
    }
    let query = settings_if_any(recording)?;
    let planner = if tables.is_some() { Some(settings(recording)?) } else { None };
    // Worlds that cannot be used were recorded, too; nothing depends on them.
    let worlds = recording.worlds.values().filter_map(|message| world_from_message(message).ok());
    Ok(Lesson {
        rounds,
        previews,
        bounds,
        planner,
        optimizer,
        query,
        planners: BTreeMap::new(),
        robots: recording.robots.clone(),
        semantics: recording.semantics.clone(),
        worlds: worlds.map(|world| (world.hash.clone(), world)).collect(),
    })
}

/// What a node restores to come to a revision from the one before.
fn entries(recording: &Recording, revision: u64) -> Result<Vec<Entry>, ReplayError> {
    let log = &recording.evidence;
    let world = |reference: &apprentice_msgs::msg::WorldReference| match recording.worlds.get(&reference.hash) {
        Some(world) => Ok(Entry::World(Box::new(world.clone()))),
        None => Err(ReplayError::NoWorld { id: reference.id.clone() }),
    };
    let Some(index) = (revision as usize).checked_sub(1) else {
        return match (log.task.width_m > 0.0, log.world.hash.is_empty()) {
            (true, _) => Ok(vec![Entry::Task(Box::new(log.task.clone()))]),
            (false, false) => Ok(vec![world(&log.world)?]),
            (false, true) => Ok(Vec::new()),
        };
    };
    let record: &EvidenceRecord = &log.records[index];
    let named = record.world.iter().map(world).collect::<Result<Vec<_>, _>>()?;
    Ok(named.into_iter().chain([Entry::Record(Box::new(record.clone()))]).collect())
}

fn recorded_previews(recording: &Recording, base_revision: u64) -> impl Iterator<Item = &PosteriorPreview> {
    let all = recording.preview.values().flatten().map(|(preview, _)| preview);
    all.filter(move |preview| preview.base_revision == base_revision)
}

fn table_round(
    posterior: &Posterior,
    query: &mut ActiveQuery,
    bounds: &mut PerformanceBoundsNode,
) -> Result<TableRound, String> {
    let now = Time::default();
    let mut candidates = None;
    for output in query.step(now, active_query::Event::Posterior(Box::new(posterior.clone()))) {
        match output {
            active_query::Output::Candidates(message) => candidates = Some(message),
            active_query::Output::Warn(text) => return Err(text),
            _ => {}
        }
    }
    let candidates = candidates.ok_or("active_query gave no candidates")?;
    let mut judged = None;
    bounds.step(now, performance_bounds::Event::Posterior(Box::new(posterior.clone())));
    for output in bounds.step(now, performance_bounds::Event::Candidates(Box::new(candidates.clone()))) {
        match output {
            performance_bounds::Output::Bounds(message) => judged = Some(*message),
            performance_bounds::Output::Warn(text) => return Err(text),
            performance_bounds::Output::PolicyBounds(_) => {}
        }
    }
    let bounds = judged.ok_or("performance_bounds gave no bounds")?;
    let (mut asked, mut lesson) = (None, None);
    for output in query.step(now, active_query::Event::Bounds(Box::new(bounds.clone()))) {
        match output {
            active_query::Output::Query(message) => asked = Some(*message),
            active_query::Output::Lesson(message) => lesson = Some(message),
            active_query::Output::Warn(text) => return Err(text),
            active_query::Output::Candidates(_)
            | active_query::Output::WorldQuery(_)
            | active_query::Output::LookAhead => {}
        }
    }
    let lesson = lesson.ok_or("active_query gave no state of the lesson")?;
    Ok(TableRound { candidates, bounds, query: asked, lesson })
}

impl Lesson {
    /// What was said to a revision.
    pub fn round(&self, revision: u64) -> Option<&Round> {
        self.rounds.iter().find(|round| round.posterior.revision == revision)
    }

    /// A recorded plan computed anew, from the scene and the start it names.
    pub fn replan(&mut self, recorded: &PlacementPlan) -> Result<PlacementPlan, ReplayError> {
        let revision = recorded.revision;
        let wrong = |reason: String| ReplayError::Compute { revision, reason };
        let round = self.rounds.iter().find(|round| round.posterior.revision == revision);
        let round = round.ok_or_else(|| wrong("a plan for a revision without a posterior".into()))?;
        let (Some(table), Some(settings)) = (&round.table, &self.planner) else {
            return Err(wrong("a plan for a table that the lesson is not about".into()));
        };
        if !self.planners.contains_key(&recorded.robot_hash) {
            let files = RobotFiles::open(settings).map_err(|error| wrong(error.to_string()))?;
            let mut planner = PlacementPlanner::with_files(settings.clone(), files);
            if !self.takes(&mut planner, &recorded.robot_hash) {
                let reason = "its robot description is not in the bag, or its meshes or SRDF are not what they were";
                return Err(wrong(reason.into()));
            }
            self.planners.insert(recorded.robot_hash.clone(), planner);
        }
        let planner = self.planners.get_mut(&recorded.robot_hash).expect("it was just put there");
        let request = Request {
            posterior: &round.posterior,
            query_id: &recorded.query_id,
            scene: &recorded.scene,
            start: &recorded.start,
            pick: recorded.picks.then_some(&recorded.pick),
            inside_bound: recorded.query_id.is_empty()
                && table.lesson.state == LessonStatus::TAUGHT
                && is_task(&recorded.scene, &round.posterior),
        };
        planner.plan(&request).map_err(wrong)
    }

    /// Gives a planner the robot of a hash: a description with or without one of the recorded SRDFs.
    fn takes(&self, planner: &mut PlacementPlanner, hash: &str) -> bool {
        if hash.is_empty() {
            return true;
        }
        // Most are named by their text alone.
        let first = self.robots.get(hash).into_iter();
        first.chain(self.robots.values()).any(|urdf| {
            let with = self.semantics.iter().map(|text| Some(text.as_str()));
            std::iter::once(None)
                .chain(with)
                .any(|semantics| planner.set_robot(urdf, semantics).is_ok() && planner.robot_hash() == hash)
        })
    }

    /// Recorded bounds on policies computed anew, from the set that they judge.
    pub fn rejudge(&self, recorded: &PolicyBounds, set: &PolicySet) -> Result<PolicyBounds, ReplayError> {
        let revision = recorded.revision;
        let wrong = |reason: String| ReplayError::Compute { revision, reason };
        let round = self.round(revision);
        let posterior = &round.ok_or_else(|| wrong("bounds for a revision without a posterior".into()))?.posterior;
        let named = &posterior.world;
        let world = self.worlds.get(&named.hash);
        if world.is_none() && !named.hash.is_empty() {
            return Err(ReplayError::NoWorld { id: named.id.clone() });
        }
        judge_policies(&self.bounds, posterior, set, world).map_err(wrong)
    }
}

fn settings_if_any<S: NodeSettings>(recording: &Recording) -> Result<Option<S>, ReplayError> {
    if recording.settings.contains_key(S::NODE) { settings(recording).map(Some) } else { Ok(None) }
}

fn settings<S: NodeSettings>(recording: &Recording) -> Result<S, ReplayError> {
    let recorded = recording.settings.get(S::NODE).ok_or(ReplayError::NoSettings(S::NODE))?;
    bus::settings_from_yaml(&recorded.parameters).map_err(|error| ReplayError::Settings {
        node: S::NODE,
        version: recorded.version.clone(),
        reason: error.to_string(),
    })
}
