//! Fresh draws: intervals cover as often as they say.
#![allow(clippy::unwrap_used)]

mod common;

use common::close;
use mdp::random::normal;
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;
use robust::{Bootstrap, Objective, Problem, Settings, out_of_sample, performance};

/// CVaR of the lower tail of a standard normal: −density(z) / (1 − α) at its (1 − α)-quantile z.
const NORMAL_CVAR_90: f64 = -1.754_983_319_324_868;

/// Stationary chains with standard normal marginals, one after another.
fn chains(rho: f64, n_chains: usize, per_chain: usize, rng: &mut ChaCha8Rng) -> Vec<f64> {
    let mut values = vec![];
    for _ in 0..n_chains {
        let mut x = normal(rng);
        for _ in 0..per_chain {
            values.push(x);
            x = rho * x + (1.0 - rho * rho).sqrt() * normal(rng);
        }
    }
    values
}

/// How many of `trials` intervals at 95 %, from 4 chains, hold the truth.
fn covered(rho: f64, per_chain: usize, treat_as: usize, trials: usize) -> usize {
    let mut rng = ChaCha8Rng::seed_from_u64(1);
    let bootstrap = Bootstrap { replicates: 200, ..Bootstrap::default() };
    let hits = (0..trials).filter(|_| {
        let values = chains(rho, 4, per_chain, &mut rng);
        let [low, high] = out_of_sample(&values, treat_as, None, 0.9, &bootstrap).unwrap().interval;
        (low..=high).contains(&NORMAL_CVAR_90)
    });
    hits.count()
}

#[test]
fn intervals_cover() {
    // 190 of 200 are expected of exact intervals; these are a little short, which draws from a tail of 40 make them.
    for (rho, per_chain, treat_as) in [(0.0, 100, 0), (0.0, 100, 4), (0.8, 400, 4)] {
        let covered = covered(rho, per_chain, treat_as, 200);
        assert!((178..=199).contains(&covered), "{covered} of 200 at ρ = {rho}");
    }
    // Taking chains for independent draws would be wrong.
    let naive = covered(0.8, 400, 0, 60);
    assert!(naive < 45, "{naive} of 60");
}

#[test]
fn estimates_are_those_of_the_tail() {
    let values: Vec<f64> = (1..=2000).rev().map(f64::from).collect();
    let fresh = out_of_sample(&values, 0, None, 0.99, &Bootstrap::default()).unwrap();
    close(fresh.conditional_value_at_risk, 10.5, 1e-9);
    close(fresh.mean, 1000.5, 1e-9);
    assert_eq!((fresh.value_at_risk, fresh.n, fresh.effective_size), (21.0, 2000, 2000.0));
    assert!(fresh.interval[0] < 10.5 && 10.5 < fresh.interval[1]);
    // The same seed gives the same bits, another one another interval, and less confidence a narrower one.
    assert_eq!(fresh, out_of_sample(&values, 0, None, 0.99, &Bootstrap::default()).unwrap());
    let other = Bootstrap { seed: 1, ..Bootstrap::default() };
    assert_ne!(fresh.interval, out_of_sample(&values, 0, None, 0.99, &other).unwrap().interval);
    let bold = Bootstrap { confidence: 0.5, ..Bootstrap::default() };
    let bold = out_of_sample(&values, 0, None, 0.99, &bold).unwrap().interval;
    assert!(bold[1] - bold[0] < fresh.interval[1] - fresh.interval[0]);
    // Nothing varies, nothing is uncertain.
    let same = out_of_sample(&[3.0; 50], 0, None, 0.9, &Bootstrap::default()).unwrap();
    assert_eq!((same.interval, same.standard_error), ([3.0, 3.0], 0.0));
}

#[test]
fn weights_weigh() {
    // Draws from N(0, 1) that stand for N(½, 1): weights ∝ exp(x / 2).
    let mut rng = ChaCha8Rng::seed_from_u64(2);
    let values: Vec<f64> = (0..20_000).map(|_| normal(&mut rng)).collect();
    let mut weights: Vec<f64> = values.iter().map(|x| (0.5 * x).exp()).collect();
    let total: f64 = weights.iter().sum();
    weights.iter_mut().for_each(|weight| *weight /= total);
    let fresh = out_of_sample(&values, 0, Some(&weights), 0.9, &Bootstrap::default()).unwrap();
    close(fresh.conditional_value_at_risk, NORMAL_CVAR_90 + 0.5, 0.06);
    assert!(fresh.interval[0] < NORMAL_CVAR_90 + 0.5 && NORMAL_CVAR_90 + 0.5 < fresh.interval[1], "{fresh:?}");
}

#[test]
fn few_draws_flatter_the_policy_chosen_by_them() {
    let case = common::Shape { n_draws: 20_000, ..common::shape(3) }.case();
    let k = case.mdp.n_features();
    let (few, many) = case.draws.split_at(100 * k);
    let problem = Problem::new(&case.mdp, few, None, Objective::Robust, 1).unwrap();
    let solution = problem.solve(0.95, 0.0, &Settings::default()).unwrap();
    let values = performance(&case.mdp, many, Objective::Robust, &solution.feature_counts, 1).unwrap();
    let fresh = out_of_sample(&values, 0, None, 0.95, &Bootstrap::default()).unwrap();
    assert!(fresh.interval[1] < solution.conditional_value_at_risk, "{fresh:?}");
    // ψ draw by draw is ψ of the whole.
    let again = performance(&case.mdp, few, Objective::Robust, &solution.feature_counts, 1).unwrap();
    let inside = out_of_sample(&again, 0, None, 0.95, &Bootstrap::default()).unwrap();
    close(inside.conditional_value_at_risk, solution.conditional_value_at_risk, 1e-12);
    let mut sorted = again.clone();
    sorted.sort_unstable_by(f64::total_cmp);
    let points = problem.distribution(&solution.feature_counts).unwrap();
    assert!(points.iter().map(|(value, _)| *value).eq(sorted));
}
