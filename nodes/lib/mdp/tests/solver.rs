//! Claims about exact optimal control.
#![allow(clippy::unwrap_used)]

use mdp::worlds::garnet::Garnet;
use mdp::worlds::{GridWorld, chapter4, chapter6};
use mdp::{Mdp, Optimum, Policy, Solver, feature_counts, random, successor_features, values};
use proptest::prelude::{prop_assert, prop_assert_eq, proptest};
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;

fn rng(seed: u64) -> ChaCha8Rng {
    ChaCha8Rng::seed_from_u64(seed)
}

fn garnet(n_states: usize, gamma: f64, by_action: bool, seed: u64) -> Mdp {
    let shape = Garnet { n_states, n_actions: 3, n_features: 4, branching: 3, gamma, terminal: 0.1, by_action };
    shape.random(&mut rng(seed)).unwrap()
}

/// Largest possible value under weights of L1 norm 1 and features of at most 1.
fn scale(mdp: &Mdp) -> f64 {
    1.0 / (1.0 - mdp.gamma())
}

/// V(s) ≥ Q(s, a) and V(s) = Q(s, π(s)), Q recomputed from V; everything within `tolerance`.
fn check_optimal(mdp: &Mdp, w: &[f64], optimum: &Optimum<'_>, tolerance: f64) {
    for s in 0..mdp.n_states() {
        for a in 0..mdp.n_actions() {
            let reward: f64 = mdp.features(s, a).iter().zip(w).map(|(phi, w)| phi * w).sum();
            let next: f64 = mdp.successors(s, a).map(|(t, p)| p * optimum.state_value(t)).sum();
            let q = reward + mdp.gamma() * next;
            assert!((q - optimum.q(s, a)).abs() <= tolerance, "Q({s}, {a})");
            assert!(q <= optimum.state_value(s) + tolerance, "action {a} is better in state {s}");
            if a == optimum.policy()[s] {
                assert!((q - optimum.state_value(s)).abs() <= tolerance, "the policy in state {s}");
            }
        }
    }
}

/// What the solver says about its policy is what an evaluation of that policy says.
fn check_consistent(mdp: &Mdp, w: &[f64], optimum: &Optimum<'_>, tolerance: f64) {
    let policy = Policy::Deterministic(optimum.policy().to_vec());
    for (s, value) in values(mdp, &policy, w).unwrap().into_iter().enumerate() {
        assert!((value - optimum.state_value(s)).abs() <= tolerance);
    }
    for (x, y) in feature_counts(mdp, &policy).unwrap().iter().zip(optimum.feature_counts()) {
        assert!((x - y).abs() <= tolerance);
    }
    let value: f64 = optimum.feature_counts().iter().zip(w).map(|(phi, w)| phi * w).sum();
    assert!((value - optimum.value()).abs() <= tolerance);
    let psi = successor_features(mdp, &policy).unwrap();
    let k = mdp.n_features();
    let mut out = vec![0.0; k];
    let mut sum = vec![0.0; k];
    let mut expected = vec![0.0; k];
    let pairs: Vec<(usize, usize, f64)> =
        (0..7).map(|i| (i * 5 % mdp.n_states(), i % mdp.n_actions(), i as f64 - 2.5)).collect();
    optimum.add_gradient(&pairs, &mut sum);
    for &(s, a, c) in &pairs {
        optimum.action_features(s, a, &mut out);
        for j in 0..k {
            let next: f64 = mdp.successors(s, a).map(|(t, p)| p * psi[t * k + j]).sum();
            assert!((out[j] - mdp.features(s, a)[j] - mdp.gamma() * next).abs() <= tolerance);
            expected[j] += c * out[j];
        }
    }
    for (x, y) in sum.iter().zip(&expected) {
        assert!((x - y).abs() <= 20.0 * tolerance);
    }
}

