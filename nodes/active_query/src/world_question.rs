//! Which question about a world is asked (dissertation chapter 8): a function of settings, posterior, world, evidence and bounds.

use crate::fit_words;
use crate::question_id::{short_hash, world_query_id};
use crate::settings::{QuestionKind, Settings, Strategy};
use crate::world_draws::WorldDraws;
use crate::world_rests::Rests;
use crate::world_subjects::{Subject, Ways, situations};
use crate::world_words::{self, Why};
use apprentice_msgs::msg::{
    EvidenceLog, LessonStatus, PolicyBounds, Posterior, RiskBound, WorldQuery, WorldTrajectory,
};
use exchange::{ROBUST_POLICY, World};
use inquiry::tabular::{Answering, Over, alternatives, discounted_features, normalised_state_losses, state_losses};
use inquiry::{
    Answers, Belief, Branches, DrawnOptima, Effort, InquiryError, Losses, Objective, Question, Round, Selecting,
    Selection, values_at_risk,
};
use likelihood::preferences::AnswerModel;
use mdp::random::uniform;
use mdp::{Mdp, Policy};
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;

/// A loss of the policy that chooses at random divides as no less than this.
const FLOOR: f64 = 1e-9;
/// Questions whose answers are followed one step ahead.
const SHORTLIST: usize = 24;
/// Policies that the robot may take up after an answer, besides the MAP policy: optimal ones of draws.
const ALTERNATIVES: usize = 40;
/// The largest share below 1.
const ALWAYS: f64 = 1.0 - f64::EPSILON;
/// Combinations of answers to open questions that are followed, at most: the most probable ones.
const MAX_BRANCHES: usize = 8;
/// Keeps these random numbers apart from those of the imagined tables.
const WORLD_STREAM: u64 = 1 << 62;

/// What a question about a world is chosen by.
#[derive(Debug, Clone, Copy)]
pub struct WorldInputs<'a> {
    /// Of a lesson about a world.
    pub posterior: &'a Posterior,
    /// The world that the posterior names.
    pub world: &'a World,
    /// At least all that the posterior takes in.
    pub log: &'a EvidenceLog,
    /// On the robot's policy under the posterior.
    pub bounds: &'a PolicyBounds,
}

/// The question to ask while the lesson goes on, and the lesson with it; none when there is nothing to ask, or nothing may be, or when
/// none is worth the person's time, which ends the lesson.
///
/// # Errors
/// In a sentence: parts that do not fit together, or a world that is too large.
pub fn world_question(
    settings: &Settings,
    inputs: &WorldInputs<'_>,
    lesson: &LessonStatus,
) -> Result<(Option<WorldQuery>, LessonStatus), String> {
    if lesson.state != LessonStatus::ASKING || settings.question_kinds.is_empty() {
        return Ok((None, lesson.clone()));
    }
    asked_by(settings, inputs, &WorldDraws::new(inputs)?, lesson)
}

/// The same by draws that are at hand.
pub(crate) fn asked_by(
    settings: &Settings,
    inputs: &WorldInputs<'_>,
    draws: &WorldDraws,
    lesson: &LessonStatus,
) -> Result<(Option<WorldQuery>, LessonStatus), String> {
    let Some(query) = ahead_by(settings, inputs, draws, lesson, None, 0)?.pop() else {
        return Ok((None, lesson.clone()));
    };
    // What is drawn at random is asked for another reason; a gain that was not reckoned is NaN, which is not below anything.
    if !query.held_out && query.gain_per_second < settings.least_gain_per_second {
        let reason = fit_words::not_worth_it(query.gain_per_second, settings.least_gain_per_second);
        return Ok((None, LessonStatus { state: LessonStatus::GAVE_UP, reason, ..lesson.clone() }));
    }
    let questions_asked = lesson.questions_asked.saturating_add(1);
    let lesson = LessonStatus { query_id: query.id.clone(), questions_asked, ..lesson.clone() };
    Ok((Some(query), lesson))
}

/// The open question and at most `n` more to ask after it if the robot has not learned from the answers by then: each is chosen by what
/// is expected once those before it are answered, and is of the revision that their answers make. The open one is `open`, which was
/// asked before the posterior came, or what [`world_question`] has.
///
/// # Errors
/// As [`world_question`].
pub fn questions_ahead(
    settings: &Settings,
    inputs: &WorldInputs<'_>,
    lesson: &LessonStatus,
    open: Option<&WorldQuery>,
    n: usize,
) -> Result<Vec<WorldQuery>, String> {
    ahead_by(settings, inputs, &WorldDraws::new(inputs)?, lesson, open, n)
}

