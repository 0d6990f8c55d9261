//! Bayesian IRL on the 9 × 9 world "rep 0" at β = 100: effective samples per CPU second of our sampler, which solves exactly,
//! and of the dissertation's walk with one value iteration per proposal.

use likelihood::actions::{ActionLikelihood, Choice, without_duplicates};
use mdp::worlds::chapter4::{N_FEATURES, REP_0_WEIGHTS, STARTS, rep_0};
use mdp::{Mdp, Policy, Solver, rollout};
use posterior::{Draws, EvidenceKind, Model, Prior, Rationality, Run, Term, TermLikelihood, draw};
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;
use serde::Serialize;

use crate::clock::timed;
use crate::effective::{Effective, judge, mean_and_error};
use crate::error::PeersError;
use crate::published_walk;

const BETA: f64 = 100.0;
const CHAINS: usize = 4;
/// Steps of a demonstration.
const LENGTH: usize = 100;
/// Draws of one ordinary job.
const JOB_DRAWS: usize = 4000;
/// Most draws of our long run, and most steps per chain of the walk.
const MAX_DRAWS: usize = 200_000;
/// Steps of the walk that are timed first.
const FIRST_STEPS: usize = 500;
/// Numbers of demonstrations, one row each.
const DEMONSTRATIONS: [usize; 3] = [1, 5, 9];

/// One program on one set of demonstrations.
#[derive(Debug, Clone, Serialize)]
pub struct Speed {
    /// Smallest effective samples per CPU second, start-up left out.
    per_second: f64,
    /// CPU seconds per draw or proposal.
    seconds_per_draw: f64,
    acceptance: f64,
    effective: Effective,
    log_likelihood_mean: f64,
    log_likelihood_error: f64,
}

/// Both programs on one set of demonstrations.
#[derive(Debug, Clone, Serialize)]
pub struct Compared {
    n_demonstrations: usize,
    n_choices: usize,
    ours: Speed,
    /// Ours of one job of 4,000 draws, warm-up counted.
    job_per_second: f64,
    walk: Speed,
    ratio: f64,
    /// The job with its warm-up over the walk without its burn-in.
    job_ratio: f64,
}

/// Compares on one, five and nine demonstrations and prints a table.
pub fn compare(seconds: f64, seed: u64) -> Result<Vec<Compared>, PeersError> {
    let mdp = rep_0().mdp()?;
    let mut all = Vec::new();
    println!(
        "{:<15} {:<24} {:>12} {:>10} {:>10} {:>8} {:>18}",
        "demonstrations", "program", "ESS/CPU-s", "us/draw", "accepted", "R-hat", "mean log-lik."
    );
    for n in DEMONSTRATIONS {
        let compared = case(&mdp, n, seconds, seed)?;
        for (program, speed) in [("ours", &compared.ours), ("the dissertation's walk", &compared.walk)] {
            println!(
                "{n:<15} {program:<24} {:>12.1} {:>10.1} {:>10.3} {:>8.4} {:>10.3} ± {:.3}",
                speed.per_second,
                1e6 * speed.seconds_per_draw,
                speed.acceptance,
                speed.effective.rhat_max,
                speed.log_likelihood_mean,
                speed.log_likelihood_error
            );
        }
        println!("ours / walk: {:.1} (our job with its warm-up: {:.1})", compared.ratio, compared.job_ratio);
        all.push(compared);
    }
    Ok(all)
}

/// Demonstrations of the optimal policy from the first starts, repeats left out as in chapter 4.
fn choices(mdp: &Mdp, n_demonstrations: usize, seed: u64) -> Result<Vec<Choice>, PeersError> {
    let policy = Policy::Deterministic(Solver::new(mdp).solve(&REP_0_WEIGHTS).policy().to_vec());
    let mut rng = ChaCha8Rng::seed_from_u64(seed);
    let mut taken = Vec::new();
    for &start in &STARTS[..n_demonstrations] {
        let steps = rollout(mdp, &policy, start, LENGTH, &mut rng)?;
        taken.extend(steps.into_iter().map(|(state, action)| Choice::taken(state, action)));
    }
    Ok(without_duplicates(&taken))
}

