//! Questions about tables: answers against the likelihood they will have as evidence, losses against distances.

use inquiry::table::{
    TableDraws, placement_alternatives, placement_answer, placement_answers, placement_comparison, placement_losses,
    sampled_placement_answers,
};
use inquiry::{Belief, reward_information};
use likelihood::placements::{Placement, PlacementLikelihood};
use likelihood::preferences::AnswerModel;
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;
use scene::{Grid, Object, Point, Rbf, Scene, Shape};

fn scene() -> Scene {
    let object = |id: &str, x: f64, y: f64| Object {
        id: id.into(),
        label: id.into(),
        shape: Shape::Cylinder { radius_m: 0.06, height_m: 0.1 },
        position_m: Point::new(x, y),
        yaw_rad: 0.0,
        supports: false,
    };
    Scene {
        id: "two".into(),
        frame: "table".into(),
        width_m: 1.0,
        depth_m: 1.0,
        objects: vec![object("cup", 0.3, 0.7), object("plate", 0.6, 0.4)],
        target: object("vase", 0.0, 0.0),
    }
}

fn draws() -> Vec<f64> {
    (0..3 * 11).map(|i| f64::from((i * i * 7 + 3) % 13) / 26.0 - 0.2).collect()
}

/// The likelihood is a density relative to uniform over the same grid: P(cell) is its mean over the cell's four points / free points.
#[test]
fn placements_are_as_probable_as_they_will_be_as_evidence() {
    let (scene, weights) = (scene(), draws());
    let table = TableDraws { weights: &weights, n_features: 11, betas: &[20.0] };
    let answers = placement_answers(&scene, &table, 8).expect("draws").expect("a free place");
    assert_eq!(answers.n(), 64);
    let grid = Grid::midpoints(16);
    let occupied = scene.occupied();
    for answer in [0, 18, 36, 45, 63] {
        let of_answer = answers.likelihood(answer).expect("an answer");
        for (draw, w) in weights.chunks(11).enumerate() {
            let theta: Vec<f64> = w.iter().map(|w| 20.0 * w).collect();
            let mut expected = 0.0;
            for point in (0..grid.n()).filter(|&i| placement_answer(grid.at(i), 8) == answer) {
                let at = grid.at(point);
                if occupied.is_free(at) {
                    let placements = [Placement { scene: &scene, at, factor: 1.0, masked: true }];
                    let likelihood = PlacementLikelihood::new(11, &placements, &grid);
                    let n_free = likelihood.n_free().next().expect("one scene") as f64;
                    expected += likelihood.value(&theta).exp() / n_free;
                }
            }
            assert!((of_answer[draw] - expected).abs() < 1e-12, "{answer} {draw}: {} {expected}", of_answer[draw]);
        }
    }
    assert!(reward_information(&answers, &Belief::equal(3).expect("draws")).expect("fits") > 0.0);
}

/// Drawn places tell as much as cells do, where cells are small beside what they tell apart.
#[test]
fn drawn_places_stand_for_all_places() {
    let (scene, weights) = (scene(), draws());
    let table = TableDraws { weights: &weights, n_features: 11, betas: &[20.0] };
    let belief = Belief::weighted(&[0.5, 0.2, 0.3]).expect("weights");
    let cells = placement_answers(&scene, &table, 16).expect("draws").expect("a free place");
    let mut rng = ChaCha8Rng::seed_from_u64(4);
    let drawn =
        sampled_placement_answers(&scene, &table, &belief, 20_000, 32, &mut rng).expect("draws").expect("a free place");
    let (of_cells, of_drawn) =
        (reward_information(&cells, &belief).expect("fits"), reward_information(&drawn, &belief).expect("fits"));
    // The standard error of the drawn one is below .01.
    assert!((of_cells - of_drawn).abs() < 0.03, "{of_cells} {of_drawn}");
    let again = || {
        let mut rng = ChaCha8Rng::seed_from_u64(4);
        sampled_placement_answers(&scene, &table, &belief, 10, 32, &mut rng).expect("draws")
    };
    assert_eq!(again(), again());
}

#[test]
fn comparisons_of_places_go_by_reward() {
    let (scene, weights) = (scene(), draws());
    let table = TableDraws { weights: &weights, n_features: 11, betas: &[1.0, 2.0, 4.0] };
    let (a, b) = (Point::new(0.2, 0.2), Point::new(0.8, 0.7));
    let answers = placement_comparison(&scene, &table, a, b, &AnswerModel::default()).expect("draws");
    let rbf = Rbf::new(&scene);
    for (draw, w) in weights.chunks(11).enumerate() {
        let difference = [1.0, 2.0, 4.0][draw] * (rbf.reward(w, b) - rbf.reward(w, a));
        let second = 1.0 / (1.0 + (-difference).exp());
        assert!((answers.likelihood(1).expect("second")[draw] - second).abs() < 1e-12);
    }
}

#[test]
fn losses_are_distances() {
    let at = |x: f64, y: f64| Point::new(x, y);
    let optima = vec![vec![at(0.0, 0.0), at(0.3, 0.4), at(0.0, 1.0)], vec![at(0.5, 0.5); 3]];
    let current = [at(0.0, 0.0), at(0.5, 0.4)];
    let losses = placement_losses(&current, &optima).expect("tables");
    assert!(losses.of(0).iter().zip([0.0, 0.5, 1.0]).all(|(a, b)| (a - b).abs() < 1e-15));
    assert!(losses.of(1).iter().all(|x| (x - 0.1).abs() < 1e-15));
    let alternatives = placement_alternatives(&current, &optima, 3).expect("tables");
    assert_eq!(alternatives.n(), 4);
    // The current one: mean of both tables; the second draw's: none where it is right.
    assert!(alternatives.of(0).iter().zip([0.05, 0.3, 0.55]).all(|(a, b)| (a - b).abs() < 1e-15));
    assert_eq!(alternatives.of(2)[1], 0.0);
    assert!(placement_losses(&current[..1], &optima).is_err());
    assert!(placement_losses(&[], &[]).is_err() && placement_alternatives(&[], &[], 3).is_err());
}

#[test]
fn a_full_table_has_no_answer() {
    let mut full = scene();
    full.target.shape = Shape::Cylinder { radius_m: 0.6, height_m: 0.1 };
    let weights = draws();
    let table = TableDraws { weights: &weights, n_features: 11, betas: &[20.0] };
    assert_eq!(placement_answers(&full, &table, 8), Ok(None));
    let other = TableDraws { n_features: 3, ..table };
    assert!(placement_answers(&scene(), &other, 8).is_err());
    assert!(placement_answers(&scene(), &table, 0).is_err());
    let wrong = TableDraws { betas: &[0.0], ..table };
    assert!(placement_answers(&scene(), &wrong, 8).is_err());
}

#[test]
fn cells_are_numbered_from_the_near_left() {
    assert_eq!(placement_answer(Point::new(0.0, 0.0), 4), 0);
    assert_eq!(placement_answer(Point::new(0.99, 0.0), 4), 3);
    assert_eq!(placement_answer(Point::new(1.0, 1.0), 4), 15);
    assert_eq!(placement_answer(Point::new(-0.1, 0.3), 4), 4);
}