proptest! {
    #[test]
    fn optimal_and_consistent(n in 2_usize..40, gamma in 0.0..0.99_f64, by_action: bool, seed: u64) {
        let mdp = garnet(n, gamma, by_action, seed);
        let mut solver = Solver::new(&mdp);
        let mut rng = rng(seed ^ 1);
        for _ in 0..5 {
            let w = random::l1_sphere(4, &mut rng);
            let tolerance = 1e-11 * scale(&mdp);
            let optimum = solver.solve(&w);
            check_optimal(&mdp, &w, optimum, tolerance);
            check_consistent(&mdp, &w, optimum, tolerance);
            prop_assert!(optimum.error_bound() <= 1e-11 * scale(&mdp));
        }
    }

    #[test]
    fn no_policy_is_better(seed: u64, by_action: bool) {
        // All 3^4 policies of four states.
        let mdp = garnet(4, 0.9, by_action, seed);
        let w = random::l1_sphere(4, &mut rng(seed ^ 1));
        let mut solver = Solver::new(&mdp);
        let optimum = solver.solve(&w);
        let mut best = f64::NEG_INFINITY;
        for code in 0..81_usize {
            let policy = (0..4).map(|s| code / 3_usize.pow(s) % 3).collect();
            let counts = feature_counts(&mdp, &Policy::Deterministic(policy)).unwrap();
            best = best.max(counts.iter().zip(&w).map(|(phi, w)| phi * w).sum());
        }
        prop_assert!((best - optimum.value()).abs() < 1e-12);
    }

    #[test]
    fn values_are_homogeneous(seed: u64, factor in 1e-6..1e6_f64) {
        let mdp = garnet(20, 0.9, false, seed);
        let w = random::l1_sphere(4, &mut rng(seed ^ 1));
        let scaled: Vec<f64> = w.iter().map(|w| factor * w).collect();
        let (mut a, mut b) = (Solver::new(&mdp), Solver::new(&mdp));
        let (a, b) = (a.solve(&w), b.solve(&scaled));
        prop_assert_eq!(a.policy(), b.policy());
        for s in 0..20 {
            prop_assert!((factor * a.state_value(s) - b.state_value(s)).abs() <= 1e-12 * factor * scale(&mdp));
        }
    }
}

/// Solves a long walk of weights with one solver and compares each answer with that of a new one.
fn check_memoryless(mdp: &Mdp, steps: &[f64], n: usize, seed: u64) {
    let k = mdp.n_features();
    let mut rng = rng(seed);
    let mut w = random::l1_sphere(k, &mut rng);
    let mut solver = Solver::new(mdp);
    let tolerance = 1e-12 * scale(mdp);
    for i in 0..n {
        let step = steps[i % steps.len()];
        w.iter_mut().for_each(|w| *w += step * (2.0 * random::uniform(&mut rng) - 1.0));
        let norm: f64 = w.iter().map(|w| w.abs()).sum();
        w.iter_mut().for_each(|w| *w /= norm);
        let mut fresh = Solver::new(mdp);
        let (old, new) = (solver.solve(&w), fresh.solve(&w));
        assert_eq!(old.policy(), new.policy(), "step {i}");
        for s in 0..mdp.n_states() {
            assert!((old.state_value(s) - new.state_value(s)).abs() <= tolerance, "step {i}, state {s}");
        }
        for (x, y) in old.feature_counts().iter().zip(new.feature_counts()) {
            assert!((x - y).abs() <= tolerance, "step {i}: {x} {y}");
        }
    }
}

#[test]
fn answers_do_not_depend_on_what_was_asked_before() {
    let steps = [0.0, 0.001, 0.01, 0.01, 0.1, 0.5];
    check_memoryless(&chapter4::random(&mut rng(1)).mdp().unwrap(), &steps, 600, 2);
    // Deterministic moves: many policies tie at every weight.
    check_memoryless(&chapter6::random(&mut rng(3)).mdp().unwrap(), &steps, 600, 4);
    check_memoryless(&garnet(60, 0.99, true, 5), &steps, 300, 6);
    // Too wide for factors.
    check_memoryless(&garnet(900, 0.9, false, 7), &steps, 30, 8);
    check_memoryless(&GridWorld::random(100, 30, 5, &mut rng(9)).mdp().unwrap(), &steps, 6, 10);
}

#[test]
fn the_first_of_equal_actions_is_taken() {
    let mdp = chapter4::rep_0().mdp().unwrap();
    let mut solver = Solver::new(&mdp);
    solver.solve(&chapter4::REP_0_WEIGHTS);
    // Equal weights: every policy is optimal.
    for w in [[-0.125; 8], [0.0; 8], [1.0; 8]] {
        let optimum = solver.solve(&w);
        assert!(optimum.policy().iter().all(|&action| action == 0));
        let Policy::Stochastic(p) = optimum.indifferent_policy() else { panic!("a stochastic policy") };
        assert!(p.iter().all(|p| *p == 0.25));
        assert!((optimum.value() - 10.0 * w[0]).abs() < 1e-13);
    }
    // In a deterministic grid, ties are those of symmetric paths.
    let grid = GridWorld { features: vec![0.0; 9], ..GridWorld::one_hot(3, 3, &[0; 9], 1) };
    let mut features = grid.features.clone();
    features[8] = 1.0;
    let mdp = GridWorld { features, ..grid }.mdp().unwrap();
    let mut solver = Solver::new(&mdp);
    assert_eq!(solver.solve(&[1.0]).policy(), [1, 1, 1, 1, 1, 1, 3, 3, 1]);
    assert_eq!(solver.solve(&[-1.0]).policy()[..3], [0, 0, 0]);
}

