//! The session computed anew: the same state machines, fed the same evidence.

use crate::{Recording, ReplayError};
use active_query::ActiveQuery;
use apprentice_msgs::builtin_interfaces::Time;
use apprentice_msgs::msg::{Candidates, LessonStatus, PerformanceBounds, PlacementPlan, PlacementQuery, Posterior};
use bus::NodeSettings;
use performance_bounds::PerformanceBoundsNode;
use placement_planner::{PlacementPlanner, Request, is_task};
use std::collections::BTreeMap;

/// What the nodes say to one revision.
#[derive(Debug, Clone, PartialEq)]
pub struct Round {
    /// The posterior.
    pub posterior: Posterior,
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
    /// One round per revision, from 0.
    pub rounds: Vec<Round>,
    planner: placement_planner::Settings,
    planners: BTreeMap<String, PlacementPlanner>,
    robots: BTreeMap<String, String>,
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
    let mut query = ActiveQuery::new(settings(recording)?);
    let mut bounds = PerformanceBoundsNode::new(bounds);
    let mut rounds = Vec::new();
    let log = &recording.evidence;
    let posteriors = reward_posterior::replay_records(posterior, log.task.clone(), &log.records);
    for posterior in posteriors {
        let revision = rounds.len() as u64;
        let posterior = posterior.map_err(|reason| ReplayError::Compute { revision, reason })?;
        let round =
            round(posterior, &mut query, &mut bounds).map_err(|reason| ReplayError::Compute { revision, reason })?;
        progress(&round);
        rounds.push(round);
    }
    Ok(Lesson { rounds, planner: settings(recording)?, planners: BTreeMap::new(), robots: recording.robots.clone() })
}

fn round(posterior: Posterior, query: &mut ActiveQuery, bounds: &mut PerformanceBoundsNode) -> Result<Round, String> {
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
        }
    }
    let bounds = judged.ok_or("performance_bounds gave no bounds")?;
    let (mut asked, mut lesson) = (None, None);
    for output in query.step(now, active_query::Event::Bounds(Box::new(bounds.clone()))) {
        match output {
            active_query::Output::Query(message) => asked = Some(*message),
            active_query::Output::Lesson(message) => lesson = Some(message),
            active_query::Output::Warn(text) => return Err(text),
            active_query::Output::Candidates(_) => {}
        }
    }
    let lesson = lesson.ok_or("active_query gave no state of the lesson")?;
    Ok(Round { posterior, candidates, bounds, query: asked, lesson })
}

impl Lesson {
    /// A recorded plan computed anew, from the scene and the start it names.
    pub fn replan(&mut self, recorded: &PlacementPlan) -> Result<PlacementPlan, ReplayError> {
        let revision = recorded.revision;
        let wrong = |reason: String| ReplayError::Compute { revision, reason };
        let index = usize::try_from(revision).unwrap_or(usize::MAX);
        let round = self.rounds.get(index).ok_or_else(|| wrong("a plan for a revision beyond the evidence".into()))?;
        if !self.planners.contains_key(&recorded.robot_hash) {
            let mut planner = PlacementPlanner::new(self.planner.clone());
            if !recorded.robot_hash.is_empty() {
                let urdf = self.robots.get(&recorded.robot_hash);
                let urdf = urdf.ok_or_else(|| wrong("its robot description is not in the bag".into()))?;
                planner.set_robot(urdf).map_err(|reason| wrong(reason.to_string()))?;
            }
            self.planners.insert(recorded.robot_hash.clone(), planner);
        }
        let planner = self.planners.get_mut(&recorded.robot_hash).expect("it was just put there");
        let request = Request {
            posterior: &round.posterior,
            query_id: &recorded.query_id,
            scene: &recorded.scene,
            start: &recorded.start,
            inside_bound: recorded.query_id.is_empty()
                && round.lesson.state == LessonStatus::TAUGHT
                && is_task(&recorded.scene, &round.posterior),
        };
        planner.plan(&request).map_err(wrong)
    }
}

fn settings<S: NodeSettings>(recording: &Recording) -> Result<S, ReplayError> {
    let recorded = recording.settings.get(S::NODE).ok_or(ReplayError::NoSettings(S::NODE))?;
    bus::settings_from_yaml(&recorded.parameters).map_err(|error| ReplayError::Settings {
        node: S::NODE,
        version: recorded.version.clone(),
        reason: error.to_string(),
    })
}
