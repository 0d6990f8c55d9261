//! Robust policies, frontiers and the state of a lesson about a world, recomputed.

use crate::report::{Mismatch, found};
use crate::{Difference, Lesson, Recording, ReplayError};
use active_query::{WorldInputs, fitted, questions_ahead, world_lesson, world_question};
use apprentice_msgs::msg::{LessonStatus, PolicyFrontier, RiskPreference, RobustPolicy, WorldQuery};
use apprentice_msgs::{Message, to_cdr};
use bus::NodeSettings;
use exchange::demonstrations_in_force;
use policy_optimizer::{Inputs, Policies};

/// What may be said at a revision of a lesson about a world: one state, and perhaps a question, for each judgement of the robot's
/// policy.
#[derive(Default)]
pub(crate) struct Said {
    states: Vec<LessonStatus>,
    queries: Vec<WorldQuery>,
}

impl Said {
    /// Whether a state was due, since the robot's policy had been judged.
    pub fn is_due(&self) -> bool {
        !self.states.is_empty()
    }

    /// Whether a question was due.
    pub fn is_asking(&self) -> bool {
        !self.queries.is_empty()
    }
}

/// What may be said at a revision.
pub(crate) fn said(recording: &Recording, lesson: &Lesson, revision: u64) -> Said {
    let mut said = Said::default();
    let Some(settings) = &lesson.query else { return said };
    let ahead = asked_ahead(recording, lesson, revision);
    // Only a person who is asked ahead gives evidence before the posterior of the last has come.
    let is_overtaken =
        recording.world_query.range(revision + 1..).any(|(_, asked)| asked.iter().any(|(query, _)| query.ahead > 0));
    for (inputs, state) in judged(recording, lesson, revision) {
        let asked = inputs.and_then(|inputs| world_question(settings, &inputs, &state).ok());
        if state.state == LessonStatus::ASKING {
            let stays = |query: &WorldQuery| LessonStatus {
                query_id: query.id.clone(),
                questions_asked: state.questions_asked.saturating_add(1),
                ..state.clone()
            };
            said.states.extend(ahead.iter().map(stays));
            said.states.extend(is_overtaken.then(|| state.clone()));
        }
        let (query, state) = asked.unwrap_or((None, state));
        said.queries.extend(query);
        said.states.push(state);
    }
    said.queries.splice(0..0, ahead);
    said
}

/// Where a lesson about a world stood at a revision, for each judgement of the robot's policy, and what a question was chosen by.
fn judged<'a>(
    recording: &'a Recording,
    lesson: &'a Lesson,
    revision: u64,
) -> impl Iterator<Item = (Option<WorldInputs<'a>>, LessonStatus)> {
    let known = lesson.query.as_ref().zip(lesson.round(revision));
    let judged = recording.policy_bounds.get(&revision).into_iter().flatten().map(|(bounds, _)| bounds);
    let unjudged = recording.unjudged.get(&revision).into_iter().flatten();
    judged.chain(unjudged).filter_map(move |bounds| {
        let (settings, round) = known?;
        let posterior = &round.posterior;
        let state = world_lesson(settings, posterior, bounds)?;
        let world = lesson.worlds.get(&posterior.world.hash);
        let inputs = world.map(|world| WorldInputs { posterior, world, log: &recording.evidence, bounds });
        // Evidence that cannot be held against the world is told of, and the lesson goes on.
        let fitted = inputs.as_ref().and_then(|inputs| fitted(settings, inputs, state.clone()).ok());
        Some((inputs, fitted.unwrap_or(state)))
    })
}

/// The questions of a revision that were recorded as chosen by the posterior of an earlier one, chosen anew.
fn asked_ahead(recording: &Recording, lesson: &Lesson, revision: u64) -> Vec<WorldQuery> {
    let Some(settings) = &lesson.query else { return Vec::new() };
    let recorded = recording.world_query.get(&revision).into_iter().flatten();
    let mut places: Vec<u32> = recorded.map(|(query, _)| query.ahead).filter(|ahead| *ahead > 0).collect();
    places.sort_unstable();
    places.dedup();
    let n = usize::try_from(settings.questions_ahead).unwrap_or(0);
    let mut found = Vec::new();
    for place in places {
        let Some(base) = revision.checked_sub(u64::from(place)) else { continue };
        // The question that was open then may have been asked ahead, too; it is compared at its own revision.
        let asked = recording.world_query.get(&base).into_iter().flatten();
        let asked: Vec<&WorldQuery> = asked.map(|(query, _)| query).filter(|query| query.ahead > 0).collect();
        for (inputs, state) in judged(recording, lesson, base) {
            for open in std::iter::once(None).chain(asked.iter().copied().map(Some)) {
                let all = inputs.and_then(|inputs| questions_ahead(settings, &inputs, &state, open, n).ok());
                found.extend(all.and_then(|all| all.into_iter().nth(place as usize)));
            }
        }
    }
    found
}

