//! What speaks against the model of a lesson about a world: see [`crate::fit`].

use crate::fit::{Claim, MAX_JUDGED, Said, compared, is_sure, judged, may_matter};
use crate::world_draws::WorldDraws;
use crate::{Settings, WorldInputs};
use apprentice_msgs::msg::LessonStatus;
use exchange::{in_force, marks_from_message, steps_from_message};
use inquiry::tabular::{Answering, distinct};
use inquiry::{Answers, InquiryError, MAX_STEPS};

/// Whether a lesson's state depends on how well the evidence fits: it is judged where there is a bound, which rests on the model.
pub(crate) fn is_judged(settings: &Settings, lesson: &LessonStatus) -> bool {
    may_matter(settings, lesson) && lesson.loss_bound.is_finite() && lesson.demonstrations > 0
}

/// The lesson with what speaks against its model: its state says so when that is too much at the level of the settings.
///
/// # Errors
/// In a sentence: parts that do not fit together, or a world that is too large.
pub fn fitted(settings: &Settings, inputs: &WorldInputs<'_>, lesson: LessonStatus) -> Result<LessonStatus, String> {
    if !is_judged(settings, &lesson) {
        return Ok(lesson);
    }
    let draws = WorldDraws::new(inputs)?;
    fitted_by(settings, inputs, &draws, lesson).map_err(|error| error.to_string())
}

/// The same by draws that are at hand.
pub(crate) fn fitted_by(
    settings: &Settings,
    inputs: &WorldInputs<'_>,
    draws: &WorldDraws,
    lesson: LessonStatus,
) -> Result<LessonStatus, InquiryError> {
    if !is_judged(settings, &lesson) {
        return Ok(lesson);
    }
    let claim = Claim {
        bound: lesson.loss_bound,
        epsilon: settings.epsilon_loss,
        delta: inputs.bounds.delta,
        features: &inputs.world.feature_names,
        can_confirm: true,
    };
    judged(settings, &claim, &said(inputs, draws)?, draws.optima.n(), lesson)
}

/// Everything in force that was said for sure about the world, oldest first.
fn said<'a>(inputs: &WorldInputs<'a>, draws: &WorldDraws) -> Result<Vec<Said<'a>>, InquiryError> {
    let WorldInputs { posterior, world, log, .. } = *inputs;
    let (mdp, optima) = (&world.mdp, &draws.optima);
    let by = |kind: &str| draws.rationality(posterior, kind);
    let (actions, critiques, preferences) = (by("actions"), by("critiques"), by("preferences"));
    let end = usize::try_from(posterior.revision).unwrap_or(usize::MAX).min(log.records.len());
    let mut found = Vec::new();
    for record in in_force(&log.records[..end]).rev() {
        if found.len() >= MAX_JUDGED {
            break;
        }
        let mut add = |answers: Answers, given: usize| found.push(Said { record, answers, given });
        for message in record.actions.iter().filter(|message| is_sure(message.confidence)) {
            let answering = Answering { mdp, optima, betas: &actions.0, wrong_rate: actions.1 };
            let steps = steps_from_message(message, world).unwrap_or_default();
            for (state, action) in steps.into_iter().rev().take(MAX_JUDGED) {
                add(answering.action(state)?, action);
            }
        }
        for message in record.critique.iter().filter(|message| is_sure(message.confidence)) {
            let answering = Answering { mdp, optima, betas: &critiques.0, wrong_rate: critiques.1 };
            let marks = marks_from_message(message, world).unwrap_or_default();
            let pairs: Vec<(usize, usize)> = marks.iter().map(|mark| (mark.state, mark.action)).collect();
            let steps = distinct(&pairs);
            if steps.is_empty() || steps.len() > MAX_STEPS {
                continue;
            }
            // A pair that is marked twice counts as it was marked first.
            let first = |step: &(usize, usize)| marks.iter().find(|m| (m.state, m.action) == *step);
            let is_good = |step: &(usize, usize)| first(step).is_some_and(|mark| mark.good);
            let given = steps.iter().enumerate().map(|(bit, step)| usize::from(is_good(step)) << bit).sum();
            add(answering.critique(&steps)?, given);
        }
        for message in &record.preference {
            found.extend(compared(record, message, (&draws.weights, world.feature_names.len()), &preferences)?);
        }
    }
    found.reverse();
    Ok(found)
}
