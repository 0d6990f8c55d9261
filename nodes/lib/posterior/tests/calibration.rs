//! Is the posterior right? Against the prior, against importance sampling, and by simulation-based calibration (method
//! notes section 3), each with a planted mistake that must be caught.

#[path = "../../likelihood/tests/common/mod.rs"]
mod common;

use common::{Random, table};
use diagnostics::normal_quantile;
use likelihood::placements::{Placement, PlacementLikelihood};
use posterior::{
    Confidence, Demonstration, Draws, Lesson, Model, Prior, Rationality, Settings, TermLikelihood, draw, evidence_hash,
    sample,
};
use scene::{Grid, Point, Scene};

fn mean(values: impl Iterator<Item = f64>) -> f64 {
    let (sum, n) = values.fold((0.0, 0.0), |(sum, n), x| (sum + x, n + 1.0));
    sum / n
}

#[test]
fn a_flat_likelihood_gives_back_the_prior() {
    // d weights uniform on the L1 sphere: E|w| = 1/d and E w² = 2/(d(d + 1)); on the L2 sphere E w² = 1/d, E w⁴ = 3/(d(d + 2)).
    let lesson = Lesson::of_objects((0..4).map(|i| i.to_string()).collect());
    let settings = Settings { n_draws: 8000, grid_side: 8, ..Settings::default() };
    let d = 13.0;
    let draws = sample(&settings, 5, &lesson, &[]).expect("draws");
    assert!(draws.rhat_max < 1.01 && draws.ess_bulk_min > 4000.0, "{} {}", draws.rhat_max, draws.ess_bulk_min);
    for k in 0..13 {
        let w = draws.feature(k);
        assert!(mean(w.iter().copied()).abs() < 0.006);
        assert!((mean(w.iter().map(|w| w.abs())) - 1.0 / d).abs() < 0.004);
        let square = mean(w.iter().map(|w| w * w));
        assert!((square - 2.0 / (d * (d + 1.0))).abs() < 0.0009, "E w² = {square}");
    }
    let settings = Settings { prior: Prior::L2Sphere, ..settings };
    let draws = sample(&settings, 5, &lesson, &[]).expect("draws");
    for k in 0..13 {
        let w = draws.feature(k);
        assert!((mean(w.iter().map(|w| w * w)) - 1.0 / d).abs() < 0.006);
        assert!((mean(w.iter().map(|w| w.powi(4))) - 3.0 / (d * (d + 2.0))).abs() < 0.0025);
    }
}

#[test]
fn the_walk_that_forgets_its_hastings_term_does_not() {
    // The author's proposal, normal noise on every weight and division by the L1 norm, accepted always (method notes 1.6):
    // d = 8 should have E w² = .02778.
    let mut random = Random(1);
    let mut w = random.l1_sphere(8);
    let mut square = 0.0;
    let n = 400_000;
    for _ in 0..n {
        w.iter_mut().for_each(|w| *w += 0.05 * normal_quantile(random.uniform()));
        let norm: f64 = w.iter().map(|w| w.abs()).sum();
        w.iter_mut().for_each(|w| *w /= norm);
        square += w[0] * w[0] / n as f64;
    }
    assert!((square - 0.02778).abs() > 0.003, "the naive walk has E w² = {square}");
    let direct = mean((0..100_000).map(|_| random.l1_sphere(8)[0].powi(2)));
    assert!((direct - 0.02778).abs() < 0.0005, "{direct}");
}

