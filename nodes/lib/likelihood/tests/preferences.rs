//! Values and gradients of the likelihood of comparisons.

use likelihood::preferences::{Answer, AnswerModel, PreferenceLikelihood, Verdict, ranking, time_ordered};
use proptest::prelude::{Just, Strategy, prop_assert, prop_assert_eq, prop_oneof, proptest};
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{Rng, SeedableRng};

/// Log-probabilities and slopes to 18 digits, by mpmath with 60 and 200 digits of working precision.
const EXACT: &str = include_str!("data/preference_answers.csv");

fn answer(less: usize, more: usize, factor: f64, verdict: Verdict) -> Answer {
    Answer { less, more, factor, verdict }
}

fn uniform(rng: &mut ChaCha8Rng) -> f64 {
    (rng.next_u64() >> 11) as f64 / (1_u64 << 53) as f64 * 2.0 - 1.0
}

/// One answer about two items with the one feature 0 and 1, so that θ is the difference of the returns.
fn single(verdict: Verdict, factor: f64, model: AnswerModel) -> PreferenceLikelihood {
    PreferenceLikelihood::new(1, vec![0.0, 1.0], vec![answer(0, 1, factor, verdict)], model).expect("a good answer")
}

fn every_model() -> impl Strategy<Value = AnswerModel> {
    let threshold = prop_oneof![Just(0.0), 1e-6..6.0_f64];
    let share = || prop_oneof![Just(0.0), 1e-6..0.999_f64];
    (threshold, share(), share()).prop_map(|(equal_threshold, cant_tell, wrong_rate)| AnswerModel {
        equal_threshold,
        cant_tell,
        wrong_rate,
    })
}

/// Answers of every kind that the model offers, about random items.
fn random(seed: u64, n_items: usize, n_features: usize, n: usize, model: AnswerModel) -> PreferenceLikelihood {
    let mut rng = ChaCha8Rng::seed_from_u64(seed);
    let features = (0..n_items * n_features).map(|_| uniform(&mut rng)).collect();
    let mut verdicts = vec![Verdict::Strict];
    verdicts.extend((model.equal_threshold > 0.0).then_some(Verdict::Equal));
    verdicts.extend((model.cant_tell > 0.0).then_some(Verdict::CantTell));
    let mut below = |n: usize| (rng.next_u64() % n as u64) as usize;
    let answers = (0..n).map(|_| {
        let (less, by) = (below(n_items), 1 + below(n_items - 1));
        answer(less, (less + by) % n_items, [0.5, 1.0, 2.0][below(3)], verdicts[below(verdicts.len())])
    });
    PreferenceLikelihood::new(n_features, features, answers.collect(), model).expect("good answers")
}

#[test]
fn single_answers_have_the_exact_probability_and_slope() {
    let mut n = 0;
    for line in EXACT.lines().skip(1) {
        let fields: Vec<&str> = line.split(',').collect();
        let number = |at: usize| fields[at].parse::<f64>().expect("a number");
        let model = AnswerModel { equal_threshold: number(0), cant_tell: number(1), wrong_rate: number(2) };
        let verdict = match fields[3] {
            "strict" => Verdict::Strict,
            "equal" => Verdict::Equal,
            _ => Verdict::CantTell,
        };
        let mut slope = [0.0];
        let likelihood = single(verdict, 1.0, model);
        let value = likelihood.evaluator().value_and_gradient(&[number(4)], &mut slope);
        assert!((value - number(5)).abs() <= 2e-15 * (1.0 + number(5).abs()), "{line}: {value}");
        // 1 − e^−|d| is right to 2^-52, and few who can tell, 1 − τ, make that count for more.
        let rounding = 2e-15 + f64::EPSILON / (1.0 - model.cant_tell);
        assert!((slope[0] - number(6)).abs() <= rounding * (1.0 + number(6).abs()), "{line}: {}", slope[0]);
        n += 1;
    }
    assert_eq!(n, 165);
}

#[test]
fn a_ranking_is_bradley_terry() {
    // Returns 0, 1, 3: P = s(1) s(3) s(2).
    let answers = ranking(&[0, 1, 2]).expect("a ranking");
    let answers = answers.into_iter().map(|(less, more)| answer(less, more, 1.0, Verdict::Strict)).collect();
    let likelihood =
        PreferenceLikelihood::new(1, vec![0.0, 1.0, 3.0], answers, AnswerModel::default()).expect("good answers");
    let s = |x: f64| 1.0 / (1.0 + (-x).exp());
    let exact = (s(1.0) * s(3.0) * s(2.0)).ln();
    assert!((likelihood.value(&[1.0]) - exact).abs() < 1e-15);
}

#[test]
fn weak_preferences_over_time_count_by_their_factor() {
    let model = AnswerModel::default();
    let weak = time_ordered(&[2, 0, 1], 0.25).expect("an order");
    assert_eq!(weak[0], answer(2, 0, 0.25, Verdict::Strict));
    assert_eq!(weak.len(), 3);
    let strong = time_ordered(&[2, 0, 1], 1.0).expect("an order");
    let of = |answers| PreferenceLikelihood::new(1, vec![0.3, 2.0, -1.0], answers, model).expect("good answers");
    // d = factor × θ × difference.
    assert_eq!(of(weak).value(&[4.0]).to_bits(), of(strong).value(&[1.0]).to_bits());
}