#[test]
fn weights_that_are_not_finite_give_nan_and_do_no_harm() {
    let mdp = chapter4::rep_0().mdp().unwrap();
    let mut solver = Solver::new(&mdp);
    let mut w = chapter4::REP_0_WEIGHTS;
    let value = solver.solve(&w).value();
    for bad in [f64::NAN, f64::INFINITY, 1e308] {
        w[3] = bad;
        let optimum = solver.solve(&w);
        assert!(optimum.value().is_nan() && optimum.q(3, 2).is_nan() && optimum.state_value(0).is_nan());
    }
    assert_eq!(solver.solve(&chapter4::REP_0_WEIGHTS).value(), value);
}

#[test]
fn ten_thousand_states() {
    let mut rng = rng(11);
    let mdp = GridWorld { slip: 0.15, ..GridWorld::random(100, 100, 8, &mut rng) }.mdp().unwrap();
    let mut solver = Solver::new(&mdp);
    for _ in 0..3 {
        let w = random::l1_sphere(8, &mut rng);
        let optimum = solver.solve(&w);
        check_optimal(&mdp, &w, optimum, 1e-12 * scale(&mdp));
        check_consistent(&mdp, &w, optimum, 1e-12 * scale(&mdp));
    }
}

#[test]
fn a_long_horizon() {
    // γ = 1 − 10⁻⁵: a horizon of 10⁵ steps.
    for seed in 0..5 {
        let mdp = garnet(30, 0.999_99, false, seed);
        let w = random::l1_sphere(4, &mut rng(seed));
        let mut solver = Solver::new(&mdp);
        let optimum = solver.solve(&w);
        check_optimal(&mdp, &w, optimum, 1e-9);
    }
}

/// Values spread slowly through a large grid: the residual of the first rounds stands still far from the optimum.
#[test]
fn a_fresh_solver_reaches_the_optimum_of_a_large_grid_at_once() {
    for (seed, gamma) in [(1, 0.95), (2, 0.95), (3, 0.98)] {
        let mut rng = rng(seed);
        let mdp = GridWorld { gamma, ..GridWorld::random(100, 100, 8, &mut rng) }.mdp().unwrap();
        let w = random::l1_sphere(8, &mut rng);
        let mut solver = Solver::new(&mdp);
        let optimum = solver.solve(&w);
        let (first, error) = (optimum.value(), optimum.error_bound());
        assert!(error < 1e-9, "gamma {gamma}: {first} with an error of up to {error}");
        let second = solver.solve(&w).value();
        assert!((first - second).abs() < 1e-9, "gamma {gamma}: {first}, then {second}");
    }
}

#[test]
fn rough_answers_are_as_exact_as_they_say() {
    // Too wide for factors.
    let mdp = garnet(900, 0.95, true, 11);
    let mut rng = rng(12);
    let center = random::l1_sphere(4, &mut rng);
    let mut rough = Solver::new(&mdp);
    for i in 0..40 {
        let error = 10_f64.powi(-2 - i % 7);
        let w: Vec<f64> = center.iter().map(|w| w + 0.02 * random::normal(&mut rng)).collect();
        let mut exact = Solver::new(&mdp);
        let (rough, exact) = (rough.solve_within(&w, error), exact.solve(&w));
        assert!(rough.error_bound() <= error, "{} over {error}", rough.error_bound());
        let apart = |s: usize| (rough.state_value(s) - exact.state_value(s)).abs();
        assert!((0..mdp.n_states()).all(|s| apart(s) <= error), "query {i}");
        // The policy found is worth what it says, and little less than the best.
        let policy = Policy::Deterministic(rough.policy().to_vec());
        let counts = feature_counts(&mdp, &policy).unwrap();
        let worth: f64 = counts.iter().zip(&w).map(|(phi, w)| phi * w).sum();
        assert!(exact.value() - worth <= 2.0 * error, "query {i}: {worth} of {}", exact.value());
        for (x, y) in rough.feature_counts().iter().zip(&counts) {
            assert!((x - y).abs() <= 1e-11 * scale(&mdp), "query {i}: {x} {y}");
        }
    }
}
