//! A lesson that ends by the stopping rule, held with a person who is as the model says, or is not.

use super::purpose;
use crate::harness::{ReproductionError, generator};
use inquiry::tabular::{Answering, Over, alternatives};
use inquiry::{
    Answered, Answers, Belief, DrawnOptima, HoldOut, Look, Losses, Objective, Obstacle, PredictiveCheck, Question,
    QuestionKind, Round, Selecting, Selection, Standing, StoppingRule, Strategy, predictive_check, select,
};
use likelihood::actions::{ActionLikelihood, Choice};
use mdp::random::{categorical, index, l1_sphere, uniform};
use mdp::worlds::GridWorld;
use mdp::{Mdp, Policy, Solver, feature_counts, policy_losses};
use posterior::{Draws, EvidenceKind, Model, Prior, Rationality, Run, Term, TermLikelihood, draw};
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::Rng;
use serde::Serialize;

/// Cells along a side.
const SIDE: usize = 4;
/// Features the robot has.
const N_FEATURES: usize = 4;
/// β of the person, known to the robot.
const BETA: f64 = 30.0;
/// The normalised loss that is good enough.
const EPSILON: f64 = 0.1;
/// Least loss of the uniform policy that divides.
const FLOOR: f64 = 0.01;
/// Looks, at most.
const MAX_LOOKS: u64 = 40;
/// Draws that questions are judged by.
const SCORED: usize = 200;
/// Share of answers at random of a careless person.
const CARELESS: f64 = 0.3;
/// Share of questions at random before the bound is below ε.
const HELD_OUT: f64 = 0.2;
/// The model is judged refuted at this level.
const MISFIT: f64 = 0.002;

/// Who answers.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Person {
    /// As the likelihood says.
    Boltzmann,
    /// By a reward that depends on a feature which the robot does not have.
    HiddenFeature,
    /// As the likelihood says, but 3 in 10 answers at random.
    Careless,
}

impl Person {
    /// Name.
    pub fn label(self) -> &'static str {
        match self {
            Self::Boltzmann => "as modelled",
            Self::HiddenFeature => "hidden feature",
            Self::Careless => "careless",
        }
    }
}

/// How a lesson ended.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Exam {
    /// Whether the rule said so.
    pub taught: bool,
    /// Whether the rule told that the model cannot be right.
    pub warned: bool,
    /// Answers given.
    pub questions: usize,
    /// True loss of the last policy as a share of what the uniform one loses.
    pub true_loss: f64,
    /// Answers until the bound was below ε for the first time.
    pub bounded_after: Option<usize>,
    /// "About n more" at every look, where it was said.
    pub predictions: Vec<Option<u32>>,
}

impl Exam {
    /// Whether it ended although the loss exceeds ε.
    pub fn is_too_early(&self) -> bool {
        self.taught && self.true_loss > EPSILON
    }

    /// Of a lesson whose bound fell below ε: answers said to be missing at the look halfway, as a share of those that were.
    pub fn prediction_ratio(&self) -> Option<f64> {
        let needed = self.bounded_after?;
        let halfway = needed / 2;
        let said = (*self.predictions.get(halfway)?)?;
        (needed > halfway).then(|| f64::from(said) / (needed - halfway) as f64)
    }
}

/// The person's own world: the robot's, perhaps with one feature more.
struct Truth {
    mdp: Mdp,
    q: Vec<f64>,
    weights: Vec<f64>,
}

