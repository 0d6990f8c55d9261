//! Scenes and random numbers shared by the tests.
#![allow(dead_code)]

use likelihood::placements::{Confidence, Demonstration, Placement};
use scene::{Object, Point, Scene, Shape};

/// SplitMix64.
pub struct Random(pub u64);

impl Random {
    pub fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        z ^ (z >> 31)
    }

    /// In the open unit interval.
    pub fn uniform(&mut self) -> f64 {
        ((self.bits() >> 12) as f64 + 0.5) / (1_u64 << 52) as f64
    }

    /// Uniform on the L1 sphere, by another route than the sampler's.
    pub fn l1_sphere(&mut self, n: usize) -> Vec<f64> {
        let x: Vec<f64> =
            (0..n).map(|_| -self.uniform().ln() * if self.bits() & 1 == 0 { 1.0 } else { -1.0 }).collect();
        let norm: f64 = x.iter().map(|x| x.abs()).sum();
        x.iter().map(|x| x / norm).collect()
    }
}

fn cylinder(id: &str, at: Point, radius_m: f64) -> Object {
    Object {
        id: id.into(),
        label: id.into(),
        shape: Shape::Cylinder { radius_m, height_m: 0.1 },
        position_m: at,
        yaw_rad: 0.0,
        supports: false,
    }
}

/// A table of one square metre with small round objects, and a target of the same kind.
pub fn table(positions: &[(f64, f64)], radius_m: f64) -> Scene {
    let objects = positions.iter().enumerate();
    Scene {
        id: "table".into(),
        frame: "table".into(),
        width_m: 1.0,
        depth_m: 1.0,
        objects: objects.map(|(i, &(x, y))| cylinder(&format!("object_{i}"), Point::new(x, y), radius_m)).collect(),
        target: cylinder("target", Point::default(), radius_m),
    }
}

/// The flowers of the dissertation's section 8.2.4.
pub fn flowers() -> Scene {
    table(&[(0.25, 0.75), (0.75, 0.75), (0.25, 0.25), (0.75, 0.25)], 0.04)
}

/// Their reward: away from the flowers, close to the middle of the table.
pub fn flowers_weights() -> Vec<f64> {
    vec![-0.1, -0.1, -0.1, -0.1, 0.0, 0.0, 0.0, 0.0, 0.6, 0.0, 0.0, 0.0, 0.0]
}

/// Demonstrations of the best placement under `w` in tables with objects at random, as a noise-free teacher gives them.
pub fn lesson(n: usize, n_objects: usize, w: &[f64], seed: u64) -> Vec<Demonstration> {
    let mut random = Random(seed);
    let demonstration = |i: usize| {
        let positions: Vec<_> =
            (0..n_objects).map(|_| (0.1 + 0.8 * random.uniform(), 0.1 + 0.8 * random.uniform())).collect();
        let scene = table(&positions, 0.04);
        let rbf = scene::Rbf::new(&scene);
        let field = scene::Field::new(&rbf, &scene::Grid::midpoints(64), Some(&scene));
        let best = scene::best_placement(&scene, &rbf, &field, w, &mut Vec::new()).expect("free cells");
        Demonstration { id: format!("d{i}"), scene, placement: best.at, confidence: Confidence::Sure }
    };
    (0..n).map(demonstration).collect()
}

pub fn placements(demonstrations: &[Demonstration], beta: f64) -> Vec<Placement<'_>> {
    demonstrations.iter().map(|d| Placement { scene: &d.scene, at: d.placement, factor: beta, masked: true }).collect()
}
