//! Whether what the person said can be explained with the features that there are (posterior-predictive check), and whether their
//! answers to questions that were drawn at random were as expected: what speaks against the model that every bound rests on.

use crate::Settings;
use crate::fit_words;
use crate::question_id::asked_at_random;
use apprentice_msgs::msg::{EvidenceRecord, LessonStatus, TrajectoryPreference};
use exchange::{Confidence, confidence_from_message, record_id};
use inquiry::tabular::comparison_answers;
use inquiry::{
    Answered, Answers, Belief, Chosen, HoldOut, InquiryError, Look, Obstacle, Selection, Standing, StoppingRule,
    predictive_check,
};
use likelihood::preferences::AnswerModel;

/// Answers that are judged, at most: the newest.
pub(crate) const MAX_JUDGED: usize = 500;

/// Something that was said for sure, as one of the answers that were possible. What was said with less confidence is expected to be off.
pub(crate) struct Said<'a> {
    pub record: &'a EvidenceRecord,
    pub answers: Answers,
    pub given: usize,
}

/// What a lesson is judged by besides what was said.
pub(crate) struct Claim<'a> {
    /// The bound, in the unit of ε.
    pub bound: f64,
    pub epsilon: f64,
    /// Of the bound.
    pub delta: f64,
    /// What the weights are about.
    pub features: &'a [String],
    /// Whether questions may be asked at random that would confirm the model.
    pub can_confirm: bool,
}

/// Whether a lesson's state may depend on how well the evidence fits.
pub(crate) fn may_matter(settings: &Settings, lesson: &LessonStatus) -> bool {
    let goes_on = [LessonStatus::ASKING, LessonStatus::TAUGHT].contains(&lesson.state);
    goes_on && (settings.misfit_level > 0.0 || settings.most_surprises < 1.0)
}

/// The lesson with what speaks against its model, by draws of equal weight: its state says so when that is too much at the level of
/// the settings.
///
/// # Errors
/// Answers about other numbers of draws.
pub(crate) fn judged(
    settings: &Settings,
    claim: &Claim<'_>,
    said: &[Said<'_>],
    n_draws: usize,
    mut lesson: LessonStatus,
) -> Result<LessonStatus, InquiryError> {
    let belief = Belief::equal(n_draws)?;
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
        epsilon: claim.epsilon,
        delta: claim.delta,
        // Of the question, which is chosen later.
        least_gain_per_second: 0.0,
        most_surprises: if claim.can_confirm { settings.most_surprises } else { 1.0 },
        // Where it is switched off, nothing is that improbable.
        misfit_level: settings.misfit_level.max(f64::MIN_POSITIVE),
    };
    let bounds = [Some(claim.bound)];
    let fit = Some(&check).filter(|_| settings.misfit_level > 0.0);
    let next = Selection::Ask(Chosen { question: 0, score: 0.0, per_second: None, is_hold_out: false });
    match rule.standing(&Look { bounds: &bounds, next: &next, drop: None, hold_out, fit })? {
        Standing::CannotBeReached { because, .. } => {
            lesson.state = LessonStatus::MISFIT;
            lesson.reason = match because {
                Obstacle::Surprises { hold_out, .. } => {
                    fit_words::surprised(hold_out.surprises, hold_out.n, claim.features)
                }
                _ => fit_words::misfit(check.p_value, claim.features),
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
            lesson.reason = fit_words::unconfirmed(&lesson.reason, about, settings.most_surprises, is_over);
        }
        Standing::Taught { .. } | Standing::NotYet { .. } => {}
    }
    Ok(lesson)
}

/// Which of two was said to be better, when that was said for sure, as one of the answers that draws of the weights (row by row, with
/// their rationality and rate of wrong answers) give probabilities to.
///
/// # Errors
/// A rate or a rationality that is none.
pub(crate) fn compared<'a>(
    record: &'a EvidenceRecord,
    message: &TrajectoryPreference,
    (weights, n_features): (&[f64], usize),
    (betas, wrong_rate): &(Vec<f64>, f64),
) -> Result<Option<Said<'a>>, InquiryError> {
    let [worse, better] = message.trajectories.as_slice() else { return Ok(None) };
    if !is_sure(message.confidence) || worse.features.len() != n_features {
        return Ok(None);
    }
    let model = AnswerModel { wrong_rate: *wrong_rate, ..AnswerModel::default() };
    let utility = |(draw, w): (usize, &[f64])| {
        let features = worse.features.iter().zip(&better.features);
        let gain: f64 = w.iter().zip(features).map(|(w, (worse, better))| w * (better - worse)).sum();
        betas[if betas.len() == 1 { 0 } else { draw }] * gain
    };
    let answers = comparison_answers(weights.chunks_exact(n_features).enumerate().map(utility), &model)?;
    let given = match message.answer {
        TrajectoryPreference::RANKED => 1,
        TrajectoryPreference::EQUAL => 2,
        _ => 3,
    };
    Ok((given < answers.n()).then_some(Said { record, answers, given }))
}

/// Whether a person was sure.
pub(crate) fn is_sure(confidence: u8) -> bool {
    confidence_from_message(confidence) == Ok(Confidence::Sure)
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
