//! Hypothetical tables: each is the table of the last demonstration with one object moved.

use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use scene::{Object, Point, Scene};

/// Places tried for one object before another object is chosen to move.
const TRIES: usize = 100;
/// Tables drawn for one candidate before it is given up.
const REDRAWS: usize = 20;
/// Space kept between two objects, metres.
const GAP_M: f64 = 0.01;

/// At most `n` tables, each `base` with one object, drawn at random, moved to a place drawn uniformly from those where it
/// is whole on the table and clear of the others, and where the table is `sensible`. Tables that are not sensible are
/// drawn again, a limited number of times. Fewer when the table has no room; none when it has no objects.
///
/// A function of the arguments alone; `revision` keeps the tables of different questions of one lesson apart.
pub fn candidates(base: &Scene, n: usize, seed: u64, revision: u64, sensible: impl Fn(&Scene) -> bool) -> Vec<Scene> {
    let mut rng = ChaCha8Rng::seed_from_u64(seed);
    rng.set_stream(revision);
    if base.objects.is_empty() {
        return Vec::new();
    }
    let mut scenes = Vec::with_capacity(n);
    for i in 0..n {
        for _ in 0..REDRAWS {
            let moved = (0..base.objects.len()).find_map(|_| {
                let which = rng.random_range(0..base.objects.len());
                Some((which, free_place(base, which, &mut rng)?))
            });
            let Some((which, position_m)) = moved else { break };
            let mut scene = base.clone();
            scene.id = format!("r{revision}-{i}");
            scene.objects[which].position_m = position_m;
            if sensible(&scene) {
                scenes.push(scene);
                break;
            }
        }
    }
    scenes
}

fn free_place(base: &Scene, which: usize, rng: &mut ChaCha8Rng) -> Option<Point> {
    let radius_m = base.objects[which].shape.bounding_radius_m();
    let range = |extent_m: f64| (extent_m > 2.0 * radius_m).then_some(radius_m..=extent_m - radius_m);
    let (x, y) = (range(base.width_m)?, range(base.depth_m)?);
    (0..TRIES).find_map(|_| {
        let at = Point::new(rng.random_range(x.clone()), rng.random_range(y.clone()));
        let clear = |other: &Object| other.distance_m(at) >= radius_m + GAP_M;
        base.objects.iter().enumerate().all(|(i, other)| i == which || clear(other)).then_some(at)
    })
}

#[cfg(test)]
mod tests {
    use super::{GAP_M, candidates};
    use proptest::prelude::{any, prop_assert, prop_assert_eq, proptest};
    use scene::{Object, Point, Scene, Shape};

    fn base(radius_m: f64) -> Scene {
        let object = |id: String, x: f64, y: f64| Object {
            label: id.clone(),
            id,
            shape: Shape::Cylinder { radius_m, height_m: 0.1 },
            position_m: Point::new(x, y),
            yaw_rad: 0.0,
            supports: false,
        };
        let at = [(0.25, 0.75), (0.75, 0.75), (0.25, 0.25), (0.75, 0.25)];
        Scene {
            id: "base".into(),
            frame: "table".into(),
            width_m: 1.0,
            depth_m: 1.0,
            objects: at.iter().enumerate().map(|(i, &(x, y))| object(format!("plate_{i}"), x, y)).collect(),
            target: object("vase".into(), 0.0, 0.0),
        }
    }

    proptest! {
        #[test]
        fn one_object_moves_and_stays_whole_and_clear(seed in any::<u64>(), revision in 0..1000_u64) {
            let base = base(0.06);
            let scenes = candidates(&base, 50, seed, revision, |_| true);
            prop_assert_eq!(scenes.len(), 50);
            for scene in &scenes {
                prop_assert!(scene.check().is_ok());
                let moved: Vec<_> = (0..4).filter(|&i| scene.objects[i] != base.objects[i]).collect();
                prop_assert_eq!(moved.len(), 1);
                let at = scene.objects[moved[0]].position_m;
                prop_assert!(at.x >= 0.06 && at.x <= 0.94 && at.y >= 0.06 && at.y <= 0.94);
                for i in (0..4).filter(|&i| i != moved[0]) {
                    prop_assert!(scene.objects[i].distance_m(at) >= 0.06 + GAP_M);
                }
            }
        }
    }

    #[test]
    fn the_same_arguments_give_the_same_tables_and_another_revision_others() {
        let base = base(0.06);
        assert_eq!(candidates(&base, 50, 3, 7, |_| true), candidates(&base, 50, 3, 7, |_| true));
        assert_ne!(candidates(&base, 50, 3, 7, |_| true)[0].objects, candidates(&base, 50, 3, 8, |_| true)[0].objects);
        assert_ne!(candidates(&base, 50, 3, 7, |_| true)[0].objects, candidates(&base, 50, 4, 7, |_| true)[0].objects);
    }

    #[test]
    fn a_table_without_room_gives_none() {
        assert!(candidates(&base(0.6), 50, 1, 1, |_| true).is_empty());
        let mut empty = base(0.06);
        empty.objects.clear();
        assert!(candidates(&empty, 50, 1, 1, |_| true).is_empty());
    }

    #[test]
    fn tables_that_are_not_sensible_are_drawn_again() {
        let left = |scene: &Scene| scene.objects.iter().all(|object| object.position_m.x < 0.8);
        let scenes = candidates(&base(0.06), 50, 1, 1, left);
        assert_eq!(scenes.len(), 50);
        assert!(scenes.iter().all(left));
        assert!(candidates(&base(0.06), 50, 1, 1, |_| false).is_empty());
    }

    #[test]
    fn places_are_uniform_over_the_table() {
        let mut lonely = base(0.05);
        lonely.objects.truncate(1);
        let scenes = candidates(&lonely, 20_000, 1, 1, |_| true);
        let mean = scenes.iter().map(|s| s.objects[0].position_m.x).sum::<f64>() / 20_000.0;
        let left = scenes.iter().filter(|s| s.objects[0].position_m.x < 0.05 + 0.9 / 4.0).count() as f64 / 20_000.0;
        assert!((mean - 0.5).abs() < 5.0 * 0.26 / 20_000_f64.sqrt(), "{mean}");
        assert!((left - 0.25).abs() < 5.0 * 0.433 / 20_000_f64.sqrt(), "{left}");
    }
}
