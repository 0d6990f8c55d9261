//! Claims about the worlds of the dissertation.
#![allow(clippy::unwrap_used)]

use mdp::worlds::{GridWorld, chapter4, chapter6, corridor, driving, machine_replacement, maze, sparse};
use mdp::{Mdp, Policy, Solver, feature_counts, finite_feature_counts, policy_losses, random, rollout, values};
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;

fn rng(seed: u64) -> ChaCha8Rng {
    ChaCha8Rng::seed_from_u64(seed)
}

fn p(mdp: &Mdp, state: usize, action: usize, target: usize) -> f64 {
    mdp.successors(state, action).find(|(t, _)| *t == target).map_or(0.0, |(_, p)| p)
}

#[test]
fn moves_slip_aside_and_bump_into_edges() {
    let mdp = chapter4::rep_0().mdp().unwrap();
    // Up from the inside, from the top edge, from a corner.
    let close = |got: f64, want: f64| assert!((got - want).abs() < 1e-15, "{got} {want}");
    close(p(&mdp, 40, 0, 31), 0.7);
    close(p(&mdp, 40, 0, 39), 0.15);
    close(p(&mdp, 40, 0, 41), 0.15);
    close(p(&mdp, 4, 0, 4), 0.7);
    close(p(&mdp, 0, 0, 0), 0.85);
    close(p(&mdp, 0, 0, 1), 0.15);
    close(p(&mdp, 40, 2, 39), 0.7);
    close(p(&mdp, 40, 2, 31), 0.15);
    close(p(&mdp, 80, 1, 80), 0.85);
    assert_eq!((mdp.shape(), mdp.actions().len()), (Some([9, 9]), 4));
    for start in chapter4::STARTS {
        close(mdp.initial()[start], 1.0 / 9.0);
    }
}

#[test]
fn random_grids_repeat_by_seed_and_may_end() {
    assert_eq!(chapter4::random(&mut rng(3)), chapter4::random(&mut rng(3)));
    assert_ne!(chapter4::random(&mut rng(3)), chapter4::random(&mut rng(4)));
    let mdp = chapter6::random(&mut rng(5)).mdp().unwrap();
    assert_eq!((mdp.n_states(), mdp.n_features(), mdp.n_transitions()), (36, 4, 144));
    assert!((0..36).all(|s| mdp.features(s, 0).iter().sum::<f64>() == 1.0 && !mdp.is_terminal(s)));
    let grid = GridWorld { terminals: vec![2, 9], ..GridWorld::random(4, 4, 3, &mut rng(6)) };
    let mdp = grid.mdp().unwrap();
    assert!((0..16).all(|s| mdp.is_terminal(s) == (s == 2 || s == 9)));
}

#[test]
fn weights_are_uniform_on_the_l1_sphere() {
    // Method notes section 3: for d = 8, E|w| = .125 and E w² = .02778 (2 / (8 · 9)).
    let (mut rng, n) = (rng(7), 20_000);
    let mut moments = [0.0; 3];
    for _ in 0..n {
        let w = random::l1_sphere(8, &mut rng);
        assert!((w.iter().map(|w| w.abs()).sum::<f64>() - 1.0).abs() < 1e-12);
        for (moment, x) in moments.iter_mut().zip([w[0], w[0].abs(), w[0] * w[0]]) {
            *moment += x / f64::from(n);
        }
    }
    assert!(moments[0].abs() < 0.005 && (moments[1] - 0.125).abs() < 0.003 && (moments[2] - 0.02778).abs() < 0.0015);
}

#[test]
fn the_maze_is_that_of_figure_4_6() {
    let mdp = maze::world().mdp().unwrap();
    let mut solver = Solver::new(&mdp);
    let shown = Policy::Deterministic(solver.solve(&maze::WEIGHTS).policy().to_vec());
    // From the left start the way round the red cells is shown: up, two to the right, two down.
    let way: Vec<usize> = rollout(&mdp, &shown, 5, 20, &mut rng(0)).unwrap().iter().map(|pair| pair.0).collect();
    assert_eq!(way, [5, 0, 1, 2, 7, 12]);
    // From the right one it depends on how bad red is: through one red cell, or far round.
    let counts = |w: &[f64]| {
        let policy = Policy::Deterministic(Solver::new(&mdp).solve(w).policy().to_vec());
        finite_feature_counts(&mdp, &policy, 50, 1.0).unwrap()
    };
    assert!(counts(&[-0.4, -0.6])[1] > 0.0);
    assert_eq!(counts(&[-0.01, -0.99])[1], 0.0);
}

#[test]
fn the_corridor_is_that_of_figure_7_4() {
    let mdp = corridor::world().mdp().unwrap();
    let red: Vec<usize> = (0..15).filter(|&s| mdp.features(s, 0)[1] == 1.0).collect();
    assert_eq!((red, mdp.gamma()), (vec![6, 7, 8, 9], 0.99));
    // The demonstration is optimal under its weights, step by step.
    let mut solver = Solver::new(&mdp);
    let optimum = solver.solve(&corridor::WEIGHTS);
    for (step, &(s, a)) in corridor::DEMONSTRATION.iter().enumerate() {
        assert!((optimum.q(s, a) - optimum.state_value(s)).abs() < 1e-12, "step {step}");
        let next = corridor::DEMONSTRATION.get(step + 1).map_or(corridor::TERMINAL, |pair| pair.0);
        assert_eq!(p(&mdp, s, a, next), 1.0);
    }
}

