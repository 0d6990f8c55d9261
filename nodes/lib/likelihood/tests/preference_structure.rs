//! What comparisons say and do not say: rankings, cycles, the span of differences; and what is refused.

use likelihood::preferences::{
    Answer, AnswerModel, MAX_ANSWERS, PreferenceError, PreferenceLikelihood, Verdict, cycles, ranking,
};
use proptest::prelude::{prop_assert, prop_assert_eq, proptest};
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{Rng, SeedableRng};

fn uniform(rng: &mut ChaCha8Rng) -> f64 {
    (rng.next_u64() >> 11) as f64 / (1_u64 << 53) as f64 * 2.0 - 1.0
}

fn strict(pairs: &[(usize, usize)]) -> Vec<Answer> {
    pairs.iter().map(|&(less, more)| Answer { less, more, factor: 1.0, verdict: Verdict::Strict }).collect()
}

fn likelihood(n_features: usize, features: Vec<f64>, pairs: &[(usize, usize)]) -> PreferenceLikelihood {
    PreferenceLikelihood::new(n_features, features, strict(pairs), AnswerModel::default()).expect("good answers")
}

fn random_features(seed: u64, n: usize) -> Vec<f64> {
    let mut rng = ChaCha8Rng::seed_from_u64(seed);
    (0..n).map(|_| uniform(&mut rng)).collect()
}

#[test]
fn a_ranking_gives_all_its_pairs() {
    assert_eq!(ranking(&[4, 1, 7]).expect("a ranking"), [(4, 1), (4, 7), (1, 7)]);
    assert_eq!(ranking(&[]).expect("nothing"), []);
    assert_eq!(ranking(&[3, 5, 3]), Err(PreferenceError::RankedTwice { item: 3, first: 0, second: 2 }));
    let long: Vec<usize> = (0..3000).collect();
    assert_eq!(ranking(&long), Err(PreferenceError::TooManyAnswers { got: 4_498_500 }));
}

#[test]
fn rankings_have_no_cycles() {
    let pairs = ranking(&[5, 2, 9, 0, 1]).expect("a ranking");
    assert_eq!(cycles(&strict(&pairs)), Vec::<Vec<usize>>::new());
    assert_eq!(cycles(&[]), Vec::<Vec<usize>>::new());
}

#[test]
fn one_shortest_cycle_per_component_is_reported() {
    // 10 < 11 < 12 < 13 < 10 with the short cut 13 < 11; 3 < 4 < 3 twice; 20 < 21 < 22 without a cycle.
    let pairs = [(10, 11), (11, 12), (12, 13), (13, 10), (13, 11), (4, 3), (3, 4), (3, 4), (20, 21), (21, 22), (4, 10)];
    assert_eq!(cycles(&strict(&pairs)), [vec![3, 4], vec![11, 12, 13]]);
    let mut answers = strict(&[(0, 1), (1, 0)]);
    answers[1].verdict = Verdict::Equal;
    assert_eq!(cycles(&answers), Vec::<Vec<usize>>::new());
}

#[test]
fn a_large_component_is_searched_in_time() {
    let n = 100_000;
    let mut pairs: Vec<(usize, usize)> = (0..n).map(|item| (item, (item + 1) % n)).collect();
    pairs.extend((0..n).map(|item| (item, (item + 2) % n)));
    let found = cycles(&strict(&pairs));
    assert_eq!((found.len(), found[0].len()), (1, n / 2));
}

#[test]
fn only_compared_items_count_for_the_span() {
    // Components {0, 1}, {2, 3}, and 4 alone; the offset between them must not count.
    let features = vec![
        0.0, 0.0, 100.0, 0.0, // 0
        1.0, 0.0, 100.0, 0.0, // 1: differs along the first axis
        0.0, 5.0, 0.0, 0.0, // 2
        0.0, 7.0, 0.0, 0.0, // 3: differs along the second axis
        0.0, 0.0, 0.0, 9.0, // 4: not compared
    ];
    let likelihood = likelihood(4, features, &[(0, 1), (2, 3)]);
    let basis = likelihood.difference_span(&[], 1e-10);
    assert_eq!((basis.rank(), basis.n_features()), (2, 4));
    assert!(basis.rows().chunks(4).all(|row| row[2] == 0.0 && row[3] == 0.0));
    let with_extra = likelihood.difference_span(&[&[0.0, 1e-3, 0.0, 2e-3], &[0.0; 4]], 1e-10);
    assert_eq!(with_extra.rank(), 3);
    assert!((with_extra.coordinates(&[0.0, 0.0, 0.0, 1.0]).iter().map(|c| c * c).sum::<f64>() - 1.0).abs() < 1e-14);
}

