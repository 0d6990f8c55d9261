//! The session computed anew: the same state machines, fed the same evidence.

use crate::{Recording, ReplayError};
use active_query::ActiveQuery;
use apprentice_msgs::builtin_interfaces::Time;
use apprentice_msgs::msg::{
    Candidates, EvidenceRecord, LessonStatus, PerformanceBounds, PlacementPlan, PlacementQuery, PolicyBounds,
    PolicySet, Posterior, PosteriorPreview, TableReach, TableScene,
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
                let mut query = ActiveQuery::new(settings(recording)?);
                // It reads as much of the log as a revision takes in.
                query.step(Time::default(), active_query::Event::Evidence(Box::new(recording.evidence.clone())));
                tables = Some((query, PerformanceBoundsNode::new(bounds.clone())));
            }
            let (query, bounds) = tables.as_mut().expect("they were just put there");
            if let Some(reach) = recorded_reach(recording, &posterior) {
                query.step(Time::default(), active_query::Event::Reach(Box::new(reach.clone())));
            }
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

/// What the arm was known to reach when tables were imagined for a revision: of the robot that the candidates name. It is computed
/// anew, too ([`Lesson::reach_again`]).
fn recorded_reach<'a>(recording: &'a Recording, posterior: &Posterior) -> Option<&'a TableReach> {
    let (candidates, _) = recording.candidates.get(&posterior.revision)?.first()?;
    let mut of_task = recording.reach.iter().filter(|reach| is_of(reach, &posterior.task));
    of_task.find(|reach| reach.robot_hash == candidates.robot_hash)
}

/// Whether that is the reach of a table with its target.
fn is_of(reach: &TableReach, task: &TableScene) -> bool {
    (reach.width_m, reach.depth_m, &reach.target_id) == (task.width_m, task.depth_m, &task.target.id)
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
    let candidates =
        candidates.ok_or("active_query gave no candidates; what the arm reaches may be missing from the bag")?;
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
        let settings = settings.clone();
        let planner = planner_of(&mut self.planners, &self.robots, &self.semantics, &settings, &recorded.robot_hash);
        let planner = planner.map_err(wrong)?;
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

    /// What an arm reaches of the lesson's table computed anew; `None` when it is of another table.
    pub fn reach_again(&mut self, recorded: &TableReach) -> Result<Option<TableReach>, ReplayError> {
        let of = |round: &Round| (round.table.is_some()).then(|| round.posterior.task.clone());
        let Some(task) = self.rounds.iter().find_map(of) else { return Ok(None) };
        let Some(settings) = self.planner.clone() else { return Ok(None) };
        if !is_of(recorded, &task) {
            return Ok(None);
        }
        let wrong = |reason: String| ReplayError::Compute { revision: 0, reason };
        let planner = planner_of(&mut self.planners, &self.robots, &self.semantics, &settings, &recorded.robot_hash);
        planner.map_err(wrong)?.reach(&task).map(Some).map_err(wrong)
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

/// The planner with the robot of a hash, made once.
fn planner_of<'a>(
    planners: &'a mut BTreeMap<String, PlacementPlanner>,
    robots: &BTreeMap<String, String>,
    semantics: &BTreeSet<String>,
    settings: &placement_planner::Settings,
    hash: &str,
) -> Result<&'a mut PlacementPlanner, String> {
    if !planners.contains_key(hash) {
        let files = RobotFiles::open(settings).map_err(|error| error.to_string())?;
        let mut planner = PlacementPlanner::with_files(settings.clone(), files);
        if !takes(&mut planner, robots, semantics, hash) {
            return Err("its robot description is not in the bag, or its meshes or SRDF are not what they were".into());
        }
        planners.insert(hash.to_owned(), planner);
    }
    Ok(planners.get_mut(hash).expect("it was just put there"))
}

/// Gives a planner the robot of a hash: a description with or without one of the recorded SRDFs.
fn takes(
    planner: &mut PlacementPlanner,
    robots: &BTreeMap<String, String>,
    semantics: &BTreeSet<String>,
    hash: &str,
) -> bool {
    if hash.is_empty() {
        return true;
    }
    // Most are named by their text alone.
    robots.get(hash).into_iter().chain(robots.values()).any(|urdf| {
        let with = semantics.iter().map(|text| Some(text.as_str()));
        std::iter::once(None)
            .chain(with)
            .any(|semantics| planner.set_robot(urdf, semantics).is_ok() && planner.robot_hash() == hash)
    })
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
