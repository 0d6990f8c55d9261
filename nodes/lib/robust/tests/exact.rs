//! Answers that are known without a solver.
#![allow(clippy::unwrap_used)]

mod common;

use common::{Numbers, Shape, close};
use mdp::worlds::machine_replacement::{REPAIR, WAIT, draws, world};
use mdp::{Features, Mdp, MdpParts, Policy, feature_counts, occupancy};
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;
use robust::{MethodChoice, Objective, Outcome, Problem, Settings, SolverStatus};

const METHODS: [MethodChoice; 3] = [MethodChoice::Automatic, MethodChoice::Direct, MethodChoice::ColumnGeneration];

fn with(method: MethodChoice) -> Settings {
    Settings { method, ..Settings::default() }
}

#[test]
fn machines_are_repaired_as_risk_demands() {
    // Method notes section 7, figure 7.3 a. Of 2000 draws, these seeds' agree with it; see the next test.
    let mdp = world(4).unwrap();
    for seed in [2, 4, 6] {
        let draws = draws(2000, &mut ChaCha8Rng::seed_from_u64(seed));
        let problem = Problem::new(&mdp, &draws, None, Objective::Robust, 1).unwrap();
        for method in METHODS {
            let settings = with(method);
            let neutral = problem.solve(0.99, 1.0, &settings).unwrap();
            let averse = problem.solve(0.99, 0.0, &settings).unwrap();
            for age in 0..4 {
                let repairs = |policy: &Policy| policy.probability(2, age, REPAIR);
                assert_eq!(neutral.policy.probability(2, age, WAIT), 1.0, "{neutral:?}");
                match age {
                    0 => assert!(repairs(&averse.policy) < 1e-6),
                    3 => assert!(repairs(&averse.policy) > 1.0 - 1e-6),
                    _ => assert!((0.05..0.95).contains(&repairs(&averse.policy)), "{averse:?}"),
                }
            }
            // E = −u · mean cost.
            let mean_costs = problem.mean_weights();
            let costs: f64 = neutral.occupancy.chunks(2).zip(mean_costs).map(|(u, cost)| u[WAIT] * cost).sum();
            close(neutral.expected_return, costs, 1e-9 * neutral.unit);
            assert!(averse.conditional_value_at_risk > neutral.conditional_value_at_risk + 0.2 * neutral.unit);
            for solution in [neutral, averse] {
                assert_eq!(solution.outcome, Outcome::Optimal);
                assert!(solution.gap() < 1e-8 * solution.unit && solution.unvisited.is_empty());
            }
        }
    }
}

#[test]
fn with_many_draws_the_oldest_machine_is_repaired_nearly_always() {
    let mdp = world(4).unwrap();
    for seed in [1, 2] {
        let draws = draws(100_000, &mut ChaCha8Rng::seed_from_u64(seed));
        let problem = Problem::new(&mdp, &draws, None, Objective::Robust, 1).unwrap();
        let solution = problem.solve(0.99, 0.0, &Settings::default()).unwrap();
        assert_eq!(solution.outcome, Outcome::Optimal);
        for (age, often) in [0.0, 0.6, 0.7, 0.95].into_iter().enumerate() {
            close(solution.policy.probability(2, age, REPAIR), often, 0.05);
        }
        close(solution.conditional_value_at_risk, -1663.0, 20.0);
    }
}

#[test]
fn the_tail_of_equal_draws_is_their_worst_share() {
    // Method notes section 7: N = 2000, α = .99 is the mean of the worst 20; N = 300, α = .95 of the worst 15. One state, one
    // action, γ = ½: the return is twice the weight.
    let mdp = bandit(1, 0.5);
    for (n, alpha, worst) in [(2000_usize, 0.99, 20_usize), (300, 0.95, 15)] {
        let mut numbers = Numbers(n as u64);
        let mut draws: Vec<f64> = (0..n).map(|_| numbers.signed()).collect();
        let problem = Problem::new(&mdp, &draws, None, Objective::Robust, 1).unwrap();
        draws.sort_unstable_by(f64::total_cmp);
        let tail = 2.0 * draws[..worst].iter().sum::<f64>() / worst as f64;
        for method in METHODS {
            let solution = problem.solve(alpha, 0.0, &with(method)).unwrap();
            close(solution.conditional_value_at_risk, tail, 1e-12);
            close(solution.value_at_risk, 2.0 * draws[worst], 1e-12);
            close(solution.objective, tail, 1e-12);
        }
    }
}

