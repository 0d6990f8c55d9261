//! Claims about given policies: evaluation, trajectories, finite horizons, projection, hill climbing.
#![allow(clippy::unwrap_used)]

use mdp::worlds::garnet::Garnet;
use mdp::worlds::{GridWorld, chapter4, maze};
use mdp::{
    Mdp, Policy, Solver, feature_counts, finite_feature_counts, finite_optimum, finite_values, improve_policy,
    occupancy, policy_losses, projection, random, rollout, successor_features, values,
};
use proptest::prelude::{prop_assert, prop_assert_eq, proptest};
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;

fn rng(seed: u64) -> ChaCha8Rng {
    ChaCha8Rng::seed_from_u64(seed)
}

fn garnet(n_states: usize, terminal: f64, seed: u64) -> Mdp {
    let shape = Garnet {
        n_states,
        n_actions: 3,
        n_features: 4,
        branching: 4,
        gamma: 0.9,
        terminal,
        by_action: seed.is_multiple_of(2),
    };
    shape.random(&mut rng(seed)).unwrap()
}

fn random_actions(mdp: &Mdp, rng: &mut ChaCha8Rng) -> Vec<usize> {
    (0..mdp.n_states()).map(|_| random::index(mdp.n_actions(), rng)).collect()
}

fn random_mixture(mdp: &Mdp, rng: &mut ChaCha8Rng) -> Policy {
    let mut p: Vec<f64> = (0..mdp.n_states() * mdp.n_actions()).map(|_| random::exponential(rng)).collect();
    for row in p.chunks_mut(mdp.n_actions()) {
        row[0] = if random::uniform(rng) < 0.3 { 0.0 } else { row[0] };
        let total: f64 = row.iter().sum();
        row.iter_mut().for_each(|x| *x /= total);
    }
    Policy::Stochastic(p)
}

fn dot(x: &[f64], y: &[f64]) -> f64 {
    x.iter().zip(y).map(|(x, y)| x * y).sum()
}

