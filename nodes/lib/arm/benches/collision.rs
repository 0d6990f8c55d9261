//! One configuration: where its links are, and whether they touch anything.
#![allow(missing_docs, reason = "criterion writes functions of its own")]

use arm::{Chain, Checker, CollisionModel, Exclusions, Isometry3, Obstacle, Placed, Robot, Solid, World};
use criterion::{Criterion, criterion_group, criterion_main};
use std::hint::black_box;
use std::sync::Arc;

fn bench(c: &mut Criterion) {
    let robot = Robot::from_urdf(include_str!("../../../../config/urdf/table_arm.urdf")).expect("shipped");
    let chain = Chain::new(&robot, "tool0").expect("shipped");
    let model = CollisionModel::new(&robot, &Exclusions::derived(&robot, 1));
    let mut world = World::new();
    world.add(Obstacle {
        name: "table".into(),
        solid: Solid::Box { half_extents: [0.5, 0.5, 0.02] },
        root_from_solid: Isometry3::translation(0.5, 0.5, -0.02),
    });
    for (x, y) in [(0.25, 0.75), (0.75, 0.75), (0.25, 0.25), (0.75, 0.25)] {
        world.add(Obstacle {
            name: format!("object at {x} {y}"),
            solid: Solid::Cylinder { radius: 0.06, half_length: 0.06 },
            root_from_solid: Isometry3::translation(x, y, 0.06),
        });
    }
    let vase = Placed {
        solid: Solid::Cylinder { radius: 0.05, half_length: 0.1 },
        owner_from_solid: Isometry3::translation(0.0, 0.0, 0.07),
    };
    world.hold("vase", chain.tool, vase, chain.hand(&robot));
    let mut poses = Vec::new();
    let mut checker = Checker::new(Arc::new(robot.clone()), Arc::new(model));
    for (name, q) in
        [("home", [0.0, -0.6, 2.2, 0.0, 1.54, 0.0, 0.05]), ("over the table", [0.2, 0.5, 1.4, 0.0, 1.2, 0.0, 0.05])]
    {
        c.bench_function(&format!("forward kinematics, {name}"), |b| {
            b.iter(|| robot.link_poses(black_box(&q), &mut poses));
        });
        c.bench_function(&format!("forward kinematics and collision, {name}"), |b| {
            b.iter(|| checker.first_contact(black_box(&q), &world, 0.005));
        });
    }
}

criterion_group!(benches, bench);
criterion_main!(benches);
