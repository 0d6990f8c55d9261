//! Bayesian IRL as the dissertation's chapter-4 program runs it: the walk on the L1 sphere of Algorithms 8 and 9, steps of .01 along
//! every pair of weights, one warm-started value iteration to 1e-3 per proposal.

use likelihood::actions::Choice;
use mdp::Mdp;
use mdp::random::uniform;
use posterior::walks::{PairOrder, Walk, l1_proposal};
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;

use crate::value_iteration::ValueIteration;

/// Step along each pair of weights.
pub const STEP: f64 = 0.01;
/// Value iteration stops when no value changes by more.
const TOLERANCE: f64 = 1e-3;

/// log P(demonstrations | w) by eq. 3.5, from value iteration to `tolerance`.
pub fn log_likelihood(
    iteration: &mut ValueIteration,
    choices: &[Choice],
    n_actions: usize,
    beta: f64,
    w: &[f64],
    tolerance: f64,
) -> f64 {
    iteration.solve(w, tolerance);
    let mut sum = 0.0;
    for choice in choices {
        let q = |action| beta * iteration.q(choice.state, action);
        let largest = (0..n_actions).map(q).fold(f64::NEG_INFINITY, f64::max);
        let exponentials: f64 = (0..n_actions).map(|action| libm::exp(q(action) - largest)).sum();
        sum += q(choice.action) - largest - libm::log(exponentials);
    }
    sum
}

/// One chain of `n_steps` proposals from `start`. Value iteration goes on from the values of the last accepted weights.
pub fn walk(mdp: &Mdp, choices: &[Choice], beta: f64, start: Vec<f64>, n_steps: usize, seed: u64) -> Walk {
    let mut iteration = ValueIteration::new(mdp);
    let mut rng = ChaCha8Rng::seed_from_u64(seed);
    let height = |iteration: &mut ValueIteration, w: &[f64]| {
        log_likelihood(iteration, choices, mdp.n_actions(), beta, w, TOLERANCE)
    };
    let mut w = start;
    let mut here = height(&mut iteration, &w);
    let mut values = iteration.values().to_vec();
    let mut visited = Walk { values: Vec::new(), log_likelihood: Vec::new(), acceptance: 0.0 };
    let mut proposal = w.clone();
    let mut n_accepted = 0;
    for _ in 0..n_steps {
        proposal.copy_from_slice(&w);
        l1_proposal(&mut proposal, STEP, PairOrder::Printed, &mut rng);
        iteration.start_from(&values);
        let there = height(&mut iteration, &proposal);
        if uniform(&mut rng) < libm::exp(there - here) {
            std::mem::swap(&mut w, &mut proposal);
            values.copy_from_slice(iteration.values());
            here = there;
            n_accepted += 1;
        }
        visited.values.extend_from_slice(&w);
        visited.log_likelihood.push(here);
    }
    visited.acceptance = f64::from(n_accepted) / n_steps as f64;
    visited
}

#[cfg(test)]
mod tests {
    use super::{TOLERANCE, log_likelihood, walk};
    use crate::value_iteration::ValueIteration;
    use likelihood::actions::Choice;
    use mdp::worlds::chapter4::{REP_0_WEIGHTS, rep_0};

    fn demonstrations() -> Vec<Choice> {
        [(10, 0), (1, 2), (0, 0), (9, 0), (11, 2), (2, 2)].map(|(state, action)| Choice::taken(state, action)).to_vec()
    }

    #[test]
    fn log_likelihoods_of_rep_0_are_the_known_ones_up_to_the_tolerance() {
        let mdp = rep_0().mdp().expect("a good world");
        let mut iteration = ValueIteration::new(&mdp);
        let cases = [
            (1.0, vec![-0.125; 8], -8.317_766_17),
            (100.0, vec![-0.125; 8], -8.317_766_17),
            (1.0, REP_0_WEIGHTS.to_vec(), -6.910_103_09),
            (10.0, REP_0_WEIGHTS.to_vec(), -2.365_131_27),
            (100.0, REP_0_WEIGHTS.to_vec(), -0.678_670_86),
        ];
        for (beta, w, exact) in cases {
            let mut at = |tolerance| log_likelihood(&mut iteration, &demonstrations(), 4, beta, &w, tolerance);
            let (published, converged) = (at(TOLERANCE), at(1e-12));
            assert!((converged - exact).abs() < 1e-7, "{converged} vs {exact}");
            // A last change below 1e-3 leaves at most 9e-3 to come, on either side of six differences.
            assert!((published - exact).abs() < 6.0 * 0.018 * beta, "{published} vs {exact}");
        }
    }

    #[test]
    fn walks_stay_on_the_sphere_and_climb() {
        let mdp = rep_0().mdp().expect("a good world");
        let visited = walk(&mdp, &demonstrations(), 10.0, vec![-0.125; 8], 300, 1);
        assert!(visited.acceptance > 0.1 && visited.acceptance < 1.0, "{}", visited.acceptance);
        assert!(visited.values.chunks_exact(8).all(|w| (w.iter().map(|w| w.abs()).sum::<f64>() - 1.0).abs() < 1e-9));
        assert!(visited.log_likelihood[299] > -8.3);
    }
}
