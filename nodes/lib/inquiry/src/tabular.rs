//! Questions about a decision process: losses of states (eq. 8.2) and the answers to questions about actions, trajectories and
//! pairs of trajectories. A large or continuous world gives the states that it sampled (section 8.2.3).

use likelihood::actions::{Choice, ChoiceVerdict};
use likelihood::preferences::AnswerModel;
use mdp::{Mdp, Policy, feature_counts, successor_features};

use crate::error::{check_length, check_numbers};
use crate::{Alternatives, Answers, DrawnOptima, InquiryError, Losses};

/// Losses below this share of Σ |w_i Ψ_i| are rounding, as in `mdp::policy_losses`.
const ROUNDING: f64 = 1e-9;

/// (state, action) pairs in the order of time.
pub type Trajectory = [(usize, usize)];

/// How a person answers about a decision process: Boltzmann-rational, as the likelihood has it.
#[derive(Debug, Clone, PartialEq)]
pub struct Answering<'a> {
    /// The world.
    pub mdp: &'a Mdp,
    /// The draws, solved.
    pub optima: &'a DrawnOptima,
    /// Rationality: one for all draws, or one a draw.
    pub betas: &'a [f64],
    /// Share of answers given at random, in [0, 1).
    pub wrong_rate: f64,
}

/// Which loss of a policy counts.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Over {
    /// The mean over the initial distribution.
    Starts,
    /// The largest over all states in which one may start.
    WorstStart,
}

/// V*_w(s) − V^π_w(s) under every draw, in each of `states` (eq. 8.2).
///
/// # Errors
/// A policy or states that are not of `mdp`.
pub fn state_losses(
    mdp: &Mdp,
    optima: &DrawnOptima,
    policy: &Policy,
    states: &[usize],
) -> Result<Losses, InquiryError> {
    check_states(mdp, states)?;
    let k = mdp.n_features();
    let psi = successor_features(mdp, policy)?;
    let mut values = Vec::with_capacity(states.len() * optima.n());
    for &state in states {
        let psi = &psi[state * k..][..k];
        values.extend((0..optima.n()).map(|draw| loss(optima.value(draw, state), optima.weights(draw), psi)));
    }
    Losses::new(optima.n(), values)
}

/// The same as shares of what the policy `reference` loses there, by at least `floor`: method notes 1.8, instead of eq. 8.5 that
/// divides by a value of any sign.
///
/// # Errors
/// As [`state_losses`]; a floor that is not positive.
pub fn normalised_state_losses(
    mdp: &Mdp,
    optima: &DrawnOptima,
    policy: &Policy,
    reference: &Policy,
    floor: f64,
    states: &[usize],
) -> Result<Losses, InquiryError> {
    let (own, other) = (state_losses(mdp, optima, policy, states)?, state_losses(mdp, optima, reference, states)?);
    let mut values = Vec::with_capacity(states.len() * optima.n());
    for situation in 0..states.len() {
        let reference = risk::Reference { name: "reference policy", losses: other.of(situation) };
        values.extend(risk::normalised_losses(own.of(situation), &reference, floor)?.values);
    }
    Losses::new(optima.n(), values)
}

/// Losses under every draw of the policies that the robot could take up: `current`, then the optimal policies of `n` draws evenly
/// spaced among all (fewer when there are fewer draws).
///
/// # Errors
/// A policy that is not of `mdp`.
pub fn alternatives(
    mdp: &Mdp,
    optima: &DrawnOptima,
    current: &Policy,
    n: usize,
    over: Over,
) -> Result<Alternatives, InquiryError> {
    let n_draws = optima.n();
    let n = n.min(n_draws);
    let chosen = (0..n).map(|i| i * n_draws / n.max(1));
    let starts: Vec<(usize, f64)> = mdp.initial().iter().copied().enumerate().filter(|(_, p)| *p > 0.0).collect();
    let mut losses = Vec::with_capacity((n + 1) * n_draws);
    match over {
        Over::Starts => {
            let value = |draw: usize| -> f64 { starts.iter().map(|&(state, p)| p * optima.value(draw, state)).sum() };
            let values: Vec<f64> = (0..n_draws).map(value).collect();
            let mut add = |counts: &[f64]| {
                losses.extend((0..n_draws).map(|draw| loss(values[draw], optima.weights(draw), counts)));
            };
            add(&feature_counts(mdp, current)?);
            chosen.for_each(|draw| add(optima.feature_counts(draw)));
        }
        Over::WorstStart => {
            let k = mdp.n_features();
            let of_draws = chosen.map(|draw| Policy::Deterministic(optima.policy(draw).to_vec()));
            for policy in std::iter::once(current.clone()).chain(of_draws) {
                let psi = successor_features(mdp, &policy)?;
                losses.extend((0..n_draws).map(|draw| {
                    let of = |&(state, _): &(usize, f64)| {
                        loss(optima.value(draw, state), optima.weights(draw), &psi[state * k..][..k])
                    };
                    starts.iter().map(of).fold(0.0, f64::max)
                }));
            }
        }
    }
    Alternatives::new(n_draws, losses)
}

