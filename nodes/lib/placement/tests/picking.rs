//! Motions that pick up, carry and withdraw, re-checked point by point against a world that is built here once more.
#![allow(clippy::unwrap_used, reason = "a test may panic")]

mod common;

use arm::{Chain, Checker, CollisionModel, Exclusions, Isometry3, Obstacle, Placed, Robot, Vector3, World, about_z};
use common::{TABLE_ARM, around, flowers, home, object, posterior, solid, upright};
use placement::{
    ClosingAxis, Gripper, LossBatch, MotionSettings, PlacementPlan, PlanOutcome, Planner, Source, Stand, Trajectory,
};
use scene::{Object, Point, Scene, Shape};
use std::sync::Arc;

const TRAY: Stand = Stand { at_m: Point { x: 1.1, y: 0.15 }, base_m: 0.0, yaw_rad: 0.4 };

fn gripper() -> Gripper {
    Gripper { joint: "finger_left".into(), closed: 0.0, open: 0.075, opening_m: 0.154, axis: ClosingAxis::Y }
}

struct Check {
    robot: Robot,
    chain: Chain,
    checker: Checker,
    hand: Vec<bool>,
    finger: f64,
}

impl Check {
    fn new(finger: f64) -> Self {
        let robot = Robot::from_urdf(TABLE_ARM).unwrap();
        let chain = Chain::new(&robot, "tool0").unwrap();
        let model = CollisionModel::new(&robot, &Exclusions::derived(&robot, 1));
        let checker = Checker::new(Arc::new(robot.clone()), Arc::new(model));
        let hand = chain.hand(&robot);
        Self { robot, chain, checker, hand, finger }
    }

    fn q(&self, positions: &[f64]) -> Vec<f64> {
        positions.iter().copied().chain([self.finger]).collect()
    }

    fn tool(&self, positions: &[f64]) -> Isometry3<f64> {
        self.chain.tool_pose(&self.q(positions))
    }

    /// Every touch along a part, but those of a pair that `may` touch.
    fn touches(&mut self, part: &Trajectory, world: &World, may: impl Fn(&str, &str) -> bool) -> Vec<(String, String)> {
        let mut all = Vec::new();
        for pair in part.points.windows(2) {
            for i in 0..10 {
                let share = f64::from(i) / 10.0;
                let mix = pair[0].positions.iter().zip(&pair[1].positions).map(|(a, b)| a * (1.0 - share) + b * share);
                let q = self.q(&mix.collect::<Vec<_>>());
                for contact in self.checker.contacts(&q, world, 0.0) {
                    let (a, b) = (contact.a.name(&self.robot, world), contact.b.name(&self.robot, world));
                    if !may(a, b) && !may(b, a) {
                        all.push((a.to_owned(), b.to_owned()));
                    }
                }
            }
        }
        all.dedup();
        all
    }

    fn is_hand(&self, name: &str) -> bool {
        self.robot.link_index(name).is_some_and(|link| self.hand[link])
    }
}

fn planned(scene: &Scene, source: &Source) -> PlacementPlan {
    let settings = MotionSettings { gripper: Some(gripper()), ..MotionSettings::default() };
    let mut planner = Planner::new(settings);
    planner.set_robot(TABLE_ARM).unwrap();
    let (draws, map) = posterior(200, 0.05, 1);
    let batch = LossBatch { draws: &draws, n_features: map.len(), map_weights: &map, threads: 1 };
    planner.plan_from(scene, &batch, 0.95, &home(), source)
}

fn things() -> [Shape; 4] {
    [
        Shape::Cylinder { radius_m: 0.04, height_m: 0.2 },
        Shape::Cylinder { radius_m: 0.1, height_m: 0.02 },
        Shape::Box { width_m: 0.02, depth_m: 0.16, height_m: 0.015 },
        Shape::Box { width_m: 0.16, depth_m: 0.05, height_m: 0.1 },
    ]
}