#[test]
fn two_arms_are_mixed_as_exhaustive_search_says() {
    // Feature j is arm j: ψ_i(x) = 2 (x w_i0 + (1 − x) w_i1). The objective is piecewise linear in x with its corners where two
    // draws are equal.
    let mdp = bandit(2, 0.5);
    for seed in 0..20 {
        let mut numbers = Numbers(seed);
        let n = 12;
        let draws: Vec<f64> = (0..2 * n).map(|_| numbers.signed()).collect();
        let weights = numbers.distribution(n);
        let problem = Problem::new(&mdp, &draws, Some(&weights), Objective::Robust, 1).unwrap();
        for (alpha, lambda) in [(0.0, 0.0), (0.5, 0.0), (0.8, 0.25), (0.9, 0.9), (0.99, 0.0)] {
            let mut corners = vec![0.0, 1.0];
            for (i, x) in draws.chunks(2).enumerate() {
                for y in draws.chunks(2).skip(i + 1) {
                    corners.push((y[1] - x[1]) / (x[0] - x[1] - y[0] + y[1]));
                }
            }
            let mut best = f64::NEG_INFINITY;
            for x in corners.into_iter().filter(|x| (0.0..=1.0).contains(x)) {
                let mut values: Vec<(f64, f64)> =
                    draws.chunks(2).map(|w| 2.0 * (x * w[0] + (1.0 - x) * w[1])).zip(weights.iter().copied()).collect();
                values.sort_unstable_by(|a, b| a.0.total_cmp(&b.0));
                let mean: f64 = values.iter().map(|(value, mass)| mass * value).sum();
                let (mut left, mut tail) = (1.0 - alpha, 0.0);
                for (value, mass) in values {
                    let taken = mass.min(left);
                    tail += taken * value / (1.0 - alpha);
                    left -= taken;
                }
                best = f64::max(best, (1.0 - lambda) * tail + lambda * mean);
            }
            for method in METHODS {
                let solution = problem.solve(alpha, lambda, &with(method)).unwrap();
                assert_eq!(solution.outcome, Outcome::Optimal, "{solution:?}");
                close(solution.objective, best, 1e-8);
            }
        }
    }
}

#[test]
fn no_mixture_of_all_policies_does_better() {
    for seed in 10..16 {
        let shape = Shape {
            seed,
            n_states: 4,
            n_actions: 2,
            n_features: 2,
            n_draws: 30,
            gamma: 0.9,
            by_action: seed % 2 == 0,
            terminal_every: if seed % 3 == 0 { 4 } else { 0 },
            spread: 1.5,
        };
        let case = shape.case();
        let problem = Problem::new(&case.mdp, &case.draws, Some(&case.weights), Objective::Robust, 1).unwrap();
        let all: Vec<Vec<f64>> = (0..16_usize)
            .map(|code| Policy::Deterministic((0..4).map(|state| code >> state & 1).collect()))
            .map(|policy| feature_counts(&case.mdp, &policy).unwrap())
            .collect();
        let solution = problem.solve(0.8, 0.2, &Settings::default()).unwrap();
        let mut numbers = Numbers(seed);
        let mut best = f64::NEG_INFINITY;
        for round in 0..5000 {
            // Up to three policies at a time: with two features no more are ever needed.
            let mut shares = vec![0.0; all.len()];
            for share in numbers.distribution(1 + round % 3) {
                shares[(numbers.uniform() * 16.0) as usize] += share;
            }
            let counts: Vec<f64> =
                (0..2).map(|j| all.iter().zip(&shares).map(|(counts, share)| share * counts[j]).sum()).collect();
            best = best.max(problem.risk_of(&counts, 0.8, 0.2).unwrap().objective);
        }
        assert!(best <= solution.upper_bound + 1e-12, "{best} beats {solution:?}");
        assert!(solution.objective - best < 0.05 * solution.unit, "{best} is all that search finds: {solution:?}");
        assert_eq!(solution.outcome, Outcome::Optimal);
    }
}

#[test]
fn without_risk_the_best_policy_for_the_mean_reward_comes_out() {
    let case = common::shape(3).case();
    let problem = Problem::new(&case.mdp, &case.draws, None, Objective::Robust, 1).unwrap();
    let best = robust::optimal_policy(&case.mdp, problem.mean_weights()).unwrap();
    for (alpha, lambda) in [(0.0, 0.0), (0.0, 0.7), (0.95, 1.0)] {
        let solution = problem.solve(alpha, lambda, &Settings::default()).unwrap();
        assert_eq!((solution.outcome, solution.status), (Outcome::Optimal, SolverStatus::NotNeeded));
        let Policy::Deterministic(actions) = &best.policy else { panic!("a deterministic policy") };
        for (state, &action) in actions.iter().enumerate() {
            assert_eq!(solution.policy.probability(3, state, action), 1.0);
        }
    }
}