/// The same by draws that are at hand.
pub(crate) fn ahead_by(
    settings: &Settings,
    inputs: &WorldInputs<'_>,
    draws: &WorldDraws,
    lesson: &LessonStatus,
    open: Option<&WorldQuery>,
    n: usize,
) -> Result<Vec<WorldQuery>, String> {
    let WorldInputs { posterior, world, log, .. } = *inputs;
    let mdp = &world.mdp;
    if lesson.state != LessonStatus::ASKING || settings.question_kinds.is_empty() || mdp.n_actions() < 2 {
        return Ok(Vec::new());
    }
    let mut rests = Rests::new(log, posterior.revision).ok_or("the evidence ends before the posterior")?;
    let mut rng = ChaCha8Rng::seed_from_u64(settings.seed.unsigned_abs());
    // An undo that leads back to an earlier state of the lesson leads back to its question.
    let stream = WORLD_STREAM | rests.n as u64;
    rng.set_stream(stream);
    let situations = situations(mdp, &mut rng);
    let wrong = |error: InquiryError| error.to_string();
    let optima = &draws.optima;
    // To confirm a model takes answers that are fair to it.
    let hold_out_share = if lesson.to_confirm > 0 { ALWAYS } else { settings.hold_out_share };
    let map = Policy::Deterministic(draws.map.clone());
    let scoring = Scoring { settings, inputs, draws, optima, map, hold_out_share };
    let steps = usize::try_from(settings.trajectory_steps).unwrap_or(2);
    let ways = Ways { mdp, map: &draws.map, optima, steps, seed: settings.seed.unsigned_abs(), stream };
    let mut branches = Branches::now(scoring.belief().map_err(wrong)?);
    let mut queries: Vec<WorldQuery> = Vec::new();
    let mut last = open.map(|query| (Subject::of(query), query.clone()));
    loop {
        let (subject, query) = match last.take() {
            Some(open) => open,
            None => {
                let Some(found) = scoring.choose(&ways, &situations, &rests, &branches).map_err(wrong)? else { break };
                let subject = found.subject.clone();
                let is_first_left = uniform(&mut rng) >= 0.5;
                (subject, scoring.query(found, situations.len(), queries.len(), is_first_left)?)
            }
        };
        queries.push(query);
        if queries.len() > n {
            break;
        }
        rests.answer(subject.kind, subject.state);
        branches = branches.after(&scoring.answers(&subject).map_err(wrong)?, MAX_BRANCHES);
    }
    Ok(queries)
}

/// A question with why it was chosen.
struct Found {
    subject: Subject,
    /// Nats, where it was chosen by information.
    gain: Option<f64>,
    per_second: Option<f64>,
    is_held_out: bool,
    by_entropy: bool,
    n_candidates: usize,
}

struct Scoring<'a> {
    settings: &'a Settings,
    inputs: &'a WorldInputs<'a>,
    draws: &'a WorldDraws,
    optima: &'a DrawnOptima,
    map: Policy,
    hold_out_share: f64,
}

