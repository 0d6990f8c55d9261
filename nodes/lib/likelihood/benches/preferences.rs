//! How long one log-likelihood with its gradient takes on comparisons of several sizes.

use std::hint::black_box;

use criterion::{Criterion, criterion_group, criterion_main};
use likelihood::preferences::{Answer, AnswerModel, PreferenceLikelihood, Verdict, ranking};
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{Rng, SeedableRng};

const N_FEATURES: usize = 64;

fn uniform(rng: &mut ChaCha8Rng) -> f64 {
    (rng.next_u64() >> 11) as f64 / (1_u64 << 53) as f64 - 0.5
}

fn strict((less, more): (usize, usize)) -> Answer {
    Answer { less, more, factor: 1.0, verdict: Verdict::Strict }
}

fn likelihood(n_items: usize, answers: Vec<Answer>, model: AnswerModel) -> PreferenceLikelihood {
    let mut rng = ChaCha8Rng::seed_from_u64(1);
    let features = (0..n_items * N_FEATURES).map(|_| uniform(&mut rng)).collect();
    PreferenceLikelihood::new(N_FEATURES, features, answers, model).expect("good answers")
}

fn all_pairs() -> Vec<Answer> {
    let order: Vec<usize> = (0..12).collect();
    ranking(&order).expect("a short ranking").into_iter().map(strict).collect()
}

fn many_pairs() -> Vec<Answer> {
    let mut rng = ChaCha8Rng::seed_from_u64(2);
    let mut below = |n: u64| (rng.next_u64() % n) as usize;
    (0..1937).map(|_| (below(200), 1 + below(199))).map(|(a, by)| strict((a, (a + by) % 200))).collect()
}

fn evaluations(c: &mut Criterion) {
    let plain = AnswerModel::default();
    let every_kind = AnswerModel { equal_threshold: 0.3, cant_tell: 0.2, wrong_rate: 0.05 };
    let verdicts = [Verdict::Strict, Verdict::Equal, Verdict::CantTell];
    let mixed = many_pairs()
        .into_iter()
        .zip(verdicts.into_iter().cycle())
        .map(|(answer, verdict)| Answer { verdict, ..answer });
    let mixed = mixed.collect();
    let small = likelihood(12, all_pairs(), plain);
    let collapsed = small.projected(&small.difference_span(&[], 1e-10));
    let cases = [
        ("k = 64, m = 12, 66 pairs", small),
        ("the same collapsed to rank 11", collapsed),
        ("k = 64, m = 200, 1,937 pairs", likelihood(200, many_pairs(), plain)),
        ("the same with every kind of answer", likelihood(200, mixed, every_kind)),
    ];
    for (name, likelihood) in &cases {
        let mut evaluator = likelihood.evaluator();
        let mut rng = ChaCha8Rng::seed_from_u64(3);
        let theta: Vec<f64> = (0..likelihood.n_features()).map(|_| uniform(&mut rng)).collect();
        let mut gradient = vec![0.0; theta.len()];
        c.bench_function(name, |b| b.iter(|| evaluator.value_and_gradient(black_box(&theta), &mut gradient)));
    }
}

criterion_group!(benches, evaluations);
criterion_main!(benches);