#[test]
fn agrees_with_weighted_draws_from_the_prior() {
    let scene = table(&[], 0.05);
    let demonstrations: Vec<Demonstration> = [(0.3, 0.6), (0.35, 0.7), (0.8, 0.6)]
        .into_iter()
        .enumerate()
        .map(|(i, (x, y))| Demonstration {
            id: i.to_string(),
            scene: scene.clone(),
            placement: Point::new(x, y),
            confidence: Confidence::Sure,
        })
        .collect();
    let likelihood = PlacementLikelihood::new(9, &common::placements(&demonstrations, 12.0), &Grid::midpoints(32));
    let settings =
        Settings { rationality: Rationality::Fixed(12.0), grid_side: 32, n_draws: 8000, ..Settings::default() };
    for prior in [Prior::L1Sphere, Prior::L2Sphere] {
        let mut random = Random(11);
        let (mut total, mut squares) = (0.0, 0.0);
        let mut moments = [[0.0; 2]; 9];
        for _ in 0..60_000 {
            let w = match prior {
                Prior::L1Sphere => random.l1_sphere(9),
                _ => {
                    let z: Vec<f64> = (0..9).map(|_| normal_quantile(random.uniform())).collect();
                    let norm = z.iter().map(|z| z * z).sum::<f64>().sqrt();
                    z.iter().map(|z| z / norm).collect()
                }
            };
            let weight = likelihood.value(&w).exp();
            total += weight;
            squares += weight * weight;
            for (moments, w) in moments.iter_mut().zip(&w) {
                moments[0] += weight * w;
                moments[1] += weight * w * w;
            }
        }
        let worth = total * total / squares;
        assert!(worth > 1000.0, "the reference is worth {worth} draws");
        let draws =
            sample(&Settings { prior, ..settings.clone() }, 2, &Lesson::new(&scene), &demonstrations).expect("draws");
        for (k, moments) in moments.iter().enumerate() {
            let w = draws.feature(k);
            let (first, second) = (moments[0] / total, moments[1] / total);
            let deviation = (second - first * first).sqrt();
            let error = 4.5 * deviation / worth.min(3000.0).sqrt();
            let got = mean(w.iter().copied());
            assert!((got - first).abs() < error, "{prior:?} E w_{k}: {got} vs {first}");
            let spread = mean(w.iter().map(|w| (w - got) * (w - got))).sqrt();
            assert!((spread / deviation - 1.0).abs() < 0.12, "{prior:?} sd w_{k}: {spread} vs {deviation}");
        }
    }
}

/// χ² over 16 bins of the ranks of w_0, |w_0| and the log-likelihood of the truth among draws, over worlds drawn from the
/// prior with data drawn from the likelihood at `beta` and a rate of placements at random, sampled as if these were `assumed`.
fn calibration(worlds: u64, (beta, wrong_rate): (f64, f64), assumed: (f64, f64)) -> [f64; 3] {
    let (assumed_beta, assumed_rate) = assumed;
    const SIDE: usize = 32;
    const KEPT: usize = 63;
    let one = |world: u64| -> [usize; 3] {
        let mut random = Random(world << 32);
        let w = random.l1_sphere(11);
        let grid = Grid::midpoints(SIDE);
        let demonstrations: Vec<Demonstration> = (0..3)
            .map(|i| {
                let mut coordinate = || 0.1 + 0.8 * random.uniform();
                let positions = [(coordinate(), coordinate()), (coordinate(), coordinate())];
                let scene = table(&positions, 0.05);
                // At random: all placements equally good.
                let beta = if wrong_rate > 0.0 && random.uniform() < wrong_rate { 0.0 } else { beta };
                let placement = draw_placement(&scene, &grid, &w, beta, &mut random);
                Demonstration { id: i.to_string(), scene, placement, confidence: Confidence::Sure }
            })
            .collect();
        let settings = Settings {
            rationality: Rationality::Fixed(assumed_beta),
            grid_side: SIDE,
            n_draws: 4 * KEPT,
            warmup: 100,
            threads: 1,
            ..Settings::default()
        };
        let lesson = Lesson::new(&demonstrations[0].scene);
        let draws = draws(&settings, world, &lesson, &demonstrations, assumed_rate);
        let truth = PlacementLikelihood::new(11, &common::placements(&demonstrations, assumed_beta), &grid);
        let truth = truth.with_wrong_rate(assumed_rate).expect("in range").value(&w);
        let first = draws.feature(0);
        let rank = |draws: &mut dyn Iterator<Item = f64>, truth: f64| draws.step_by(4).filter(|x| *x < truth).count();
        [
            rank(&mut first.iter().copied(), w[0]),
            rank(&mut first.iter().map(|w| w.abs()), w[0].abs()),
            rank(&mut draws.log_likelihood.iter().copied(), truth),
        ]
    };
    let ranks: Vec<[usize; 3]> = std::thread::scope(|scope| {
        let halves = [0, 1].map(|half| {
            scope.spawn(move || (0..worlds).filter(|world| world % 2 == half).map(one).collect::<Vec<_>>())
        });
        halves.into_iter().flat_map(|half| half.join().expect("no panic")).collect()
    });
    [0, 1, 2].map(|statistic| {
        let mut bins = [0.0; 16];
        for ranks in &ranks {
            bins[ranks[statistic] * 16 / (KEPT + 1)] += 1.0;
        }
        let expected = worlds as f64 / 16.0;
        bins.iter().map(|n: &f64| (n - expected) * (n - expected) / expected).sum()
    })
}

