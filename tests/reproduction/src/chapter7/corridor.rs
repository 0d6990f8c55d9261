//! The grid of figure 7.4 with its one demonstration, and the posterior of the reward as the author has it and as we do.

use crate::harness::ReproductionError;
use likelihood::actions::{ActionLikelihood, Choice};
use mdp::worlds::UP;
use mdp::worlds::corridor::{DEMONSTRATION, N_FEATURES, TERMINAL, world};
use mdp::{Mdp, Policy, feature_counts};
use posterior::walks::{l2_proposal, metropolis};
use posterior::{EvidenceKind, Model, Prior, Rationality, Run, Term, TermLikelihood, draw};
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::Rng;
use robust::expert_feature_counts;

/// Section F.2 and the author's program: rationality, standard deviation of a proposal, steps, burn-in, and every how many steps are
/// kept.
const BETA: f64 = 10.0;
const SIGMA: f64 = 0.2;
const STEPS: usize = 2000;
const BURN: usize = 500;
const EVERY: usize = 5;
/// Steps of warm-up: a start far from the demonstration lies 700 nats below the mode, and takes some time to come from there.
const WARMUP: usize = 2000;
/// Chains of ours.
pub(super) const N_CHAINS: usize = 4;

/// The process and what was shown in it.
#[derive(Debug, Clone)]
pub struct Corridor {
    /// The process.
    pub mdp: Mdp,
    /// Discounted feature counts of the demonstration.
    pub expert: Vec<f64>,
    /// The same without a discount, for Maximum Entropy IRL.
    pub undiscounted: Vec<f64>,
}

impl Corridor {
    /// The world of figure 7.4.
    pub fn new() -> Result<Self, ReproductionError> {
        let mdp = world().mdp()?;
        let mut steps = DEMONSTRATION.to_vec();
        steps.push((TERMINAL, UP));
        let shown = [steps];
        let expert = expert_feature_counts(&mdp, &shown, mdp.gamma())?;
        let undiscounted = expert_feature_counts(&mdp, &shown, 1.0)?;
        Ok(Self { mdp, expert, undiscounted })
    }

    fn likelihood(&self) -> Result<ActionLikelihood<'_>, ReproductionError> {
        let choices = DEMONSTRATION.iter().map(|&(state, action)| Choice::taken(state, action)).collect();
        Ok(ActionLikelihood::new(&self.mdp, choices)?)
    }

    /// Draws as published: 300 of one walk on the L2 sphere.
    pub fn walked(&self, generator: &mut ChaCha8Rng) -> Result<Vec<f64>, ReproductionError> {
        let likelihood = self.likelihood()?;
        let mut evaluator = likelihood.evaluator();
        let log_density = |w: &[f64]| evaluator.value(&[BETA * w[0], BETA * w[1]]);
        // All weights equal and negative, as the author's programs of chapter 4 begin.
        let start = vec![-1.0 / libm::sqrt(N_FEATURES as f64); N_FEATURES];
        let propose = |w: &mut [f64], generator: &mut ChaCha8Rng| l2_proposal(w, SIGMA, generator);
        let walked = metropolis(log_density, start, STEPS, propose, generator);
        let rows: Vec<&[f64]> = walked.values.chunks(N_FEATURES).collect();
        Ok(rows[BURN..].iter().step_by(EVERY).flat_map(|row| row.iter().copied()).collect())
    }

    /// Draws of the same posterior in four chains of ours.
    pub fn sampled(&self, n_draws: usize, generator: &mut ChaCha8Rng) -> Result<Vec<f64>, ReproductionError> {
        let term = Term {
            kind: EvidenceKind::Actions,
            rationality: Rationality::Fixed(BETA),
            likelihood: TermLikelihood::Actions(self.likelihood()?),
        };
        let model =
            Model { n_features: N_FEATURES, prior: Prior::L2Sphere, nonnegative_return: None, terms: vec![term] };
        let run = Run { n_draws, n_chains: N_CHAINS, warmup: WARMUP, threads: 1 };
        let mut key = [0; 32];
        generator.fill_bytes(&mut key);
        Ok(draw(&model, &run, generator.next_u64(), &key)?.values)
    }
}

/// Share of a policy's discounted visits that are of red cells.
pub fn red_share(mdp: &Mdp, policy: &Policy) -> Result<f64, ReproductionError> {
    let counts = feature_counts(mdp, policy)?;
    Ok(counts[1] / (counts[0] + counts[1]))
}