#[test]
fn sparse_grids_have_one_goal_and_few_features() {
    for seed in 0..50 {
        let (grid, w) = sparse::random(&mut rng(seed));
        let mdp = grid.mdp().unwrap();
        assert!((w.iter().map(|w| w.abs()).sum::<f64>() - 1.0).abs() < 1e-12);
        assert!(w[0] > 0.0 && w[1..].iter().all(|w| *w < 0.0));
        let active: Vec<f64> = (0..64).map(|s| mdp.features(s, 0).iter().sum()).collect();
        assert_eq!((0..64).filter(|&s| mdp.features(s, 0)[0] == 1.0).count(), 1);
        assert!(active.iter().all(|x| *x <= 1.0) && active.iter().sum::<f64>() <= 21.0);
        assert!(grid.starts.iter().all(|&s| active[s] == 0.0) && grid.starts.len() == sparse::N_STARTS);
        // Reaching the goal is worth something from anywhere.
        let optimum = Solver::new(&mdp).solve(&w).value();
        assert!(optimum > 0.0);
    }
}

#[test]
fn drivers_drive_as_table_4_2_says() {
    let mdp = driving::world();
    let hundred = |weights: &[f64; 6]| finite_feature_counts(&mdp, &driving::driver(&mdp, weights), 101, 1.0).unwrap();
    // Collisions in 100 steps: 0, 13.65 and 42.75 there, where they were sampled.
    let (safe, right, road, nasty) =
        (hundred(&driving::SAFE), hundred(&driving::RIGHT_SAFE), hundred(&driving::ON_ROAD), hundred(&driving::NASTY));
    assert_eq!((safe[driving::COLLISION], right[driving::COLLISION]), (0.0, 0.0));
    assert!((road[driving::COLLISION] - 13.65).abs() < 1.5, "{road:?}");
    assert!((nasty[driving::COLLISION] - 42.75).abs() < 1.5, "{nasty:?}");
    for (counts, off_road) in [(&safe, 0.0), (&right, 0.0), (&road, 0.0), (&nasty, 0.0)] {
        assert_eq!(counts[1] + counts[5], off_road);
        assert!((counts[1..].iter().sum::<f64>() - 101.0).abs() < 1e-9);
    }
    assert!(right[4] > 60.0, "{right:?}");
    // Under the demonstrator's reward the true ranking is right-safe, on-road, nasty.
    let loss = |weights: &[f64; 6]| {
        let counts = feature_counts(&mdp, &driving::driver(&mdp, weights)).unwrap();
        policy_losses(&mdp, &counts, &driving::SAFE, 1).unwrap()[0]
    };
    let losses = [loss(&driving::RIGHT_SAFE), loss(&driving::ON_ROAD), loss(&driving::NASTY)];
    assert!(losses[0].abs() < 1e-12 && losses[0] < losses[1] && losses[1] < losses[2], "{losses:?}");
}

#[test]
fn observations_see_what_is_near() {
    let seen = |lane, traffic, place| {
        let seen = driving::observation(driving::state(lane, traffic, place));
        (0..12).filter(|&i| seen[i]).collect::<Vec<usize>>()
    };
    // Traffic lane 1 is the centre lane, lane 2.
    assert_eq!(seen(2, 1, 0), [5]);
    assert_eq!(seen(2, 1, 1), [2, 5]);
    assert_eq!(seen(2, 1, 2), [1, 5]);
    assert_eq!(seen(2, 1, 4), [0, 5]);
    assert_eq!(seen(2, 1, 6), [5]);
    assert_eq!(seen(3, 1, 2), [6, 8]);
    assert_eq!(seen(3, 1, 1), [6, 9]);
    assert_eq!(seen(1, 1, 3), [4, 10]);
    assert_eq!(seen(1, 1, 1), [4, 11]);
    assert_eq!(seen(0, 2, 3), [3]);
}

#[test]
fn machines_are_never_repaired_for_the_mean_cost() {
    let mdp = machine_replacement::world(machine_replacement::N_STATES).unwrap();
    let n = 20_000;
    let draws = machine_replacement::draws(n, &mut rng(9));
    let mut mean = [0.0; 8];
    for draw in draws.chunks(8) {
        assert!(draw.iter().all(|w| *w <= 0.0));
        mean.iter_mut().zip(draw).for_each(|(mean, w)| *mean += w / n as f64);
    }
    // Gamma(½, θ) has mean θ/2 and variance θ²/2.
    for (s, scale) in machine_replacement::SCALES.iter().enumerate() {
        assert!((mean[s] + scale / 2.0).abs() < 4.0 * scale / (2.0 * n as f64).sqrt());
        assert!((mean[4 + s] + 100.0).abs() < 0.03);
    }
    let mut solver = Solver::new(&mdp);
    let optimum = solver.solve(&mean);
    assert_eq!(optimum.policy(), [machine_replacement::WAIT; 4]);
    assert_eq!(p(&mdp, 3, machine_replacement::WAIT, 0), 1.0);
    assert_eq!(p(&mdp, 2, machine_replacement::REPAIR, 0), 1.0);
    let repair = Policy::Deterministic(vec![machine_replacement::REPAIR; 4]);
    let costs = values(&mdp, &repair, &[0.0, 0.0, 0.0, 0.0, -100.0, -100.0, -100.0, -100.0]).unwrap();
    assert!(costs.iter().all(|cost| (cost + 2000.0).abs() < 1e-9));
}
