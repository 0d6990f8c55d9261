//! Placement losses against the plain search of `scene`, and their bits against the number of threads.
#![allow(clippy::unwrap_used, reason = "a test may panic")]

use placement::{LossBatch, placement_losses, placement_optima};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use scene::{Field, Grid, Object, Point, Rbf, Scene, Shape, best_placement};

fn object(id: usize, shape: Shape, x: f64, y: f64) -> Object {
    Object {
        id: format!("object {id}"),
        label: "thing".into(),
        shape,
        position_m: Point::new(x, y),
        yaw_rad: 0.3 * id as f64,
        supports: false,
    }
}

fn table(width_m: f64, depth_m: f64, target_radius_m: f64) -> Scene {
    let cup = Shape::Cylinder { radius_m: 0.05, height_m: 0.1 };
    let book = Shape::Box { width_m: 0.2, depth_m: 0.12, height_m: 0.03 };
    Scene {
        id: "table".into(),
        frame: "table".into(),
        width_m,
        depth_m,
        objects: vec![
            object(0, cup, 0.25 * width_m, 0.75 * depth_m),
            object(1, book, 0.72 * width_m, 0.7 * depth_m),
            object(2, cup, 0.3 * width_m, 0.3 * depth_m),
            object(3, cup, 0.75 * width_m, 0.25 * depth_m),
        ],
        target: object(9, Shape::Cylinder { radius_m: target_radius_m, height_m: 0.2 }, 0.0, 0.0),
    }
}

/// The base scene and, for every object, some with it moved; the last has all of them moved.
fn variants(base: &Scene, n: usize, rng: &mut ChaCha8Rng) -> Vec<Scene> {
    let mut scenes = vec![base.clone()];
    for i in 0..n {
        let mut scene = base.clone();
        let all = i + 1 == n;
        for (o, object) in scene.objects.iter_mut().enumerate() {
            if all || o == i % 4 {
                object.position_m = Point::new(base.width_m * rng.random::<f64>(), base.depth_m * rng.random::<f64>());
            }
        }
        scenes.push(scene);
    }
    scenes
}

fn draws(n: usize, spread: f64, rng: &mut ChaCha8Rng) -> Vec<f32> {
    let truth = [-0.1, -0.1, -0.1, -0.1, 0.0, 0.0, 0.0, 0.0, 0.6, 0.0, 0.0, 0.0, 0.0];
    (0..13 * n).map(|i| (truth[i % 13] + spread * (2.0 * rng.random::<f64>() - 1.0)) as f32).collect()
}

#[test]
fn optima_agree_with_the_plain_search_to_a_millimetre_or_lie_higher_on_an_outline() {
    // The plain search stops where its steps leave the free area; along an object's outline that is short of the top.
    let mut rng = ChaCha8Rng::seed_from_u64(3);
    let (mut n, mut in_the_open, mut lower) = (0, 0, 0);
    for (width, depth, radius) in [(1.0, 1.0, 0.05), (1.4, 0.7, 0.04)] {
        let scenes = variants(&table(width, depth, radius), 9, &mut rng);
        for spread in [0.03, 0.3] {
            let draws = draws(100, spread, &mut rng);
            let map: Vec<f64> = draws[..13].iter().map(|&w| f64::from(w)).collect();
            let batch = LossBatch { draws: &draws, n_features: 13, map_weights: &map, threads: 1 };
            let mut scratch = Vec::new();
            for (scene, found) in scenes.iter().zip(placement_optima(&scenes, &batch)) {
                let (of_map, tops) = found.unwrap();
                assert_eq!(of_map, tops[0], "the MAP weights are the first draw");
                let rbf = Rbf::new(scene);
                let field = Field::new(&rbf, &Grid::midpoints(32), Some(scene));
                let occupied = scene.occupied();
                for (w, &top) in draws.chunks(13).zip(&tops) {
                    let w: Vec<f64> = w.iter().map(|&w| f64::from(w)).collect();
                    let plain = best_placement(scene, &rbf, &field, &w, &mut scratch).unwrap();
                    assert!(occupied.is_free(top), "{top:?}: {:?}", occupied.reason(top));
                    let reward = rbf.reward(&w, scene.normalised(top));
                    let on_outline = |at| scene.objects.iter().any(|object| object.distance_m(at) < radius + 1e-3);
                    let outline = on_outline(top) || on_outline(scene.metres(plain.at));
                    let near = top.distance(scene.metres(plain.at)) < 1e-3;
                    assert!(near || outline, "{top:?} is not {:?}", scene.metres(plain.at));
                    n += 1;
                    in_the_open += usize::from(!outline);
                    lower += usize::from(!near && reward < plain.reward - 1e-6);
                }
            }
        }
    }
    assert!(in_the_open * 2 > n, "{in_the_open} of {n}");
    assert!(lower * 1000 <= n, "{lower} of {n} ended on a lower top of the same outline");
}

