//! The sampler's claims: reproducible draws, mixed chains, a mode no draw beats, and clear refusals.

#[path = "../../likelihood/tests/common/mod.rs"]
mod common;

use common::{Random, flowers, flowers_weights, lesson, table};
use posterior::{
    Confidence, Demonstration, EvidenceError, Lesson, MAX_DEMONSTRATIONS, PosteriorError, Prior, Rationality, Settings,
    SettingsError, evidence_hash, sample,
};
use scene::Point;

/// Short runs on a small grid.
fn quick() -> Settings {
    Settings { n_draws: 400, warmup: 150, grid_side: 32, ..Settings::default() }
}

fn flowers_lesson(n: usize) -> (Lesson, Vec<Demonstration>) {
    (Lesson::new(&flowers()), lesson(n, 4, &flowers_weights(), 1))
}

#[test]
fn draws_are_the_same_for_any_number_of_threads_and_any_history() {
    let (lesson, demonstrations) = flowers_lesson(3);
    let draw = |threads, n| sample(&Settings { threads, ..quick() }, 7, &lesson, &demonstrations[..n]).expect("draws");
    let two = draw(1, 2);
    assert_eq!(two, draw(2, 2));
    assert_eq!(two, draw(4, 2));
    // A third answer and its retraction leave no trace.
    assert_ne!(two, draw(2, 3));
    assert_eq!(two, draw(2, 2));
    // Another seed, another order: other draws, but the same mode for another seed.
    let reseeded = sample(&quick(), 8, &lesson, &demonstrations[..2]).expect("draws");
    assert_ne!(two.values, reseeded.values);
    assert_eq!(two.map_weights, reseeded.map_weights);
    let swapped = [demonstrations[1].clone(), demonstrations[0].clone()];
    assert_ne!(evidence_hash(&swapped), evidence_hash(&demonstrations[..2]));
    assert_ne!(two.values, sample(&quick(), 7, &lesson, &swapped).expect("draws").values);
}

#[test]
fn a_lesson_of_ten_mixes() {
    let (lesson, demonstrations) = flowers_lesson(10);
    let draws = sample(&Settings::default(), 1, &lesson, &demonstrations).expect("draws");
    assert!(draws.acceptance > 0.85, "accepted {}", draws.acceptance);
    assert!(draws.rhat_max < 1.01, "R-hat {}", draws.rhat_max);
    assert!(draws.ess_bulk_min > 1800.0, "bulk {}", draws.ess_bulk_min);
    assert!(draws.ess_tail_min > 1500.0, "tail {}", draws.ess_tail_min);
    for draw in 0..draws.n() {
        let norm: f64 = draws.weights(draw).iter().map(|w| w.abs()).sum();
        assert!((norm - 1.0).abs() < 1e-12);
    }
    // The teacher's liking for the middle of the table is learned.
    let centre = draws.feature(8);
    let mean = centre.iter().sum::<f64>() / centre.len() as f64;
    assert!((0.3..0.8).contains(&mean), "mean weight of the centre {mean}");
    // No draw is likelier than the mode.
    let best = draws.log_likelihood.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    assert!(draws.map_log_likelihood > best - 1e-3, "{} vs {best}", draws.map_log_likelihood);
}

#[test]
fn a_surrogate_force_costs_little_acceptance_at_any_sharpness() {
    let (lesson, demonstrations) = flowers_lesson(4);
    for beta in [1.0, 30.0, 300.0, 1000.0] {
        let settings =
            Settings { rationality: Rationality::Fixed(beta), n_draws: 400, warmup: 200, ..Settings::default() };
        let draws = sample(&settings, 3, &lesson, &demonstrations).expect("draws");
        assert!(draws.acceptance > 0.8, "beta {beta}: accepted {}", draws.acceptance);
        assert!(draws.rhat_max < 1.1, "beta {beta}: R-hat {}", draws.rhat_max);
    }
}

#[test]
fn the_mode_beats_all_draws_under_either_prior_and_hardly_moves_with_the_evidence() {
    let w = Random(4).l1_sphere(11);
    let lesson_of = Lesson::new(&table(&[(0.2, 0.3), (0.7, 0.6)], 0.04));
    for prior in [Prior::L1Sphere, Prior::L2Sphere] {
        // Few demonstrations leave the mode on the face of a ball, many blunt ones inside it.
        for (n, beta) in [(2, 100.0), (12, 4.0)] {
            let demonstrations = lesson(n, 2, &w, 5);
            let settings = Settings { prior, rationality: Rationality::Fixed(beta), ..quick() };
            let draws = sample(&settings, 1, &lesson_of, &demonstrations).expect("draws");
            let norm: f64 = match prior {
                Prior::L1Sphere => draws.map_weights.iter().map(|w| w.abs()).sum(),
                _ => draws.map_weights.iter().map(|w| w * w).sum(),
            };
            assert!((norm - 1.0).abs() < 1e-9);
            let best = draws.log_likelihood.iter().copied().fold(f64::NEG_INFINITY, f64::max);
            assert!(draws.map_log_likelihood > best - 1e-3, "{prior:?}: {} vs {best}", draws.map_log_likelihood);

            let mut nudged = demonstrations.clone();
            nudged[0].placement.x += 1e-5;
            let moved = sample(&settings, 1, &lesson_of, &nudged).expect("draws");
            let largest = draws.map_weights.iter().zip(&moved.map_weights).map(|(a, b)| (a - b).abs());
            assert!(largest.fold(0.0, f64::max) < 0.02, "{prior:?}: {:?} {:?}", draws.map_weights, moved.map_weights);
        }
    }
}

