//! Worlds of section 6.5 and what is shown in them.

use super::purpose;
use crate::harness::{ReproductionError, generator};
use likelihood::actions::Choice;
use mdp::random::l1_sphere;
use mdp::worlds::chapter6;
use mdp::{Mdp, Policy, Solver, rollout};
use rand_chacha::ChaCha8Rng;

/// Steps of a trajectory.
const LENGTH: usize = 20;
/// Returns closer than this are equal: which of them is better is not said.
const SAME_RETURN: f64 = 1e-9;

/// State–action pairs in the order of time.
pub type Trajectory = Vec<(usize, usize)>;

/// A world and its true reward.
#[derive(Debug, Clone)]
pub struct World {
    /// The world without its reward.
    pub mdp: Mdp,
    /// w*, ‖w*‖₁ = 1.
    pub weights: Vec<f64>,
    value: f64,
    optimal: Policy,
}

/// Trajectories with comparisons between them.
#[derive(Debug, Clone, Default)]
pub struct Ranked {
    /// Discounted feature sums Σ_t γᵗ φ(s_t) of every trajectory, row by row: the author discounts them (equation 6.3 does not).
    pub features: Vec<f64>,
    /// (worse, better).
    pub pairs: Vec<(usize, usize)>,
}

/// What both methods are shown.
#[derive(Debug, Clone)]
pub struct Shown {
    /// For Bayesian IRL: actions taken, or judged good and bad.
    pub actions: Vec<Choice>,
    /// For Bayesian REX.
    pub ranked: Ranked,
}

impl World {
    /// The world of a replicate.
    pub fn new(seed: u64, replicate: usize) -> Result<Self, ReproductionError> {
        let mut generator = generator(seed, replicate, purpose::WORLD);
        let mdp = chapter6::random(&mut generator).mdp()?;
        let weights = l1_sphere(mdp.n_features(), &mut generator);
        let mut solver = Solver::new(&mdp);
        let optimum = solver.solve(&weights);
        let (value, optimal) = (optimum.value(), optimum.indifferent_policy());
        Ok(Self { mdp, weights, value, optimal })
    }

    /// True loss of the policy that is optimal under other weights.
    pub fn loss_of(&self, weights: &[f64]) -> f64 {
        let mut solver = Solver::new(&self.mdp);
        let counts = solver.solve(weights).feature_counts();
        let value: f64 = self.weights.iter().zip(counts).map(|(w, phi)| w * phi).sum();
        self.value - value
    }

    /// A perfect demonstration of 20 steps; equally good actions at random.
    pub fn perfect(&self, start: usize, generator: &mut ChaCha8Rng) -> Result<Trajectory, ReproductionError> {
        Ok(rollout(&self.mdp, &self.optimal, start, LENGTH, generator)?)
    }

    /// 20 steps at random.
    pub fn random(&self, start: usize, generator: &mut ChaCha8Rng) -> Result<Trajectory, ReproductionError> {
        Ok(rollout(&self.mdp, &Policy::uniform(&self.mdp), start, LENGTH, generator)?)
    }

    /// Discounted feature sums of a trajectory.
    pub fn features(&self, trajectory: &Trajectory) -> Vec<f64> {
        let mut sums = vec![0.0; self.mdp.n_features()];
        let mut discount = 1.0;
        for &(state, action) in trajectory {
            for (sum, phi) in sums.iter_mut().zip(self.mdp.features(state, action)) {
                *sum += discount * phi;
            }
            discount *= self.mdp.gamma();
        }
        sums
    }

    /// True return of a trajectory.
    pub fn true_return(&self, trajectory: &Trajectory) -> f64 {
        self.features(trajectory).iter().zip(&self.weights).map(|(phi, w)| phi * w).sum()
    }
}

/// Where the trajectory of this number starts: in the states in turn.
pub fn repeated_starts(world: &World, n: usize) -> impl Iterator<Item = usize> {
    let n_states = world.mdp.n_states();
    (0..n).map(move |i| i % n_states)
}

/// Every pair of trajectories ordered by true return; equal ones are not compared.
pub fn ranked_by_return(world: &World, trajectories: &[Trajectory]) -> Ranked {
    let returns: Vec<f64> = trajectories.iter().map(|trajectory| world.true_return(trajectory)).collect();
    let mut pairs = Vec::new();
    for i in 0..returns.len() {
        for j in i + 1..returns.len() {
            if returns[j] - returns[i] > SAME_RETURN {
                pairs.push((i, j));
            } else if returns[i] - returns[j] > SAME_RETURN {
                pairs.push((j, i));
            }
        }
    }
    Ranked { features: trajectories.iter().flat_map(|trajectory| world.features(trajectory)).collect(), pairs }
}
