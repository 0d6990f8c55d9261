//! Demonstrations and their feature counts.

use super::Problem;
use crate::harness::ReproductionError;
use likelihood::actions::Choice;
use mdp::worlds::chapter4::STARTS;
use mdp::{Mdp, Policy, Solver, rollout};
use rand_chacha::ChaCha8Rng;

/// State–action pairs in the order of time.
pub type Demonstration = Vec<(usize, usize)>;

/// Steps of a demonstration.
const LENGTH: usize = 100;

/// Who demonstrates.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Demonstrator {
    /// Always the optimal action.
    Optimal,
    /// The optimal action, but with this probability any action at random.
    Careless(f64),
    /// Equation 3.4 with this β.
    Boltzmann(f64),
}

impl Demonstrator {
    fn policy(self, problem: &Problem) -> Policy {
        let (n_states, n_actions) = (problem.mdp.n_states(), problem.mdp.n_actions());
        match self {
            Self::Optimal => Policy::Deterministic(problem.optimal.clone()),
            Self::Careless(share) => {
                let mut p = vec![share / n_actions as f64; n_states * n_actions];
                for (row, &best) in p.chunks_exact_mut(n_actions).zip(&problem.optimal) {
                    row[best] += 1.0 - share;
                }
                Policy::Stochastic(p)
            }
            Self::Boltzmann(beta) => {
                let mut solver = Solver::new(&problem.mdp);
                let optimum = solver.solve(&problem.weights);
                let mut p = Vec::with_capacity(n_states * n_actions);
                for state in 0..n_states {
                    let best = optimum.state_value(state);
                    let row: Vec<f64> =
                        (0..n_actions).map(|a| libm::exp(beta * (optimum.q(state, a) - best))).collect();
                    let sum: f64 = row.iter().sum();
                    p.extend(row.iter().map(|x| x / sum));
                }
                Policy::Stochastic(p)
            }
        }
    }
}

/// Demonstrations of 100 steps from the starts in turn.
pub fn demonstrate(
    problem: &Problem,
    who: Demonstrator,
    n: usize,
    generator: &mut ChaCha8Rng,
) -> Result<Vec<Demonstration>, ReproductionError> {
    let policy = who.policy(problem);
    let one = |d: usize| rollout(&problem.mdp, &policy, STARTS[d % STARTS.len()], LENGTH, generator);
    Ok((0..n).map(one).collect::<Result<_, _>>()?)
}

/// All state–action pairs as choices.
pub fn choices(demonstrations: &[Demonstration]) -> Vec<Choice> {
    demonstrations.iter().flatten().map(|&(state, action)| Choice::taken(state, action)).collect()
}

/// Empirical feature counts: the mean over the demonstrations of Σ_t γᵗ φ(s_t) (equation 4.15).
pub fn discounted_counts(mdp: &Mdp, demonstrations: &[Demonstration]) -> Vec<f64> {
    let mut counts = vec![0.0; mdp.n_features()];
    for demonstration in demonstrations {
        let mut discount = 1.0 / demonstrations.len() as f64;
        for &(state, action) in demonstration {
            for (count, phi) in counts.iter_mut().zip(mdp.features(state, action)) {
                *count += discount * phi;
            }
            discount *= mdp.gamma();
        }
    }
    counts
}
