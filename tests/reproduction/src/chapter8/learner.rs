//! The robot: a posterior after every answer, and the policy it would follow.

use super::purpose;
use crate::harness::{ReproductionError, generator};
use likelihood::actions::{ActionLikelihood, Choice};
use mdp::{Mdp, Policy, Solver};
use posterior::{Draws, EvidenceKind, Model, Prior, Rationality, Run, Term, TermLikelihood, Warm, draw_from};
use rand_chacha::rand_core::Rng;

/// β of the dissertation's author, for a person who never errs.
pub const BETA: f64 = 100.0;

/// How a learner samples. The chains of question n are seeded alike for every method, so methods are compared on equal luck.
#[derive(Debug, Clone)]
pub struct Learner<'a> {
    /// The world.
    pub mdp: &'a Mdp,
    /// How many draws.
    pub run: Run,
    /// Seed of the figure.
    pub seed: u64,
    /// Number of the replicate.
    pub replicate: usize,
    /// β that is taken for granted.
    pub beta: f64,
}

impl Learner<'_> {
    /// The posterior after `n_asked` answers.
    ///
    /// # Errors
    /// Evidence that does not fit the world.
    pub fn learn(&self, evidence: &[Choice], n_asked: usize, warm: Option<&Warm>) -> Result<Draws, ReproductionError> {
        let likelihood = ActionLikelihood::new(self.mdp, evidence.to_vec())?;
        let term = Term {
            kind: EvidenceKind::Actions,
            rationality: Rationality::Fixed(self.beta),
            likelihood: TermLikelihood::Actions(likelihood),
        };
        let n_features = self.mdp.n_features();
        let model = Model { n_features, prior: Prior::L1Sphere, nonnegative_return: None, terms: vec![term] };
        let number = u32::try_from(n_asked).unwrap_or(u32::MAX - purpose::CHAINS);
        let mut chains = generator(self.seed, self.replicate, purpose::CHAINS + number);
        let mut key = [0; 32];
        chains.fill_bytes(&mut key);
        Ok(draw_from(&model, &self.run, chains.next_u64(), &key, warm)?)
    }

    /// The policy that is optimal under some weights.
    pub fn policy(&self, weights: &[f64]) -> Policy {
        Policy::Deterministic(Solver::new(self.mdp).solve(weights).policy().to_vec())
    }
}