#[test]
fn a_guess_counts_less_than_a_sure_placement() {
    let (lesson, mut demonstrations) = flowers_lesson(2);
    let spread = |demonstrations: &[Demonstration]| {
        let centre = sample(&quick(), 1, &lesson, demonstrations).expect("draws").feature(8);
        let mean = centre.iter().sum::<f64>() / centre.len() as f64;
        (mean, centre.iter().map(|w| (w - mean) * (w - mean)).sum::<f64>())
    };
    let sure = spread(&demonstrations);
    demonstrations.iter_mut().for_each(|d| d.confidence = Confidence::Guess);
    let guess = spread(&demonstrations);
    assert!(guess.0 < sure.0, "the centre is liked {guess:?} after guesses, {sure:?} after sure placements");
}

#[test]
fn without_evidence_the_mode_is_even() {
    let draws = sample(&quick(), 1, &Lesson::new(&flowers()), &[]).expect("draws");
    assert!(draws.map_weights.iter().all(|w| (w - 1.0 / 13.0).abs() < 1e-15));
    assert_eq!(draws.map_log_likelihood, 0.0);
    assert!(draws.log_likelihood.iter().all(|l| *l == 0.0));
}

#[test]
fn refuses_bad_evidence_in_one_line() {
    let (lesson, demonstrations) = flowers_lesson(1);
    let refusal = |change: &dyn Fn(&mut Demonstration)| {
        let mut demonstration = demonstrations[0].clone();
        change(&mut demonstration);
        sample(&quick(), 1, &lesson, &[demonstration]).expect_err("refused").to_string()
    };
    let off = refusal(&|d| d.placement = Point::new(1.5, 0.5));
    assert_eq!(off, "demonstration 'd0' puts the target at (1.5, 0.5), outside the unit square of the table");
    assert!(refusal(&|d| d.placement.x = f64::NAN).contains("NaN"));
    assert!(refusal(&|d| d.scene.objects[2].id = "cup".into()).contains("\"cup\""));
    assert!(refusal(&|d| d.scene.objects.swap(0, 1)).contains("in this order"));
    assert!(refusal(&|d| d.scene.objects[0].position_m.x = f64::NAN).contains("'object_0'"));
    assert!(refusal(&|d| d.scene.width_m = -1.0).contains("demonstration 'd0'"));
    let wide = scene::Shape::Cylinder { radius_m: 0.6, height_m: 0.1 };
    assert_eq!(
        refusal(&|d| d.scene.target.shape = wide),
        "demonstration 'd0': the target fits nowhere on the table of scene 'table'"
    );
    let many = vec![demonstrations[0].clone(); MAX_DEMONSTRATIONS + 1];
    assert_eq!(
        sample(&quick(), 1, &lesson, &many),
        Err(PosteriorError::Evidence(EvidenceError::TooMany { got: MAX_DEMONSTRATIONS + 1 }))
    );
    let settings = Settings { rationality: Rationality::Fixed(-1.0), ..quick() };
    assert!(matches!(
        sample(&settings, 1, &lesson, &demonstrations),
        Err(PosteriorError::Settings(SettingsError::Range { name: "beta", .. }))
    ));
}

#[test]
fn the_evidence_hash_sees_every_part() {
    let (_, demonstrations) = flowers_lesson(1);
    let original = evidence_hash(&demonstrations);
    assert_eq!(original, evidence_hash(&demonstrations.clone()));
    let changes: [fn(&mut Demonstration); 8] = [
        |d| d.id.push('x'),
        |d| d.placement.x += 1e-12,
        |d| d.confidence = Confidence::Fairly,
        |d| d.scene.objects[1].position_m.y += 1e-12,
        |d| d.scene.objects.swap(0, 1),
        |d| d.scene.target.shape = scene::Shape::Cylinder { radius_m: 0.05, height_m: 0.1 },
        |d| d.scene.width_m = 2.0,
        |d| d.scene.objects[0].supports = true,
    ];
    let mut seen = vec![original, evidence_hash(&[])];
    for change in changes {
        let mut changed = demonstrations.clone();
        change(&mut changed[0]);
        let hash = evidence_hash(&changed);
        assert!(!seen.contains(&hash));
        seen.push(hash);
    }
}
