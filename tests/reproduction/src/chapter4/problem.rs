//! A random world with its true reward.

use super::purpose;
use crate::harness::{ReproductionError, generator};
use mdp::random::l1_sphere;
use mdp::worlds::chapter4;
use mdp::{Mdp, Policy, Solver, feature_counts};

/// A world and the reward that nobody but the demonstrator knows.
#[derive(Debug, Clone)]
pub struct Problem {
    /// The world without its reward.
    pub mdp: Mdp,
    /// w*, ‖w*‖₁ = 1.
    pub weights: Vec<f64>,
    /// The optimal action in every state.
    pub optimal: Vec<usize>,
    /// V* over the starts.
    pub value: f64,
}

impl Problem {
    /// The problem of a replicate.
    pub fn new(seed: u64, replicate: usize) -> Result<Self, ReproductionError> {
        let mut generator = generator(seed, replicate, purpose::WORLD);
        let mdp = chapter4::random(&mut generator).mdp()?;
        let weights = l1_sphere(mdp.n_features(), &mut generator);
        Self::with(mdp, weights)
    }

    /// A problem of any world and reward.
    pub fn with(mdp: Mdp, weights: Vec<f64>) -> Result<Self, ReproductionError> {
        let mut solver = Solver::new(&mdp);
        let optimum = solver.solve(&weights);
        let (optimal, value) = (optimum.policy().to_vec(), optimum.value());
        Ok(Self { mdp, weights, optimal, value })
    }

    /// Φ of a deterministic policy.
    pub fn counts(&self, policy: &[usize]) -> Result<Vec<f64>, ReproductionError> {
        Ok(feature_counts(&self.mdp, &Policy::Deterministic(policy.to_vec()))?)
    }

    /// The true loss V* − w*ᵀΦ of a policy with feature counts Φ (equation 4.4).
    pub fn loss(&self, counts: &[f64]) -> f64 {
        let value: f64 = self.weights.iter().zip(counts).map(|(w, phi)| w * phi).sum();
        self.value - value
    }

    /// The policy that is optimal under other weights, and its Φ.
    pub fn greedy(&self, weights: &[f64]) -> (Vec<usize>, Vec<f64>) {
        let mut solver = Solver::new(&self.mdp);
        let optimum = solver.solve(weights);
        (optimum.policy().to_vec(), optimum.feature_counts().to_vec())
    }
}
