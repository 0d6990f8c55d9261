//! Whether what the person said can be explained with the features that the world has (posterior-predictive check), and whether
//! their answers to questions that were drawn at random were as expected: what speaks against the model that every bound rests on.

use crate::world_draws::WorldDraws;
use crate::world_rests::asked_at_random;
use crate::world_words;
use crate::{Settings, WorldInputs};
use apprentice_msgs::msg::{EvidenceRecord, LessonStatus, TrajectoryPreference};
use exchange::{Confidence, confidence_from_message, in_force, marks_from_message, record_id, steps_from_message};
use inquiry::tabular::{Answering, comparison_answers, distinct};
use inquiry::{
    Answered, Answers, Belief, Chosen, HoldOut, InquiryError, Look, MAX_STEPS, Obstacle, Selection, Standing,
    StoppingRule, predictive_check,
};
use likelihood::preferences::AnswerModel;

/// Answers that are judged, at most: the newest.
const MAX_JUDGED: usize = 500;

/// Something that was said for sure, as one of the answers that were possible. What was said with less confidence is expected to be off.
struct Said<'a> {
    record: &'a EvidenceRecord,
    answers: Answers,
    given: usize,
}

/// Whether a lesson's state depends on how well the evidence fits: it is judged where there is a bound, which rests on the model.
pub(crate) fn is_judged(settings: &Settings, lesson: &LessonStatus) -> bool {
    let goes_on = [LessonStatus::ASKING, LessonStatus::TAUGHT].contains(&lesson.state);
    let may_matter = settings.misfit_level > 0.0 || settings.most_surprises < 1.0;
    may_matter && goes_on && lesson.loss_bound.is_finite() && lesson.demonstrations > 0
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
    mut lesson: LessonStatus,
) -> Result<LessonStatus, InquiryError> {
    if !is_judged(settings, &lesson) {
        return Ok(lesson);
    }
    let said = said(inputs, draws)?;
    let belief = Belief::equal(draws.optima.n())?;
    let answered: Vec<Answered<'_>> =
        said.iter().map(|said| Answered { answers: &said.answers, given: said.given }).collect();
    let check = predictive_check(&answered, &belief, settings.seed.unsigned_abs())?;
    let mut hold_out = HoldOut::default();
    for said in said.iter().filter(|said| asked_at_random(said.record)) {
        hold_out.add(&said.answers, &belief_without(said)?, said.given)?;
    }
    let number = |n: u64| u32::try_from(n).unwrap_or(u32::MAX);
    (lesson.held_out, lesson.surprises) = (number(hold_out.n), number(hold_out.surprises));
    lesson.misfit_p = check.p_value;
    let rule = StoppingRule {
        epsilon: settings.epsilon_loss,
        delta: inputs.bounds.delta,
        // Of the question, which is chosen later.
        least_gain_per_second: 0.0,
        most_surprises: settings.most_surprises,
        // Where it is switched off, nothing is that improbable.
        misfit_level: settings.misfit_level.max(f64::MIN_POSITIVE),
    };
    let bounds = [Some(lesson.loss_bound)];
    let fit = Some(&check).filter(|_| settings.misfit_level > 0.0);
    let next = Selection::Ask(Chosen { question: 0, score: 0.0, per_second: None, is_hold_out: false });
    let names = &inputs.world.feature_names;
    match rule.standing(&Look { bounds: &bounds, next: &next, drop: None, hold_out, fit })? {
        Standing::CannotBeReached { because, .. } => {
            lesson.state = LessonStatus::MISFIT;
            lesson.reason = match because {
                Obstacle::Surprises { hold_out, .. } => world_words::surprised(hold_out.surprises, hold_out.n, names),
                _ => world_words::misfit(check.p_value, names),
            };
            for &at in &check.worst {
                let id = record_id(said[at].record).to_owned();
                if !lesson.misfits.contains(&id) {
                    lesson.misfits.push(id);
                }
            }
        }
        Standing::Confirming { about, .. } => {
            lesson.to_confirm = about;
            let is_over = i64::from(lesson.demonstrations) >= settings.max_questions;
            lesson.state = if is_over { LessonStatus::GAVE_UP } else { LessonStatus::ASKING };
            lesson.reason = world_words::unconfirmed(&lesson.reason, about, settings.most_surprises, is_over);
        }
        Standing::Taught { .. } | Standing::NotYet { .. } => {}
    }
    Ok(lesson)
}

/// What is believed by everything but one answer: the draws weighed by the inverse of its probability (importance sampling of
/// the posterior that leaves it out), with weights that are truncated at √n times their mean (Ionides 2008).
fn belief_without(said: &Said<'_>) -> Result<Belief, InquiryError> {
    let mut weights = said.answers.likelihood(said.given)?;
    weights.iter_mut().for_each(|p| *p = 1.0 / p.max(f64::MIN_POSITIVE));
    let n = weights.len() as f64;
    let most = (weights.iter().fold(0.0, |sum, w| sum + w / n) * n.sqrt()).min(f64::MAX);
    weights.iter_mut().for_each(|w| *w = w.min(most));
    Belief::weighted(&weights)
}

/// Everything in force that was said for sure about the world, oldest first.
fn said<'a>(inputs: &WorldInputs<'a>, draws: &WorldDraws) -> Result<Vec<Said<'a>>, InquiryError> {
    let WorldInputs { posterior, world, log, .. } = *inputs;
    let (mdp, optima) = (&world.mdp, &draws.optima);
    let by = |kind: &str| draws.rationality(posterior, kind);
    let (actions, critiques, preferences) = (by("actions"), by("critiques"), by("preferences"));
    let is_sure = |confidence: u8| confidence_from_message(confidence) == Ok(Confidence::Sure);
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
        for message in record.preference.iter().filter(|message| is_sure(message.confidence)) {
            let [worse, better] = message.trajectories.as_slice() else { continue };
            let model = AnswerModel { wrong_rate: preferences.1, ..AnswerModel::default() };
            let utilities = (0..optima.n()).map(|draw| {
                let betas = &preferences.0;
                let gain: f64 = optima
                    .weights(draw)
                    .iter()
                    .zip(worse.features.iter().zip(&better.features))
                    .map(|(w, (worse, better))| w * (better - worse))
                    .sum();
                betas[if betas.len() == 1 { 0 } else { draw }] * gain
            });
            let answers = comparison_answers(utilities, &model)?;
            let given = match message.answer {
                TrajectoryPreference::RANKED => 1,
                TrajectoryPreference::EQUAL => 2,
                _ => 3,
            };
            if given < answers.n() {
                add(answers, given);
            }
        }
    }
    found.reverse();
    Ok(found)
}
