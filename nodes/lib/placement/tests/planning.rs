//! Plans: trajectories re-checked independently, the reach map against brute force, and every outcome with its reason.
#![allow(clippy::unwrap_used, reason = "a test may panic")]

mod common;

use arm::{
    AxisGoal, Chain, Checker, CollisionModel, Exclusions, Goal, IkOutcome, IkSettings, Isometry3, Placed, Robot,
    Translation3, Vector3, World, about_z, solid_distance, solve,
};
use common::{TABLE_ARM, around, flowers, home, object, posterior, solid, wall};
use placement::{CellState, LossBatch, MAP_SIDE, Manipulator, MotionSettings, PlanOutcome, Planner, ReachMap};
use scene::{Grid, Object, Point, Rbf, Scene, Shape};
use std::sync::Arc;

fn planner() -> Planner {
    let mut planner = Planner::new(MotionSettings::default());
    planner.set_robot(TABLE_ARM).unwrap();
    planner
}

fn batch<'a>(draws: &'a [f32], map: &'a [f64]) -> LossBatch<'a> {
    LossBatch { draws, n_features: map.len(), map_weights: map, threads: 1 }
}

/// The world of a scene, built here once more; the frame "table" is the robot's root.
fn world(robot: &Robot, chain: &Chain, scene: &Scene) -> World {
    let mut world = around(scene);
    let height = scene.target.shape.height_m();
    let below = height - 0.03_f64.min(height / 2.0) - height / 2.0;
    let placed = Placed { solid: solid(&scene.target), owner_from_solid: Isometry3::translation(0.0, 0.0, below) };
    world.hold("target", chain.tool, placed, chain.hand(robot));
    world
}

fn checker(robot: &Robot) -> Checker {
    let model = CollisionModel::new(robot, &Exclusions::derived(robot, 1));
    Checker::new(Arc::new(robot.clone()), Arc::new(model))
}

/// Re-checks a trajectory: starts where the arm is, ends at rest with the target over its place, keeps the limits of
/// speed, and touches nothing on straight lines and on cubics between its points.
fn check_trajectory(scene: &Scene, plan: &placement::PlacementPlan, joints: &[(String, f64)], base_m: f64) {
    let robot = Robot::from_urdf(TABLE_ARM).unwrap();
    let chain = Chain::new(&robot, "tool0").unwrap();
    let mut checker = checker(&robot);
    let world = world(&robot, &chain, scene);
    let start: Vec<f64> = joints.iter().map(|(_, position)| *position).collect();
    let points = &plan.trajectory.points;
    let names: Vec<&str> = chain.joint_names(&robot).collect();
    assert_eq!(plan.trajectory.joint_names, names);
    assert!(points.len() > 10);
    assert_eq!(points[0].time_from_start_s, 0.0);
    assert!(points[0].positions.iter().zip(&start).all(|(a, b)| (a - b).abs() < 1e-12));
    let last = points.last().unwrap();
    assert!(points[0].velocities.iter().chain(&last.velocities).all(|v| *v == 0.0));
    let mut q = start.clone();
    let mut tool_at = |positions: &[f64]| {
        q[..6].copy_from_slice(positions);
        let contact = checker.first_contact(&q, &world, 0.0);
        let names = contact.map(|c| (c.a.name(&robot, &world).to_owned(), c.b.name(&robot, &world).to_owned()));
        (chain.tool_pose(&q), names)
    };
    for pair in points.windows(2) {
        let dt = pair[1].time_from_start_s - pair[0].time_from_start_s;
        assert!(dt > 0.0);
        for j in 0..6 {
            let limit = robot.driven_joint(j).limits;
            let (a, b) = (pair[0].positions[j], pair[1].positions[j]);
            assert!(a >= limit.lower - 1e-9 && a <= limit.upper + 1e-9);
            assert!(((b - a) / dt).abs() <= limit.velocity, "joint {j}: {} in {dt}", b - a);
            assert!(pair[0].velocities[j].abs() <= limit.velocity * 0.6 + 1e-9);
            // Full speed after 0.4 s: 4v/3T and 16v/3T².
            let most = 4.0 * 0.6 * limit.velocity.min(10.0) / (3.0 * 0.4);
            assert!(pair[0].accelerations[j].abs() <= most + 1e-6);
            let jerk = (pair[1].accelerations[j] - pair[0].accelerations[j]) / dt;
            assert!(jerk.abs() <= most * 4.0 / 0.4 + 1e-3, "joint {j}: jerk {jerk}");
        }
        for i in 0..10 {
            let s = f64::from(i) / 10.0;
            let line: Vec<f64> = (0..6).map(|j| pair[0].positions[j] * (1.0 - s) + pair[1].positions[j] * s).collect();
            assert_eq!(tool_at(&line).1, None, "at {} s", pair[0].time_from_start_s);
            let (h00, h10) = ((1.0 + 2.0 * s) * (1.0 - s) * (1.0 - s), s * (1.0 - s) * (1.0 - s));
            let (h01, h11) = (s * s * (3.0 - 2.0 * s), s * s * (s - 1.0));
            let cubic: Vec<f64> = (0..6)
                .map(|j| {
                    h00 * pair[0].positions[j]
                        + h10 * dt * pair[0].velocities[j]
                        + h01 * pair[1].positions[j]
                        + h11 * dt * pair[1].velocities[j]
                })
                .collect();
            assert_eq!(tool_at(&cubic).1, None, "cubic at {} s", pair[0].time_from_start_s);
        }
    }
    let (tool, contact) = tool_at(&last.positions);
    assert_eq!(contact, None);
    let height = scene.target.shape.height_m();
    let Point { x, y } = plan.robust_placement_m.unwrap();
    let expected = Vector3::new(x, y, base_m + height - 0.03_f64.min(height / 2.0));
    assert!((tool.translation.vector - expected).norm() < 1e-5, "{} {expected}", tool.translation.vector);
    assert!((tool.rotation * Vector3::z() + Vector3::z()).norm() < 1e-5);
}

