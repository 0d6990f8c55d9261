//! Tables with eight things on them, one to place, and rewards for it: the same for the same seed.

use crate::arm::uniform;
use placement::LossBatch;
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;
use scene::{Object, Point, Scene, Shape};

/// Things on a table.
const N_OBJECTS: usize = 8;
/// Weights: one for each thing, and nine for fixed centres.
const N_FEATURES: usize = N_OBJECTS + 9;
/// Things keep this far from each other, metres.
const GAP_M: f64 = 0.02;

/// A table and what is wanted on it.
pub struct Problem {
    pub scene: Scene,
    pub draws: Vec<f32>,
    pub map_weights: Vec<f64>,
}

impl Problem {
    /// For one thread.
    pub fn batch(&self) -> LossBatch<'_> {
        LossBatch { draws: &self.draws, n_features: N_FEATURES, map_weights: &self.map_weights, threads: 1 }
    }
}

/// Table number `n` of a seed, `width_m` × `depth_m` in `frame`, with `n_draws` draws of the weights.
pub fn problem(seed: u64, n: u64, frame: &str, [width_m, depth_m]: [f64; 2], n_draws: usize) -> Problem {
    let mut rng = ChaCha8Rng::seed_from_u64(seed);
    rng.set_stream(n);
    let mut objects: Vec<Object> = Vec::new();
    let mut tries = 0;
    while objects.len() < N_OBJECTS && tries < 10_000 {
        tries += 1;
        let one = object(&mut rng, &format!("thing {}", objects.len() + 1), [width_m, depth_m]);
        let radius_m = one.shape.bounding_radius_m();
        let apart = |other: &Object| {
            other.position_m.distance(one.position_m) > radius_m + other.shape.bounding_radius_m() + GAP_M
        };
        if objects.iter().all(apart) {
            objects.push(one);
        }
    }
    let target = Object {
        id: "target".into(),
        label: "target".into(),
        shape: Shape::Cylinder { radius_m: 0.035, height_m: 0.16 },
        position_m: Point::new(0.0, 0.0),
        yaw_rad: 0.0,
        supports: false,
    };
    let scene = Scene { id: format!("clutter {n}"), frame: frame.into(), width_m, depth_m, objects, target };
    // People keep clear of most things and like one place.
    let mut map_weights: Vec<f64> = (0..N_FEATURES)
        .map(|i| if i < N_OBJECTS { -0.2 * uniform(&mut rng) } else { 0.2 * uniform(&mut rng) })
        .collect();
    map_weights[N_OBJECTS + (9.0 * uniform(&mut rng)) as usize] += 0.6;
    let draws = (0..n_draws * N_FEATURES)
        .map(|i| (map_weights[i % N_FEATURES] + 0.1 * (2.0 * uniform(&mut rng) - 1.0)) as f32)
        .collect();
    Problem { scene, draws, map_weights }
}

fn object(rng: &mut ChaCha8Rng, id: &str, [width_m, depth_m]: [f64; 2]) -> Object {
    let height_m = 0.04 + 0.26 * uniform(rng);
    let shape = if uniform(rng) < 0.5 {
        Shape::Cylinder { radius_m: 0.025 + 0.035 * uniform(rng), height_m }
    } else {
        Shape::Box { width_m: 0.05 + 0.1 * uniform(rng), depth_m: 0.04 + 0.06 * uniform(rng), height_m }
    };
    let edge_m = shape.bounding_radius_m();
    let within = |length_m: f64, rng: &mut ChaCha8Rng| edge_m + (length_m - 2.0 * edge_m) * uniform(rng);
    let position_m = Point::new(within(width_m, rng), within(depth_m, rng));
    let yaw_rad = std::f64::consts::PI * uniform(rng);
    Object { id: id.into(), label: id.into(), shape, position_m, yaw_rad, supports: false }
}