proptest! {
    #[test]
    fn evaluations_agree(n in 1_usize..40, seed: u64) {
        let mdp = garnet(n, 0.2, seed);
        let mut rng = rng(seed ^ 1);
        let w = random::l1_sphere(4, &mut rng);
        for policy in [random_mixture(&mdp, &mut rng), Policy::Deterministic(random_actions(&mdp, &mut rng))] {
            let psi = successor_features(&mdp, &policy).unwrap();
            let counts = feature_counts(&mdp, &policy).unwrap();
            for (s, value) in values(&mdp, &policy, &w).unwrap().iter().enumerate() {
                prop_assert!((value - dot(&psi[s * 4..][..4], &w)).abs() < 1e-12);
                // Ψ = φ + γ P Ψ.
                for j in 0..4 {
                    let mut right = 0.0;
                    for a in 0..3 {
                        let next: f64 = mdp.successors(s, a).map(|(t, p)| p * psi[t * 4 + j]).sum();
                        right += policy.probability(3, s, a) * (mdp.features(s, a)[j] + 0.9 * next);
                    }
                    prop_assert!((psi[s * 4 + j] - right).abs() < 1e-12);
                }
            }
            for j in 0..4 {
                let mean: f64 = mdp.initial().iter().zip(psi.chunks(4)).map(|(p, psi)| p * psi[j]).sum();
                prop_assert!((counts[j] - mean).abs() < 1e-12);
            }
            let visits: f64 = occupancy(&mdp, &policy).unwrap().iter().sum();
            let ends = (0..n).any(|s| mdp.is_terminal(s));
            prop_assert!(visits < 10.0 + 1e-11 && (ends || visits > 10.0 - 1e-11));
        }
    }

    #[test]
    fn policies_survive_their_file(seed: u64) {
        let mdp = garnet(7, 0.1, seed);
        let mut rng = rng(seed ^ 1);
        for policy in [random_mixture(&mdp, &mut rng), Policy::Deterministic(random_actions(&mdp, &mut rng))] {
            prop_assert_eq!(&Policy::from_json(policy.to_json(3).as_bytes(), &mdp).unwrap(), &policy);
        }
    }

    #[test]
    fn a_far_horizon_is_an_infinite_one(seed: u64) {
        let mdp = garnet(15, 0.1, seed);
        let w = random::l1_sphere(4, &mut rng(seed ^ 1));
        let mut solver = Solver::new(&mdp);
        let optimum = solver.solve(&w);
        // 0.9^400 is below 1e-18.
        let far = finite_optimum(&mdp, &w, 400, 0.9).unwrap();
        let policy = Policy::Deterministic(optimum.policy().to_vec());
        let finite = finite_values(&mdp, &policy, &w, 400, 0.9).unwrap();
        for (s, value) in finite.iter().enumerate() {
            prop_assert!((far.state_value(0, s) - optimum.state_value(s)).abs() < 1e-12);
            prop_assert!((value - optimum.state_value(s)).abs() < 1e-11);
        }
        for (x, y) in finite_feature_counts(&mdp, &policy, 400, 0.9).unwrap().iter().zip(optimum.feature_counts()) {
            prop_assert!((x - y).abs() < 1e-11);
        }
    }

    #[test]
    fn backward_induction_beats_every_fixed_policy(seed: u64, horizon in 1_usize..12, discount in 0.5..=1.0_f64) {
        let mdp = garnet(8, 0.1, seed);
        let mut rng = rng(seed ^ 1);
        let w = random::l1_sphere(4, &mut rng);
        let best = finite_optimum(&mdp, &w, horizon, discount).unwrap();
        prop_assert_eq!(best.horizon(), horizon);
        let value: f64 = mdp.initial().iter().enumerate().map(|(s, p)| p * best.state_value(0, s)).sum();
        prop_assert!((dot(best.feature_counts(), &w) - value).abs() < 1e-10);
        for _ in 0..10 {
            let policy = random_mixture(&mdp, &mut rng);
            let values = finite_values(&mdp, &policy, &w, horizon, discount).unwrap();
            prop_assert!((0..8).all(|s| values[s] <= best.state_value(0, s) + 1e-12));
            let counts = finite_feature_counts(&mdp, &policy, horizon, discount).unwrap();
            prop_assert!((dot(&counts, &w) - dot(mdp.initial(), &values)).abs() < 1e-12);
        }
        // One step before the end only the last reward counts.
        for s in 0..8 {
            let last = (0..3).map(|a| dot(mdp.features(s, a), &w)).fold(f64::NEG_INFINITY, f64::max);
            prop_assert!((best.state_value(horizon - 1, s) - last).abs() < 1e-14);
        }
    }
}

#[test]
fn an_undiscounted_walk_counts_its_cells() {
    // Five cells in a row, a step to the right each time: with T = 3 each start sees its own and the next two.
    let cells: Vec<usize> = (0..5).collect();
    let mdp = GridWorld { starts: vec![1], terminals: vec![4], ..GridWorld::one_hot(1, 5, &cells, 5) }.mdp().unwrap();
    let right = Policy::Deterministic(vec![3; 5]);
    assert_eq!(finite_feature_counts(&mdp, &right, 3, 1.0).unwrap(), [0.0, 1.0, 1.0, 1.0, 0.0]);
    // The terminal cell counts once, however long the horizon.
    assert_eq!(finite_feature_counts(&mdp, &right, 50, 1.0).unwrap(), [0.0, 1.0, 1.0, 1.0, 1.0]);
    assert_eq!(feature_counts(&mdp, &right).unwrap()[4], 0.9 * 0.9 * 0.9);
}