#[test]
fn flowers_plan_is_reached_from_above_without_touching_anything() {
    let scene = flowers();
    let (draws, map) = posterior(200, 0.05, 1);
    let plan = planner().plan(&scene, &batch(&draws, &map), 0.95, &home());
    assert_eq!(plan.outcome, PlanOutcome::Planned, "{}", plan.reason);
    assert!(plan.reason.starts_with("the arm puts 'thing' at (0."), "{}", plan.reason);
    assert!(plan.map_placement_m.unwrap().distance(Point::new(0.5, 0.5)) < 0.01);
    assert!(plan.robust_cvar_m <= plan.map_cvar_m);
    check_trajectory(&scene, &plan, &home(), 0.006);
    // The last part goes straight down: the tool stays within a millimetre of the vertical.
    let robot = Robot::from_urdf(TABLE_ARM).unwrap();
    let place = plan.robust_placement_m.unwrap();
    let mut low = 0;
    for point in plan.trajectory.points.iter().rev() {
        let mut q = point.positions.clone();
        q.push(0.05);
        let mut poses = Vec::new();
        robot.link_poses(&q, &mut poses);
        let tool = poses[robot.link_index("tool0").unwrap()].translation.vector;
        if tool.z > 0.006 + 0.17 + 0.1 {
            break;
        }
        low += 1;
        assert!(Point::new(tool.x, tool.y).distance(place) < 1e-3, "{tool}");
    }
    assert!(low > 10);
}

#[test]
fn a_wall_is_gone_around() {
    let scene = wall();
    let (draws, map) = posterior(50, 0.0, 1);
    // The table's middle is behind the wall.
    let plan = planner().plan(&scene, &batch(&draws, &map), 0.9, &home());
    assert_eq!(plan.outcome, PlanOutcome::Planned, "{}", plan.reason);
    check_trajectory(&scene, &plan, &home(), 0.006);
    // Around a corner it does not rest: only at the start, over the place and on it.
    let rests = plan.trajectory.points.iter().filter(|point| point.velocities.iter().all(|v| *v == 0.0)).count();
    assert_eq!(rests, 3);
}

#[test]
fn a_spoon_is_put_onto_the_bowl() {
    let mut scene = flowers();
    scene.objects[0].shape = Shape::Cylinder { radius_m: 0.08, height_m: 0.06 };
    scene.objects[0].supports = true;
    scene.target.shape = Shape::Box { width_m: 0.15, depth_m: 0.03, height_m: 0.02 };
    let mut map = vec![0.0; 13];
    map[0] = 1.0;
    let draws: Vec<f32> = map.iter().map(|&w| w as f32).collect();
    let plan = planner().plan(&scene, &batch(&draws, &map), 0.9, &home());
    assert_eq!(plan.outcome, PlanOutcome::Planned, "{}", plan.reason);
    assert!(plan.robust_placement_m.unwrap().distance(scene.objects[0].position_m) < 1e-6);
    check_trajectory(&scene, &plan, &home(), 0.06 + 0.006);
}

