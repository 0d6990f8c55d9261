//! From the evidence in force to a posterior: one weight vector under all kinds of evidence, each with its rationality.

use crate::piece::bare;
use crate::{Evidence, Settings};
use apprentice_msgs::msg::{EvidenceRecord, FeatureTrajectory, PlacementDemonstration, TrajectoryPreference};
use apprentice_msgs::to_cdr;
use exchange::{
    Confidence, ExchangeError, confidence_from_message, marks_from_message, point_from_message, scene_from_message,
    steps_from_message,
};
use likelihood::actions::{ActionLikelihood, Choice, ChoiceVerdict};
use likelihood::preferences::{Answer, PreferenceLikelihood, Verdict, cycles, ranking};
use posterior::{Demonstration, Draws, EvidenceKind, Lesson, Model, PlacementTerm, Term, TermLikelihood, draw_unless};
use sha2::{Digest, Sha256};
use std::collections::HashMap;
use std::sync::atomic::AtomicBool;

/// A placement as the core takes it.
///
/// # Errors
/// A scene or a point that cannot be used.
pub(crate) fn demonstration_from_message(message: &PlacementDemonstration) -> Result<Demonstration, ExchangeError> {
    let scene = scene_from_message(&message.scene)?;
    let placement_m = point_from_message("the placement", &message.placement)?;
    Ok(Demonstration {
        id: message.id.clone(),
        placement: scene.normalised(placement_m),
        scene,
        confidence: match confidence_from_message(message.confidence) {
            Ok(Confidence::Sure) => posterior::Confidence::Sure,
            Ok(Confidence::Fairly) => posterior::Confidence::Fairly,
            Ok(Confidence::Guess) | Err(_) => posterior::Confidence::Guess,
        },
    })
}

/// SHA-256 over the evidence in force, in accepted order: of each piece what says something about rewards, and the world
/// that it is about.
pub(crate) fn evidence_hash(evidence: &Evidence) -> [u8; 32] {
    let mut hash = Sha256::new_with_prefix(b"apprentice evidence 2");
    let informative = |record: &&EvidenceRecord| {
        ![EvidenceRecord::RESPONSE, EvidenceRecord::SCENE, EvidenceRecord::WORLD].contains(&record.kind)
    };
    for record in evidence.in_force().filter(informative) {
        let bytes = to_cdr(&bare(record));
        hash.update((bytes.len() as u64).to_le_bytes());
        hash.update(bytes);
        if [EvidenceRecord::ACTIONS, EvidenceRecord::CRITIQUE].contains(&record.kind) {
            hash.update(evidence.world_reference().hash.as_bytes());
        }
    }
    hash.finalize().into()
}

/// Draws given the evidence in force: a function of the settings and of that evidence in accepted order, of nothing else.
///
/// # Errors
/// Evidence that the core cannot use, although it was checked before it was accepted; a posterior that is zero everywhere;
/// and draws that are not wanted any more, which `stop` says.
pub(crate) fn infer(
    stop: &AtomicBool,
    settings: &Settings,
    evidence: &Evidence,
    hash: &[u8; 32],
) -> Result<Draws, String> {
    let model = model(settings, evidence)?;
    let seed = settings.seed.unsigned_abs();
    draw_unless(stop, &model, &settings.run(), seed, hash, None).map_err(|error| error.to_string())
}

/// The model of the evidence in force. Kinds without any have no term: it is the same whether they never had any or all of
/// it was taken back.
///
/// # Errors
/// As [`infer`].
pub(crate) fn model<'a>(settings: &Settings, evidence: &'a Evidence) -> Result<Model<'a>, String> {
    let terms = [
        (EvidenceKind::Placements, placements(settings, evidence)?),
        (EvidenceKind::Actions, actions(settings, evidence)?),
        (EvidenceKind::Preferences, preferences(settings, evidence)?),
        (EvidenceKind::Critiques, critiques(settings, evidence)?),
        (EvidenceKind::Progress, progress(settings, evidence)?),
    ];
    let term = |(kind, likelihood): (EvidenceKind, Option<TermLikelihood<'a>>)| {
        Some(Term { kind, rationality: settings.rationality(kind), likelihood: likelihood? })
    };
    Ok(Model {
        n_features: evidence.feature_names().len(),
        prior: settings.prior(),
        nonnegative_return: if settings.nonnegative_return { worst_ranked(evidence) } else { None },
        terms: terms.into_iter().filter_map(term).collect(),
    })
}