#[test]
fn mean_returns_of_trajectories_are_feature_counts() {
    let mdp = garnet(12, 0.1, 4);
    let mut rng = rng(5);
    let policy = random_mixture(&mdp, &mut rng);
    let counts = feature_counts(&mdp, &policy).unwrap();
    let n = 40_000;
    let mut mean = [0.0; 4];
    let mut square = [0.0; 4];
    for _ in 0..n {
        let start = random::categorical(mdp.initial().iter().copied(), 1.0, &mut rng);
        let pairs = rollout(&mdp, &policy, start, 250, &mut rng).unwrap();
        assert!(pairs.len() == 250 || mdp.is_terminal(pairs[pairs.len() - 1].0));
        let mut sum = [0.0; 4];
        let mut discount = 1.0;
        for (s, a) in pairs {
            for (sum, phi) in sum.iter_mut().zip(mdp.features(s, a)) {
                *sum += discount * phi;
            }
            discount *= 0.9;
        }
        for j in 0..4 {
            mean[j] += sum[j] / f64::from(n);
            square[j] += sum[j] * sum[j] / f64::from(n);
        }
    }
    for j in 0..4 {
        let error = ((square[j] - mean[j] * mean[j]) / f64::from(n)).sqrt();
        assert!((mean[j] - counts[j]).abs() < 4.0 * error, "{} {} {error}", mean[j], counts[j]);
    }
}

#[test]
fn losses_are_those_of_single_solutions_and_do_not_depend_on_threads() {
    let mut rng = rng(6);
    let mdp = chapter4::random(&mut rng).mdp().unwrap();
    let policy = Policy::Deterministic(random_actions(&mdp, &mut rng));
    let counts = feature_counts(&mdp, &policy).unwrap();
    let draws: Vec<f64> = (0..700).flat_map(|_| random::l1_sphere(8, &mut rng)).collect();
    let losses = policy_losses(&mdp, &counts, &draws, 1).unwrap();
    for threads in [2, 3, 16] {
        assert_eq!(policy_losses(&mdp, &counts, &draws, threads).unwrap(), losses);
    }
    for (loss, w) in losses.iter().zip(draws.chunks(8)).step_by(50) {
        let exact = Solver::new(&mdp).solve(w).value() - dot(w, &counts);
        assert!((loss - exact).abs() < 1e-11 && *loss >= -1e-11);
    }
}

#[test]
fn projection_reaches_an_expert_who_is_optimal() {
    for seed in 0..10 {
        let mut rng = rng(seed);
        let mdp = chapter4::random(&mut rng).mdp().unwrap();
        let w = random::l1_sphere(8, &mut rng);
        let expert = Solver::new(&mdp).solve(&w).feature_counts().to_vec();
        let start = Policy::Deterministic(random_actions(&mdp, &mut rng));
        let found = projection(&mdp, &expert, &start, 0.02, 5000).unwrap();
        assert!(found.distance <= 0.02, "distance {}", found.distance);
        assert!((found.mixture.iter().sum::<f64>() - 1.0).abs() < 1e-12);
        let mut mean = [0.0; 8];
        for (share, counts) in found.mixture.iter().zip(&found.feature_counts) {
            mean.iter_mut().zip(counts).for_each(|(mean, x)| *mean += share * x);
        }
        let mixed = feature_counts(&mdp, &found.mixed_policy(&mdp).unwrap()).unwrap();
        for (x, y) in mean.iter().zip(&mixed) {
            assert!((x - y).abs() < 1e-10);
        }
        // Hölder: the loss of the mixture is at most ‖w‖₁ times the distance.
        assert!(dot(&expert, &w) - dot(&mixed, &w) <= found.distance + 1e-10);
        let nearest = found.closest(&expert);
        let gap = |i: usize| found.feature_counts[i].iter().zip(&expert).map(|(x, y)| (x - y) * (x - y)).sum::<f64>();
        assert!((0..found.policies.len()).all(|i| gap(nearest) <= gap(i)));
    }
}

