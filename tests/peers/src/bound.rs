//! How long a bound from 10,000 draws takes.

use mdp::random::normal;
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;
use risk::{Outcome, upper_bound};
use serde::Serialize;

use crate::clock::timed;
use crate::error::PeersError;

const N_DRAWS: usize = 10_000;
const CHAINS: usize = 4;
/// Correlation of neighbouring losses, as of a sampler that is not perfect.
const CORRELATION: f64 = 0.3;
/// Bounds that are timed at most.
const MAX_BOUNDS: usize = 5000;

/// How long one bound takes.
#[derive(Debug, Clone, Serialize)]
pub struct Measured {
    n_draws: usize,
    n_bounds: usize,
    /// CPU milliseconds: median and largest.
    median_ms: f64,
    worst_ms: f64,
    outcome: String,
}

/// The upper 0.95-quantile bound at δ = .05, over and over.
pub fn measure(seconds: f64, seed: u64) -> Result<Measured, PeersError> {
    let losses = losses(seed);
    let mut times = Vec::new();
    let mut spent = 0.0;
    let outcome = loop {
        let (outcome, took) = timed(|| upper_bound(&losses, CHAINS, 0.95, 0.05));
        let outcome = outcome?;
        times.push(took);
        spent += took;
        if times.len() >= MAX_BOUNDS || spent >= seconds {
            break outcome;
        }
    };
    times.sort_unstable_by(f64::total_cmp);
    let measured = Measured {
        n_draws: N_DRAWS,
        n_bounds: times.len(),
        median_ms: 1e3 * times[times.len() / 2],
        worst_ms: 1e3 * times[times.len() - 1],
        outcome: describe(&outcome),
    };
    println!(
        "a bound from {N_DRAWS} draws: median {:.3} ms, worst of {} {:.3} ms ({})",
        measured.median_ms, measured.n_bounds, measured.worst_ms, measured.outcome
    );
    Ok(measured)
}

/// Four autoregressive chains of standard normal losses.
fn losses(seed: u64) -> Vec<f64> {
    let mut rng = ChaCha8Rng::seed_from_u64(seed);
    let mut losses = Vec::with_capacity(N_DRAWS);
    for _ in 0..CHAINS {
        let mut loss = normal(&mut rng);
        for _ in 0..N_DRAWS / CHAINS {
            loss = CORRELATION * loss + libm::sqrt(1.0 - CORRELATION * CORRELATION) * normal(&mut rng);
            losses.push(loss);
        }
    }
    losses
}

fn describe(outcome: &Outcome) -> String {
    outcome.bound().map_or_else(|| "no bound".into(), |bound| format!("bound {bound:.3}"))
}

#[cfg(test)]
mod tests {
    use super::{N_DRAWS, measure};

    #[test]
    fn a_tiny_run_gives_figures_that_survive_json() {
        let measured = measure(1e-9, 1).expect("a bound");
        let json = serde_json::to_value(&measured).expect("JSON");
        assert_eq!((json["n_draws"].as_u64(), json["n_bounds"].as_u64()), (Some(N_DRAWS as u64), Some(1)));
        // The 0.95-quantile of a standard normal is 1.645; the bound lies above it, not far.
        let bound: f64 = measured.outcome.trim_start_matches("bound ").parse().expect("a bound was issued");
        assert!((1.6..1.9).contains(&bound), "{bound}");
    }
}