#[test]
fn the_parts_join_and_nothing_touches_that_should_not() {
    for shape in things() {
        let scene = Scene { target: Object { shape, ..object("vase", 0.0, 0.0) }, ..flowers() };
        let plan = planned(&scene, &Source::Stands(TRAY));
        assert_eq!(plan.outcome, PlanOutcome::Planned, "{shape:?}: {}", plan.reason);
        let [grip_open, grip] = plan.grip.unwrap();
        assert!(grip < grip_open);
        let joints: Vec<f64> = home().iter().map(|(_, at)| *at).collect();
        let ends = |part: &Trajectory| {
            let (first, last) = (part.points.first().unwrap(), part.points.last().unwrap());
            assert!(first.velocities.iter().chain(&last.velocities).all(|v| *v == 0.0), "from rest to rest");
            (first.positions.clone(), last.positions.clone())
        };
        let (start, grasp) = ends(&plan.approach);
        let (taken, put) = ends(&plan.trajectory);
        let (left, end) = ends(&plan.retreat);
        assert_eq!((&start[..], &grasp, &put), (&joints[..6], &taken, &left), "each part begins where one ended");

        let mut check = Check::new(grip_open);
        let target = &scene.target;
        // To it: the fingers come about it, and nothing else of the robot touches it.
        let mut to_it = around(&scene);
        let stands = upright(TRAY.at_m.x, TRAY.at_m.y, 0.0, target, TRAY.yaw_rad);
        to_it.add(Obstacle { name: "vase".into(), solid: solid(target), root_from_solid: stands });
        let is_hand = |name: &str| check.is_hand(name);
        let names: Vec<String> = check.robot.links.iter().map(|link| link.name.clone()).collect();
        let hand: Vec<String> = names.into_iter().filter(|name| is_hand(name)).collect();
        let fingers = |a: &str, b: &str| b == "vase" && hand.iter().any(|name| name == a);
        assert_eq!(check.touches(&plan.approach, &to_it, fingers), [], "{shape:?} on the way to it");
        // With it, held as it stood: what it stands on it may touch at first, as it hangs a little above its place at last.
        let mut with_it = around(&scene);
        let tool_from_solid = check.tool(&grasp).inverse() * stands;
        let placed = Placed { solid: solid(target), owner_from_solid: tool_from_solid };
        with_it.hold("vase", check.chain.tool, placed, check.hand.clone());
        assert_eq!(
            check.touches(&plan.trajectory, &with_it, |a, b| (a, b) == ("vase", "table")),
            [],
            "{shape:?} with it"
        );
        // It ends upright, over its place.
        let ends_at = check.tool(&put) * tool_from_solid;
        let place = plan.robust_placement_m.unwrap();
        let base = ends_at.translation.vector - Vector3::new(0.0, 0.0, target.shape.height_m() / 2.0);
        let above_m = MotionSettings::default().release_m;
        assert!((base - Vector3::new(place.x, place.y, above_m)).norm() < 1e-4, "{shape:?}: {base} for {place:?}");
        assert!((ends_at.rotation * Vector3::z() - Vector3::z()).norm() < 1e-4);
        // Away from it: it stands, and again only the fingers may touch it.
        let mut away = around(&scene);
        let mut rests = ends_at;
        rests.translation.vector.z -= above_m;
        away.add(Obstacle { name: "vase".into(), solid: solid(target), root_from_solid: rests });
        assert_eq!(check.touches(&plan.retreat, &away, fingers), [], "{shape:?} on the way from it");
        let risen_m = check.tool(&end).translation.z - check.tool(&left).translation.z;
        assert!(risen_m > 0.0299, "{shape:?}: the hand rises by {risen_m} m");
    }
}

#[test]
fn a_box_is_taken_across_its_narrow_side() {
    for (shape, along_x) in [(things()[2], false), (things()[3], true)] {
        let scene = Scene { target: Object { shape, ..object("box", 0.0, 0.0) }, ..flowers() };
        let plan = planned(&scene, &Source::Stands(TRAY));
        assert_eq!(plan.outcome, PlanOutcome::Planned, "{}", plan.reason);
        let check = Check::new(plan.grip.unwrap()[0]);
        let closes = check.tool(&plan.approach.points.last().unwrap().positions).rotation * Vector3::y();
        let long = about_z(TRAY.yaw_rad) * if along_x { Vector3::x() } else { Vector3::y() };
        assert!(closes.dot(&long).abs() < 1e-4, "the fingers close across the long side");
    }
}

