//! How long the likelihood and the sampler take on flowers lessons of several lengths.

use std::hint::black_box;

use criterion::{Criterion, criterion_group, criterion_main};
use likelihood::placements::PlacementLikelihood;
use posterior::{Lesson, Settings, sample};
use scene::Grid;

#[path = "../../likelihood/tests/common/mod.rs"]
mod common;

fn likelihood(c: &mut Criterion) {
    let lesson = common::lesson(10, 4, &common::flowers_weights(), 1);
    let w = common::flowers_weights();
    for side in [64, 16] {
        let likelihood = PlacementLikelihood::new(13, &common::placements(&lesson, 100.0), &Grid::midpoints(side));
        c.bench_function(&format!("log-likelihood of 10 demonstrations on {side} x {side}"), |b| {
            b.iter(|| likelihood.value(black_box(&w)));
        });
        let mut gradient = vec![0.0; 13];
        c.bench_function(&format!("gradient of 10 demonstrations on {side} x {side}"), |b| {
            b.iter(|| likelihood.value_and_gradient(black_box(&w), &mut gradient));
        });
    }
}

fn sampling(c: &mut Criterion) {
    let lesson = Lesson::new(&common::flowers());
    let mut group = c.benchmark_group("4000 draws on two threads");
    group.sample_size(10);
    for n in [5, 10, 20] {
        let demonstrations = common::lesson(n, 4, &common::flowers_weights(), 1);
        let draw = || sample(&Settings::default(), 1, &lesson, &demonstrations).expect("draws");
        let draws = draw();
        println!(
            "{n} demonstrations: accepted {:.3}, R-hat {:.4}, bulk {:.0}, tail {:.0}",
            draws.acceptance, draws.rhat_max, draws.ess_bulk_min, draws.ess_tail_min
        );
        group.bench_function(format!("{n} demonstrations"), |b| b.iter(draw));
    }
}

criterion_group!(benches, likelihood, sampling);
criterion_main!(benches);