#[test]
fn losses_are_distances_in_metres_and_have_the_same_bits_for_any_number_of_threads() {
    let mut rng = ChaCha8Rng::seed_from_u64(4);
    let scenes = variants(&table(1.2, 0.8, 0.05), 12, &mut rng);
    let draws = draws(101, 0.2, &mut rng);
    let map = [0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0];
    let run =
        |threads| placement_losses(&scenes, &LossBatch { draws: &draws, n_features: 13, map_weights: &map, threads });
    let one = run(1);
    for threads in [2, 3, 200] {
        for (a, b) in one.iter().zip(run(threads)) {
            let (a, b) = (a.as_ref().unwrap(), b.unwrap());
            assert!(a.losses_m.iter().zip(&b.losses_m).all(|(a, b)| a.to_bits() == b.to_bits()));
        }
    }
    // The centre of the table is free in the base scene and the top of the MAP reward.
    let base = one[0].as_ref().unwrap();
    assert!(base.map_placement_m.distance(Point::new(0.6, 0.4)) < 1e-6, "{:?}", base.map_placement_m);
    assert_eq!(base.losses_m.len(), 101);
    // Each scene alone gives the same losses: sharing is not seen in the answer by more than rounding.
    for (scene, together) in scenes.iter().zip(&one) {
        let alone = placement_losses(
            std::slice::from_ref(scene),
            &LossBatch { draws: &draws, n_features: 13, map_weights: &map, threads: 1 },
        );
        for (a, b) in alone[0].as_ref().unwrap().losses_m.iter().zip(&together.as_ref().unwrap().losses_m) {
            assert!((a - b).abs() < 1e-3, "{a} {b}");
        }
    }
}

#[test]
fn a_reward_that_pulls_off_the_table_ends_at_the_corner() {
    let scene = table(1.0, 1.0, 0.05);
    // Only the far right fixed centre counts.
    let mut w = [0.0; 13];
    w[4 + 2] = 1.0;
    let draws: Vec<f32> = w.iter().map(|&w| w as f32).collect();
    let batch = LossBatch { draws: &draws, n_features: 13, map_weights: &w, threads: 1 };
    let (top, _) = placement_optima(&[scene], &batch)[0].clone().unwrap();
    assert_eq!(top, Point::new(0.95, 0.95));
}

#[test]
fn a_reward_for_an_object_ends_beside_it() {
    // The object's own centre is the top; the target must stand 0.1 m beside it, anywhere around.
    let mut scene = table(1.0, 1.0, 0.05);
    scene.objects[2].position_m = Point::new(0.5, 0.5);
    let mut w = [0.0; 13];
    w[2] = 1.0;
    w[4 + 5] = 0.3;
    let draws: Vec<f32> = w.iter().map(|&w| w as f32).collect();
    let batch = LossBatch { draws: &draws, n_features: 13, map_weights: &w, threads: 1 };
    let (top, _) = placement_optima(&[scene], &batch)[0].clone().unwrap();
    // A little is added on the right, at half the depth.
    assert!(top.distance(Point::new(0.6, 0.5)) < 1e-6, "{top:?}");
}

#[test]
fn a_full_table_has_no_losses() {
    let scene = table(1.0, 1.0, 0.6);
    let batch = LossBatch { draws: &[0.1; 26], n_features: 13, map_weights: &[0.1; 13], threads: 2 };
    assert_eq!(placement_losses(&[scene], &batch), [None]);
}

#[test]
fn weights_that_are_not_numbers_do_not_panic() {
    let scene = table(1.0, 1.0, 0.05);
    let batch = LossBatch { draws: &[f32::NAN; 13], n_features: 13, map_weights: &[f64::INFINITY; 13], threads: 1 };
    let losses = placement_losses(&[scene], &batch);
    assert_eq!(losses[0].as_ref().unwrap().losses_m.len(), 1);
}