/// Holds one lesson.
///
/// # Errors
/// Never for these worlds.
pub fn hold(
    person: Person,
    (delta, most_surprises): (f64, f64),
    seed: u64,
    replicate: usize,
) -> Result<Exam, ReproductionError> {
    let mut world = generator(seed, replicate, purpose::WORLD);
    let mdp = GridWorld { slip: 0.1, ..GridWorld::random(SIDE, SIDE, N_FEATURES, &mut world) }.mdp()?;
    let truth = Truth::new(person, &mdp, &mut world)?;
    let (mut answers_rng, mut questions_rng) =
        (generator(seed, replicate, purpose::PERSON), generator(seed, replicate, purpose::QUESTIONS));
    let rule =
        StoppingRule { epsilon: EPSILON, delta, least_gain_per_second: 0.0, most_surprises, misfit_level: MISFIT };
    let uniform_counts = feature_counts(&mdp, &Policy::uniform(&mdp))?;
    let mut evidence: Vec<Choice> = Vec::new();
    let (mut hold_out, mut bounds, mut predictions) = (HoldOut::default(), Vec::new(), Vec::new());
    let mut exam =
        Exam { taught: false, warned: false, questions: 0, true_loss: 0.0, bounded_after: None, predictions: vec![] };
    for look in 1..=MAX_LOOKS {
        let draws = learn(&mdp, &evidence, seed, replicate, look)?;
        // The policy that is optimal for the mean reward loses least on average.
        let policy = Policy::Deterministic(Solver::new(&mdp).solve(&draws.mean_weights()).policy().to_vec());
        let counts = feature_counts(&mdp, &policy)?;
        let own = policy_losses(&mdp, &counts, &draws.values, 1)?;
        let reference = policy_losses(&mdp, &uniform_counts, &draws.values, 1)?;
        let reference = risk::Reference { name: "uniform", losses: &reference };
        let shares = risk::normalised_losses(&own, &reference, FLOOR)?.values;
        let levels = rule.at_look(look);
        bounds.push(risk::upper_bound(&shares, draws.n_chains, levels.alpha, levels.delta)?.bound());
        let round = Judged::new(&mdp, &draws, &policy)?;
        let selecting = Selecting {
            strategy: Strategy::LookAhead { objective: Objective::Mean, shortlist: 0 },
            effort: None,
            hold_out_share: HELD_OUT,
            seed: questions_rng.next_u64(),
        };
        let next = select(&round.round, &selecting, look)?;
        let fit = round.fit(&evidence, seed)?;
        let at = Look { bounds: &bounds, next: &next, drop: None, hold_out, fit: Some(&fit) };
        let standing = rule.standing(&at)?;
        exam.true_loss = truth.loss(&policy)?;
        if exam.bounded_after.is_none() && bounds[bounds.len() - 1].is_some_and(|bound| bound < EPSILON) {
            exam.bounded_after = Some(evidence.len());
        }
        predictions.push(match &standing {
            Standing::NotYet { about } => about.map(|about| about.answers),
            _ => None,
        });
        match (standing, next) {
            (Standing::Taught { .. }, _) => {
                exam.taught = true;
                break;
            }
            (Standing::CannotBeReached { because: Obstacle::Misfit { .. } | Obstacle::Surprises { .. }, .. }, _) => {
                exam.warned = true;
                break;
            }
            // A random question confirms the model, or refutes it.
            (Standing::Confirming { .. }, _) => {
                let state = index(mdp.n_states(), &mut questions_rng);
                let action = truth.answer(person, state, &mut answers_rng);
                let question = &round.round.questions[state];
                hold_out.add(&question.answers, &round.round.belief, action)?;
                evidence.push(Choice::taken(state, action));
            }
            (_, Selection::Ask(chosen)) => {
                let state = chosen.question;
                let action = truth.answer(person, state, &mut answers_rng);
                if chosen.is_hold_out {
                    let question = &round.round.questions[state];
                    hold_out.add(&question.answers, &round.round.belief, action)?;
                }
                evidence.push(Choice::taken(state, action));
            }
            // Few draws may agree where all do not: any question helps.
            (_, _) => {
                let state = index(mdp.n_states(), &mut questions_rng);
                evidence.push(Choice::taken(state, truth.answer(person, state, &mut answers_rng)));
            }
        }
    }
    exam.questions = evidence.len();
    exam.predictions = predictions;
    Ok(exam)
}

fn learn(mdp: &Mdp, evidence: &[Choice], seed: u64, replicate: usize, look: u64) -> Result<Draws, ReproductionError> {
    let term = Term {
        kind: EvidenceKind::Actions,
        rationality: Rationality::Fixed(BETA),
        likelihood: TermLikelihood::Actions(ActionLikelihood::new(mdp, evidence.to_vec())?),
    };
    let model =
        Model { n_features: mdp.n_features(), prior: Prior::L1Sphere, nonnegative_return: None, terms: vec![term] };
    // A look needs 2 n_min effective draws of its δ: some 500 at the first, 900 at the fortieth.
    let run = Run { n_draws: 1200, n_chains: 4, warmup: 150, threads: 1 };
    let mut chains = generator(seed, replicate, purpose::CHAINS + look as u32);
    let mut key = [0; 32];
    chains.fill_bytes(&mut key);
    Ok(draw(&model, &run, chains.next_u64(), &key)?)
}