/// As [`sample`], with a rate of placements at random.
fn draws(settings: &Settings, seed: u64, lesson: &Lesson, demonstrations: &[Demonstration], wrong_rate: f64) -> Draws {
    let mut term = settings.placements(lesson, demonstrations).expect("good placements");
    if let TermLikelihood::Placements(placements) = term.likelihood {
        term.likelihood = TermLikelihood::Placements(placements.with_wrong_rate(wrong_rate).expect("in range"));
    }
    let (n_features, prior) = (lesson.n_features(), settings.prior);
    let model = Model { n_features, prior, nonnegative_return: None, terms: vec![term] };
    draw(&model, &settings.run(), seed, &evidence_hash(demonstrations)).expect("draws")
}

/// A free grid point, drawn from the softmax of β R.
fn draw_placement(scene: &Scene, grid: &Grid, w: &[f64], beta: f64, random: &mut Random) -> Point {
    let field = scene::Field::new(&scene::Rbf::new(scene), grid, Some(scene));
    let mut rewards = vec![0.0; grid.n()];
    field.rewards(w, &mut rewards);
    let weights: Vec<f64> =
        rewards.iter().zip(field.free()).map(|(r, free)| if *free { (beta * r).exp() } else { 0.0 }).collect();
    let mut left = random.uniform() * weights.iter().sum::<f64>();
    let chosen = weights.iter().position(|weight| {
        left -= weight;
        left < 0.0
    });
    grid.at(chosen.expect("some cell is free"))
}

#[test]
fn ranks_of_the_truth_are_uniform() {
    // The 99.9 % quantile of χ² with 15 degrees of freedom.
    for rate in [0.0, 0.3] {
        let model = (50.0, rate);
        for (statistic, chi_squared) in ["w_0", "|w_0|", "log-likelihood"].iter().zip(calibration(320, model, model)) {
            assert!(chi_squared < 37.7, "rate {rate}, {statistic}: {chi_squared}");
        }
    }
}

#[test]
fn a_wrong_beta_shows_in_the_rank_of_the_log_likelihood() {
    let [_, _, log_likelihood] = calibration(160, (50.0, 0.0), (100.0, 0.0));
    assert!(log_likelihood > 37.7, "{log_likelihood}");
}

#[test]
fn a_forgotten_rate_of_wrong_placements_shows_too() {
    let [_, _, log_likelihood] = calibration(160, (50.0, 0.3), (50.0, 0.0));
    assert!(log_likelihood > 37.7, "{log_likelihood}");
}

#[test]
fn placements_are_scored_where_they_are_drawn() {
    // The likelihood used for calibration is a distribution: its exponentials average to 1 over the free cells.
    let scene = table(&[(0.4, 0.4)], 0.1);
    let grid = Grid::midpoints(32);
    let w = Random(2).l1_sphere(10);
    let field = scene::Field::new(&scene::Rbf::new(&scene), &grid, Some(&scene));
    let densities = (0..grid.n()).filter(|&i| field.free()[i]).map(|i| {
        let placement = Placement { scene: &scene, at: grid.at(i), factor: 60.0, masked: true };
        PlacementLikelihood::new(10, &[placement], &grid).value(&w).exp()
    });
    assert!((mean(densities) - 1.0).abs() < 1e-12);
}
