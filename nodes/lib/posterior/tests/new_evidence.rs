//! New evidence: old draws re-weighted at once, warm restarts, retraction, and refusals of models that do not fit.

mod support;

use diagnostics::pareto_smooth;
use likelihood::preferences::{Answer, AnswerModel, PreferenceLikelihood, Verdict};
use posterior::{EvidenceKind, Model, Prior, Rationality, Run, Term, TermLikelihood, draw, draw_from, log_weights};
use support::{answers, generator, l2_sphere};

const K: usize = 5;

/// The first `n` of sixty answers about thirty items.
fn model(n: usize, rationality: Rationality) -> Model<'static> {
    let mut generator = generator(100, 0);
    let w = l2_sphere(K, &mut generator);
    let (features, mut given) = answers(&w, 3.0, &AnswerModel::default(), (30, 60), &mut generator);
    given.truncate(n);
    with(features, given, rationality)
}

fn with(features: Vec<f64>, given: Vec<Answer>, rationality: Rationality) -> Model<'static> {
    let preferences = PreferenceLikelihood::new(K, features, given, AnswerModel::default()).expect("good preferences");
    Model {
        n_features: K,
        prior: Prior::L2Sphere,
        nonnegative_return: None,
        terms: vec![Term {
            kind: EvidenceKind::Preferences,
            rationality,
            likelihood: TermLikelihood::Preferences(preferences),
        }],
    }
}

const FIXED: Rationality = Rationality::Fixed(3.0);
const LEARNED: Rationality = Rationality::Learned { median: 3.0, log_sd: 0.5 };

fn long_run() -> Run {
    Run { n_draws: 16_000, ..Run::default() }
}

#[test]
fn reweighted_draws_stand_in_for_a_full_run() {
    for rationality in [FIXED, LEARNED] {
        let before = draw(&model(20, rationality), &long_run(), 1, &[0; 32]).expect("draws");
        let more = model(22, rationality);
        let smoothed = pareto_smooth(&log_weights(&more, &before)).expect("finite weights");
        assert!(smoothed.is_reliable(), "k-hat {}", smoothed.khat);
        let after = draw(&more, &long_run(), 2, &[0; 32]).expect("draws");
        let weights = smoothed.weights();
        for k in 0..K {
            let reweighted: f64 = before.feature(k).iter().zip(&weights).map(|(w, weight)| w * weight).sum();
            let full = after.mean_weights()[k];
            assert!((reweighted - full).abs() < 0.015, "{rationality:?}, weight {k}: {reweighted} vs {full}");
        }
    }
}

#[test]
fn reweighting_far_away_is_refused() {
    let before = draw(&model(0, FIXED), &long_run(), 1, &[0; 32]).expect("draws");
    // Forty sharp answers concentrate the posterior on a small part of the prior.
    let sharp = model(60, Rationality::Fixed(60.0));
    let smoothed = pareto_smooth(&log_weights(&sharp, &before)).expect("finite weights");
    assert!(!smoothed.is_reliable(), "k-hat {}, worth {}", smoothed.khat, smoothed.effective_size);
}

#[test]
fn a_kind_that_is_new_with_a_learned_rationality_takes_it_from_its_prior() {
    let plain = Model { terms: Vec::new(), ..model(0, FIXED) };
    let before = draw(&plain, &long_run(), 1, &[0; 32]).expect("draws");
    let more = model(3, LEARNED);
    let smoothed = pareto_smooth(&log_weights(&more, &before)).expect("finite weights");
    let after = draw(&more, &long_run(), 2, &[0; 32]).expect("draws");
    for k in 0..K {
        let of_draws = before.feature(k);
        let reweighted: f64 = of_draws.iter().zip(&smoothed.weights()).map(|(w, weight)| w * weight).sum();
        let full = after.mean_weights()[k];
        assert!((reweighted - full).abs() < 0.02, "weight {k}: {reweighted} vs {full}");
    }
}

#[test]
fn a_warm_restart_agrees_with_a_cold_one() {
    let before = draw(&model(20, LEARNED), &Run::default(), 1, &[0; 32]).expect("draws");
    let more = model(24, LEARNED);
    let short = Run { warmup: 100, ..long_run() };
    let warm = draw_from(&more, &short, 3, &[1; 32], Some(&before.warm)).expect("draws");
    let cold = draw(&more, &long_run(), 4, &[1; 32]).expect("draws");
    assert!(warm.rhat_max < 1.01 && warm.ess_bulk_min > 4000.0, "{} {}", warm.rhat_max, warm.ess_bulk_min);
    for (k, (warm, cold)) in warm.mean_weights().iter().zip(cold.mean_weights()).enumerate() {
        assert!((warm - cold).abs() < 0.015, "weight {k}: {warm} vs {cold}");
    }
    assert!((warm.betas[0].mean() - cold.betas[0].mean()).abs() < 0.15);
}

