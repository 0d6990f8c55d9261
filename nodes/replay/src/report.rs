//! Recorded against recomputed, bit for bit.

use crate::recording::Recorded;
use crate::{Difference, Lesson, Recording, ReplayError, difference};
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
    /// States of the lesson compared.
    pub lessons: Checked,
    /// Plans and guesses compared.
    pub plans: Checked,
    /// The first difference, in the order of the loop.
    pub mismatch: Option<Mismatch>,
}

/// Compares everything recorded with the session computed anew; stops at the first difference.
pub fn verify(recording: &Recording, lesson: &mut Lesson) -> Result<Report, ReplayError> {
    let revisions = lesson.rounds.len();
    let mut mismatch = None;
    for (r, round) in lesson.rounds.iter().enumerate() {
        let r = r as u64;
        mismatch = mismatch
            .or_else(|| compare(&recording.posterior, r, Some(&round.posterior)))
            .or_else(|| compare(&recording.candidates, r, Some(&round.candidates)))
            .or_else(|| compare(&recording.bounds, r, Some(&round.bounds)))
            .or_else(|| compare(&recording.query, r, round.query.as_ref()))
            .or_else(|| compare(&recording.lesson, r, Some(&round.lesson)));
    }
    mismatch = mismatch
        .or_else(|| beyond(&recording.posterior, revisions))
        .or_else(|| beyond(&recording.candidates, revisions))
        .or_else(|| beyond(&recording.bounds, revisions))
        .or_else(|| beyond(&recording.query, revisions))
        .or_else(|| beyond(&recording.lesson, revisions));
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
    Ok(Report {
        records: recording.evidence.records.len(),
        posteriors: checked(&recording.posterior, revisions),
        candidates: checked(&recording.candidates, revisions),
        bounds: checked(&recording.bounds, revisions),
        queries: checked(&recording.query, lesson.rounds.iter().filter(|round| round.query.is_some()).count()),
        lessons: checked(&recording.lesson, revisions),
        plans: checked(&recording.plan, revisions),
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

fn beyond<M: Message>(recorded: &Recorded<M>, revisions: usize) -> Option<Mismatch> {
    let revision = *recorded.keys().find(|revision| **revision >= revisions as u64)?;
    let difference = Difference {
        field: "revision".into(),
        recorded: revision.to_string(),
        recomputed: format!("the evidence ends at revision {}", revisions.saturating_sub(1)),
    };
    Some(Mismatch { message: M::TYPE, revision, difference })
}

fn found<M: Message>(recorded: &M, recomputed: &M, revision: u64) -> Mismatch {
    Mismatch { message: M::TYPE, revision, difference: difference(recorded, recomputed) }
}

fn checked<M>(recorded: &Recorded<M>, revisions: usize) -> Checked {
    Checked { recorded: recorded.values().map(Vec::len).sum(), revisions }
}
