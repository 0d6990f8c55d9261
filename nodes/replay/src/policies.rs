//! Robust policies, frontiers and the state of a lesson about a world, recomputed.

use crate::report::{Mismatch, found};
use crate::{Difference, Lesson, Recording, ReplayError};
use active_query::world_lesson;
use apprentice_msgs::msg::{LessonStatus, PolicyFrontier, RiskPreference, RobustPolicy};
use apprentice_msgs::{Message, to_cdr};
use bus::NodeSettings;
use exchange::demonstrations_in_force;
use policy_optimizer::{Inputs, Policies};

/// The revisions of a lesson about a world whose state was due, since the robot's policy had been judged.
pub(crate) fn lessons_due(recording: &Recording, lesson: &Lesson) -> usize {
    let of_world = lesson.rounds.iter().filter(|round| round.table.is_none()).map(|round| round.posterior.revision);
    of_world.filter(|revision| !states(recording, lesson, *revision).is_empty()).count()
}

/// The states that a revision of a lesson about a world may have: one for each judgement of the robot's policy.
fn states(recording: &Recording, lesson: &Lesson, revision: u64) -> Vec<LessonStatus> {
    let (Some(settings), Some(round)) = (&lesson.query, lesson.round(revision)) else { return Vec::new() };
    let judged = recording.policy_bounds.get(&revision).into_iter().flatten();
    judged.filter_map(|(bounds, _)| world_lesson(settings, &round.posterior, bounds)).collect()
}

/// Recorded states of a lesson about a world must follow from one of the recorded bounds on the robot's policy, which are
/// compared on their own.
pub(crate) fn world_lessons(recording: &Recording, lesson: &Lesson, revision: u64) -> Option<Mismatch> {
    let recorded = recording.lesson.get(&revision)?;
    let states = states(recording, lesson, revision);
    let known: Vec<Vec<u8>> = states.iter().map(to_cdr).collect();
    let (other, _) = recorded.iter().find(|(_, bytes)| !known.contains(bytes))?;
    Some(match states.last() {
        Some(state) => found(other, state, revision),
        None => none_is_due(LessonStatus::TYPE, revision),
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