fn case(mdp: &Mdp, n_demonstrations: usize, seconds: f64, seed: u64) -> Result<Compared, PeersError> {
    let choices = choices(mdp, n_demonstrations, seed)?;
    let term = Term {
        kind: EvidenceKind::Actions,
        rationality: Rationality::Fixed(BETA),
        likelihood: TermLikelihood::Actions(ActionLikelihood::new(mdp, choices.clone())?),
    };
    let model = Model { n_features: N_FEATURES, prior: Prior::L1Sphere, nonnegative_return: None, terms: vec![term] };
    let (_, least_seconds, _) = timed_draw(&model, 10 * CHAINS, seed)?;
    let (_, job_seconds, job_effective) = timed_draw(&model, JOB_DRAWS, seed)?;
    let per_draw = (job_seconds - least_seconds).max(1e-9) / JOB_DRAWS as f64;
    let n_draws = ((seconds / per_draw) as usize / CHAINS * CHAINS).clamp(JOB_DRAWS, MAX_DRAWS);
    let (draws, all_seconds, effective) = timed_draw(&model, n_draws, seed)?;
    let (log_likelihood_mean, log_likelihood_error) = mean_and_error(&draws.log_likelihood, CHAINS)?;
    let ours = Speed {
        per_second: effective.ess_bulk_min / (all_seconds - least_seconds),
        seconds_per_draw: (all_seconds - least_seconds) / n_draws as f64,
        acceptance: draws.acceptance,
        effective,
        log_likelihood_mean,
        log_likelihood_error,
    };
    let walk = walk(mdp, &choices, seconds, seed)?;
    let job_per_second = job_effective.ess_bulk_min / job_seconds;
    Ok(Compared {
        n_demonstrations,
        n_choices: choices.len(),
        ratio: ours.per_second / walk.per_second,
        job_ratio: job_per_second / walk.per_second,
        ours,
        job_per_second,
        walk,
    })
}

/// CPU seconds of `n_draws` draws, their diagnostics left out: those are done once more to know how long they took.
fn timed_draw(model: &Model<'_>, n_draws: usize, seed: u64) -> Result<(Draws, f64, Effective), PeersError> {
    let run = Run { n_draws, n_chains: CHAINS, threads: 1, ..Run::default() };
    let (draws, all) = timed(|| draw(model, &run, seed, &[0; 32]));
    let draws = draws?;
    let (effective, judging) = timed(|| judge(&draws.values, N_FEATURES, &draws.log_likelihood, CHAINS));
    Ok((draws, all - judging, effective?))
}

/// Four chains of the walk from −1/8 each, the first tenth left out.
fn walk(mdp: &Mdp, choices: &[Choice], seconds: f64, seed: u64) -> Result<Speed, PeersError> {
    let run = |n_steps, seed| {
        let start = vec![-1.0 / N_FEATURES as f64; N_FEATURES];
        published_walk::walk(mdp, choices, BETA, start, n_steps, seed)
    };
    let (_, first) = timed(|| run(FIRST_STEPS, seed));
    let n_steps = (seconds / first * FIRST_STEPS as f64 / CHAINS as f64) as usize;
    let n_steps = n_steps.clamp(FIRST_STEPS, MAX_DRAWS);
    let (chains, all) = timed(|| (0..CHAINS as u64).map(|chain| run(n_steps, seed + chain)).collect::<Vec<_>>());
    let burn = n_steps / 10;
    let values: Vec<f64> = chains.iter().flat_map(|walk| &walk.values[burn * N_FEATURES..]).copied().collect();
    let heights: Vec<f64> = chains.iter().flat_map(|walk| &walk.log_likelihood[burn..]).copied().collect();
    let effective = judge(&values, N_FEATURES, &heights, CHAINS)?;
    let (log_likelihood_mean, log_likelihood_error) = mean_and_error(&heights, CHAINS)?;
    Ok(Speed {
        per_second: effective.ess_bulk_min / (0.9 * all),
        seconds_per_draw: all / (n_steps * CHAINS) as f64,
        acceptance: chains.iter().map(|walk| walk.acceptance).sum::<f64>() / CHAINS as f64,
        effective,
        log_likelihood_mean,
        log_likelihood_error,
    })
}
