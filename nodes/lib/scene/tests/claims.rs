//! The flowers reward of the dissertation's table task, and what must hold of any scene.

use proptest::prelude::{Strategy, prop_assert, proptest};
use scene::{Field, Grid, Object, Obstruction, Point, Rbf, Scene, SceneError, Shape, best_placement};

fn object(id: &str, x: f64, y: f64, radius_m: f64) -> Object {
    Object {
        id: id.into(),
        label: id.into(),
        shape: Shape::Cylinder { radius_m, height_m: 0.1 },
        position_m: Point::new(x, y),
        yaw_rad: 0.0,
        supports: false,
    }
}

fn flowers(radius_m: f64) -> Scene {
    let at = [(0.25, 0.75), (0.75, 0.75), (0.25, 0.25), (0.75, 0.25)];
    Scene {
        id: "flowers".into(),
        frame: "table".into(),
        width_m: 1.0,
        depth_m: 1.0,
        objects: at.iter().enumerate().map(|(i, &(x, y))| object(&format!("plate_{i}"), x, y, radius_m)).collect(),
        target: object("vase", 0.0, 0.0, 0.04),
    }
}

fn flowers_weights() -> Vec<f64> {
    let mut w = vec![-0.1; 4];
    w.extend([0.0, 0.0, 0.0, 0.0, 0.6, 0.0, 0.0, 0.0, 0.0]);
    w
}

#[test]
fn flowers_reward_and_gradient_are_those_of_the_authors_program() {
    let rbf = Rbf::new(&flowers(0.05));
    let w = flowers_weights();
    assert!((rbf.reward(&w, Point::new(0.5, 0.5)) - 0.336_303_75).abs() < 5e-9);
    assert!((rbf.reward(&w, Point::new(0.2, 0.3)) - 0.185_411_08).abs() < 5e-9);
    let [gx, gy] = rbf.gradient(&w, Point::new(0.2, 0.3));
    assert!((gx - 0.527_630_47).abs() < 5e-9 && (gy - 0.356_312_37).abs() < 5e-9);
}

#[test]
fn flowers_belong_in_the_middle() {
    let scene = flowers(0.05);
    let rbf = Rbf::new(&scene);
    let field = Field::new(&rbf, &Grid::midpoints(64), Some(&scene));
    let best = best_placement(&scene, &rbf, &field, &flowers_weights(), &mut Vec::new()).expect("the table has room");
    assert!(best.at.distance(Point::new(0.5, 0.5)) < 1e-9, "{best:?}");
}

#[test]
fn a_reward_at_the_edge_is_followed_to_the_edge() {
    let scene = flowers(0.05);
    let rbf = Rbf::new(&scene);
    let field = Field::new(&rbf, &Grid::midpoints(64), Some(&scene));
    let mut w = vec![0.0; 13];
    w[5] = 1.0; // far middle: the best the vase can do is to touch the far edge
    let best = best_placement(&scene, &rbf, &field, &w, &mut Vec::new()).expect("the table has room");
    assert!(best.at.distance(Point::new(0.5, 0.96)) < 1e-6, "{best:?}");
}

#[test]
fn a_hill_cut_by_an_object_is_climbed_along_its_outline() {
    let mut scene = flowers(0.05);
    scene.objects[0].position_m = Point::new(0.47, 0.5);
    let rbf = Rbf::new(&scene);
    let field = Field::new(&rbf, &Grid::midpoints(64), Some(&scene));
    let mut w = vec![0.0; 13];
    w[8] = 1.0; // the middle, on which the plate stands: touching it on the right is nearest
    let best = best_placement(&scene, &rbf, &field, &w, &mut Vec::new()).expect("the table has room");
    assert!(best.at.distance(Point::new(0.56, 0.5)) < 1e-6, "{best:?}");
}

#[test]
fn no_free_cell_means_no_placement() {
    let mut scene = flowers(0.05);
    scene.target.shape = Shape::Cylinder { radius_m: 0.6, height_m: 0.1 };
    let rbf = Rbf::new(&scene);
    let field = Field::new(&rbf, &Grid::midpoints(16), Some(&scene));
    assert_eq!(field.n_free(), 0);
    assert_eq!(best_placement(&scene, &rbf, &field, &flowers_weights(), &mut Vec::new()), None);
}

