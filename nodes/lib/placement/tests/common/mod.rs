//! Scenes and posteriors that the tests share.
#![allow(dead_code, reason = "not every test uses all of it")]

use arm::{Isometry3, Obstacle, Solid, Translation3, World, about_z};
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

/// What an object is to the collision checker.
pub fn solid(object: &Object) -> Solid {
    match object.shape {
        Shape::Cylinder { radius_m, height_m } => Solid::Cylinder { radius: radius_m, half_length: height_m / 2.0 },
        Shape::Box { width_m, depth_m, height_m } => {
            Solid::Box { half_extents: [width_m / 2.0, depth_m / 2.0, height_m / 2.0] }
        }
    }
}

/// The pose of something that stands upright, its base `base_m` above the table; the frame "table" is the robot's root.
pub fn upright(x: f64, y: f64, base_m: f64, object: &Object, yaw_rad: f64) -> Isometry3<f64> {
    Isometry3::from_parts(Translation3::new(x, y, base_m + object.shape.height_m() / 2.0), about_z(yaw_rad))
}

/// The table and what stands on it, built here once more.
pub fn around(scene: &Scene) -> World {
    let mut world = World::new();
    world.add(Obstacle {
        name: "table".into(),
        solid: Solid::Box { half_extents: [scene.width_m / 2.0, scene.depth_m / 2.0, 0.02] },
        root_from_solid: Isometry3::translation(scene.width_m / 2.0, scene.depth_m / 2.0, -0.02),
    });
    for object in &scene.objects {
        let Point { x, y } = object.position_m;
        let root_from_solid = upright(x, y, 0.0, object, object.yaw_rad);
        world.add(Obstacle { name: object.id.clone(), solid: solid(object), root_from_solid });
    }
    world
}
