//! Recorded against recomputed, bit for bit.

use crate::policies;
use crate::recording::Recorded;
use crate::{Difference, Lesson, Recording, ReplayError, difference};
use apprentice_msgs::msg::{PolicyBounds, PolicySet, PosteriorPreview};
use apprentice_msgs::{Message, to_cdr};
use serde::Serialize;

/// How many recorded outputs of one kind were compared.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
pub struct Checked {
    /// Distinct recorded messages.
    pub recorded: usize,
    /// Revisions of the session for which there should be one.
    pub revisions: usize,
}

/// The first recorded message that is not what its evidence and settings give.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Mismatch {
    /// Type of the message.
    pub message: &'static str,
    /// Its revision.
    pub revision: u64,
    /// The first field that differs.
    #[serde(flatten)]
    pub difference: Difference,
}

/// What a verification found.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Report {
    /// Accepted events.
    pub records: usize,
    /// Posteriors compared.
    pub posteriors: Checked,
    /// Lists of candidates compared.
    pub candidates: Checked,
    /// Bounds compared.
    pub bounds: Checked,
    /// Questions compared.
    pub queries: Checked,
    /// Questions about a world compared.
    pub world_queries: Checked,
    /// States of the lesson compared.
    pub lessons: Checked,
    /// Plans and guesses compared.
    pub plans: Checked,
    /// What an arm reaches compared, of all that was recorded: that of the lesson's table.
    pub reaches: Checked,
    /// Previews compared.
    pub previews: Checked,
    /// Bounds on policies compared, of all that were recorded: those whose policies were recorded, too.
    pub policy_bounds: Checked,
    /// Robust policies compared, of all that were recorded.
    pub robust_policies: Checked,
    /// Frontiers compared, of all that were recorded.
    pub frontiers: Checked,
    /// The first difference, in the order of the loop.
    pub mismatch: Option<Mismatch>,
}

/// Compares everything recorded with the session computed anew; stops at the first difference.
pub fn verify(recording: &Recording, lesson: &mut Lesson) -> Result<Report, ReplayError> {
    let last = recording.evidence.records.len() as u64;
    let mut mismatch = None;
    let (mut n_states, mut n_asked) = (0, 0);
    for r in 0..=last {
        let round = lesson.round(r);
        let is_of_world = round.is_some_and(|round| round.table.is_none());
        let said = if is_of_world { policies::said(recording, lesson, r) } else { policies::Said::default() };
        n_states += usize::from(said.is_due());
        n_asked += usize::from(said.is_asking());
        let table = round.and_then(|round| round.table.as_ref());
        mismatch = mismatch
            .or_else(|| compare(&recording.posterior, r, round.map(|round| &round.posterior)))
            .or_else(|| compare(&recording.candidates, r, table.map(|table| &table.candidates)))
            .or_else(|| compare(&recording.bounds, r, table.map(|table| &table.bounds)))
            .or_else(|| compare(&recording.query, r, table.and_then(|table| table.query.as_ref())))
            .or_else(|| match is_of_world {
                true => policies::world_lessons(recording, &said, r),
                false => compare(&recording.lesson, r, table.map(|table| &table.lesson)),
            });
    }
    mismatch = mismatch
        .or_else(|| beyond(&recording.posterior, last))
        .or_else(|| beyond(&recording.candidates, last))
        .or_else(|| beyond(&recording.bounds, last))
        .or_else(|| beyond(&recording.query, last))
        .or_else(|| beyond(&recording.world_query, last))
        .or_else(|| beyond(&recording.lesson, last));
    let mut reaches = Checked { recorded: 0, revisions: recording.reach.len() };
    for recorded in &recording.reach {
        if mismatch.is_some() {
            break;
        }
        let Some(recomputed) = lesson.reach_again(recorded)? else { continue };
        reaches.recorded += 1;
        if recomputed != *recorded {
            mismatch = Some(found(recorded, &recomputed, 0));
        }
    }
    for plans in recording.plan.values() {
        for (recorded, bytes) in plans {
            if mismatch.is_some() {
                break;
            }
            let mut recomputed = lesson.replan(recorded)?;
            // A plan may go out before the state of the lesson is known, and again after it.
            recomputed.inside_bound &= recorded.inside_bound;
            if to_cdr(&recomputed) != *bytes {
                mismatch = Some(found(recorded, &recomputed, recorded.revision));
            }
        }
    }
    for (recorded, bytes) in recording.preview.values().flatten() {
        mismatch = mismatch.or_else(|| preview(lesson, recorded, bytes));
    }
    let mut policy_bounds = Checked { recorded: 0, revisions: recording.policy_bounds.values().map(Vec::len).sum() };
    for (recorded, bytes) in recording.policy_bounds.values().flatten() {
        // Whoever sends policies may be gone before a recorder hears of it.
        let sets = sets_of(recording, recorded);
        policy_bounds.recorded += usize::from(!sets.is_empty());
        if mismatch.is_none() {
            mismatch = rejudged(lesson, &sets, recorded, bytes)?;
        }
    }
    for recorded in recording.robust_policy.values().flatten() {
        if mismatch.is_none() {
            mismatch = policies::robust_policy(recording, lesson, recorded)?;
        }
    }
    for recorded in recording.frontier.values().flatten() {
        if mismatch.is_none() {
            mismatch = policies::frontier(recording, lesson, recorded)?;
        }
    }
    let all = |n: usize| Checked { recorded: n, revisions: n };
    let revisions = lesson.rounds.len();
    let tables = lesson.rounds.iter().filter_map(|round| round.table.as_ref());
    let n_tables = tables.clone().count();
    Ok(Report {
        records: recording.evidence.records.len(),
        posteriors: checked(&recording.posterior, revisions),
        candidates: checked(&recording.candidates, n_tables),
        bounds: checked(&recording.bounds, n_tables),
        queries: checked(&recording.query, tables.filter(|table| table.query.is_some()).count()),
        world_queries: checked(&recording.world_query, n_asked),
        lessons: checked(&recording.lesson, n_tables.max(n_states)),
        plans: checked(&recording.plan, n_tables),
        reaches,
        previews: checked(&recording.preview, lesson.previews.len()),
        policy_bounds,
        robust_policies: all(recording.robust_policy.values().map(Vec::len).sum()),
        frontiers: all(recording.frontier.values().map(Vec::len).sum()),
        mismatch,
    })
}

