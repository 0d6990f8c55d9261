//! The likelihood against the published numbers, its own derivatives, and a plain evaluation.

mod common;

use common::{Random, flowers, flowers_weights, lesson, placements, table};
use likelihood::placements::{Placement, PlacementLikelihood};
use proptest::prelude::{prop_assert, proptest};
use scene::{Field, Grid, Point, Rbf};

#[test]
fn agrees_with_the_author_s_program() {
    // Method notes section 5: normalised over linspace(0, 1, 10)² without a mask, as a sum rather than a mean.
    let scene = flowers();
    let w = flowers_weights();
    let rbf = Rbf::new(&scene);
    assert!((rbf.reward(&w, Point::new(0.5, 0.5)) - 0.33630375).abs() < 5e-9);
    assert!((rbf.reward(&w, Point::new(0.2, 0.3)) - 0.18541108).abs() < 5e-9);
    let cases = [
        (100.0, Point::new(0.5, 0.5), -0.54480233),
        (100.0, Point::new(0.2, 0.3), -15.63406893),
        (10.0, Point::new(0.5, 0.5), -3.13533005),
    ];
    for (beta, at, want) in cases {
        let placement = Placement { scene: &scene, at, factor: beta, masked: false };
        let likelihood = PlacementLikelihood::new(13, &[placement], &Grid::linspace(10));
        let got = likelihood.value(&w) - 100.0_f64.ln();
        assert!((got - want).abs() < 5e-9, "beta {beta}: {got} vs {want}");
    }
}

#[test]
fn leaves_occupied_cells_out() {
    let lesson = lesson(3, 5, &common::Random(3).l1_sphere(14), 4);
    for side in [64, 10, 13] {
        let grid = Grid::midpoints(side);
        for beta in [100.0, 5000.0] {
            let likelihood = PlacementLikelihood::new(14, &placements(&lesson, beta), &grid);
            let w = Random(9).l1_sphere(14);
            let mut plain = 0.0;
            for demonstration in &lesson {
                let scene = &demonstration.scene;
                let rbf = Rbf::new(scene);
                let field = Field::new(&rbf, &grid, Some(scene));
                let free: Vec<f64> =
                    (0..grid.n()).filter(|&i| field.free()[i]).map(|i| beta * rbf.reward(&w, grid.at(i))).collect();
                let top = free.iter().copied().fold(f64::NEG_INFINITY, f64::max);
                let mean = free.iter().map(|r| (r - top).exp()).sum::<f64>() / free.len() as f64;
                plain += beta * rbf.reward(&w, demonstration.placement) - top - mean.ln();
            }
            let got = likelihood.value(&w);
            assert!((got - plain).abs() < 1e-9 * (1.0 + plain.abs()), "side {side}, beta {beta}: {got} vs {plain}");
        }
    }
}

/// The mixture written out: (1 − ε) p + ε of every placement, p relative to a uniform one.
#[test]
fn placements_at_random_are_mixed_in() {
    let lesson = lesson(4, 5, &Random(3).l1_sphere(14), 4);
    let w = Random(9).l1_sphere(14);
    let all = placements(&lesson, 60.0);
    let grid = Grid::midpoints(32);
    let one = |placement: &Placement<'_>| PlacementLikelihood::new(14, &[*placement], &grid).value(&w).exp();
    for rate in [1e-6, 0.1, 0.9] {
        let likelihood = PlacementLikelihood::new(14, &all, &grid).with_wrong_rate(rate).expect("in range");
        let want: f64 = all.iter().map(|placement| ((1.0 - rate) * one(placement) + rate).ln()).sum();
        let got = likelihood.value(&w);
        assert!((got - want).abs() < 1e-9 * (1.0 + want.abs()), "{rate}: {got} vs {want}");
    }
    for rate in [1.0, -0.1, f64::NAN] {
        assert!(PlacementLikelihood::new(14, &all, &grid).with_wrong_rate(rate).is_err());
    }
}

#[test]
fn a_table_without_objects_is_fine() {
    let scene = table(&[], 0.04);
    let placement = Placement { scene: &scene, at: Point::new(0.3, 0.6), factor: 50.0, masked: true };
    let likelihood = PlacementLikelihood::new(9, &[placement], &Grid::midpoints(32));
    let mut gradient = vec![0.0; 9];
    assert!(likelihood.value_and_gradient(&Random(1).l1_sphere(9), &mut gradient).is_finite());
    assert_eq!(likelihood.n_free().collect::<Vec<_>>().len(), 1);
}

proptest! {
    #[test]
    fn gradient_is_the_derivative_and_the_value_is_concave(
        seed in 0_u64..1000, n in 1_usize..4, n_objects in 0_usize..6, beta in 1.0..400.0_f64, wrong in 0..3_usize,
    ) {
        let wrong_rate = [0.0, 0.02, 0.5][wrong];
        let features = n_objects + 9;
        let mut random = Random(seed);
        let (w, v) = (random.l1_sphere(features), random.l1_sphere(features));
        let lesson = lesson(n, n_objects, &v, seed);
        let likelihood = PlacementLikelihood::new(features, &placements(&lesson, beta), &Grid::midpoints(20));
        let likelihood = likelihood.with_wrong_rate(wrong_rate).expect("in range");
        let mut gradient = vec![0.0; features];
        let value = likelihood.value_and_gradient(&w, &mut gradient);
        prop_assert!((value - likelihood.value(&w)).abs() < 1e-12 * (1.0 + value.abs()));
        let h = 1e-6;
        for i in 0..features {
            let shifted = |by: f64| {
                let mut w = w.clone();
                w[i] += by;
                likelihood.value(&w)
            };
            let numeric = (shifted(h) - shifted(-h)) / (2.0 * h);
            prop_assert!((gradient[i] - numeric).abs() < 1e-5 * (1.0 + beta), "{i}: {} vs {numeric}", gradient[i]);
        }
        if wrong_rate > 0.0 {
            return Ok(());
        }
        let middle: Vec<f64> = w.iter().zip(&v).map(|(w, v)| 0.5 * (w + v)).collect();
        prop_assert!(likelihood.value(&middle) >= 0.5 * (value + likelihood.value(&v)) - 1e-9);
    }
}
