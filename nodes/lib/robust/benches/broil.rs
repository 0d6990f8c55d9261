//! How long robust policies take: one λ by either method, and a frontier of 21, on grids and on processes without structure.
//! `cargo bench -p robust@0.1.0` (another crate of that name is among the dependencies); about five minutes.

use std::hint::black_box;

use criterion::{Criterion, criterion_group, criterion_main};
use mdp::Mdp;
use mdp::random::{l1_sphere, normal};
use mdp::worlds::GridWorld;
use mdp::worlds::garnet::Garnet;
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;
use robust::{MethodChoice, Objective, Problem, Settings};

const N_FEATURES: usize = 8;
const ALPHA: f64 = 0.95;

fn grid(side: usize, rng: &mut ChaCha8Rng) -> Mdp {
    let world = GridWorld { gamma: 0.95, ..GridWorld::random(side, side, N_FEATURES, rng) };
    world.mdp().expect("a valid process")
}

fn garnet(n_states: usize, rng: &mut ChaCha8Rng) -> Mdp {
    let (n_actions, n_features, branching, gamma) = (4, N_FEATURES, 5, 0.95);
    let garnet = Garnet { n_states, n_actions, n_features, branching, gamma, terminal: 0.0, by_action: false };
    garnet.random(rng).expect("a valid process")
}

/// A posterior about as wide as the weights are large.
fn draws(n: usize, rng: &mut ChaCha8Rng) -> Vec<f64> {
    let center = l1_sphere(N_FEATURES, rng);
    let spread = 1.0 / N_FEATURES as f64;
    (0..n).flat_map(|_| center.clone()).map(|w| w + spread * normal(rng)).collect()
}

fn broil(criterion: &mut Criterion) {
    let mut rng = ChaCha8Rng::seed_from_u64(1);
    let lambdas: Vec<f64> = (0..=20).map(|i| f64::from(i) / 20.0).collect();
    let worlds = [
        ("grid, S = 100, N = 2000", grid(10, &mut rng), 2000),
        ("grid, S = 400, N = 2000", grid(20, &mut rng), 2000),
        ("grid, S = 10000, N = 10000", grid(100, &mut rng), 10_000),
        ("garnet, S = 100, N = 2000", garnet(100, &mut rng), 2000),
        ("garnet, S = 400, N = 2000", garnet(400, &mut rng), 2000),
        ("garnet, S = 10000, N = 10000", garnet(10_000, &mut rng), 10_000),
    ];
    for (name, mdp, n) in &worlds {
        let mut group = criterion.benchmark_group(*name);
        group.sample_size(10).measurement_time(std::time::Duration::from_secs(2));
        let draws = draws(*n, &mut rng);
        // The problem is made each time: planning for the mean reward is part of the work.
        let problem = || Problem::new(mdp, black_box(&draws), None, Objective::Robust, 1).expect("valid draws");
        for (name, lambda) in [("λ = 0.5", 0.5), ("λ = 0", 0.0)] {
            group.bench_function(format!("automatic, {name}"), |bencher| {
                bencher.iter(|| problem().solve(ALPHA, lambda, &Settings::default()).expect("valid levels"));
            });
        }
        group.bench_function("automatic, frontier of 21", |bencher| {
            bencher.iter(|| problem().frontier(ALPHA, &lambdas, &Settings::default()).expect("valid levels"));
        });
        if mdp.n_states() <= 400 {
            let settings = Settings { method: MethodChoice::Direct, ..Settings::default() };
            group.bench_function("linear program, λ = 0.5", |bencher| {
                bencher.iter(|| problem().solve(ALPHA, 0.5, &settings).expect("valid levels"));
            });
        }
        group.finish();
    }
}

criterion_group!(benches, broil);
criterion_main!(benches);
