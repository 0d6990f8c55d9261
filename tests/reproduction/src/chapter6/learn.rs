//! The mean reward under what is shown: as published and as we do it.

use super::{Shown, World, purpose};
use crate::chapter4::{Walk, keep, walk_on};
use crate::harness::{ReproductionError, extent, generator};
use likelihood::actions::{ActionLikelihood, ChoiceVerdict, without_duplicates};
use likelihood::preferences::{Answer, AnswerModel, PreferenceLikelihood, Verdict};
use posterior::{Draws, EvidenceKind, Model, Prior, Rationality, Run, Term, TermLikelihood, draw};
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::Rng;
use serde::Serialize;

/// β of both methods, as published.
const BETA: f64 = 50.0;
/// 5,000 steps, a tenth not kept, then every 5th kept.
const CHAPTER_6: Walk = Walk { steps: 5000, burn: 500, every: 5 };
/// What is known of the rationality of either kind of evidence: 95 % of its prior lies between 1 and 2,500.
const UNKNOWN: Rationality = Rationality::Learned { median: BETA, log_sd: 2.0 };

/// Draws first asked for.
const DRAWS: usize = extent(2000, 200);
/// Most draws; chains that still do not agree are counted and shown.
const MOST_DRAWS: usize = extent(8000, DRAWS);
/// R̂ from which chains do not agree, as for a bound.
const MOST_RHAT: f64 = 1.01;

/// True losses of the policies that are optimal under the mean rewards.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Learned {
    /// Bayesian IRL as published.
    pub irl_published: f64,
    /// Bayesian REX as published.
    pub rex_published: f64,
    /// Bayesian IRL, ours.
    pub irl: f64,
    /// Bayesian REX, ours.
    pub rex: f64,
    /// Both kinds of evidence in one posterior.
    pub joint: f64,
    /// Mean β of the actions in the joint posterior.
    pub beta_actions: f64,
    /// Mean β of the preferences in the joint posterior.
    pub beta_preferences: f64,
    /// Largest R̂ of ours: Bayesian IRL, Bayesian REX, joint.
    pub rhat: [f64; 3],
}

impl Learned {
    /// How many of our three posteriors are of chains that do not agree.
    pub fn n_not_mixed(&self) -> usize {
        self.rhat.iter().filter(|rhat| **rhat > MOST_RHAT).count()
    }
}

/// Learns from what is shown in every way.
pub fn learn(
    world: &World,
    shown: &Shown,
    seed: u64,
    replicate: usize,
    column: u32,
) -> Result<Learned, ReproductionError> {
    let preferences = preferences(world, shown)?;
    // Columns draw from generators of their own, so that none shifts another.
    let generator_of = |purpose| generator(seed, replicate, purpose + 16 * (column + 1));
    let mut walks = generator_of(purpose::WALK);
    let irl_walk = walk_on(&world.mdp, without_duplicates(&shown.actions), BETA, CHAPTER_6, &mut walks)?;
    let mut evaluator = preferences.evaluator();
    let k = world.mdp.n_features();
    let mut theta = vec![0.0; k];
    let log_density = |w: &[f64]| {
        for (theta, w) in theta.iter_mut().zip(w) {
            *theta = BETA * w;
        }
        evaluator.value(&theta)
    };
    let rex_walk = keep(k, log_density, CHAPTER_6, &mut walks);
    let actions = actions_term(world, shown)?;
    let compared = Term {
        kind: EvidenceKind::Preferences,
        rationality: UNKNOWN,
        likelihood: TermLikelihood::Preferences(preferences.clone()),
    };
    let mut chains = generator_of(purpose::CHAINS);
    let irl = believe(world, vec![actions.clone()], &mut chains)?;
    let rex = believe(world, vec![compared.clone()], &mut chains)?;
    let joint = believe(world, vec![actions, compared], &mut chains)?;
    let loss = |draws: &Draws| world.loss_of(&draws.mean_weights());
    Ok(Learned {
        irl_published: world.loss_of(&mean(&irl_walk.draws, k)),
        rex_published: world.loss_of(&mean(&rex_walk.draws, k)),
        irl: loss(&irl),
        rex: loss(&rex),
        joint: loss(&joint),
        beta_actions: joint.betas[0].mean(),
        beta_preferences: joint.betas[1].mean(),
        rhat: [irl.rhat_max, rex.rhat_max, joint.rhat_max],
    })
}

fn preferences(world: &World, shown: &Shown) -> Result<PreferenceLikelihood, ReproductionError> {
    let answer = |&(less, more): &(usize, usize)| Answer { less, more, factor: 1.0, verdict: Verdict::Strict };
    let answers = shown.ranked.pairs.iter().map(answer).collect();
    let features = shown.ranked.features.clone();
    Ok(PreferenceLikelihood::new(world.mdp.n_features(), features, answers, AnswerModel::default())?)
}

fn actions_term<'a>(world: &'a World, shown: &Shown) -> Result<Term<'a>, ReproductionError> {
    let judged = shown.actions.iter().any(|choice| choice.verdict != ChoiceVerdict::Taken);
    let likelihood = ActionLikelihood::new(&world.mdp, without_duplicates(&shown.actions))?;
    Ok(Term {
        kind: if judged { EvidenceKind::Critiques } else { EvidenceKind::Actions },
        rationality: UNKNOWN,
        likelihood: TermLikelihood::Actions(likelihood),
    })
}

/// Samples the posterior of some evidence, with more draws for as long as the chains do not agree. What all chains say together is
/// worth nothing before: one that is stuck where the evidence is improbable spoils a mean.
fn believe(world: &World, terms: Vec<Term<'_>>, generator: &mut ChaCha8Rng) -> Result<Draws, ReproductionError> {
    let n_features = world.mdp.n_features();
    let model = Model { n_features, prior: Prior::L1Sphere, nonnegative_return: None, terms };
    let mut n_draws = DRAWS;
    loop {
        let run = Run { n_draws, n_chains: 4, warmup: 300.max(n_draws / 10), threads: 1 };
        let mut key = [0; 32];
        generator.fill_bytes(&mut key);
        let draws = draw(&model, &run, generator.next_u64(), &key)?;
        if draws.rhat_max <= MOST_RHAT || n_draws >= MOST_DRAWS {
            return Ok(draws);
        }
        n_draws *= 2;
    }
}

fn mean(draws: &[f64], k: usize) -> Vec<f64> {
    let n = (draws.len() / k) as f64;
    (0..k).map(|j| draws.iter().skip(j).step_by(k).fold(0.0, |sum, w| sum + w) / n).collect()
}
