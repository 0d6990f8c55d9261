//! Robust policies, frontiers and the state of a lesson about a world, recomputed.

use crate::report::{Mismatch, found};
use crate::{Difference, Lesson, Recording, ReplayError};
use active_query::{WorldInputs, world_lesson, world_question};
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
    let (Some(settings), Some(round)) = (&lesson.query, lesson.round(revision)) else { return said };
    let posterior = &round.posterior;
    for (bounds, _) in recording.policy_bounds.get(&revision).into_iter().flatten() {
        let Some(state) = world_lesson(settings, posterior, bounds) else { continue };
        let world = lesson.worlds.get(&posterior.world.hash);
        let inputs = world.map(|world| WorldInputs { posterior, world, log: &recording.evidence, bounds });
        let asked = inputs.and_then(|inputs| world_question(settings, &inputs, &state).ok().flatten());
        let (query, state) = asked.map_or((None, state), |(query, state)| (Some(query), state));
        said.queries.extend(query);
        said.states.push(state);
    }
    said
}

/// Recorded states of a lesson about a world, and its questions, must follow from one of the recorded bounds on the robot's
/// policy, which are compared on their own.
pub(crate) fn world_lessons(recording: &Recording, said: &Said, revision: u64) -> Option<Mismatch> {
    one_of(recording.world_query.get(&revision), &said.queries, revision)
        .or_else(|| one_of(recording.lesson.get(&revision), &said.states, revision))
}

fn one_of<M: Message>(recorded: Option<&Vec<(M, Vec<u8>)>>, possible: &[M], revision: u64) -> Option<Mismatch> {
    let known: Vec<Vec<u8>> = possible.iter().map(to_cdr).collect();
    let (other, _) = recorded?.iter().find(|(_, bytes)| !known.contains(bytes))?;
    Some(match possible.last() {
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