#[test]
fn plans_repeat_and_do_not_depend_on_what_was_planned_before() {
    let scene = flowers();
    let (draws, map) = posterior(60, 0.1, 2);
    let one = planner().plan(&scene, &batch(&draws, &map), 0.95, &home());
    let mut used = planner();
    used.plan(&wall(), &batch(&draws, &map), 0.9, &[]);
    let two = used.plan(&scene, &batch(&draws, &map), 0.95, &home());
    let threads = LossBatch { threads: 2, ..batch(&draws, &map) };
    let three = used.plan(&scene, &threads, 0.95, &home());
    assert_eq!(format!("{one:?}"), format!("{two:?}"));
    assert_eq!(format!("{one:?}"), format!("{three:?}"));
}

#[test]
fn reach_map_is_what_brute_force_finds() {
    let scene = flowers();
    let manipulator = Manipulator::from_urdf(TABLE_ARM, MotionSettings::default()).unwrap();
    let map = ReachMap::new(&manipulator, &scene, MAP_SIDE).unwrap();
    let (robot, grid) = (manipulator.robot(), Grid::midpoints(MAP_SIDE));
    let chain = Chain::new(robot, "tool0").unwrap();
    let mut checker = checker(robot);
    let empty = Scene { objects: Vec::new(), ..scene.clone() };
    let (world, occupied) = (world(robot, &chain, &empty), empty.occupied());
    let inside = (0..grid.n()).filter(|&i| occupied.is_free(scene.metres(grid.at(i)))).count();
    // Most of the table, not the far corners.
    assert!(map.n_reachable() * 100 > inside * 85 && map.n_reachable() < inside, "{} of {inside}", map.n_reachable());
    assert!(map.configuration(31 * 32 + 31).is_none());
    let (mut in_reach, mut out) = (0, 0);
    // Every cell that the map leaves out, and one in seven of the others.
    for i in (0..grid.n()).filter(|&i| i % 7 == 0 || map.configuration(i).is_none()) {
        let at = scene.metres(grid.at(i));
        if !occupied.is_free(at) {
            assert!(map.configuration(i).is_none());
            continue;
        }
        // Many more starts than the map used, from another seed.
        let goal = |base: f64| {
            let position = Vector3::new(at.x, at.y, base + 0.17);
            Goal::Axis(AxisGoal { position, direction: -Vector3::z_axis() })
        };
        let ik = IkSettings { restarts: 100, seed: 99, ..IkSettings::default() };
        let found = solve(robot, &chain, &goal(0.006), &robot.rest(), &ik, |q| {
            if !checker.is_free(q, &world, 0.003) {
                return false;
            }
            let above = IkSettings { restarts: 0, ..ik };
            let IkOutcome::Solved(up) = solve(robot, &chain, &goal(0.036), q, &above, |_| true) else { return false };
            checker.is_free(&up, &world, 0.003)
        });
        let found = matches!(found, IkOutcome::Solved(_));
        assert_eq!(map.configuration(i).is_some(), found, "cell {i} at {at:?}");
        if found { in_reach += 1 } else { out += 1 }
    }
    assert!(in_reach > 80 && out > 10, "{in_reach} {out}");
}

#[test]
fn the_risk_averse_placement_is_at_the_mode_or_between_as_the_analysis_says() {
    // Two supporting things 0.5 m apart; 80 draws in 100 want the one, 20 the other.
    let mut scene = flowers();
    scene.objects = vec![object("a", 0.25, 0.5), object("b", 0.75, 0.5)];
    for object in &mut scene.objects {
        object.supports = true;
    }
    let mut draws = vec![0.0_f32; 100 * 11];
    for i in 0..100 {
        draws[11 * i + usize::from(i % 5 == 4)] = 1.0;
    }
    let mut map = vec![0.0; 11];
    map[0] = 1.0;
    let mut planner = Planner::new(MotionSettings::default());
    let mut at = |alpha| planner.plan(&scene, &batch(&draws, &map), alpha, &[]);
    // At (1−t, t) of the way, t < ½: CVaR_½ = 2 (0.2 (1−t) + 0.3 t) 0.5 m, least at the mode, t = 0.
    let half = at(0.5);
    assert_eq!(half.outcome, PlanOutcome::NoRobot);
    assert_eq!(half.reason, "no robot description has been received");
    assert!(half.robust_placement_m.unwrap().distance(Point::new(0.25, 0.5)) < 1e-6, "{:?}", half.robust_placement_m);
    assert!((half.robust_cvar_m - 0.2).abs() < 1e-6, "{}", half.robust_cvar_m);
    // The worst tenth is the farther of the two: least half way, 0.25 m. The MAP placement risks 0.5 m.
    let tenth = at(0.9);
    assert!(tenth.robust_placement_m.unwrap().distance(Point::new(0.5, 0.5)) < 2e-3, "{:?}", tenth.robust_placement_m);
    assert!((tenth.robust_cvar_m - 0.25).abs() < 2e-3, "{}", tenth.robust_cvar_m);
    assert!((tenth.map_cvar_m - 0.5).abs() < 1e-6, "{}", tenth.map_cvar_m);
}