impl Answering<'_> {
    /// "What would you do in this state?": one answer an action.
    ///
    /// # Errors
    /// A state that is not of the world; rationalities that do not fit.
    pub fn action(&self, state: usize) -> Result<Answers, InquiryError> {
        check_states(self.mdp, &[state])?;
        let (n, n_actions) = (self.optima.n(), self.mdp.n_actions());
        let mut probabilities = vec![0.0; n * n_actions];
        self.for_each_choice(state, |draw, choice| {
            for (action, p) in choice.iter().enumerate() {
                probabilities[action * n + draw] = *p;
            }
        })?;
        Answers::table(n, probabilities)
    }

    /// "Which of these steps are good, which bad?": π(a|s) is the probability of "good". A pair that comes twice is judged
    /// once; see [`critique_evidence`].
    ///
    /// # Errors
    /// A pair that is not of the world; more than [`crate::MAX_STEPS`] different ones, or none; rationalities that do not fit.
    pub fn critique(&self, trajectory: &Trajectory) -> Result<Answers, InquiryError> {
        let n = self.optima.n();
        let steps = distinct(trajectory);
        let mut good = Vec::with_capacity(steps.len() * n);
        for &(state, action) in &steps {
            check_states(self.mdp, &[state])?;
            check_action(self.mdp, action)?;
            let first = good.len();
            good.resize(first + n, 0.0);
            self.for_each_choice(state, |draw, choice| good[first + draw] = choice[action])?;
        }
        Answers::segments(n, good)
    }

    /// "Which of these two is better?" by the discounted return: the first, the second, about equal, can't tell, the last two where
    /// `model` offers them. Its random clicks count, not those of `self`.
    ///
    /// # Errors
    /// Pairs that are not of the world; a model that is none.
    pub fn comparison(
        &self,
        first: &Trajectory,
        second: &Trajectory,
        model: &AnswerModel,
    ) -> Result<Answers, InquiryError> {
        self.check_betas()?;
        let (a, b) = (discounted_features(self.mdp, first)?, discounted_features(self.mdp, second)?);
        let difference: Vec<f64> = a.iter().zip(&b).map(|(a, b)| b - a).collect();
        let utilities = (0..self.optima.n()).map(|draw| self.beta(draw) * dot(self.optima.weights(draw), &difference));
        comparison_answers(utilities, model)
    }

    /// Calls `f` with every draw and π(·|state) under it.
    fn for_each_choice(&self, state: usize, mut f: impl FnMut(usize, &[f64])) -> Result<(), InquiryError> {
        self.check_betas()?;
        let uniform = 1.0 / self.mdp.n_actions() as f64;
        let mut choice = vec![0.0; self.mdp.n_actions()];
        for draw in 0..self.optima.n() {
            let (q, beta) = (self.optima.q(draw, state), self.beta(draw));
            let best = q.iter().copied().fold(f64::NEG_INFINITY, f64::max);
            let mut total = 0.0;
            for (p, q) in choice.iter_mut().zip(q) {
                *p = libm::exp(beta * (q - best));
                total += *p;
            }
            choice.iter_mut().for_each(|p| *p = (1.0 - self.wrong_rate) * *p / total + self.wrong_rate * uniform);
            f(draw, &choice);
        }
        Ok(())
    }

    fn beta(&self, draw: usize) -> f64 {
        self.betas[if self.betas.len() == 1 { 0 } else { draw }]
    }

    fn check_betas(&self) -> Result<(), InquiryError> {
        let expected = if self.betas.len() == 1 { 1 } else { self.optima.n() };
        check_length("rationalities", self.betas.len(), expected)?;
        check_numbers("rationality", self.betas, "positive and finite", |beta| beta > 0.0 && beta.is_finite())?;
        check_numbers("wrong rate", &[self.wrong_rate], "at least 0 and below 1", |rate| (0.0..1.0).contains(&rate))
    }
}

