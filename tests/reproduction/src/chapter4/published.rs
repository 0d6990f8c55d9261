//! The posterior as its author sampled it: a walk on the L1 sphere along all pairs of weights in the printed order.

use super::{ALPHAS, Demonstration, Judged, Problem, choices, discounted_counts, printed_bound};
use crate::harness::ReproductionError;
use likelihood::actions::{ActionLikelihood, Choice, without_duplicates};
use mdp::{Mdp, policy_losses};
use posterior::walks::{PairOrder, l1_proposal, metropolis};
use rand_chacha::ChaCha8Rng;
use risk::worst_case_feature_count_bound;

/// Length of a move along a pair of weights.
const STEP: f64 = 0.01;

/// What of a walk is kept.
#[derive(Debug, Clone)]
pub struct Walked {
    /// Kept weights, row-major.
    pub draws: Vec<f64>,
    /// The most probable weights of the whole walk.
    pub map: Vec<f64>,
}

/// How long to walk and what to keep.
#[derive(Debug, Clone, Copy)]
pub struct Walk {
    /// Steps.
    pub steps: usize,
    /// Steps not kept at the beginning.
    pub burn: usize,
    /// Every how many steps one is kept.
    pub every: usize,
}

/// Chapter 4: 10,000 steps, every 20th from the 100th on: 495 draws.
pub const CHAPTER_4: Walk = Walk { steps: 10_000, burn: 100, every: 20 };

impl Walked {
    /// Judges a policy with the bounds as printed.
    pub fn judge(
        &self,
        problem: &Problem,
        demonstrations: &[Demonstration],
        counts: &[f64],
    ) -> Result<Judged, ReproductionError> {
        let losses = policy_losses(&problem.mdp, counts, &self.draws, 1)?;
        let bounds = ALPHAS.map(|alpha| Some(printed_bound(&losses, alpha)));
        let worst_case = worst_case_feature_count_bound(&discounted_counts(&problem.mdp, demonstrations), counts)?;
        Ok(Judged { loss: problem.loss(counts), bounds, worst_case })
    }
}

/// Walks on the posterior of demonstrations, repeated pairs removed.
pub fn walk(
    mdp: &Mdp,
    demonstrations: &[Demonstration],
    beta: f64,
    generator: &mut ChaCha8Rng,
) -> Result<Walked, ReproductionError> {
    walk_on(mdp, without_duplicates(&choices(demonstrations)), beta, CHAPTER_4, generator)
}

/// Walks on the posterior of any choices.
pub fn walk_on(
    mdp: &Mdp,
    choices: Vec<Choice>,
    beta: f64,
    walk: Walk,
    generator: &mut ChaCha8Rng,
) -> Result<Walked, ReproductionError> {
    let likelihood = ActionLikelihood::new(mdp, choices)?;
    let mut evaluator = likelihood.evaluator();
    let mut theta = vec![0.0; mdp.n_features()];
    let log_density = |w: &[f64]| {
        for (theta, w) in theta.iter_mut().zip(w) {
            *theta = beta * w;
        }
        evaluator.value(&theta)
    };
    Ok(keep(mdp.n_features(), log_density, walk, generator))
}

/// Walks on any log density from all weights −1/k, as the author does.
pub fn keep(
    n_features: usize,
    log_density: impl FnMut(&[f64]) -> f64,
    walk: Walk,
    generator: &mut ChaCha8Rng,
) -> Walked {
    let start = vec![-1.0 / n_features as f64; n_features];
    // The start counts as the first of the steps.
    let steps = walk.steps - 1;
    let propose = |w: &mut [f64], generator: &mut ChaCha8Rng| l1_proposal(w, STEP, PairOrder::Printed, generator);
    let walked = metropolis(log_density, start.clone(), steps, propose, generator);
    let row = |i: usize| &walked.values[i * n_features..][..n_features];
    let draws = (walk.burn.max(1)..walk.steps).step_by(walk.every).flat_map(|i| row(i - 1).iter().copied()).collect();
    let best = (0..steps).max_by(|&a, &b| {
        // Of equals the first.
        walked.log_likelihood[a].total_cmp(&walked.log_likelihood[b]).then(b.cmp(&a))
    });
    let map = best.map_or(start, |i| row(i).to_vec());
    Walked { draws, map }
}