#[test]
fn policy_and_visits_are_one() {
    let case = common::shape(4).case();
    let problem = Problem::new(&case.mdp, &case.draws, None, Objective::Robust, 1).unwrap();
    for method in METHODS {
        let solution = problem.solve(0.9, 0.3, &with(method)).unwrap();
        solution.policy.check(&case.mdp).unwrap();
        for (u, exact) in solution.occupancy.iter().zip(occupancy(&case.mdp, &solution.policy).unwrap()) {
            close(*u, exact, 1e-9);
        }
        let counts = feature_counts(&case.mdp, &solution.policy).unwrap();
        let risk = problem.risk(&solution.policy, 0.9, 0.3).unwrap();
        close(risk.objective, solution.objective, 1e-9 * solution.unit);
        close(risk.value_at_risk, solution.value_at_risk, 1e-9 * solution.unit);
        for (x, y) in solution.feature_counts.iter().zip(&counts) {
            close(*x, *y, 1e-9 * solution.unit);
        }
    }
}

#[test]
fn states_that_are_never_visited_have_a_policy_too() {
    // State 0 → 1 or 2, which stay where they are; 3 → 3 is out of reach. Action 1 is best for the mean reward everywhere.
    let transitions = vec![
        (0, 0, 1, 1.0),
        (0, 1, 2, 1.0),
        (1, 0, 1, 1.0),
        (1, 1, 1, 1.0),
        (2, 0, 2, 1.0),
        (2, 1, 2, 1.0),
        (3, 0, 3, 1.0),
        (3, 1, 3, 1.0),
    ];
    let features = vec![0.0, 0.0, -1.0, -0.9, 0.0, 1.0, 0.0, 0.5];
    let mdp = Mdp::new(MdpParts {
        gamma: 0.9,
        n_states: 4,
        n_actions: 2,
        n_features: 1,
        initial: vec![1.0, 0.0, 0.0, 0.0],
        transitions,
        features: Features::StateAction(features),
        actions: vec![],
        shape: None,
    })
    .unwrap();
    let problem = Problem::new(&mdp, &[1.0, 0.8, 1.2], None, Objective::Robust, 1).unwrap();
    for method in METHODS {
        let solution = problem.solve(0.5, 0.0, &with(method)).unwrap();
        assert_eq!(solution.unvisited, [1, 3]);
        assert_eq!(solution.policy.probability(2, 0, 1), 1.0, "{solution:?}");
        assert_eq!(solution.policy.probability(2, 1, 1), 1.0);
        assert_eq!(solution.policy.probability(2, 3, 1), 1.0);
        solution.policy.check(&mdp).unwrap();
    }
}

#[test]
fn equal_and_weightless_draws_change_nothing() {
    let case = common::shape(1).case();
    let k = case.mdp.n_features();
    let once = Problem::new(&case.mdp, &case.draws, None, Objective::Robust, 1).unwrap();
    let mut doubled = case.draws.clone();
    doubled.extend_from_slice(&case.draws);
    let twice = Problem::new(&case.mdp, &doubled, None, Objective::Robust, 1).unwrap();
    let n = case.draws.len() / k;
    let mut weights = vec![1.0 / n as f64; n];
    weights.extend(vec![0.0; n]);
    doubled[n * k..].iter_mut().for_each(|w| *w = -9.0);
    let weighted = Problem::new(&case.mdp, &doubled, Some(&weights), Objective::Robust, 1).unwrap();
    assert_eq!((once.n_draws(), twice.n_draws(), weighted.n_draws()), (n, n, n));
    let settings = Settings::default();
    let solution = once.solve(0.9, 0.1, &settings).unwrap();
    for other in [twice, weighted] {
        let other = other.solve(0.9, 0.1, &settings).unwrap();
        close(other.objective, solution.objective, 1e-12);
        assert_eq!(other.policy, solution.policy);
    }
}

/// One state with `n` arms, each with a feature of its own.
fn bandit(n: usize, gamma: f64) -> Mdp {
    let mut features = vec![0.0; n * n];
    (0..n).for_each(|arm| features[arm * n + arm] = 1.0);
    Mdp::new(MdpParts {
        gamma,
        n_states: 1,
        n_actions: n,
        n_features: n,
        initial: vec![1.0],
        transitions: (0..n).map(|arm| (0, arm, 0, 1.0)).collect(),
        features: Features::StateAction(features),
        actions: vec![],
        shape: None,
    })
    .unwrap()
}
