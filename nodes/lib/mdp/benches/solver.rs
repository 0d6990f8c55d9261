//! Optimal control for weights that move a little each time, as a sampler moves them.
#![allow(missing_docs, reason = "criterion writes functions of its own")]

use std::hint::black_box;

use criterion::{Criterion, criterion_group, criterion_main};
use mdp::worlds::{GridWorld, chapter4};
use mdp::{Mdp, Solver, random};
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;

/// `n` weight vectors, each coordinate moved by up to ± `step` from the one before and pulled back to `around`.
fn walk(around: &[f64], step: f64, n: usize, rng: &mut ChaCha8Rng) -> Vec<Vec<f64>> {
    let mut w = around.to_vec();
    (0..n)
        .map(|_| {
            for (w, centre) in w.iter_mut().zip(around) {
                *w += step * (2.0 * random::uniform(rng) - 1.0) + 0.05 * (centre - *w);
            }
            w.clone()
        })
        .collect()
}

/// How many states change their action from one weight vector to the next, on average.
fn changes(mdp: &Mdp, weights: &[Vec<f64>]) -> f64 {
    let mut solver = Solver::new(mdp);
    let policies: Vec<Vec<usize>> = weights.iter().map(|w| solver.solve(w).policy().to_vec()).collect();
    let differ = |pair: &[Vec<usize>]| pair[0].iter().zip(&pair[1]).filter(|(a, b)| a != b).count();
    policies.windows(2).map(differ).sum::<usize>() as f64 / (weights.len() - 1) as f64
}

fn bench_walk(c: &mut Criterion, name: &str, mdp: &Mdp, weights: &[Vec<f64>], gradient: bool) {
    let name = format!("{name}, {:.1} states change", changes(mdp, weights));
    let mut solver = Solver::new(mdp);
    let mut next = weights.iter().cycle();
    let mut out = vec![0.0; mdp.n_features()];
    // All actions in 30 states.
    let coefficients: Vec<(usize, usize, f64)> = (0..120).map(|i| (i / 4 * 2, i % 4, 0.1)).collect();
    c.bench_function(&name, |b| {
        b.iter(|| {
            let optimum = solver.solve(black_box(next.next().expect("cycles")));
            if gradient {
                optimum.add_gradient(&coefficients, &mut out);
            }
            optimum.value()
        });
    });
}

fn bench(c: &mut Criterion) {
    let mut rng = ChaCha8Rng::seed_from_u64(1);
    let mdp = chapter4::rep_0().mdp().expect("a process");
    let around = chapter4::REP_0_WEIGHTS;
    bench_walk(c, "9 x 9, the policy stays", &mdp, &vec![around.to_vec(); 2], false);
    bench_walk(c, "9 x 9, the policy stays, with gradient", &mdp, &vec![around.to_vec(); 2], true);
    for step in [0.003, 0.01, 0.03, 0.1] {
        bench_walk(c, &format!("9 x 9, steps of {step}"), &mdp, &walk(&around, step, 5000, &mut rng), false);
    }
    for (side, gamma) in [(30, 0.9), (30, 0.99), (60, 0.9), (60, 0.99), (100, 0.99)] {
        let grid = GridWorld { slip: 0.15, gamma, ..GridWorld::random(side, side, 8, &mut rng) };
        let mdp = grid.mdp().expect("a process");
        bench_walk(c, &format!("{side} x {side}, {gamma}"), &mdp, &walk(&around, 0.01, 400, &mut rng), true);
    }
    let mdp = GridWorld { slip: 0.15, ..GridWorld::random(100, 100, 8, &mut rng) }.mdp().expect("a process");
    for step in [0.003, 0.03] {
        let weights = walk(&around, step, 60, &mut rng);
        bench_walk(c, &format!("100 x 100, steps of {step}"), &mdp, &weights, false);
        bench_walk(c, &format!("100 x 100 with gradient, steps of {step}"), &mdp, &weights, true);
    }
}

criterion_group! {
    name = benches;
    config = Criterion::default().sample_size(20);
    targets = bench
}
criterion_main!(benches);