fn placements(settings: &Settings, evidence: &Evidence) -> Result<Option<TermLikelihood<'static>>, String> {
    let shown = evidence.placements().map(demonstration_from_message).collect::<Result<Vec<_>, _>>();
    let shown = shown.map_err(|error| error.to_string())?;
    if shown.is_empty() {
        return Ok(None);
    }
    let (_, task) = evidence.task().ok_or("there are placements, but no table")?;
    let (side, factors) = (settings.grid_side(), settings.confidence_factors());
    let term = PlacementTerm::new(&Lesson::new(task), &shown, side, factors, settings.beta);
    Ok(Some(TermLikelihood::Placements(term.map_err(|error| error.to_string())?)))
}

fn actions<'a>(settings: &Settings, evidence: &'a Evidence) -> Result<Option<TermLikelihood<'a>>, String> {
    let mut choices = Vec::new();
    for message in evidence.actions() {
        let world = evidence.world().ok_or("there are actions, but no world")?;
        let factor = factor(settings, message.confidence)?;
        let steps = steps_from_message(message, world).map_err(|error| error.to_string())?;
        let verdict = ChoiceVerdict::Taken;
        choices.extend(steps.into_iter().map(|(state, action)| Choice { state, action, verdict, factor }));
    }
    choices_term(evidence, choices, settings.wrong_rate_actions)
}

fn critiques<'a>(settings: &Settings, evidence: &'a Evidence) -> Result<Option<TermLikelihood<'a>>, String> {
    let mut choices = Vec::new();
    for message in evidence.critiques() {
        let world = evidence.world().ok_or("there are critiques, but no world")?;
        let factor = factor(settings, message.confidence)?;
        let marks = marks_from_message(message, world).map_err(|error| error.to_string())?;
        choices.extend(marks.into_iter().map(|mark| {
            let verdict = if mark.good { ChoiceVerdict::Good } else { ChoiceVerdict::Bad };
            Choice { state: mark.state, action: mark.action, verdict, factor }
        }));
    }
    choices_term(evidence, choices, settings.wrong_rate_critiques)
}

fn choices_term(
    evidence: &Evidence,
    choices: Vec<Choice>,
    wrong_rate: f64,
) -> Result<Option<TermLikelihood<'_>>, String> {
    match evidence.world() {
        Some(world) if !choices.is_empty() => {
            let likelihood = ActionLikelihood::new(&world.mdp, choices);
            let likelihood = likelihood.and_then(|likelihood| likelihood.with_wrong_rate(wrong_rate));
            Ok(Some(TermLikelihood::Actions(likelihood.map_err(|error| error.to_string())?)))
        }
        _ => Ok(None),
    }
}

/// Trajectories by their first occurrence: the same id stands for the same features.
#[derive(Default)]
struct Items<'a> {
    index: HashMap<&'a str, usize>,
    ids: Vec<&'a str>,
    features: Vec<f64>,
}

impl<'a> Items<'a> {
    fn add(&mut self, trajectory: &'a FeatureTrajectory) -> usize {
        let next = self.ids.len();
        let index = *self.index.entry(&trajectory.id).or_insert(next);
        if index == next {
            self.ids.push(&trajectory.id);
            self.features.extend(&trajectory.features);
        }
        index
    }
}

