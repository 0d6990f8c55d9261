//! What robust policies are compared with does what its papers say.
#![allow(clippy::unwrap_used)]

mod common;

use common::{Numbers, close};
use mdp::worlds::{DOWN, GridWorld, LEFT, RIGHT, UP, corridor, maze};
use mdp::{Policy, feature_counts, rollout};
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;
use robust::{
    Convergence, Horizon, MaxEntropySettings, Objective, Outcome, Problem, Settings, Signs, WeightNorm,
    climb_value_at_risk, expert_feature_counts, lpal, max_entropy, optimal_policy,
};

const FREE: MaxEntropySettings = MaxEntropySettings {
    rationality: 1.0,
    horizon: Horizon::Discounted,
    norm: WeightNorm::Free,
    tolerance: 1e-8,
    max_iterations: 5000,
};

#[test]
fn demonstrations_become_feature_counts() {
    let mdp = corridor::world().mdp().unwrap();
    let mut steps = corridor::DEMONSTRATION.to_vec();
    steps.push((corridor::TERMINAL, UP));
    let gamma: f64 = 0.99;
    let white: f64 = (0..8).map(|t| gamma.powi(t)).sum();
    let counts = expert_feature_counts(&mdp, &[steps.clone()], gamma).unwrap();
    close(counts[0], white, 1e-12);
    close(counts[1], 0.0, 0.0);
    let twice = expert_feature_counts(&mdp, &[steps.clone(), vec![(6, RIGHT), (7, DOWN)]], 1.0).unwrap();
    assert_eq!(twice, [4.0, 1.0]);
}

#[test]
fn maximum_entropy_recovers_the_policy_whose_counts_it_is_given() {
    // Counts of a soft-optimal policy are matched by exactly the weights that made it.
    for (seed, horizon) in [(1, Horizon::Discounted), (2, Horizon::Discounted), (3, Horizon::Steps(12))] {
        let case = common::shape(seed).case();
        let k = case.mdp.n_features();
        let mut numbers = Numbers(seed);
        let settings = MaxEntropySettings { horizon, ..FREE };
        // Its counts are found by asking for the weights themselves: one step of length 0.
        let truth: Vec<f64> = (0..k).map(|_| 0.5 * numbers.signed()).collect();
        let counts = soft_counts(&case.mdp, &truth, horizon);
        let found = max_entropy(&case.mdp, &counts, &settings).unwrap();
        assert_eq!(found.outcome, Convergence::Converged, "{found:?}");
        for (x, want) in found.feature_counts.iter().zip(&counts) {
            close(*x, *want, 1e-6);
        }
        let again = soft_counts(&case.mdp, &found.weights, horizon);
        for (x, want) in again.iter().zip(&counts) {
            close(*x, *want, 1e-6);
        }
        found.policy.check(&case.mdp).unwrap();
    }
}

/// Feature counts of P(a|s) ∝ exp Q(s, a), by the definition of soft values over (nearly) all steps.
fn soft_counts(mdp: &mdp::Mdp, theta: &[f64], horizon: Horizon) -> Vec<f64> {
    let (steps, discount) = match horizon {
        Horizon::Steps(steps) => (steps, 1.0),
        Horizon::Discounted => (600, mdp.gamma()),
    };
    let (n, n_actions, k) = (mdp.n_states(), mdp.n_actions(), mdp.n_features());
    let (mut value, mut counts) = (vec![0.0; n], vec![0.0; n * k]);
    for _ in 0..steps {
        let (mut next, mut next_counts) = (vec![0.0; n], vec![0.0; n * k]);
        for state in 0..n {
            let q: Vec<f64> = (0..n_actions)
                .map(|action| {
                    let reward: f64 = mdp.features(state, action).iter().zip(theta).map(|(x, y)| x * y).sum();
                    reward + discount * mdp.successors(state, action).map(|(s, p)| p * value[s]).sum::<f64>()
                })
                .collect();
            let total: f64 = q.iter().map(|q| q.exp()).sum();
            let choices = if mdp.is_terminal(state) { n_actions as f64 } else { 1.0 };
            next[state] = (total / choices).ln();
            for (action, q) in q.iter().enumerate() {
                let p = q.exp() / total;
                for j in 0..k {
                    let ahead: f64 = mdp.successors(state, action).map(|(s, p)| p * counts[s * k + j]).sum();
                    next_counts[state * k + j] += p * (mdp.features(state, action)[j] + discount * ahead);
                }
            }
        }
        (value, counts) = (next, next_counts);
    }
    (0..k).map(|j| (0..n).map(|state| mdp.initial()[state] * counts[state * k + j]).sum()).collect()
}

#[test]
fn maximum_entropy_says_when_nothing_matches() {
    // More visits than there can be: weights would have to be infinite.
    let case = common::shape(1).case();
    let settings = MaxEntropySettings { max_iterations: 200, ..FREE };
    let found = max_entropy(&case.mdp, &[1e3, 0.0, 0.0], &settings).unwrap();
    assert_eq!(found.outcome, Convergence::NotConverged);
    assert!(found.slope > 1.0 && found.weights.iter().all(|w| w.is_finite()));
}