#[test]
fn out_of_reach_the_next_best_place_is_taken_and_said() {
    let scene = flowers();
    // Only the far right corner counts.
    let mut map = vec![0.0; 13];
    map[4 + 2] = 1.0;
    let draws: Vec<f32> = map.iter().map(|&w| w as f32).collect();
    let plan = planner().plan(&scene, &batch(&draws, &map), 0.9, &home());
    assert_eq!(plan.outcome, PlanOutcome::Planned, "{}", plan.reason);
    assert!(plan.reason.contains("the best place, (0.950, 0.950) m, is out of the arm's reach"), "{}", plan.reason);
    let corner = Point::new(0.95, 0.95);
    assert!(plan.map_placement_m.unwrap().distance(corner) > 0.01);
    // No cell in reach is better under the MAP reward, and none is nearer to what every draw wants.
    let (rbf, grid) = (Rbf::new(&scene), Grid::midpoints(MAP_SIDE));
    let chosen = rbf.reward(&map, scene.normalised(plan.map_placement_m.unwrap()));
    for (i, &state) in plan.cell_state.iter().enumerate() {
        let at = grid.at(i);
        if state == CellState::Free {
            assert!(rbf.reward(&map, at) <= chosen);
            assert!(scene.metres(at).distance(corner) >= plan.robust_cvar_m - 1e-9);
        }
        assert_eq!(state == CellState::Occupied, !scene.occupied().is_free(scene.metres(at)));
    }
    assert!(plan.cell_state.contains(&CellState::Unreachable));
    check_trajectory(&scene, &plan, &home(), 0.006);
}

#[test]
fn every_other_outcome_has_its_reason() {
    let (draws, map) = posterior(20, 0.05, 3);
    // A target wider than the table.
    let mut scene = flowers();
    scene.target.shape = Shape::Cylinder { radius_m: 0.6, height_m: 0.1 };
    let plan = planner().plan(&scene, &batch(&draws, &map), 0.9, &home());
    assert_eq!(plan.outcome, PlanOutcome::NoFreePlace);
    assert_eq!(plan.reason, "there is no free place for 'thing' on the table");
    assert!(plan.robust_placement_m.is_none() && plan.trajectory.points.is_empty());
    assert!(plan.cell_state.iter().all(|&state| state == CellState::Occupied));
    // A target higher than the arm.
    let mut scene = flowers();
    scene.target.shape = Shape::Cylinder { radius_m: 0.05, height_m: 2.0 };
    let plan = planner().plan(&scene, &batch(&draws, &map), 0.9, &home());
    assert_eq!(plan.outcome, PlanOutcome::Unreachable);
    assert_eq!(plan.reason, "the arm reaches none of the free places for 'thing'");
    assert!(plan.map_placement_m.is_some());
    // An arm that lies on the table.
    let mut joints = home();
    joints[1].1 = 1.5;
    joints[2].1 = 0.6;
    joints[4].1 = 0.5;
    let plan = planner().plan(&flowers(), &batch(&draws, &map), 0.9, &joints);
    assert_eq!(plan.outcome, PlanOutcome::StartInCollision);
    assert!(plan.reason.starts_with("where the arm is now, '") && plan.reason.contains("touches"), "{}", plan.reason);
    // A robot that is not at this table.
    let mut scene = flowers();
    scene.frame = "kitchen".into();
    let plan = planner().plan(&scene, &batch(&draws, &map), 0.9, &home());
    assert_eq!(plan.outcome, PlanOutcome::NoRobot);
    assert!(plan.reason.starts_with("the robot 'table_arm' has no fixed link 'kitchen'"), "{}", plan.reason);
    // A robot without the tool.
    let settings = MotionSettings { tool_link: "hook".into(), ..MotionSettings::default() };
    let error = Planner::new(settings).set_robot(TABLE_ARM).unwrap_err().to_string();
    assert!(error.starts_with("the robot has no link 'hook'"), "{error}");
}