#[test]
fn nothing_to_tell_apart_gives_rank_zero() {
    let same = likelihood(3, vec![0.1, 0.2, 0.3, 0.1, 0.2, 0.3], &[(0, 1)]);
    let basis = same.difference_span(&[], 1e-10);
    assert_eq!(basis.rank(), 0);
    let projected = same.projected(&basis);
    assert_eq!(projected.n_features(), 0);
    assert!((projected.value(&[]) - 0.5_f64.ln()).abs() < 1e-15);
    assert_eq!(projected.evaluator().value_and_gradient(&[], &mut []), projected.value(&[]));
}

#[test]
fn a_common_offset_costs_no_digits() {
    let (k, m) = (6, 5);
    let small = random_features(3, k * m);
    // Exactly representable features of size 1 beside an offset of 2^30.
    let rounded: Vec<f64> = small.iter().map(|value| (value * 1_048_576.0).round() / 1_048_576.0).collect();
    let offset: Vec<f64> = rounded.iter().map(|value| value + 1_073_741_824.0).collect();
    let pairs = ranking(&[0, 1, 2, 3, 4]).expect("a ranking");
    let (near, far) = (likelihood(k, rounded, &pairs), likelihood(k, offset, &pairs));
    let (near_basis, far_basis) = (near.difference_span(&[], 1e-10), far.difference_span(&[], 1e-10));
    assert_eq!((near_basis.rank(), far_basis.rank()), (4, 4));
    let theta = [3.0, -2.0, 1.0, 0.5, -4.0, 2.0];
    let exact = near.value(&theta);
    let value = far.projected(&far_basis).value(&far_basis.coordinates(&theta));
    assert!((value - exact).abs() < 1e-13, "{value} vs {exact}");
}

proptest! {
    #[test]
    fn the_projection_changes_nothing(seed in 0_u64..10_000, n_items in 2_usize..9, k in 1_usize..12, spread in -3..6_i32) {
        let mut features = random_features(seed, n_items * k);
        // Columns of very different size.
        for (at, value) in features.iter_mut().enumerate() {
            *value *= 10_f64.powi(spread * (at % k) as i32 % 5);
        }
        let order: Vec<usize> = (0..n_items).collect();
        let likelihood = likelihood(k, features, &ranking(&order).expect("a ranking"));
        let basis = likelihood.difference_span(&[], 1e-12);
        prop_assert!(basis.rank() <= k.min(n_items - 1));
        for (i, a) in basis.rows().chunks(k).enumerate() {
            for (j, b) in basis.rows().chunks(k).enumerate() {
                let inner: f64 = a.iter().zip(b).map(|(a, b)| a * b).sum();
                prop_assert!((inner - f64::from(u8::from(i == j))).abs() < 1e-14);
            }
        }
        let largest = likelihood.items().iter().fold(0.0_f64, |largest, value| largest.max(value.abs()));
        let theta: Vec<f64> = random_features(seed + 1, k).iter().map(|w| 10.0 * w / largest).collect();
        let projected = likelihood.projected(&basis);
        let (mut gradient, mut short) = (vec![0.0; k], vec![0.0; basis.rank()]);
        let value = likelihood.evaluator().value_and_gradient(&theta, &mut gradient);
        let same = projected.evaluator().value_and_gradient(&basis.coordinates(&theta), &mut short);
        prop_assert!((value - same).abs() < 1e-10 * (1.0 + value.abs()), "{} vs {}", value, same);
        for (full, back) in gradient.iter().zip(basis.vector(&short)) {
            prop_assert!((full - back).abs() < 1e-10 * (1.0 + largest), "{} vs {}", full, back);
        }
    }

    #[test]
    fn cycles_are_cycles(seed in 0_u64..10_000, n in 2_usize..8) {
        let mut rng = ChaCha8Rng::seed_from_u64(seed);
        let mut below = |n: usize| (rng.next_u64() % n as u64) as usize;
        let pairs: Vec<(usize, usize)> =
            (0..2 * n).map(|_| (below(n), below(n))).filter(|(less, more)| less != more).collect();
        let found = cycles(&strict(&pairs));
        for cycle in &found {
            for (at, &less) in cycle.iter().enumerate() {
                prop_assert!(pairs.contains(&(less, cycle[(at + 1) % cycle.len()])));
            }
        }
        // A ranking that agrees with all answers exists exactly where no cycle does: take away items that nothing beats.
        let mut left: Vec<usize> = (0..n).collect();
        while let Some(at) =
            left.iter().position(|item| !pairs.iter().any(|(less, more)| less == item && left.contains(more)))
        {
            left.remove(at);
        }
        prop_assert_eq!(left.is_empty(), found.is_empty());
    }
}

