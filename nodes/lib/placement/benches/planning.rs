//! The reach map of a new table, and whole plans.
#![allow(missing_docs, reason = "criterion writes functions of its own")]

#[path = "../tests/common/mod.rs"]
mod common;

use common::{TABLE_ARM, flowers, home, posterior, wall};
use criterion::{Criterion, criterion_group, criterion_main};
use placement::{LossBatch, MAP_SIDE, Manipulator, MotionSettings, Planner, ReachMap};

fn bench(c: &mut Criterion) {
    let manipulator = Manipulator::from_urdf(TABLE_ARM, MotionSettings::default()).expect("shipped");
    c.bench_function("reach map, 1024 cells", |b| b.iter(|| ReachMap::new(&manipulator, &flowers(), MAP_SIDE)));
    let (draws, map) = posterior(4000, 0.05, 1);
    let batch = LossBatch { draws: &draws, n_features: 13, map_weights: &map, threads: 1 };
    let mut planner = Planner::new(MotionSettings::default());
    c.bench_function("plan without a robot, 4000 draws", |b| {
        b.iter(|| planner.plan(&flowers(), &batch, 0.95, &home()));
    });
    planner.set_robot(TABLE_ARM).expect("shipped");
    c.bench_function("plan, 4000 draws", |b| b.iter(|| planner.plan(&flowers(), &batch, 0.95, &home())));
    c.bench_function("plan around a wall, 4000 draws", |b| b.iter(|| planner.plan(&wall(), &batch, 0.95, &home())));
}

criterion_group! { name = benches; config = Criterion::default().sample_size(10); targets = bench }
criterion_main!(benches);