#[test]
fn obstructions_are_named_and_supports_are_none() {
    let mut scene = flowers(0.05);
    assert_eq!(scene.occupied().reason(Point::new(0.27, 0.75)), Some(Obstruction::Object { id: "plate_0".into() }));
    assert_eq!(scene.occupied().reason(Point::new(0.01, 0.5)), Some(Obstruction::Edge));
    scene.objects[0].supports = true;
    assert_eq!(scene.occupied().reason(Point::new(0.27, 0.75)), None);
    let turned = Object {
        shape: Shape::Box { width_m: 0.4, depth_m: 0.1, height_m: 0.1 },
        yaw_rad: std::f64::consts::FRAC_PI_2,
        ..object("tray", 0.5, 0.5, 0.1)
    };
    assert!((turned.distance_m(Point::new(0.5, 0.75)) - 0.05).abs() < 1e-12);
    assert!((turned.distance_m(Point::new(0.6, 0.5)) - 0.05).abs() < 1e-12);
}

#[test]
fn broken_scenes_are_refused_by_name() {
    let refused = |change: fn(&mut Scene)| {
        let mut scene = flowers(0.05);
        change(&mut scene);
        scene.check().expect_err("the scene is broken")
    };
    assert!(flowers(0.05).check().is_ok());
    assert!(matches!(refused(|s| s.width_m = f64::NAN), SceneError::Table { .. }));
    assert!(matches!(refused(|s| s.objects[1].id = "plate_0".into()), SceneError::DuplicateId { .. }));
    assert!(matches!(refused(|s| s.target.id = "plate_0".into()), SceneError::DuplicateId { .. }));
    assert!(matches!(refused(|s| s.objects[1].position_m.x = f64::NAN), SceneError::NotFinite { .. }));
    assert!(matches!(refused(|s| s.objects[1].position_m.x = 1.2), SceneError::OffTable { .. }));
    assert!(matches!(refused(|s| s.target.label = String::new()), SceneError::Name { .. }));
    assert!(matches!(
        refused(|s| s.target.shape = Shape::Cylinder { radius_m: 0.0, height_m: 1.0 }),
        SceneError::Size { .. }
    ));
    assert!(matches!(
        refused(|s| s.objects = (0..65).map(|i| object(&i.to_string(), 0.5, 0.5, 0.01)).collect()),
        SceneError::TooMany { got: 65, .. }
    ));
}

fn weights() -> impl Strategy<Value = Vec<f64>> {
    proptest::collection::vec(-1.0..1.0_f64, 13)
}

proptest! {
    #[test]
    fn the_field_equals_the_reward_point_by_point(w in weights()) {
        let scene = flowers(0.05);
        let rbf = Rbf::new(&scene);
        let grid = Grid::midpoints(9);
        let field = Field::new(&rbf, &grid, Some(&scene));
        let mut out = vec![0.0; grid.n()];
        field.rewards(&w, &mut out);
        for (i, value) in out.iter().enumerate() {
            prop_assert!((value - rbf.reward(&w, grid.at(i))).abs() < 1e-13);
        }
    }

    #[test]
    fn the_derivatives_are_those_of_the_reward(w in weights(), x in 0.0..1.0_f64, y in 0.0..1.0_f64) {
        let rbf = Rbf::new(&flowers(0.05));
        let h = 1e-5;
        let r = |dx: f64, dy: f64| rbf.reward(&w, Point::new(x + dx, y + dy));
        let d = rbf.derivatives(&w, Point::new(x, y));
        prop_assert!((d[1] - (r(h, 0.0) - r(-h, 0.0)) / (2.0 * h)).abs() < 1e-8);
        prop_assert!((d[2] - (r(0.0, h) - r(0.0, -h)) / (2.0 * h)).abs() < 1e-8);
        let g = |dx: f64, dy: f64| rbf.gradient(&w, Point::new(x + dx, y + dy));
        prop_assert!((d[3] - (g(h, 0.0)[0] - g(-h, 0.0)[0]) / (2.0 * h)).abs() < 1e-7);
        prop_assert!((d[4] - (g(0.0, h)[0] - g(0.0, -h)[0]) / (2.0 * h)).abs() < 1e-7);
        prop_assert!((d[5] - (g(0.0, h)[1] - g(0.0, -h)[1]) / (2.0 * h)).abs() < 1e-7);
    }

    #[test]
    fn the_best_placement_is_free_and_beats_every_free_cell(w in weights()) {
        let scene = flowers(0.05);
        let rbf = Rbf::new(&scene);
        let grid = Grid::midpoints(32);
        let field = Field::new(&rbf, &grid, Some(&scene));
        let best = best_placement(&scene, &rbf, &field, &w, &mut Vec::new()).expect("the table has room");
        prop_assert!(scene.occupied().is_free(scene.metres(best.at)));
        for i in (0..grid.n()).filter(|&i| field.free()[i]) {
            prop_assert!(rbf.reward(&w, grid.at(i)) <= best.reward + 1e-12);
        }
    }
}
