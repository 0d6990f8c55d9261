//! One lesson: ask, be answered, learn, again and again.

use super::{Learner, Method, Teacher, cpu_seconds, purpose};
use crate::harness::{ReproductionError, generator};
use inquiry::tabular::{Answering, Over, alternatives, state_losses};
use inquiry::{
    Belief, DrawnOptima, InquiryError, Question, QuestionKind, Round, Selecting, Selection, Strategy, select,
};
use likelihood::actions::Choice;
use mdp::{Policy, rollout};
use posterior::Draws;
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::Rng;
use serde::Serialize;

/// Draws that questions are judged by.
const SCORED: usize = 400;
/// Policies that ours considers besides the current one.
const POLICIES: usize = 100;

/// What is asked for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Ask {
    /// The action in a state.
    Actions,
    /// A critique of so many steps of the MAP policy from a state on.
    Critiques(usize),
}

/// What a lesson is about.
#[derive(Debug, Clone)]
pub struct Course<'a> {
    /// The robot.
    pub learner: Learner<'a>,
    /// The person.
    pub teacher: &'a Teacher<'a>,
    /// Shown before the first question.
    pub shown: Vec<Choice>,
    /// States that may be asked about.
    pub states: Vec<usize>,
    /// What is asked for.
    pub ask: Ask,
    /// Questions, at most.
    pub n_questions: usize,
    /// The lesson ends once the worst loss is below this; never: 0.
    pub enough: f64,
    /// Whether ours makes the worst loss small, not the mean.
    pub over: Over,
}

/// Where a lesson stands after so many answers.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Step {
    /// True mean loss of the MAP policy over the starts.
    pub loss: f64,
    /// True largest loss of the MAP policy over the starts.
    pub worst: f64,
    /// True mean loss of the policy for the mean reward.
    pub loss_of_mean: f64,
    /// True largest loss of the policy for the mean reward.
    pub worst_of_mean: f64,
    /// Seconds of processor time that choosing the next question took, the draws solved; 0 after the last.
    pub choosing_s: f64,
    /// Seconds of processor time for solving the draws; 0 where the method needs none.
    pub solving_s: f64,
    /// The state asked about next.
    pub asked: Option<usize>,
}

/// Holds one lesson; `first` is the posterior before the first question. One step for every posterior.
///
/// # Errors
/// Whatever keeps the robot from learning or asking.
pub fn hold(course: &Course<'_>, method: &Method, first: &Draws) -> Result<Vec<Step>, ReproductionError> {
    let Course { learner, teacher, .. } = course;
    let mut questions = generator(learner.seed, learner.replicate, purpose::QUESTIONS);
    let mut evidence = course.shown.clone();
    let mut draws = first.clone();
    let mut steps = Vec::with_capacity(course.n_questions + 1);
    for n_asked in 0..=course.n_questions {
        if n_asked > 0 {
            draws = learner.learn(&evidence, n_asked, Some(&draws.warm))?;
        }
        let policy = learner.policy(&draws.map_weights);
        let (loss, worst) = teacher.losses(&policy)?;
        let (loss_of_mean, worst_of_mean) = teacher.losses(&learner.policy(&draws.mean_weights()))?;
        let mut step = Step { loss, worst, loss_of_mean, worst_of_mean, choosing_s: 0.0, solving_s: 0.0, asked: None };
        if n_asked < course.n_questions && worst >= course.enough {
            let seed = questions.next_u64();
            let rollouts = rollouts(course, &policy, &mut questions)?;
            let begin = cpu_seconds();
            let (round, solving_s) = round(course, &draws, &policy, &rollouts, method)?;
            let selecting = Selecting { strategy: method.strategy, effort: None, hold_out_share: 0.0, seed };
            let selection = select(&round, &selecting, n_asked as u64)?;
            (step.choosing_s, step.solving_s) = (cpu_seconds() - begin - solving_s, solving_s);
            // Where a method sees nothing to learn it may as well ask about the first state.
            let question = match selection {
                Selection::Ask(chosen) => chosen.question,
                Selection::NothingToLearn | Selection::NothingFeasible => 0,
            };
            let state = course.states[question];
            step.asked = Some(state);
            match course.ask {
                Ask::Actions => evidence.push(Choice::taken(state, teacher.action(state))),
                Ask::Critiques(_) => evidence.extend(teacher.critique(&rollouts[question])),
            }
        }
        let done = step.asked.is_none();
        steps.push(step);
        if done {
            break;
        }
    }
    Ok(steps)
}

/// A trajectory of the policy from every state that may be asked about, where trajectories are.
fn rollouts(
    course: &Course<'_>,
    policy: &Policy,
    rng: &mut ChaCha8Rng,
) -> Result<Vec<Vec<(usize, usize)>>, ReproductionError> {
    let Ask::Critiques(length) = course.ask else { return Ok(vec![vec![]; course.states.len()]) };
    let from = |&state: &usize| Ok(rollout(course.learner.mdp, policy, state, length, rng)?);
    course.states.iter().map(from).collect()
}

/// What may be asked, judged by some of the draws, and the seconds it took to solve them.
fn round(
    course: &Course<'_>,
    draws: &Draws,
    policy: &Policy,
    rollouts: &[Vec<(usize, usize)>],
    method: &Method,
) -> Result<(Round, f64), ReproductionError> {
    let mdp = course.learner.mdp;
    // Asking at random needs nothing to be known.
    let n = if method.strategy == Strategy::Random { 1 } else { SCORED.min(draws.n()) };
    let begin = cpu_seconds();
    let optima = DrawnOptima::new(mdp, &some(draws, n), 1)?;
    let solving_s = if n == 1 { 0.0 } else { cpu_seconds() - begin };
    let answering = Answering { mdp, optima: &optima, betas: &[course.learner.beta], wrong_rate: 0.0 };
    let question = |(situation, &state): (usize, &usize)| -> Result<Question, InquiryError> {
        let (kind, answers) = match course.ask {
            Ask::Actions => (QuestionKind::Action, answering.action(state)?),
            Ask::Critiques(_) => (QuestionKind::Critique, answering.critique(&rollouts[situation])?),
        };
        Ok(Question { kind, situation, answers, feasible: true })
    };
    let alternatives = match method.strategy {
        Strategy::LookAhead { .. } => Some(alternatives(mdp, &optima, policy, POLICIES, course.over)?),
        _ => None,
    };
    let losses = match method.strategy {
        Strategy::ValueAtRisk { .. } | Strategy::RiskInformation { .. } => {
            state_losses(mdp, &optima, policy, &course.states)?
        }
        _ => inquiry::Losses::new(n, vec![0.0; n * course.states.len()])?,
    };
    let round = Round {
        belief: Belief::equal(n)?,
        losses,
        questions: course.states.iter().enumerate().map(question).collect::<Result<_, _>>()?,
        alternatives,
    };
    Ok((round, solving_s))
}

/// `n` draws, evenly spaced.
pub fn some(draws: &Draws, n: usize) -> Vec<f64> {
    (0..n).flat_map(|i| draws.weights(i * draws.n() / n)).copied().collect()
}