/// Items and answers of all preferences in force.
fn compared<'a>(settings: &Settings, evidence: &'a Evidence) -> Result<(Items<'a>, Vec<Answer>), String> {
    let (mut items, mut answers) = (Items::default(), Vec::new());
    for message in evidence.preferences() {
        let factor = factor(settings, message.confidence)?;
        let verdict = match message.answer {
            TrajectoryPreference::RANKED => Verdict::Strict,
            TrajectoryPreference::EQUAL => Verdict::Equal,
            _ => Verdict::CantTell,
        };
        let order: Vec<usize> = message.trajectories.iter().map(|trajectory| items.add(trajectory)).collect();
        let pairs = ranking(&order).map_err(|error| error.to_string())?;
        answers.extend(pairs.into_iter().map(|(less, more)| Answer { less, more, factor, verdict }));
    }
    Ok((items, answers))
}

fn preferences(settings: &Settings, evidence: &Evidence) -> Result<Option<TermLikelihood<'static>>, String> {
    let (items, answers) = compared(settings, evidence)?;
    if answers.is_empty() {
        return Ok(None);
    }
    let n_features = evidence.feature_names().len();
    let likelihood = PreferenceLikelihood::new(n_features, items.features, answers, settings.preferences());
    Ok(Some(TermLikelihood::Preferences(likelihood.map_err(|error| error.to_string())?)))
}

fn progress(settings: &Settings, evidence: &Evidence) -> Result<Option<TermLikelihood<'static>>, String> {
    let (mut items, mut answers) = (Items::default(), Vec::new());
    for message in evidence.histories() {
        let factor = factor(settings, message.confidence)?;
        let order: Vec<usize> = message.demonstrations.iter().map(|trajectory| items.add(trajectory)).collect();
        let pairs = ranking(&order).map_err(|error| error.to_string())?;
        let verdict = Verdict::Strict;
        answers.extend(pairs.into_iter().map(|(less, more)| Answer { less, more, factor, verdict }));
    }
    if answers.is_empty() {
        return Ok(None);
    }
    let n_features = evidence.feature_names().len();
    let likelihood = PreferenceLikelihood::new(n_features, items.features, answers, settings.progress());
    Ok(Some(TermLikelihood::Preferences(likelihood.map_err(|error| error.to_string())?)))
}

fn factor(settings: &Settings, confidence: u8) -> Result<f64, String> {
    let confidence = confidence_from_message(confidence).map_err(|error| error.to_string())?;
    Ok(settings.confidence_factors()[confidence as usize])
}

/// Φ of the worst ranked trajectory in force (equation E.3): the one that was called better than another least often, of those the
/// one called worse most often, of those the first.
pub(crate) fn worst_ranked(evidence: &Evidence) -> Option<Vec<f64>> {
    let mut tally: Vec<(&FeatureTrajectory, usize, usize)> = Vec::new();
    let mut index: HashMap<&str, usize> = HashMap::new();
    for message in evidence.preferences().filter(|message| message.answer == TrajectoryPreference::RANKED) {
        for (worse, trajectory) in message.trajectories.iter().enumerate() {
            let at = *index.entry(&trajectory.id).or_insert(tally.len());
            if at == tally.len() {
                tally.push((trajectory, 0, 0));
            }
            tally[at].1 += worse;
            tally[at].2 += message.trajectories.len() - 1 - worse;
        }
    }
    let worst = tally.into_iter().min_by_key(|&(_, wins, losses)| (wins, std::cmp::Reverse(losses)))?;
    Some(worst.0.features.clone())
}

/// Trajectories that were said to be better than each other all around, by id: one shortest cycle of each knot.
pub(crate) fn preference_cycles(settings: &Settings, evidence: &Evidence) -> Vec<Vec<String>> {
    let Ok((items, answers)) = compared(settings, evidence) else { return Vec::new() };
    let named = |cycle: Vec<usize>| cycle.into_iter().map(|item| items.ids[item].to_owned()).collect();
    cycles(&answers).into_iter().map(named).collect()
}
