//! How long the likelihood and the sampler take on flowers lessons of several lengths.

use std::hint::black_box;

use criterion::{Criterion, criterion_group, criterion_main};
use posterior::Likelihood;
use scene::Grid;

#[path = "../tests/common/mod.rs"]
mod common;

fn likelihood(c: &mut Criterion) {
    let lesson = common::lesson(10, 4, &common::flowers_weights(), 1);
    let w = common::flowers_weights();
    for side in [64, 16] {
        let likelihood = Likelihood::new(13, &common::placements(&lesson, 100.0), &Grid::midpoints(side));
        c.bench_function(&format!("log-likelihood of 10 demonstrations on {side} x {side}"), |b| {
            b.iter(|| likelihood.value(black_box(&w)));
        });
        let mut gradient = vec![0.0; 13];
        c.bench_function(&format!("gradient of 10 demonstrations on {side} x {side}"), |b| {
            b.iter(|| likelihood.value_and_gradient(black_box(&w), &mut gradient));
        });
    }
}

criterion_group!(benches, likelihood);
criterion_main!(benches);
