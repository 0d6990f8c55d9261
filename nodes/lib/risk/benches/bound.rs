//! How long a bound takes: 4 chains of 2500 draws, independent and strongly autocorrelated.

use std::hint::black_box;

use criterion::{Criterion, criterion_group, criterion_main};
use diagnostics::{normal_quantile, pareto_smooth};
use risk::{Measure, Sample, Tail, risk_bound, upper_bound};

/// Stationary autoregressive chains with standard normal marginals, from SplitMix64.
fn chains(mut state: u64, n_chains: usize, per_chain: usize, rho: f64) -> Vec<f64> {
    let mut normal = || {
        state = state.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = state;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        z ^= z >> 31;
        normal_quantile(((z >> 12) as f64 + 0.5) / (1_u64 << 52) as f64)
    };
    let mut draws = Vec::with_capacity(n_chains * per_chain);
    for _ in 0..n_chains {
        let mut x = normal();
        for _ in 0..per_chain {
            draws.push(x);
            x = rho * x + (1.0 - rho * rho).sqrt() * normal();
        }
    }
    draws
}

fn bounds(criterion: &mut Criterion) {
    for (name, rho) in [("independent", 0.0), ("rho 0.9", 0.9)] {
        let draws = chains(7, 4, 2500, rho);
        criterion.bench_function(&format!("upper_bound, {name}"), |bencher| {
            bencher.iter(|| upper_bound(black_box(&draws), 4, 0.95, 0.05));
        });
        let sample = Sample { values: &draws, n_chains: 4, weights: None };
        let measure = Measure::ConditionalValueAtRisk { alpha: 0.95 };
        criterion.bench_function(&format!("conditional value at risk, {name}"), |bencher| {
            bencher.iter(|| risk_bound(black_box(&sample), measure, 0.05, Some(9.0), Tail::Upper));
        });
        let log_weights: Vec<f64> = draws.iter().map(|x| 0.5 * x).collect();
        let weights = pareto_smooth(&log_weights).expect("finite weights");
        let sample = Sample { weights: Some(&weights), ..sample };
        let measure = Measure::ValueAtRisk { alpha: 0.95 };
        criterion.bench_function(&format!("weighted value at risk, {name}"), |bencher| {
            bencher.iter(|| risk_bound(black_box(&sample), measure, 0.05, None, Tail::Upper));
        });
        criterion.bench_function(&format!("Pareto smoothing, {name}"), |bencher| {
            bencher.iter(|| pareto_smooth(black_box(&log_weights)));
        });
    }
}

criterion_group!(benches, bounds);
criterion_main!(benches);