/// Answers to a comparison from β (U_second − U_first) under each draw: first, second, then "about equal" and "can't tell" where
/// they are offered.
///
/// # Errors
/// No draws; a model that is none.
pub fn comparison_answers(
    differences: impl Iterator<Item = f64>,
    model: &AnswerModel,
) -> Result<Answers, InquiryError> {
    // The likelihood refuses a model that is none.
    likelihood::preferences::PreferenceLikelihood::new(1, vec![], vec![], *model)?;
    let of: Vec<_> = differences.map(|difference| model.probabilities(difference)).collect();
    let mut rows: Vec<f64> = of.iter().map(|p| p.less).chain(of.iter().map(|p| p.more)).collect();
    if model.equal_threshold > 0.0 {
        rows.extend(of.iter().map(|p| p.equal));
    }
    if model.cant_tell > 0.0 {
        rows.extend(of.iter().map(|p| p.cant_tell));
    }
    Answers::table(of.len(), rows)
}

/// What a critique says, pair by pair as [`Answering::critique`] has them: `verdicts` holds good, bad or, for steps left unjudged,
/// nothing for every step of the trajectory. A pair that was judged twice counts once, as it was judged first.
///
/// # Errors
/// Not one verdict a step.
pub fn critique_evidence(trajectory: &Trajectory, verdicts: &[Option<bool>]) -> Result<Vec<Choice>, InquiryError> {
    check_length("verdicts", verdicts.len(), trajectory.len())?;
    let mut evidence: Vec<Choice> = Vec::new();
    for (&(state, action), verdict) in trajectory.iter().zip(verdicts) {
        let Some(is_good) = verdict else { continue };
        if !evidence.iter().any(|known| (known.state, known.action) == (state, action)) {
            let verdict = if *is_good { ChoiceVerdict::Good } else { ChoiceVerdict::Bad };
            evidence.push(Choice { state, action, verdict, factor: 1.0 });
        }
    }
    Ok(evidence)
}

/// Each pair once, where it first stands.
pub fn distinct(trajectory: &Trajectory) -> Vec<(usize, usize)> {
    let mut steps: Vec<(usize, usize)> = Vec::with_capacity(trajectory.len());
    for step in trajectory {
        if !steps.contains(step) {
            steps.push(*step);
        }
    }
    steps
}

/// Σ_t γᵗ φ(s_t, a_t): k numbers.
///
/// # Errors
/// Pairs that are not of the world.
pub fn discounted_features(mdp: &Mdp, trajectory: &Trajectory) -> Result<Vec<f64>, InquiryError> {
    let mut sums = vec![0.0; mdp.n_features()];
    let mut discount = 1.0;
    for &(state, action) in trajectory {
        check_states(mdp, &[state])?;
        check_action(mdp, action)?;
        for (sum, phi) in sums.iter_mut().zip(mdp.features(state, action)) {
            *sum += discount * phi;
        }
        discount *= mdp.gamma();
    }
    Ok(sums)
}

/// V* − wᵀΨ, zero where that is rounding.
fn loss(value: f64, w: &[f64], psi: &[f64]) -> f64 {
    let (mut own, mut size) = (0.0, 0.0);
    for (w, psi) in w.iter().zip(psi) {
        own += w * psi;
        size += (w * psi).abs();
    }
    let difference = value - own;
    if difference.abs() > ROUNDING * size { difference } else { 0.0 }
}

fn dot(x: &[f64], y: &[f64]) -> f64 {
    x.iter().zip(y).map(|(x, y)| x * y).sum()
}

fn check_states(mdp: &Mdp, states: &[usize]) -> Result<(), InquiryError> {
    let below = mdp.n_states();
    match states.iter().position(|&state| state >= below) {
        Some(index) => {
            let (name, what, got) = ("questions", "state", states[index]);
            Err(mdp::MdpError::OutOfRange { name, index, what, got, below }.into())
        }
        None => Ok(()),
    }
}

fn check_action(mdp: &Mdp, got: usize) -> Result<(), InquiryError> {
    let below = mdp.n_actions();
    if got < below {
        return Ok(());
    }
    Err(mdp::MdpError::OutOfRange { name: "questions", index: 0, what: "action", got, below }.into())
}