#[test]
fn the_reward_map_is_the_mean_over_the_draws() {
    let (draws, map) = posterior(30, 0.2, 4);
    let scene = flowers();
    let plan = Planner::new(MotionSettings::default()).plan(&scene, &batch(&draws, &map), 0.9, &[]);
    let (rbf, grid) = (Rbf::new(&scene), Grid::midpoints(MAP_SIDE));
    for i in (0..grid.n()).step_by(37) {
        let mean: f64 = draws
            .chunks(13)
            .map(|w| rbf.reward(&w.iter().map(|&w| f64::from(w)).collect::<Vec<_>>(), grid.at(i)))
            .sum::<f64>()
            / 30.0;
        assert!((f64::from(plan.reward_map[i]) - mean).abs() < 1e-6);
    }
}

#[test]
fn free_places_are_free_of_the_solids_themselves() {
    // The bounding circle that decides about free places is on the safe side of parry's answer, and exact for cylinders.
    let mut scene = flowers();
    scene.objects[1].shape = Shape::Box { width_m: 0.3, depth_m: 0.1, height_m: 0.05 };
    scene.objects[1].yaw_rad = 0.7;
    let (occupied, grid) = (scene.occupied(), Grid::midpoints(64));
    let pose = |object: &Object, at: Point| {
        let up = Translation3::new(at.x, at.y, object.shape.height_m() / 2.0);
        Isometry3::from_parts(up, about_z(object.yaw_rad))
    };
    for i in 0..grid.n() {
        let at = scene.metres(grid.at(i));
        let gap = |object: &Object| {
            let (a, b) = (solid(object), solid(&scene.target));
            solid_distance(&a, &pose(object, object.position_m), &b, &pose(&scene.target, at))
        };
        let least = scene.objects.iter().map(gap).fold(f64::INFINITY, f64::min);
        match occupied.reason(at) {
            None => assert!(least > 0.0, "{at:?}"),
            Some(scene::Obstruction::Object { .. }) => assert!(least < 1e-6, "{at:?}: {least}"),
            Some(scene::Obstruction::Edge) => {}
        }
    }
}

#[test]
fn a_joint_that_crawls_or_an_endless_turn_does_not_stop_the_planner() {
    let slow = |limit: &str| {
        TABLE_ARM.replace(r#"effort="150" velocity="1.6""#, &format!(r#"effort="150" velocity="{limit}""#))
    };
    let (draws, map) = posterior(5, 0.0, 1);
    let mut planner = Planner::new(MotionSettings::default());
    let error = planner.set_robot(&slow("1e-11")).unwrap_err().to_string();
    assert!(error.contains("velocity limit 0.00000000001; at least 0.001"), "{error}");
    planner.set_robot(&slow("0.002")).unwrap();
    let plan = planner.plan(&flowers(), &batch(&draws, &map), 0.9, &home());
    assert_eq!(plan.outcome, PlanOutcome::Planned, "{}", plan.reason);
    assert!(plan.trajectory.points.len() <= 40_001, "{}", plan.trajectory.points.len());
    let endless = TABLE_ARM.replace(r#"name="wrist_roll" type="revolute""#, r#"name="wrist_roll" type="continuous""#);
    let mut joints = home();
    joints[5].1 = 1e300;
    planner.set_robot(&endless).unwrap();
    let plan = planner.plan(&flowers(), &batch(&draws, &map), 0.9, &joints);
    assert!(matches!(plan.outcome, PlanOutcome::Planned | PlanOutcome::OutsideLimits), "{}", plan.reason);
}

#[test]
fn a_larger_margin_releases_the_target_higher() {
    let (draws, map) = posterior(5, 0.0, 1);
    let mut planner = Planner::new(MotionSettings { margin_m: 0.02, ..MotionSettings::default() });
    planner.set_robot(TABLE_ARM).unwrap();
    let plan = planner.plan(&flowers(), &batch(&draws, &map), 0.9, &home());
    assert_eq!(plan.outcome, PlanOutcome::Planned, "{}", plan.reason);
    check_trajectory(&flowers(), &plan, &home(), 0.023);
}
