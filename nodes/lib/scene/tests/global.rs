//! Branch and bound: what it proves holds on every table that was tried, and the quick search agrees with it.

use proptest::prelude::{ProptestConfig, Strategy, prop_assert, prop_assert_eq, proptest};
use scene::{Field, Grid, Object, Point, Rbf, Scene, Shape, best_placement, global_placement};

fn objects() -> impl Strategy<Value = Vec<Object>> {
    let one = (0.0..1.0_f64, 0.0..1.0_f64, 0.02..0.15_f64, 0.02..0.3_f64, 0.0..3.1_f64, proptest::bool::ANY);
    proptest::collection::vec(one, 0..10).prop_map(|all| {
        let object = |(i, (x, y, a, b, yaw_rad, round)): (usize, (f64, f64, f64, f64, f64, bool))| Object {
            id: format!("o{i}"),
            label: format!("o{i}"),
            shape: if round {
                Shape::Cylinder { radius_m: a, height_m: 0.1 }
            } else {
                Shape::Box { width_m: a, depth_m: b, height_m: 0.1 }
            },
            position_m: Point::new(x, y),
            yaw_rad,
            supports: false,
        };
        all.into_iter().enumerate().map(object).collect()
    })
}

fn tables() -> impl Strategy<Value = (Scene, Vec<f64>)> {
    (objects(), 0.5..2.0_f64, 0.02..0.12_f64).prop_flat_map(|(objects, depth_m, radius_m)| {
        let n = objects.len() + 9;
        let scene = Scene {
            id: "table".into(),
            frame: "table".into(),
            width_m: 1.0,
            depth_m,
            objects: objects
                .into_iter()
                .map(|o| Object { position_m: Point::new(o.position_m.x, o.position_m.y * depth_m), ..o })
                .collect(),
            target: Object {
                id: "target".into(),
                label: "target".into(),
                shape: Shape::Cylinder { radius_m, height_m: 0.1 },
                position_m: Point::default(),
                yaw_rad: 0.0,
                supports: false,
            },
        };
        proptest::collection::vec(-1.0..1.0_f64, n).prop_map(move |w| (scene.clone(), w))
    })
}

const TOLERANCE: f64 = 1e-6;

proptest! {
    #![proptest_config(ProptestConfig { cases: 200, ..ProptestConfig::default() })]
    #[test]
    fn nothing_free_is_above_what_it_proves((scene, w) in tables()) {
        let rbf = Rbf::new(&scene);
        let grid = Grid::midpoints(200);
        let occupied = scene.occupied();
        let free = (0..grid.n()).map(|i| grid.at(i)).filter(|&at| occupied.is_free(scene.metres(at)));
        let seen = free.map(|at| rbf.reward(&w, at)).reduce(f64::max);
        let size: f64 = w.iter().map(|w| w.abs()).sum();
        match global_placement(&scene, &w, TOLERANCE) {
            None => prop_assert_eq!(seen, None),
            Some(best) => {
                prop_assert!(occupied.is_free(best.at_m), "{:?}", best);
                prop_assert!((rbf.reward(&w, scene.normalised(best.at_m)) - best.reward).abs() < 1e-12);
                prop_assert!(best.gap <= TOLERANCE * size, "{:?}", best);
                prop_assert!(seen.is_none_or(|seen| seen <= best.reward + best.gap), "{:?} {:?}", seen, best);
            }
        }
    }
}

/// The quick search, a grid of 32 × 32 and a climb, is what judges thousands of draws. It misses free places narrower than
/// its cells, which these tables, far fuller than a laid one, have: 8 of 400.
#[test]
fn the_quick_search_finds_the_proved_optimum_but_for_crevices() {
    use proptest::strategy::ValueTree;
    use proptest::test_runner::{Config, TestRunner};
    let mut runner = TestRunner::new_with_rng(
        Config::default(),
        proptest::test_runner::TestRng::deterministic_rng(proptest::test_runner::RngAlgorithm::ChaCha),
    );
    let (mut tables_seen, mut missed, mut worst): (u32, u32, f64) = (0, 0, 0.0);
    while tables_seen < 400 {
        let (scene, w) = tables().new_tree(&mut runner).expect("tables can be made").current();
        let rbf = Rbf::new(&scene);
        let field = Field::new(&rbf, &Grid::midpoints(32), Some(&scene));
        let Some(quick) = best_placement(&scene, &rbf, &field, &w, &mut Vec::new()) else { continue };
        let size: f64 = w.iter().map(|w| w.abs()).sum();
        let proved = global_placement(&scene, &w, TOLERANCE).expect("the quick search found a free place");
        let loss = (proved.reward - quick.reward) / size;
        assert!(loss > -TOLERANCE, "the quick search is above what was proved: {loss}");
        tables_seen += 1;
        missed += u32::from(loss > TOLERANCE);
        worst = worst.max(loss);
    }
    println!("missed in {missed} of {tables_seen} tables, by at most {worst:.2e} of Σ|w|");
    assert!(missed <= 12, "missed in {missed} of {tables_seen}");
}

#[test]
fn a_table_that_is_full_has_no_optimum() {
    let mut scene = Scene {
        id: "full".into(),
        frame: "table".into(),
        width_m: 1.0,
        depth_m: 1.0,
        objects: Vec::new(),
        target: Object {
            id: "target".into(),
            label: "target".into(),
            shape: Shape::Cylinder { radius_m: 0.6, height_m: 0.1 },
            position_m: Point::default(),
            yaw_rad: 0.0,
            supports: false,
        },
    };
    assert_eq!(global_placement(&scene, &[1.0; 9], TOLERANCE), None);
    scene.target.shape = Shape::Cylinder { radius_m: 0.1, height_m: 0.1 };
    scene.objects.push(Object {
        id: "tray".into(),
        label: "tray".into(),
        shape: Shape::Box { width_m: 0.95, depth_m: 0.95, height_m: 0.1 },
        position_m: Point::new(0.5, 0.5),
        ..scene.target.clone()
    });
    assert_eq!(global_placement(&scene, &[1.0; 10], TOLERANCE), None);
}
