//! Effective samples of preference posteriors: 64 weights, few and many trajectories, soft and sharp.

use std::time::Duration;

use criterion::{Criterion, criterion_group, criterion_main};
use diagnostics::normal_quantile;
use likelihood::preferences::{Answer, AnswerModel, PreferenceLikelihood, Verdict, ranking};
use posterior::{EvidenceKind, Model, Prior, Rationality, Run, Term, TermLikelihood, draw};
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{Rng, SeedableRng};

const K: usize = 64;

/// `m` trajectories with features of standard deviation `sd`, and `n` answers drawn from the model at β = 1.
fn preferences(m: usize, n: usize, sd: f64, seed: u64) -> PreferenceLikelihood {
    let mut generator = ChaCha8Rng::seed_from_u64(seed);
    let mut uniform = || ((generator.next_u64() >> 12) as f64 + 0.5) / (1_u64 << 52) as f64;
    let features: Vec<f64> = (0..m * K).map(|_| sd * normal_quantile(uniform())).collect();
    let mut w: Vec<f64> = (0..K).map(|_| normal_quantile(uniform())).collect();
    let norm = w.iter().map(|w| w * w).sum::<f64>().sqrt();
    w.iter_mut().for_each(|w| *w /= norm);
    let returns: Vec<f64> = features.chunks_exact(K).map(|row| row.iter().zip(&w).map(|(x, w)| x * w).sum()).collect();
    let mut pairs = ranking(&(0..m).collect::<Vec<_>>()).expect("distinct items");
    for i in (1..pairs.len()).rev() {
        pairs.swap(i, (uniform() * (i + 1) as f64) as usize);
    }
    pairs.truncate(n);
    let answers = pairs.into_iter().map(|(a, b)| {
        let prefers_b = uniform() < 1.0 / (1.0 + (returns[a] - returns[b]).exp());
        let (less, more) = if prefers_b { (a, b) } else { (b, a) };
        Answer { less, more, factor: 1.0, verdict: Verdict::Strict }
    });
    let model = AnswerModel { equal_threshold: 0.0, cant_tell: 0.0, wrong_rate: 0.0 };
    PreferenceLikelihood::new(K, features, answers.collect(), model).expect("good preferences")
}

fn sampling(c: &mut Criterion) {
    let mut group = c.benchmark_group("4000 draws on one thread");
    group.sample_size(10).measurement_time(Duration::from_secs(3));
    for (name, m, n, sd) in [
        ("12 soft", 12, 66, 1.0),
        ("12 sharp", 12, 66, 10.0),
        ("200 soft", 200, 1937, 1.0),
        ("200 sharp", 200, 1937, 10.0),
    ] {
        let model = Model {
            n_features: K,
            prior: Prior::L2Sphere,
            nonnegative_return: None,
            terms: vec![Term {
                kind: EvidenceKind::Preferences,
                rationality: Rationality::Fixed(1.0),
                likelihood: TermLikelihood::Preferences(preferences(m, n, sd, 1)),
            }],
        };
        let run = Run { threads: 1, ..Run::default() };
        let sample = || draw(&model, &run, 1, &[0; 32]).expect("draws");
        #[allow(clippy::disallowed_methods, reason = "a benchmark reads the clock")]
        let start = std::time::Instant::now();
        let draws = sample();
        let seconds = start.elapsed().as_secs_f64();
        println!(
            "{name}: accepted {:.3}, R-hat {:.4}, bulk {:.0}, tail {:.0}, MAP {:.2} (mean {:.2}), {:.0} minimum effective samples per second",
            draws.acceptance,
            draws.rhat_max,
            draws.ess_bulk_min,
            draws.ess_tail_min,
            draws.map_log_likelihood,
            draws.log_likelihood_mean(),
            draws.ess_bulk_min / seconds
        );
        group.bench_function(name, |b| b.iter(sample));
    }
}

criterion_group!(benches, sampling);
criterion_main!(benches);
