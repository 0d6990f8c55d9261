//! Scenes and posteriors that the tests share.
#![allow(dead_code, reason = "not every test uses all of it")]

use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use scene::{Object, Point, Scene, Shape};

pub const TABLE_ARM: &str = include_str!("../../../../../config/urdf/table_arm.urdf");

pub fn object(id: &str, x: f64, y: f64) -> Object {
    Object {
        id: id.into(),
        label: "thing".into(),
        shape: Shape::Cylinder { radius_m: 0.05, height_m: 0.1 },
        position_m: Point::new(x, y),
        yaw_rad: 0.0,
        supports: false,
    }
}

/// Four things around the middle, and a vase of 20 cm.
pub fn flowers() -> Scene {
    let mut target = object("vase", 0.0, 0.0);
    target.shape = Shape::Cylinder { radius_m: 0.05, height_m: 0.2 };
    Scene {
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
        target,
    }
}

/// The same with a wall of 35 cm between the arm and the middle.
pub fn wall() -> Scene {
    let mut scene = flowers();
    scene.objects[2].shape = Shape::Box { width_m: 0.5, depth_m: 0.03, height_m: 0.35 };
    scene.objects[2].position_m = Point::new(0.5, 0.3);
    scene.objects[3].position_m = Point::new(0.9, 0.1);
    scene
}

/// Where the URDF recommends to start from.
pub fn home() -> Vec<(String, f64)> {
    let names = ["shoulder_yaw", "shoulder_pitch", "elbow", "forearm_roll", "wrist_pitch", "wrist_roll", "finger_left"];
    let positions = [0.0, -0.6, 2.2, 0.0, 1.54, 0.0, 0.05];
    names.iter().zip(positions).map(|(name, position)| ((*name).into(), position)).collect()
}

/// Draws around the flowers reward, and its weights.
pub fn posterior(n: usize, spread: f32, seed: u64) -> (Vec<f32>, Vec<f64>) {
    let mut rng = ChaCha8Rng::seed_from_u64(seed);
    let truth = [-0.1, -0.1, -0.1, -0.1, 0.0, 0.0, 0.0, 0.0, 0.6, 0.0, 0.0, 0.0, 0.0];
    let draws = (0..13 * n).map(|i| truth[i % 13] as f32 + spread * (2.0 * rng.random::<f32>() - 1.0)).collect();
    (draws, truth.to_vec())
}