#[test]
fn evidence_taken_back_leaves_no_trace_and_threads_do_not_matter() {
    let run = |threads| Run { threads, n_draws: 800, ..Run::default() };
    for rationality in [FIXED, LEARNED] {
        let never = draw(&model(10, rationality), &run(1), 9, &[3; 32]).expect("draws");
        let _ = draw(&model(11, rationality), &run(2), 9, &[4; 32]).expect("draws");
        let again = draw(&model(10, rationality), &run(3), 9, &[3; 32]).expect("draws");
        assert_eq!(never, again);
        assert_ne!(never.values, draw(&model(10, rationality), &run(1), 9, &[4; 32]).expect("draws").values);
    }
}

#[test]
fn a_cycle_of_preferences_has_a_posterior() {
    let answer = |less, more| Answer { less, more, factor: 1.0, verdict: Verdict::Strict };
    let features: Vec<f64> = (0..3 * K).map(|i| ((i * i) as f64).sin()).collect();
    let cyclic = with(features, vec![answer(0, 1), answer(1, 2), answer(2, 0)], LEARNED);
    let draws = draw(&cyclic, &Run::default(), 1, &[0; 32]).expect("draws");
    assert!(draws.rhat_max < 1.01);
    // Contradictions speak for a person who is less rational than expected.
    assert!(draws.betas[0].mean() < 3.0, "{}", draws.betas[0].mean());
}

#[test]
fn models_that_do_not_fit_are_refused_in_words() {
    let refused = |model: &Model<'_>| draw(model, &Run::default(), 1, &[0; 32]).expect_err("refused").to_string();
    let good = || model(4, FIXED);
    let other = Model { n_features: 4, ..good() };
    assert_eq!(refused(&other), "the preferences are about 5 weights, but the model has 4");
    let none = Model { n_features: 0, terms: Vec::new(), ..good() };
    assert_eq!(refused(&none), "0 weights; 1 to 4096 are supported");
    let beta = model(4, Rationality::Fixed(f64::NAN));
    assert_eq!(refused(&beta), "beta of the preferences is NaN, but must be a number between 0.000001 and 1000000");
    let wide = model(4, Rationality::Learned { median: 1.0, log_sd: 9.0 });
    assert!(refused(&wide).contains("standard deviation of ln beta of the preferences is 9"), "{}", refused(&wide));
    let scale = Model { prior: Prior::Gaussian { scale: -1.0 }, ..good() };
    assert!(refused(&scale).contains("the scale of the prior is -1"), "{}", refused(&scale));
    let short = Model { nonnegative_return: Some(vec![1.0]), ..good() };
    assert!(refused(&short).contains("are 1 numbers, but the model has 5 weights"), "{}", refused(&short));
    let nan = Model { nonnegative_return: Some(vec![f64::NAN; K]), ..good() };
    assert!(refused(&nan).contains("feature 0 of the worst demonstration is NaN"), "{}", refused(&nan));
    // One weight on a sphere is 1 or −1: with a negative return known to be non-negative one start in two remains.
    let one = Model { n_features: 1, prior: Prior::L1Sphere, nonnegative_return: Some(vec![1.0]), terms: Vec::new() };
    let draws = draw(&one, &Run::default(), 1, &[0; 32]).expect("draws");
    assert!(draws.values.iter().all(|w| *w == 1.0) && draws.map_weights == [1.0]);
}

#[test]
fn what_cannot_be_sampled_is_told_by_the_diagnostics() {
    // Two opposite answers about trajectories 1e9 apart leave a slice of the sphere 1e-9 wide.
    let features: Vec<f64> = (0..2 * K).map(|i| if i < K { 0.0 } else { 1e9 }).collect();
    let answer = |less, more| Answer { less, more, factor: 1.0, verdict: Verdict::Strict };
    let draws = draw(&with(features, vec![answer(0, 1), answer(1, 0)], FIXED), &Run::default(), 1, &[0; 32]);
    let draws = draws.expect("draws");
    assert!(draws.log_likelihood.iter().all(|value| value.is_finite()));
    assert!(draws.rhat_max > 1.05, "R-hat {}", draws.rhat_max);
}
