//! A seven-joint arm among 20 objects: where its links are, whether they touch anything, straight ways, inverse kinematics.
#![allow(missing_docs, reason = "criterion writes functions of its own")]

use arm::{
    Chain, Checker, CollisionModel, Exclusions, Goal, IkSettings, Isometry3, Obstacle, Placed, Robot, Solid,
    SweepSettings, Vector3, World, solve,
};
use criterion::{Criterion, criterion_group, criterion_main};
use std::hint::black_box;
use std::sync::Arc;

const ARM: &str = include_str!("../../../../config/urdf/table_arm_7.urdf");
const HOME: [f64; 8] = [0.0, -0.5, 0.0, 2.1, 0.0, 1.54, 0.0, 0.04];
const OVER: [f64; 8] = [0.2, 0.4, 0.1, 1.5, 0.0, 1.2, 0.3, 0.04];

/// A table, 19 things on it, and one in the hand.
fn table(chain: &Chain, robot: &Robot) -> World {
    let mut world = World::new();
    let mut add = |name: String, solid: Solid, at: Vector3<f64>| {
        world.add(Obstacle { name, solid, root_from_solid: Isometry3::translation(at.x, at.y, at.z) });
    };
    add("table".into(), Solid::Box { half_extents: [0.5, 0.5, 0.02] }, Vector3::new(0.5, 0.5, -0.02));
    for i in 0..19 {
        let solid = match i % 3 {
            0 => Solid::Cylinder { radius: 0.04, half_length: 0.06 },
            1 => Solid::Box { half_extents: [0.05, 0.03, 0.06] },
            _ => Solid::Ball { radius: 0.06 },
        };
        let at = Vector3::new(0.1 + 0.2 * f64::from(i % 5), 0.25 + 0.2 * f64::from(i / 5), 0.06);
        add(format!("thing {i}"), solid, at);
    }
    let vase = Placed {
        solid: Solid::Cylinder { radius: 0.05, half_length: 0.1 },
        owner_from_solid: Isometry3::translation(0.0, 0.0, 0.07),
    };
    world.hold("vase", chain.tool, vase, chain.hand(robot));
    world
}

fn bench(c: &mut Criterion) {
    let robot = Arc::new(Robot::from_urdf(ARM).expect("shipped"));
    let chain = Chain::new(&robot, "tool0").expect("shipped");
    let model = CollisionModel::new(&robot, &Exclusions::derived(&robot, 1));
    let mut checker = Checker::new(Arc::clone(&robot), Arc::new(model));
    let world = table(&chain, &robot);
    let mut poses = Vec::new();
    let mut columns = Vec::new();
    c.bench_function("poses of all links", |b| b.iter(|| robot.link_poses(black_box(&OVER), &mut poses)));
    c.bench_function("pose of the tool", |b| b.iter(|| chain.tool_pose(black_box(&OVER))));
    c.bench_function("pose of the tool and Jacobian", |b| b.iter(|| chain.linearise(black_box(&OVER), &mut columns)));
    for (name, q) in [("home", HOME), ("over the table", OVER)] {
        c.bench_function(&format!("contact with itself and 20 objects, {name}"), |b| {
            b.iter(|| checker.first_contact(black_box(&q), &world, 0.005));
        });
        c.bench_function(&format!("nearest of all within 0.1 m, {name}"), |b| {
            b.iter(|| checker.nearest(black_box(&q), &world, 0.1));
        });
    }
    let mut near = HOME;
    near.iter_mut().take(7).for_each(|q| *q += 0.2);
    let settings = SweepSettings { margin: 0.005, ..SweepSettings::default() };
    c.bench_function("a way of 0.2 rad in each joint", |b| {
        b.iter(|| checker.sweep(black_box(&HOME), &near, &world, &settings));
    });
    let goal = Goal::Pose(chain.tool_pose(&OVER));
    c.bench_function("inverse kinematics from home", |b| {
        b.iter(|| solve(&robot, &chain, black_box(&goal), &HOME, &IkSettings::default(), |_| true));
    });
}

criterion_group!(benches, bench);
criterion_main!(benches);
