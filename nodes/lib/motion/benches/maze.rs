//! `cargo bench -p motion`: search, shortening and timing in a box of seven joints with spheres in it.

use criterion::{Criterion, criterion_group, criterion_main};
use motion::{Limits, Metric, Search, Space, connect, shorten, time};
use rand::{RngExt, SeedableRng};
use std::hint::black_box;

struct Spheres {
    lower: [f64; 7],
    upper: [f64; 7],
    centres: Vec<[f64; 7]>,
}

impl Space for Spheres {
    fn lower(&self) -> &[f64] {
        &self.lower
    }
    fn upper(&self) -> &[f64] {
        &self.upper
    }
    fn is_free(&mut self, q: &[f64]) -> bool {
        let squared = |c: &[f64; 7]| c.iter().zip(q).map(|(c, q)| (c - q) * (c - q)).sum::<f64>();
        self.centres.iter().all(|centre| squared(centre) > 0.49)
    }
    fn edge_is_free(&mut self, a: &[f64], b: &[f64]) -> bool {
        (0..=20).all(|i| {
            let q: Vec<f64> = a.iter().zip(b).map(|(a, b)| a + (b - a) * f64::from(i) / 20.0).collect();
            self.is_free(&q)
        })
    }
}

fn maze(criterion: &mut Criterion) {
    let mut rng = rand_chacha::ChaCha8Rng::seed_from_u64(1);
    let centres = (0..300).map(|_| std::array::from_fn(|_| rng.random_range(-1.0..1.0))).collect();
    let mut space = Spheres { lower: [-1.0; 7], upper: [1.0; 7], centres };
    let mut free = || loop {
        let q: Vec<f64> = (0..7).map(|_| rng.random_range(-1.0..1.0)).collect();
        if space.is_free(&q) {
            return q;
        }
    };
    let (start, goal) = (free(), free());
    let limits = Limits::from_velocity(vec![1.0; 7], 0.4).expect("good");
    let metric = Metric::of_limits(&limits);
    let search = Search::default();
    let path = connect(&mut space, &metric, &start, std::slice::from_ref(&goal), &search).expect("there is a way");
    criterion.bench_function("connect", |b| {
        b.iter(|| black_box(connect(&mut space, &metric, &start, std::slice::from_ref(&goal), &search)));
    });
    criterion.bench_function("shorten", |b| b.iter(|| black_box(shorten(&mut space, &metric, &path, 100, 1))));
    let short = shorten(&mut space, &metric, &path, 100, 1);
    criterion.bench_function("time", |b| b.iter(|| black_box(time(&mut space, &short, &limits, 0.02))));
}

criterion_group!(benches, maze);
criterion_main!(benches);
