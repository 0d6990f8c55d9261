//! 4,000 draws in 50 scenes, each the flowers table with one object moved.
#![allow(missing_docs, reason = "criterion writes functions of its own")]

use criterion::{Criterion, criterion_group, criterion_main};
use placement::{LossBatch, placement_losses};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use scene::{Object, Point, Scene, Shape};
use std::hint::black_box;

fn object(id: &str, x: f64, y: f64) -> Object {
    let shape = Shape::Cylinder { radius_m: 0.05, height_m: 0.1 };
    Object { id: id.into(), label: id.into(), shape, position_m: Point::new(x, y), yaw_rad: 0.0, supports: false }
}

fn bench(c: &mut Criterion) {
    let mut rng = ChaCha8Rng::seed_from_u64(5);
    let base = Scene {
        id: "flowers".into(),
        frame: "table".into(),
        width_m: 1.0,
        depth_m: 1.0,
        objects: vec![
            object("a", 0.25, 0.75),
            object("b", 0.75, 0.75),
            object("c", 0.25, 0.25),
            object("d", 0.75, 0.25),
        ],
        target: object("vase", 0.0, 0.0),
    };
    let scenes: Vec<Scene> = (0..50)
        .map(|s| {
            let mut scene = base.clone();
            scene.objects[s % 4].position_m =
                Point::new(0.1 + 0.8 * rng.random::<f64>(), 0.1 + 0.8 * rng.random::<f64>());
            scene
        })
        .collect();
    let k = 13;
    let truth = [-0.1, -0.1, -0.1, -0.1, 0.0, 0.0, 0.0, 0.0, 0.6, 0.0, 0.0, 0.0, 0.0];
    for (name, spread) in [("after some answers", 0.03), ("early on", 0.3)] {
        let draws: Vec<f32> =
            (0..4000 * k).map(|i| truth[i % k] as f32 + spread * (2.0 * rng.random::<f32>() - 1.0)).collect();
        for threads in [1, 2] {
            let batch = LossBatch { draws: &draws, n_features: k, map_weights: &truth, threads };
            c.bench_function(&format!("losses of 4000 draws in 50 scenes, {name}, {threads} threads"), |b| {
                b.iter(|| placement_losses(black_box(&scenes), &batch));
            });
        }
    }
}

criterion_group! { name = benches; config = Criterion::default().sample_size(10); targets = bench }
criterion_main!(benches);
