//! From a model to draws: a function of model, run and seed, of nothing else.

use crate::collapsed_density::CollapsedDensity;
use crate::density::Density;
use crate::draws::{BetaDraws, Kept, Warm};
use crate::full_density::FullDensity;
use crate::hmc::{Acceptance, Chain, MAX_STARTS, MAX_STEPS};
use crate::map::most_probable;
use crate::random::chain_generator;
use crate::warmup::{DualAveraging, pooled_scale};
use crate::{Draws, Model, ModelError, PosteriorError, Run};
use std::sync::atomic::{AtomicBool, Ordering};

/// Step size to start the search with.
const FIRST_STEP: f64 = 0.1;
/// Share of proposals to accept. High where the force is coarse: a rejected move costs a whole trajectory.
const TARGET_COARSE: f64 = 0.95;
/// The same where it is exact.
const TARGET_EXACT: f64 = 0.85;
/// Jumps after every trajectory where the force is coarse: each costs one exact evaluation, as much as the trajectory.
const JUMPS_COARSE: usize = 1;
/// The same where the force is exact: cheap beside a trajectory.
const JUMPS_EXACT: usize = 2;

/// Draws from the posterior of `model`. `evidence` is a fingerprint of its evidence: together with `seed` it decides the
/// random numbers.
///
/// The same for any number of threads and whatever was sampled before. Without evidence: draws from the prior.
///
/// # Errors
/// A run out of range; a model that does not fit together, or of probability zero everywhere.
pub fn draw(model: &Model<'_>, run: &Run, seed: u64, evidence: &[u8; 32]) -> Result<Draws, PosteriorError> {
    draw_from(model, run, seed, evidence, None)
}

/// The same from where an earlier run on almost the same evidence ended, with its step size and scale: a quarter of the
/// warm-up is enough. The draws then depend on that run too, so a session that must forget what was taken back starts cold.
///
/// # Errors
/// As [`draw`].
pub fn draw_from(
    model: &Model<'_>,
    run: &Run,
    seed: u64,
    evidence: &[u8; 32],
    warm: Option<&Warm>,
) -> Result<Draws, PosteriorError> {
    draw_unless(&AtomicBool::new(false), model, run, seed, evidence, warm)
}

/// The same, but given up soon after somebody sets `stop`: they know by then that the draws are not wanted.
///
/// # Errors
/// As [`draw`]; [`PosteriorError::Stopped`].
pub fn draw_unless(
    stop: &AtomicBool,
    model: &Model<'_>,
    run: &Run,
    seed: u64,
    evidence: &[u8; 32],
    warm: Option<&Warm>,
) -> Result<Draws, PosteriorError> {
    run.check()?;
    model.check()?;
    let sampled = match CollapsedDensity::plan(model) {
        Some(plan) => sample(stop, run, seed, evidence, warm, || CollapsedDensity::new(model, &plan)),
        None => sample(stop, run, seed, evidence, warm, || FullDensity::new(model)),
    };
    let (kept, acceptance, warm) = sampled?;
    let log_likelihood: Vec<f64> = kept.iter().flat_map(|kept| kept.log_likelihood.iter().copied()).collect();
    let n_terms = model.terms.len();
    let betas = model.terms.iter().enumerate().map(|(i, term)| BetaDraws {
        kind: term.kind,
        values: if term.rationality.is_learned() {
            kept.iter().flat_map(|kept| kept.betas.iter().skip(i).step_by(n_terms).copied()).collect()
        } else {
            vec![term.rationality.median()]
        },
    });
    let mut draws = Draws {
        n_chains: run.n_chains,
        per_chain: run.per_chain(),
        n_features: model.n_features,
        values: kept.iter().flat_map(|kept| kept.values.iter().copied()).collect(),
        log_likelihood,
        betas: betas.collect(),
        map_weights: Vec::new(),
        map_betas: Vec::new(),
        map_log_likelihood: 0.0,
        acceptance: acceptance / run.n_draws as f64,
        rhat_max: f64::INFINITY,
        ess_bulk_min: 0.0,
        ess_bulk_median: 0.0,
        ess_tail_min: 0.0,
        warm,
    };
    let map = most_probable(model, &draws);
    (draws.map_weights, draws.map_betas, draws.map_log_likelihood) = (map.weights, map.betas, map.log_likelihood);
    draws.diagnose(run.threads);
    Ok(draws)
}

/// A chain with what it found out and what it kept.
struct Runner<D> {
    chain: Chain<D>,
    step: DualAveraging,
    acceptance: f64,
    positions: Vec<f64>,
    kept: Kept,
}

