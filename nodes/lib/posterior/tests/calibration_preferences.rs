//! Simulation-based calibration of preferences: the truth ranks uniformly among the draws when the data come from the
//! likelihood in use, and does not when β is wrong.

mod support;

use likelihood::preferences::{AnswerModel, PreferenceLikelihood};
use posterior::{EvidenceKind, Model, Prior, Rationality, Term, TermLikelihood, draw};
use support::{LIMIT, answers, chi_squared, generator, l1_sphere, l2_sphere, normal, rank, ranks, short_run};

/// Weights.
const K: usize = 6;

fn model(
    prior: Prior,
    rationality: Rationality,
    features: Vec<f64>,
    given: Vec<likelihood::preferences::Answer>,
    answer_model: AnswerModel,
) -> Model<'static> {
    let preferences = PreferenceLikelihood::new(K, features, given, answer_model).expect("good answers");
    Model {
        n_features: K,
        prior,
        nonnegative_return: None,
        terms: vec![Term {
            kind: EvidenceKind::Preferences,
            rationality,
            likelihood: TermLikelihood::Preferences(preferences),
        }],
    }
}

/// χ² with items and answers as given: few items collapse the posterior to their span, many do not.
fn calibration(
    test: u64,
    prior: Prior,
    answer_model: AnswerModel,
    (m, n): (usize, usize),
    assumed_beta: f64,
) -> [f64; 3] {
    let beta = 3.0;
    chi_squared(320, |world| {
        let mut generator = generator(test, world);
        let w = match prior {
            Prior::L2Sphere => l2_sphere(K, &mut generator),
            Prior::L1Sphere => l1_sphere(K, &mut generator),
            Prior::Gaussian { scale } => (0..K).map(|_| scale * normal(&mut generator)).collect(),
            Prior::Laplace { scale } => {
                // The size of a point of the L1 sphere is made Gamma(k), which makes it Laplace.
                let size: f64 = (0..K).map(|_| -support::uniform(&mut generator).ln()).sum();
                l1_sphere(K, &mut generator).iter().map(|w| scale * size * w).collect()
            }
        };
        let (features, given) = answers(&w, beta, &answer_model, (m, n), &mut generator);
        let model = model(prior, Rationality::Fixed(assumed_beta), features, given, answer_model);
        let draws = draw(&model, &short_run(), world, &[1; 32]).expect("draws");
        ranks(&draws, &w, model.log_likelihood(&w, &[assumed_beta]))
    })
}

fn uniform_ranks(what: &str, chi_squared: [f64; 3]) {
    for (statistic, value) in ["w_0", "|w_0|", "log-likelihood"].iter().zip(chi_squared) {
        assert!(value < LIMIT, "{what}, {statistic}: {value}");
    }
}

const ALL_ANSWERS: AnswerModel = AnswerModel { equal_threshold: 0.8, cant_tell: 0.4, wrong_rate: 0.1 };

#[test]
fn strict_answers_under_every_prior() {
    let priors = [Prior::L2Sphere, Prior::L1Sphere, Prior::Gaussian { scale: 0.7 }, Prior::Laplace { scale: 0.5 }];
    for (test, prior) in (10..).zip(priors) {
        uniform_ranks(&format!("{prior:?}"), calibration(test, prior, AnswerModel::default(), (9, 14), 3.0));
    }
}

#[test]
fn all_answers() {
    uniform_ranks("not collapsed", calibration(20, Prior::L2Sphere, ALL_ANSWERS, (9, 20), 3.0));
}

#[test]
fn collapsed_to_the_span() {
    // Four items span three of six directions.
    uniform_ranks("sphere", calibration(30, Prior::L2Sphere, AnswerModel::default(), (4, 8), 3.0));
    let gaussian = Prior::Gaussian { scale: 0.7 };
    uniform_ranks("Gaussian", calibration(31, gaussian, ALL_ANSWERS, (4, 8), 3.0));
}

#[test]
fn a_doubled_beta_is_caught() {
    let [_, _, log_likelihood] = calibration(40, Prior::L2Sphere, AnswerModel::default(), (9, 14), 6.0);
    assert!(log_likelihood > LIMIT, "{log_likelihood}");
    let [_, _, log_likelihood] = calibration(41, Prior::L2Sphere, AnswerModel::default(), (4, 14), 6.0);
    assert!(log_likelihood > LIMIT, "collapsed: {log_likelihood}");
}

#[test]
fn a_missing_answer_model_is_caught() {
    // Answers with ties and wrong clicks, read as if all had been strict and meant.
    let chi_squared = chi_squared(320, |world| {
        let mut generator = generator(50, world);
        let w = l2_sphere(K, &mut generator);
        let (features, given) = answers(&w, 6.0, &ALL_ANSWERS, (9, 40), &mut generator);
        let strict = given.into_iter().filter(|a| a.verdict == likelihood::preferences::Verdict::Strict).collect();
        let model = model(Prior::L2Sphere, Rationality::Fixed(6.0), features, strict, AnswerModel::default());
        let draws = draw(&model, &short_run(), world, &[1; 32]).expect("draws");
        ranks(&draws, &w, model.log_likelihood(&w, &[6.0]))
    });
    assert!(chi_squared.iter().any(|value| *value > LIMIT), "{chi_squared:?}");
}

/// Ranks of w_0, the log-likelihood and β when β is drawn from its prior.
fn learned(test: u64, m: usize, assumed_log_sd: f64) -> [f64; 3] {
    chi_squared(320, |world| {
        let mut generator = generator(test, world);
        let w = l2_sphere(K, &mut generator);
        let beta = 3.0 * (0.7 * normal(&mut generator)).exp();
        let (features, given) = answers(&w, beta, &ALL_ANSWERS, (m, 20), &mut generator);
        let rationality = Rationality::Learned { median: 3.0, log_sd: assumed_log_sd };
        let model = model(Prior::L2Sphere, rationality, features, given, ALL_ANSWERS);
        let draws = draw(&model, &short_run(), world, &[2; 32]).expect("draws");
        let truth = model.log_likelihood(&w, &[beta]);
        [
            rank(draws.feature(0).into_iter(), w[0]),
            rank(draws.log_likelihood.iter().copied(), truth),
            rank(draws.betas[0].values.iter().copied(), beta),
        ]
    })
}

#[test]
fn a_learned_rationality_is_calibrated() {
    for (test, m) in [(60, 9), (61, 4)] {
        for (statistic, value) in ["w_0", "log-likelihood", "beta"].iter().zip(learned(test, m, 0.7)) {
            assert!(value < LIMIT, "{m} items, {statistic}: {value}");
        }
    }
    let [_, _, beta] = learned(62, 9, 0.25);
    assert!(beta > LIMIT, "a prior of beta that is too sure of itself is caught: {beta}");
}