#[test]
fn bad_items_are_refused() {
    let refuse = |n_features, features, expected: PreferenceError| {
        let got = PreferenceLikelihood::new(n_features, features, Vec::new(), AnswerModel::default());
        assert_eq!(got.expect_err("bad items"), expected);
    };
    refuse(0, vec![1.0], PreferenceError::FeatureCount { got: 0 });
    refuse(5000, vec![1.0; 5000], PreferenceError::FeatureCount { got: 5000 });
    refuse(2, vec![1.0; 3], PreferenceError::Ragged { got: 3, n_features: 2 });
    refuse(1, vec![1.0; 100_001], PreferenceError::TooManyItems { got: 100_001, n_features: 1 });
    for got in [f64::INFINITY, f64::NEG_INFINITY, 1e101] {
        refuse(2, vec![1.0, 1.0, 1.0, got], PreferenceError::FeatureValue { item: 1, feature: 1, got });
    }
    let nan = PreferenceLikelihood::new(1, vec![f64::NAN], Vec::new(), AnswerModel::default());
    assert_eq!(
        nan.expect_err("not a number").to_string(),
        "feature 0 of item 0 is NaN, expected a number of magnitude at most 1e100"
    );
}

#[test]
fn bad_answers_are_refused() {
    let good = Answer { less: 0, more: 1, factor: 1.0, verdict: Verdict::Strict };
    let refuse = |bad: Answer, expected: PreferenceError| {
        let got = PreferenceLikelihood::new(1, vec![0.0, 1.0], vec![good, bad], AnswerModel::default());
        assert_eq!(got.expect_err("a bad answer"), expected);
    };
    refuse(Answer { less: 2, ..good }, PreferenceError::UnknownItem { answer: 1, got: 2, n_items: 2 });
    let huge = usize::MAX;
    refuse(Answer { more: huge, ..good }, PreferenceError::UnknownItem { answer: 1, got: huge, n_items: 2 });
    refuse(Answer { less: 1, ..good }, PreferenceError::SameItem { answer: 1, item: 1 });
    for got in [0.0, -1.0, f64::INFINITY, 2e6] {
        refuse(Answer { factor: got, ..good }, PreferenceError::Factor { answer: 1, got });
    }
    let verdict = Verdict::Equal;
    let parameter = "equal_threshold";
    refuse(Answer { verdict, ..good }, PreferenceError::NotOffered { answer: 1, verdict, parameter });
    let verdict = Verdict::CantTell;
    let parameter = "cant_tell";
    refuse(Answer { verdict, ..good }, PreferenceError::NotOffered { answer: 1, verdict, parameter });
    let many = PreferenceLikelihood::new(1, vec![0.0, 1.0], vec![good; MAX_ANSWERS + 1], AnswerModel::default());
    assert_eq!(many.expect_err("too many"), PreferenceError::TooManyAnswers { got: MAX_ANSWERS + 1 });
}

#[test]
fn bad_answer_models_are_refused() {
    let plain = AnswerModel::default();
    let refuse = |model, message: &str| {
        let got = PreferenceLikelihood::new(1, vec![0.0], Vec::new(), model).expect_err("a bad model");
        assert_eq!(got.to_string(), message);
    };
    let threshold = "expected at least 0 and at most 1e6";
    let share = "expected at least 0 and below 1";
    refuse(
        AnswerModel { equal_threshold: -0.1, ..plain },
        &format!("the equal_threshold of the answer model is -0.1, {threshold}"),
    );
    refuse(
        AnswerModel { equal_threshold: f64::NAN, ..plain },
        &format!("the equal_threshold of the answer model is NaN, {threshold}"),
    );
    refuse(AnswerModel { cant_tell: 1.0, ..plain }, &format!("the cant_tell of the answer model is 1, {share}"));
    refuse(
        AnswerModel { wrong_rate: -1e-9, ..plain },
        &format!("the wrong_rate of the answer model is -0.000000001, {share}"),
    );
}