#[test]
fn without_answers_every_reward_explains_everything() {
    let likelihood =
        PreferenceLikelihood::new(2, vec![1.0, 2.0], Vec::new(), AnswerModel::default()).expect("no answers");
    let mut gradient = [1.0, 1.0];
    assert_eq!(likelihood.evaluator().value_and_gradient(&[3.0, 4.0], &mut gradient), 0.0);
    assert_eq!(gradient, [0.0, 0.0]);
}

#[test]
fn thousands_of_answers_add_up() {
    // More than one product of factors, and more than one block of it.
    let likelihood = random(5, 40, 7, 3000, AnswerModel::default());
    let theta = [2.0, -1.0, 0.5, 3.0, -8.0, 0.0, 1.0];
    let mut exact = 0.0;
    for answer in likelihood.answers() {
        let utility = |item: usize| -> f64 {
            likelihood.items()[item * 7..][..7].iter().zip(&theta).map(|(feature, w)| feature * w).sum()
        };
        let d = answer.factor * (utility(answer.more) - utility(answer.less));
        exact -= if d > 0.0 { (-d).exp().ln_1p() } else { d.exp().ln_1p() - d };
    }
    let value = likelihood.value(&theta);
    assert!((value - exact).abs() < 1e-12 * exact.abs(), "{value} vs {exact}");
}

#[test]
fn overflow_and_nan_show() {
    for model in [AnswerModel::default(), AnswerModel { equal_threshold: 1.0, cant_tell: 0.1, wrong_rate: 0.1 }] {
        for theta in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
            assert!(single(Verdict::Strict, 1.0, model).value(&[theta]).is_nan());
        }
    }
}

proptest! {
    #[test]
    fn probabilities_sum_to_one_and_agree_with_the_likelihood(model in every_model(), d in -60.0..60.0_f64) {
        let p = model.probabilities(d);
        prop_assert!((p.more + p.less + p.equal + p.cant_tell - 1.0).abs() < 1e-14);
        prop_assert!(p.more >= 0.0 && p.less >= 0.0 && p.equal >= 0.0 && p.cant_tell >= 0.0);
        let agrees = |verdict, d: f64, p: f64| {
            p < 1e-12 || (single(verdict, 2.0, model).value(&[d / 2.0]) - p.ln()).abs() < 1e-9
        };
        prop_assert!(agrees(Verdict::Strict, d, p.more));
        prop_assert!(agrees(Verdict::Strict, -d, p.less));
        prop_assert!(model.equal_threshold == 0.0 || agrees(Verdict::Equal, d, p.equal));
        prop_assert!(model.cant_tell == 0.0 || agrees(Verdict::CantTell, d, p.cant_tell));
    }

    #[test]
    fn a_larger_difference_makes_more_likelier_and_equal_less_likely(
        model in every_model(), d in 0.0..30.0_f64, by in 0.01..5.0_f64,
    ) {
        let (near, far) = (model.probabilities(d), model.probabilities(d + by));
        let slack = 1e-15;
        prop_assert!(far.more >= near.more - slack && far.cant_tell <= near.cant_tell + slack);
        // "About equal" can gain at first where those who cannot tell become fewer.
        prop_assert!(model.cant_tell > 0.0 || far.equal <= near.equal + slack);
        prop_assert!(model.cant_tell > 0.0 || far.less <= near.less + slack);
    }

    #[test]
    fn the_gradient_is_the_derivative(model in every_model(), seed in 0_u64..1000, scale in 0.1..20.0_f64) {
        let likelihood = random(seed, 9, 5, 40, model);
        let mut evaluator = likelihood.evaluator();
        let mut rng = ChaCha8Rng::seed_from_u64(seed);
        let theta: Vec<f64> = (0..5).map(|_| scale * uniform(&mut rng)).collect();
        let mut gradient = vec![0.0; 5];
        let value = evaluator.value_and_gradient(&theta, &mut gradient);
        prop_assert_eq!(value.to_bits(), evaluator.value(&theta).to_bits());
        for k in 0..5 {
            let mut at = |by: f64| {
                let mut moved = theta.clone();
                moved[k] += by;
                evaluator.value(&moved)
            };
            let h = 1e-4;
            let numeric = (8.0 * (at(h) - at(-h)) - (at(2.0 * h) - at(-2.0 * h))) / (12.0 * h);
            prop_assert!((gradient[k] - numeric).abs() < 1e-6 * (1.0 + numeric.abs()), "{}: {} vs {}", k, gradient[k], numeric);
        }
    }

    #[test]
    fn the_order_of_the_answers_does_not_matter(model in every_model(), seed in 0_u64..1000) {
        let likelihood = random(seed, 6, 3, 30, model);
        let mut reversed = likelihood.answers().to_vec();
        reversed.reverse();
        let other = PreferenceLikelihood::new(3, likelihood.items().to_vec(), reversed, model).expect("good answers");
        let theta = [1.0, -0.5, 2.0];
        prop_assert_eq!(likelihood.value(&theta).to_bits(), other.value(&theta).to_bits());
    }
}