#[test]
fn the_same_plan_comes_from_the_same_question() {
    let scene = flowers();
    let source = Source::Stands(TRAY);
    let (one, two) = (planned(&scene, &source), planned(&scene, &source));
    assert_eq!((&one.approach, &one.trajectory, &one.retreat), (&two.approach, &two.trajectory, &two.retreat));
    assert!(one.approach.points.len() > 10 && one.retreat.points.len() > 5);
}

#[test]
fn what_cannot_be_picked_up_leaves_the_places_standing() {
    let scene = flowers();
    let unknown = planned(&scene, &Source::Unknown);
    assert_eq!(unknown.outcome, PlanOutcome::CannotPick);
    assert!(unknown.robust_placement_m.is_some() && unknown.trajectory.points.is_empty());
    assert!(unknown.reason.contains("nothing is heard of where"), "{}", unknown.reason);
    // Beside a wall of cups there is no room for the fingers.
    let cup = |i: u32, x: f64, y: f64| Object { shape: scene.target.shape, ..object(&format!("c{i}"), x, y) };
    let (x, y) = (0.5, 0.3);
    let ring = (0..6).map(|i| {
        let angle = f64::from(i) * std::f64::consts::FRAC_PI_3;
        cup(i, x + 0.108 * angle.cos(), y + 0.108 * angle.sin())
    });
    let crowded = Scene { objects: ring.collect(), ..scene.clone() };
    let stand = Stand { at_m: Point::new(x, y), base_m: 0.0, yaw_rad: 0.0 };
    let settings = MotionSettings { gripper: Some(gripper()), ..MotionSettings::default() };
    let mut planner = Planner::new(settings);
    planner.set_robot(TABLE_ARM).unwrap();
    let weights: Vec<f64> = vec![0.0; scene::Rbf::names(&crowded).len()];
    let batch = LossBatch { draws: &[], n_features: weights.len(), map_weights: &weights, threads: 1 };
    let plan = planner.plan_from(&crowded, &batch, 0.95, &home(), &Source::Stands(stand));
    assert_eq!(plan.outcome, PlanOutcome::CannotPick, "{}", plan.reason);
    assert!(plan.reason.contains("would touch"), "{}", plan.reason);
}

#[test]
fn the_hand_goes_over_a_tall_thing_and_not_through_it() {
    let mut check = Check::new(0.05);
    let joints: Vec<f64> = home().iter().map(|(_, at)| *at).collect();
    let tool = check.tool(&joints[..6]).translation.vector;
    // So tall and so near that the straight way to over it would push it away.
    let shape = Shape::Cylinder { radius_m: 0.03, height_m: tool.z + 0.12 };
    let scene = Scene { target: Object { shape, ..object("vase", 0.0, 0.0) }, ..flowers() };
    let stand = Stand { at_m: Point::new(tool.x + 0.17, tool.y), base_m: 0.0, yaw_rad: 0.0 };
    let plan = planned(&scene, &Source::Stands(stand));
    assert_eq!(plan.outcome, PlanOutcome::Planned, "{}", plan.reason);
    check.finger = plan.grip.unwrap()[0];
    let mut world = around(&scene);
    let root_from_solid = upright(stand.at_m.x, stand.at_m.y, 0.0, &scene.target, 0.0);
    world.add(Obstacle { name: "vase".into(), solid: solid(&scene.target), root_from_solid });
    let points = &plan.approach.points;
    let above = |positions: &[f64]| {
        let at = check.tool(positions).translation.vector;
        (at.x - stand.at_m.x).hypot(at.y - stand.at_m.y) < 2e-3
    };
    let down = points.iter().position(|point| above(&point.positions)).unwrap();
    let over = Trajectory { points: points[..=down].to_vec(), ..plan.approach.clone() };
    assert!(down > 5 && down + 5 < points.len());
    assert_eq!(check.touches(&over, &world, |_, _| false), [], "before the hand comes down on it");
}