#[test]
fn maximum_entropy_of_unit_weights_is_the_most_probable_direction() {
    // Section F.3 on the world of figure 7.4.
    let mdp = corridor::world().mdp().unwrap();
    let mut steps = corridor::DEMONSTRATION.to_vec();
    steps.push((corridor::TERMINAL, UP));
    let expert = expert_feature_counts(&mdp, &[steps], 1.0).unwrap();
    let settings = MaxEntropySettings::dissertation(&mdp);
    let found = max_entropy(&mdp, &expert, &settings).unwrap();
    assert_eq!(found.outcome, Convergence::Converged, "{found:?}");
    close(found.weights.iter().map(|w| w * w).sum(), 1.0, 1e-12);
    // Nobody was seen on red.
    assert!(found.weights[1] < found.weights[0]);
    // No other direction makes the demonstration more probable: the likelihood is ln P = θᵀμ_E − V.
    let beta = settings.rationality;
    let likelihood = |angle: f64| {
        let theta = [beta * angle.cos(), beta * angle.sin()];
        let h = 1e-6;
        // d/dθ of V are the counts, so that the slope along the circle tells.
        let counts = soft_counts(&mdp, &theta, settings.horizon);
        let tangent = [-theta[1], theta[0]];
        h * expert.iter().zip(&counts).zip(tangent).map(|((e, x), t)| (e - x) * t).sum::<f64>()
    };
    let angle = found.weights[1].atan2(found.weights[0]);
    assert!(likelihood(angle - 0.02) > 0.0 && likelihood(angle + 0.02) < 0.0);
}

#[test]
fn acting_at_random_teaches_nothing() {
    let case = common::shape(2).case();
    let random = feature_counts(&case.mdp, &Policy::uniform(&case.mdp)).unwrap();
    for norm in [WeightNorm::Free, WeightNorm::Unit] {
        let found = max_entropy(&case.mdp, &random, &MaxEntropySettings { norm, ..FREE }).unwrap();
        assert_eq!(found.outcome, Convergence::Converged);
        assert!(found.weights.iter().all(|w| w.abs() < 1e-6), "{found:?}");
    }
}

#[test]
fn an_apprentice_of_a_good_expert_is_no_worse_under_any_reward() {
    // The expert is optimal for positive weights: the margin of F.6 is at least 0, and F.18 can match it exactly.
    let mut rng = ChaCha8Rng::seed_from_u64(4);
    let mdp = GridWorld { gamma: 0.9, ..GridWorld::random(5, 5, 4, &mut rng) }.mdp().unwrap();
    let expert = optimal_policy(&mdp, &[0.1, 0.4, 0.3, 0.2]).unwrap();
    let positive = lpal(&mdp, &expert.feature_counts, Signs::Positive, &Settings::default()).unwrap();
    let unknown = lpal(&mdp, &expert.feature_counts, Signs::Unknown, &Settings::default()).unwrap();
    assert_eq!((positive.outcome, unknown.outcome), (Outcome::Optimal, Outcome::Optimal));
    assert!(positive.margin >= -1e-9);
    close(unknown.margin, 0.0, 1e-8);
    for (x, e) in unknown.feature_counts.iter().zip(&expert.feature_counts) {
        close(*x, *e, 1e-8);
    }
}

#[test]
fn optimal_policies_are_optimal() {
    let world = maze::world().mdp().unwrap();
    let best = optimal_policy(&world, &maze::WEIGHTS).unwrap();
    let value = |counts: &[f64]| maze::WEIGHTS.iter().zip(counts).map(|(w, x)| w * x).sum::<f64>();
    for action in [UP, DOWN, LEFT, RIGHT] {
        let other = Policy::Deterministic(vec![action; world.n_states()]);
        assert!(value(&best.feature_counts) >= value(&feature_counts(&world, &other).unwrap()) - 1e-12);
    }
    let path = rollout(&world, &best.policy, maze::STARTS[0], 100, &mut ChaCha8Rng::seed_from_u64(1)).unwrap();
    assert_eq!(path[path.len() - 1].0, maze::TERMINAL);
}

#[test]
fn hill_climbing_lowers_the_value_at_risk_but_not_below_the_optimum_of_the_tail() {
    let case = common::shape(3).case();
    let problem = Problem::new(&case.mdp, &case.draws, None, Objective::Loss, 2).unwrap();
    let start = optimal_policy(&case.mdp, problem.mean_weights()).unwrap();
    let climbed = climb_value_at_risk(&case.mdp, &problem, &start.policy, 0.9, 1000).unwrap();
    let before = problem.risk(&start.policy, 0.9, 0.0).unwrap();
    let after = problem.risk(&climbed.policy, 0.9, 0.0).unwrap();
    assert!(climbed.n_changes > 0 && after.value_at_risk > before.value_at_risk);
    close(-climbed.objective, after.value_at_risk, 1e-12);
    let best = problem.solve(0.9, 0.0, &Settings::default()).unwrap();
    assert!(best.conditional_value_at_risk >= after.conditional_value_at_risk - 1e-9);
}