#[test]
fn projection_stops_at_the_nearest_mixture_of_counts_out_of_reach() {
    let mut rng = rng(12);
    let mdp = chapter4::random(&mut rng).mdp().unwrap();
    let expert = vec![3.0; 8];
    let found = projection(&mdp, &expert, &Policy::uniform(&mdp), 1e-9, 3000).unwrap();
    // Nearest: no policy goes further towards the expert than the mixture does.
    let mean: Vec<f64> = expert.iter().zip(&found.weights).map(|(x, w)| x - w).collect();
    let furthest = Solver::new(&mdp).solve(&found.weights).value();
    assert!(furthest - dot(&mean, &found.weights) < 1e-2, "{furthest}");
}

#[test]
fn hill_climbing_ends_where_no_single_change_helps() {
    for seed in 0..6 {
        let mdp = garnet(10, 0.1, seed);
        let mut rng = rng(seed + 100);
        let draws: Vec<Vec<f64>> = (0..40).map(|_| random::l1_sphere(4, &mut rng)).collect();
        // The second largest of 40 losses against nothing: a quantile, neither smooth nor convex.
        let objective = |counts: &[f64]| {
            let mut losses: Vec<f64> = draws.iter().map(|w| -dot(w, counts)).collect();
            losses.sort_unstable_by(f64::total_cmp);
            losses[38]
        };
        for start in [Policy::Deterministic(random_actions(&mdp, &mut rng)), random_mixture(&mdp, &mut rng)] {
            let before = objective(&feature_counts(&mdp, &start).unwrap());
            let found = improve_policy(&mdp, &start, 1000, objective).unwrap();
            assert!(found.objective <= before);
            assert_eq!(found.feature_counts, feature_counts(&mdp, &found.policy).unwrap());
            for s in 0..10 {
                for a in 0..3 {
                    let mut p: Vec<f64> = (0..30).map(|i| found.policy.probability(3, i / 3, i % 3)).collect();
                    p[s * 3..][..3].fill(0.0);
                    p[s * 3 + a] = 1.0;
                    let value = objective(&feature_counts(&mdp, &Policy::Stochastic(p)).unwrap());
                    assert!(value >= found.objective - 1e-11, "state {s}, action {a}");
                }
            }
        }
    }
}

#[test]
fn hill_climbing_on_one_reward_is_policy_iteration() {
    // Where every state is a start, each better action shows in the mean value: only the optimum is left.
    let grid = GridWorld { starts: (0..25).collect(), ..maze::world() };
    let mdp = grid.mdp().unwrap();
    let start = Policy::Deterministic(vec![0; 25]);
    let found = improve_policy(&mdp, &start, 1000, |counts| -dot(counts, &maze::WEIGHTS)).unwrap();
    let optimum = Solver::new(&mdp).solve(&maze::WEIGHTS).value();
    assert!(found.n_changes > 5);
    assert!((found.objective + optimum).abs() < 1e-12, "{} {optimum}", -found.objective);
}

#[test]
fn losses_of_the_best_policy_are_exactly_zero_and_those_of_no_counts_the_value_itself() {
    let mdp = chapter4::rep_0().mdp().unwrap();
    // All rewards negative: V* is too.
    let w: Vec<f64> = [3.0, 1.0, 2.0, 1.0, 4.0, 1.0, 5.0, 2.0].iter().map(|w| -w / 19.0).collect();
    let mut solver = Solver::new(&mdp);
    let best = solver.solve(&w);
    let (value, counts) = (best.value(), best.feature_counts().to_vec());
    assert!(value < 0.0);
    assert_eq!(policy_losses(&mdp, &counts, &w, 1).unwrap(), [0.0]);
    let of_nothing = policy_losses(&mdp, &[0.0; 8], &w, 1).unwrap();
    assert!((of_nothing[0] - value).abs() < 1e-12, "{of_nothing:?} vs {value}");
}