fn compare<M: Message>(recorded: &Recorded<M>, revision: u64, recomputed: Option<&M>) -> Option<Mismatch> {
    let all = recorded.get(&revision)?;
    let Some(recomputed) = recomputed else {
        let difference = Difference {
            field: "(the whole message)".into(),
            recorded: "present".into(),
            recomputed: "none is due at this revision".into(),
        };
        return (!all.is_empty()).then_some(Mismatch { message: M::TYPE, revision, difference });
    };
    let bytes = to_cdr(recomputed);
    all.iter().find(|(_, recorded)| *recorded != bytes).map(|(recorded, _)| found(recorded, recomputed, revision))
}

fn beyond<M: Message>(recorded: &Recorded<M>, last: u64) -> Option<Mismatch> {
    let revision = *recorded.keys().find(|revision| **revision > last)?;
    let difference = Difference {
        field: "revision".into(),
        recorded: revision.to_string(),
        recomputed: format!("the evidence ends at revision {last}"),
    };
    Some(Mismatch { message: M::TYPE, revision, difference })
}

fn preview(lesson: &Lesson, recorded: &PosteriorPreview, bytes: &[u8]) -> Option<Mismatch> {
    let recomputed = lesson.previews.get(&(recorded.revision, recorded.base_revision));
    let recomputed = recomputed.cloned().unwrap_or_default();
    (to_cdr(&recomputed) != bytes).then(|| found(recorded, &recomputed, recorded.revision))
}

/// The sets that carry the id and the number that bounds name.
fn sets_of<'a>(recording: &'a Recording, recorded: &PolicyBounds) -> Vec<&'a PolicySet> {
    let named = |set: &&PolicySet| set.id == recorded.set_id && set.number == recorded.set_number;
    recording.policies.iter().filter(named).collect()
}

/// Bounds must be those of one of the sets.
fn rejudged(
    lesson: &Lesson,
    sets: &[&PolicySet],
    recorded: &PolicyBounds,
    bytes: &[u8],
) -> Result<Option<Mismatch>, ReplayError> {
    let mut first = None;
    for set in sets {
        let recomputed = lesson.rejudge(recorded, set)?;
        if to_cdr(&recomputed) == bytes {
            return Ok(None);
        }
        first = first.or_else(|| Some(found(recorded, &recomputed, recorded.revision)));
    }
    Ok(first)
}

pub(crate) fn found<M: Message>(recorded: &M, recomputed: &M, revision: u64) -> Mismatch {
    Mismatch { message: M::TYPE, revision, difference: difference(recorded, recomputed) }
}

fn checked<M>(recorded: &Recorded<M>, revisions: usize) -> Checked {
    Checked { recorded: recorded.values().map(Vec::len).sum(), revisions }
}