impl Scoring<'_> {
    /// The message about a question, which `ahead` others come before; of two ways the first is shown on the left, or not.
    fn query(
        &self,
        found: Found,
        n_situations: usize,
        ahead: usize,
        is_first_left: bool,
    ) -> Result<WorldQuery, String> {
        let WorldInputs { posterior, world, bounds, .. } = *self.inputs;
        let (settings, mdp) = (self.settings, self.mdp());
        let wrong = |error: InquiryError| error.to_string();
        let Found { subject, gain, per_second, is_held_out, by_entropy, n_candidates } = found;
        let state = [subject.state];
        let at_risk = |losses: Losses| values_at_risk(&losses, &self.belief()?, bounds.alpha).map(|of| of[0]);
        let value_at_risk = state_losses(mdp, self.optima, &self.map, &state).and_then(at_risk).map_err(wrong)?;
        let uniform_policy = Policy::uniform(mdp);
        let share = normalised_state_losses(mdp, self.optima, &self.map, &uniform_policy, FLOOR, &state)
            .and_then(at_risk)
            .map_err(wrong)?;
        let why = match (is_held_out, settings.strategy) {
            (true, _) => Why::HoldOut,
            (false, Strategy::Random) => Why::Lot,
            (false, Strategy::Information) if gain.is_some() => Why::Telling { n: n_candidates },
            (false, Strategy::RewardInformation) if gain.is_some() => Why::Informing { n: n_candidates },
            (false, Strategy::LookAhead) if gain.is_some() => Why::Helping { n: n_candidates },
            (false, Strategy::Entropy) if by_entropy => Why::Torn { n_states: n_situations },
            (false, _) => Why::Risk { share, alpha: bounds.alpha, n_states: n_situations },
        };
        let revision = posterior.revision + ahead as u64;
        let id =
            world_query_id(revision, subject.kind, subject.state, is_held_out, &short_hash(settings.seed, posterior));
        let mut trajectories = Vec::new();
        for (way, name) in subject.ways.iter().zip(["a", "b"]) {
            trajectories.push(WorldTrajectory {
                id: format!("{id}-{name}"),
                states: way.iter().map(|step| number(step.0)).collect(),
                actions: way.iter().map(|step| number(step.1)).collect(),
                features: discounted_features(mdp, way).map_err(wrong)?,
            });
        }
        // Which stands on the left says nothing about which the robot would do.
        if !is_first_left {
            trajectories.reverse();
        }
        let robust = bounds.policies.iter().find(|policy| policy.id == ROBUST_POLICY);
        let loss = robust.map(|policy| &policy.normalised_loss).filter(|of| of.outcome == RiskBound::BOUND);
        let question = world_words::question(world, subject.kind, subject.state);
        Ok(WorldQuery {
            header: posterior.header.clone(),
            id,
            revision,
            ahead: number(ahead),
            world: world.reference(),
            kind: match subject.kind {
                QuestionKind::Action => WorldQuery::ACTION,
                QuestionKind::Critique => WorldQuery::CRITIQUE,
                QuestionKind::Comparison => WorldQuery::COMPARISON,
            },
            state: number(subject.state),
            trajectories,
            reason: format!("{question} {}{}", world_words::why(why), world_words::ahead(ahead)),
            value_at_risk,
            alpha: bounds.alpha,
            gain: gain.unwrap_or(f64::NAN),
            gain_per_second: per_second.unwrap_or(f64::NAN),
            held_out: is_held_out,
            n_candidates: u32::try_from(n_candidates).unwrap_or(u32::MAX),
            loss_bound: loss.map_or(f64::NAN, |of| of.bound),
            epsilon_loss: settings.epsilon_loss,
        })
    }

    fn belief(&self) -> Result<Belief, InquiryError> {
        Belief::equal(self.optima.n())
    }

    /// The question of the strategy. Where nothing would change what matters, something is asked all the same: the lesson goes
    /// on until the bound is small.
    fn choose(
        &self,
        ways: &Ways<'_>,
        situations: &[usize],
        rests: &Rests,
        branches: &Branches,
    ) -> Result<Option<Found>, InquiryError> {
        let (settings, alpha) = (self.settings, self.inputs.bounds.alpha);
        let mut kinds = settings.question_kinds.clone();
        kinds.sort_unstable();
        kinds.dedup();
        let risk = inquiry::Strategy::ValueAtRisk { alpha };
        let ask = |kinds: &[QuestionKind], strategies: &[inquiry::Strategy]| {
            let mut subjects = Vec::new();
            for kind in kinds {
                subjects.extend(ways.subjects(*kind, situations)?);
            }
            strategies
                .iter()
                .find_map(|by| self.select(&subjects, situations, rests, branches, *by).transpose())
                .transpose()
        };
        let (telling, any) = (inquiry::Strategy::RewardInformation, inquiry::Strategy::Random);
        match settings.strategy {
            Strategy::Information => {
                let exceeds = inquiry::Strategy::RiskInformation { epsilon: settings.epsilon_loss };
                return ask(&kinds, &[exceeds, telling, risk, any]);
            }
            Strategy::RewardInformation => return ask(&kinds, &[telling, risk, any]),
            Strategy::LookAhead => {
                let objective = Objective::ValueAtRisk { alpha };
                let ahead = inquiry::Strategy::LookAhead { objective, shortlist: SHORTLIST };
                return ask(&kinds, &[ahead, telling, risk, any]);
            }
            // Where it may not be asked what to do, nothing is known of how torn the rewards are.
            Strategy::Entropy if kinds.contains(&QuestionKind::Action) => {
                return ask(&[QuestionKind::Action], &[inquiry::Strategy::ActionEntropy, risk, any]);
            }
            Strategy::Var | Strategy::Random | Strategy::Entropy => {}
        }
        // A value at risk is that of a state and says nothing about the kind of question: they take turns.
        for turn in 0..kinds.len() {
            let kind = kinds[(rests.n + turn) % kinds.len()];
            let by: &[_] = match settings.strategy {
                Strategy::Random => &[any],
                _ => &[risk, any],
            };
            if let Some(found) = ask(&[kind], by)? {
                return Ok(Some(found));
            }
        }
        Ok(None)
    }

    /// The best of the subjects by one score; none when it tells none from another, or there is none.
    fn select(
        &self,
        subjects: &[Subject],
        situations: &[usize],
        rests: &Rests,
        branches: &Branches,
        strategy: inquiry::Strategy,
    ) -> Result<Option<Found>, InquiryError> {
        if subjects.is_empty() {
            return Ok(None);
        }
        let by_state = matches!(strategy, inquiry::Strategy::ValueAtRisk { .. });
        let losses =
            if by_state { state_losses(self.mdp(), self.optima, &self.map, situations)? } else { self.loss()? };
        let level = (0..2).find(|&level| subjects.iter().any(|of| !rests.holds(level, of.kind, of.state))).unwrap_or(2);
        let mut questions = Vec::with_capacity(subjects.len());
        for subject in subjects {
            questions.push(Question {
                kind: match subject.kind {
                    QuestionKind::Action => inquiry::QuestionKind::Action,
                    QuestionKind::Critique => inquiry::QuestionKind::Critique,
                    QuestionKind::Comparison => inquiry::QuestionKind::Comparison,
                },
                situation: if by_state { subject.situation } else { 0 },
                answers: self.answers(subject)?,
                feasible: !rests.holds(level, subject.kind, subject.state),
            });
        }
        let alternatives = match strategy {
            inquiry::Strategy::LookAhead { .. } => {
                Some(alternatives(self.mdp(), self.optima, &self.map, ALTERNATIVES, Over::Starts)?)
            }
            _ => None,
        };
        let round = Round { belief: self.belief()?, losses, questions, alternatives };
        let selecting = Selecting {
            strategy,
            effort: Some(Effort::default()),
            hold_out_share: self.hold_out_share,
            seed: self.settings.seed.unsigned_abs(),
        };
        let chosen = match branches.select(&round, &selecting, WORLD_STREAM >> 1 | rests.n as u64, &[])? {
            Selection::Ask(chosen) => chosen,
            Selection::NothingToLearn | Selection::NothingFeasible => return Ok(None),
        };
        Ok(Some(Found {
            subject: subjects[chosen.question].clone(),
            gain: (strategy.is_gain()).then_some(chosen.score),
            per_second: chosen.per_second,
            is_held_out: chosen.is_hold_out,
            by_entropy: strategy == inquiry::Strategy::ActionEntropy,
            n_candidates: round.questions.iter().filter(|question| question.feasible).count(),
        }))
    }

    /// What the MAP policy loses from where the robot starts, as a share of what choosing at random loses: what ends the lesson.
    fn loss(&self) -> Result<Losses, InquiryError> {
        let mdp = self.mdp();
        let starts: Vec<usize> = (0..mdp.n_states()).filter(|&state| mdp.initial()[state] > 0.0).collect();
        let mean = |policy: &Policy| -> Result<Vec<f64>, InquiryError> {
            let losses = state_losses(mdp, self.optima, policy, &starts)?;
            let of = |draw: usize| -> f64 {
                starts.iter().enumerate().map(|(row, state)| mdp.initial()[*state] * losses.of(row)[draw]).sum()
            };
            Ok((0..self.optima.n()).map(of).collect())
        };
        let (own, random) = (mean(&self.map)?, mean(&Policy::uniform(mdp))?);
        Losses::new(self.optima.n(), own.iter().zip(random).map(|(own, random)| own / random.max(FLOOR)).collect())
    }

    fn answers(&self, subject: &Subject) -> Result<Answers, InquiryError> {
        let kind = match subject.kind {
            QuestionKind::Action => "actions",
            QuestionKind::Critique => "critiques",
            QuestionKind::Comparison => "preferences",
        };
        let (betas, wrong_rate) = self.draws.rationality(self.inputs.posterior, kind);
        let answering = Answering { mdp: self.mdp(), optima: self.optima, betas: &betas, wrong_rate };
        match subject.ways.as_slice() {
            [] => answering.action(subject.state),
            [first, second] => {
                answering.comparison(first, second, &AnswerModel { wrong_rate, ..AnswerModel::default() })
            }
            [way, ..] => answering.critique(way),
        }
    }

    fn mdp(&self) -> &Mdp {
        &self.inputs.world.mdp
    }
}

/// A world is checked to be small, so that its numbers fit.
fn number(n: usize) -> u32 {
    u32::try_from(n).unwrap_or(u32::MAX)
}