/// Warms all chains up and lets them run: what each kept, the sum of acceptance probabilities, and a start for later.
fn sample<D: Density>(
    stop: &AtomicBool,
    run: &Run,
    seed: u64,
    evidence: &[u8; 32],
    warm: Option<&Warm>,
    density: impl Fn() -> D,
) -> Result<(Vec<Kept>, f64, Warm), PosteriorError> {
    let mut runners = Vec::with_capacity(run.n_chains);
    let mut target = TARGET_EXACT;
    let n = density().n();
    let warm = warm.filter(|warm| warm.scale.len() == n * n && warm.positions.len() == run.n_chains);
    for chain in 0..run.n_chains {
        let density = density();
        target = if density.force_is_exact() { TARGET_EXACT } else { TARGET_COARSE };
        let from = warm.map(|warm| warm.positions[chain].as_slice());
        let chain = Chain::new(density, chain_generator(seed, evidence, chain), from)
            .ok_or(ModelError::NoStart { tries: MAX_STARTS })?;
        let first = warm.map_or(FIRST_STEP, |warm| warm.step_size);
        runners.push(Runner {
            chain,
            step: DualAveraging::new(first, target),
            acceptance: 0.0,
            positions: Vec::new(),
            kept: Kept::default(),
        });
    }

    // Three rounds on the force's density find the scale, a last one the step size for the exact one.
    let mut scale: Vec<f64> = match warm {
        Some(warm) => warm.scale.clone(),
        None => (0..n * n).map(|i| if i % (n + 1) == 0 { 1.0 } else { 0.0 }).collect(),
    };
    // Without a scale trajectories would be long for what they gain, so the first are kept short.
    let rounds: &[(usize, usize)] =
        if warm.is_some() { &[(2, MAX_STEPS), (3, MAX_STEPS)] } else { &[(4, 16), (4, 16), (8, 32)] };
    for (twentieths, max_steps) in rounds {
        let length = run.warmup * twentieths / 20;
        in_parallel(&mut runners, run.threads, |runner| {
            runner.explore(stop, length, &scale, Acceptance::Coarse, *max_steps);
        });
        if stop.load(Ordering::Relaxed) {
            return Err(PosteriorError::Stopped);
        }
        let positions: Vec<Vec<f64>> = runners.iter_mut().map(|r| std::mem::take(&mut r.positions)).collect();
        // Without any movement there is no covariance: keep the old one and let the diagnostics tell.
        scale = pooled_scale(&positions, n).unwrap_or(scale);
        for runner in &mut runners {
            runner.step = DualAveraging::new(runner.step.averaged().max(FIRST_STEP), target);
        }
    }
    in_parallel(&mut runners, run.threads, |runner| {
        runner.chain.refresh_exact();
        runner.explore(stop, run.warmup / 5, &scale, Acceptance::Exact, MAX_STEPS);
    });
    // One step size for all: chains that differ in it would differ in what they can reach.
    let log_steps: f64 = runners.iter().map(|r| libm::log(r.step.averaged())).sum();
    let step_size = libm::exp(log_steps / runners.len() as f64);
    in_parallel(&mut runners, run.threads, |runner| runner.keep(stop, run.per_chain(), step_size, &scale));
    if stop.load(Ordering::Relaxed) {
        return Err(PosteriorError::Stopped);
    }
    let acceptance = runners.iter().map(|runner| runner.acceptance).sum();
    let positions = runners.iter().map(|runner| runner.chain.z.clone()).collect();
    let kept = runners.into_iter().map(|runner| runner.kept).collect();
    Ok((kept, acceptance, Warm { positions, scale, step_size }))
}

impl<D: Density> Runner<D> {
    /// Warm-up: adapts the step size, and remembers positions of the later half.
    fn explore(&mut self, stop: &AtomicBool, length: usize, scale: &[f64], acceptance: Acceptance, max_steps: usize) {
        for i in (0..length).take_while(|_| !stop.load(Ordering::Relaxed)) {
            let accepted = self.chain.advance(self.step.step_size(), scale, acceptance, max_steps);
            self.step.update(accepted);
            if i >= length / 2 {
                self.positions.extend_from_slice(&self.chain.z);
            }
        }
    }

    fn keep(&mut self, stop: &AtomicBool, length: usize, step_size: f64, scale: &[f64]) {
        let n_jumps = if self.chain.force_is_exact() { JUMPS_EXACT } else { JUMPS_COARSE };
        for _ in (0..length).take_while(|_| !stop.load(Ordering::Relaxed)) {
            self.acceptance += self.chain.advance(step_size, scale, Acceptance::Exact, MAX_STEPS);
            for _ in 0..n_jumps {
                self.chain.jump(scale);
            }
            self.chain.keep(&mut self.kept);
        }
    }
}

/// Runs `work` on every runner. Runners share nothing, so what they do does not depend on the number of threads.
fn in_parallel<D: Density>(runners: &mut [Runner<D>], threads: usize, work: impl Fn(&mut Runner<D>) + Sync) {
    let share = runners.len().div_ceil(threads);
    if share == runners.len() {
        return runners.iter_mut().for_each(work);
    }
    std::thread::scope(|scope| {
        for part in runners.chunks_mut(share) {
            scope.spawn(|| part.iter_mut().for_each(&work));
        }
    });
}