/// Recorded states of a lesson about a world, and its questions, must follow from one of the recorded bounds on the robot's
/// policy, which are compared on their own.
pub(crate) fn world_lessons(recording: &Recording, said: &Said, revision: u64) -> Option<Mismatch> {
    one_of(recording.world_query.get(&revision), &said.queries, revision, |a, b| a.ahead == b.ahead)
        .or_else(|| one_of(recording.lesson.get(&revision), &said.states, revision, |a, b| a.query_id == b.query_id))
}

/// A recorded message that is none of the possible ones, held against one that `is_like` it, or the last.
fn one_of<M: Message>(
    recorded: Option<&Vec<(M, Vec<u8>)>>,
    possible: &[M],
    revision: u64,
    is_like: impl Fn(&M, &M) -> bool,
) -> Option<Mismatch> {
    let known: Vec<Vec<u8>> = possible.iter().map(to_cdr).collect();
    let (other, _) = recorded?.iter().find(|(_, bytes)| !known.contains(bytes))?;
    Some(match possible.iter().find(|one| is_like(one, other)).or(possible.last()) {
        Some(last) => found(other, last, revision),
        None => none_is_due(M::TYPE, revision),
    })
}

/// A recorded robust policy, and the set that was sent to be judged with it.
pub(crate) fn robust_policy(
    recording: &Recording,
    lesson: &Lesson,
    (recorded, bytes): &(RobustPolicy, Vec<u8>),
) -> Result<Option<Mismatch>, ReplayError> {
    let preference = preference(recording, recorded)?;
    let recomputed = computed(recording, lesson, recorded.revision, &recorded.world.id, |settings, inputs| {
        policy_optimizer::policy(settings, inputs, preference)
    })?;
    let Policies { policy, set } = recomputed;
    if to_cdr(&policy) != *bytes {
        return Ok(Some(found(recorded, &policy, recorded.revision)));
    }
    // Whoever listened later than it was said has nothing to compare.
    let Some(set) = set else { return Ok(None) };
    let same: Vec<_> =
        recording.policies.iter().filter(|known| known.id == set.id && known.number == set.number).collect();
    let differs = !same.is_empty() && !same.iter().any(|known| to_cdr(*known) == to_cdr(&set));
    Ok(differs.then(|| found(same[0], &set, recorded.revision)))
}

/// A recorded frontier.
pub(crate) fn frontier(
    recording: &Recording,
    lesson: &Lesson,
    (recorded, bytes): &(PolicyFrontier, Vec<u8>),
) -> Result<Option<Mismatch>, ReplayError> {
    let recomputed = computed(recording, lesson, recorded.revision, &recorded.world.id, policy_optimizer::frontier)?;
    Ok((to_cdr(&recomputed) != *bytes).then(|| found(recorded, &recomputed, recorded.revision)))
}

/// What the optimizer computes of a revision.
fn computed<T>(
    recording: &Recording,
    lesson: &Lesson,
    revision: u64,
    world_id: &str,
    compute: impl FnOnce(&policy_optimizer::Settings, &Inputs<'_>) -> T,
) -> Result<T, ReplayError> {
    let settings = lesson.optimizer.as_ref().ok_or(ReplayError::NoSettings(policy_optimizer::Settings::NODE))?;
    let wrong = |reason: &str| ReplayError::Compute { revision, reason: reason.into() };
    let round = lesson.round(revision).ok_or_else(|| wrong("a policy for a revision without a posterior"))?;
    let named = &round.posterior.world.hash;
    let world = lesson.worlds.get(named).ok_or_else(|| ReplayError::NoWorld { id: world_id.into() })?;
    let demonstrations = demonstrations_in_force(&recording.evidence, revision, &world.id)
        .ok_or_else(|| wrong("the evidence ends before it"))?;
    Ok(compute(settings, &Inputs { posterior: &round.posterior, world, demonstrations: &demonstrations }))
}

/// The preference that a policy names; none: the parameter.
fn preference<'a>(
    recording: &'a Recording,
    recorded: &RobustPolicy,
) -> Result<Option<&'a RiskPreference>, ReplayError> {
    if recorded.preference_number == 0 {
        return Ok(None);
    }
    let key = (recorded.preference_number, recorded.preference_id.clone());
    let said = recording.preferences.get(&key);
    said.map(Some).ok_or_else(|| ReplayError::NoPreference { id: recorded.preference_id.clone() })
}

fn none_is_due(message: &'static str, revision: u64) -> Mismatch {
    let difference = Difference {
        field: "(the whole message)".into(),
        recorded: "present".into(),
        recomputed: "none is due at this revision".into(),
    };
    Mismatch { message, revision, difference }
}