/// Questions about every state, judged by some of the draws.
struct Judged {
    round: Round,
}

impl Judged {
    fn new(mdp: &Mdp, draws: &Draws, policy: &Policy) -> Result<Self, ReproductionError> {
        let optima = DrawnOptima::new(mdp, &super::some(draws, SCORED), 1)?;
        let answering = Answering { mdp, optima: &optima, betas: &[BETA], wrong_rate: 0.0 };
        let question = |state: usize| -> Result<Question, ReproductionError> {
            let answers = answering.action(state)?;
            Ok(Question { kind: QuestionKind::Action, situation: state, answers, feasible: true })
        };
        let n = optima.n();
        let round = Round {
            belief: Belief::equal(n)?,
            losses: Losses::new(n, vec![0.0; n * mdp.n_states()])?,
            questions: (0..mdp.n_states()).map(question).collect::<Result<_, _>>()?,
            alternatives: Some(alternatives(mdp, &optima, policy, 40, Over::Starts)?),
        };
        Ok(Self { round })
    }

    fn fit(&self, evidence: &[Choice], seed: u64) -> Result<PredictiveCheck, ReproductionError> {
        let answers = |state: usize| -> &Answers { &self.round.questions[state].answers };
        let answered: Vec<Answered<'_>> =
            evidence.iter().map(|choice| Answered { answers: answers(choice.state), given: choice.action }).collect();
        Ok(predictive_check(&answered, &self.round.belief, seed)?)
    }
}

impl Truth {
    fn new(person: Person, robot: &Mdp, rng: &mut ChaCha8Rng) -> Result<Self, ReproductionError> {
        let hidden = person == Person::HiddenFeature;
        let mdp = if hidden { with_hidden_feature(robot, rng)? } else { robot.clone() };
        let weights = l1_sphere(mdp.n_features(), rng);
        let mut solver = Solver::new(&mdp);
        let optimum = solver.solve(&weights);
        let pairs = (0..mdp.n_states()).flat_map(|state| (0..mdp.n_actions()).map(move |action| (state, action)));
        let q = pairs.map(|(state, action)| optimum.q(state, action)).collect();
        Ok(Self { q, weights, mdp })
    }

    fn answer(&self, person: Person, state: usize, rng: &mut ChaCha8Rng) -> usize {
        let n_actions = self.mdp.n_actions();
        if person == Person::Careless && uniform(rng) < CARELESS {
            return index(n_actions, rng);
        }
        let q = &self.q[state * n_actions..][..n_actions];
        let best = q.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        let masses: Vec<f64> = q.iter().map(|q| libm::exp(BETA * (q - best))).collect();
        let total = masses.iter().fold(0.0, |sum, mass| sum + mass);
        categorical(masses.into_iter(), total, rng)
    }

    /// As a share of what the uniform policy loses.
    fn loss(&self, policy: &Policy) -> Result<f64, ReproductionError> {
        let loss = |policy: &Policy| -> Result<f64, ReproductionError> {
            Ok(policy_losses(&self.mdp, &feature_counts(&self.mdp, policy)?, &self.weights, 1)?[0])
        };
        Ok(loss(policy)? / loss(&Policy::uniform(&self.mdp))?.max(FLOOR))
    }
}

/// The same world with one feature more, present in a third of the cells.
fn with_hidden_feature(robot: &Mdp, rng: &mut ChaCha8Rng) -> Result<Mdp, ReproductionError> {
    let mut parts = robot.parts();
    let k = parts.n_features;
    let mut features = Vec::with_capacity(parts.n_states * (k + 1));
    for state in 0..parts.n_states {
        features.extend_from_slice(robot.features(state, 0));
        features.push(f64::from(u8::from(uniform(rng) < 1.0 / 3.0)));
    }
    parts.n_features = k + 1;
    parts.features = mdp::Features::State(features);
    Ok(Mdp::new(parts)?)
}
