//! From demonstrations to draws: a function of settings, seed and the demonstrations in order, of nothing else.

use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;
use scene::Grid;
use sha2::{Digest, Sha256};

use crate::hmc::{Acceptance, Chain, Target};
use crate::most_likely::most_likely;
use crate::warmup::{DualAveraging, pooled_scale};
use crate::{
    Demonstration, Draws, EvidenceError, Lesson, Likelihood, MAX_DEMONSTRATIONS, Placement, Settings, SettingsError,
    evidence_hash,
};

/// Step size to start the search with.
const FIRST_STEP: f64 = 0.1;
/// Cells per axis that the forces need at β = 100; sharper likelihoods need more.
const FORCE_SIDE: usize = 16;

/// Why there are no draws.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum PosteriorError {
    /// A setting out of range.
    #[error(transparent)]
    Settings(#[from] SettingsError),
    /// A demonstration that cannot be learned from.
    #[error(transparent)]
    Evidence(#[from] EvidenceError),
}

/// Draws from the posterior of the weights given `demonstrations`, all about the same `lesson`.
///
/// The same for any number of threads and whatever was sampled before. Without demonstrations: draws from the prior.
///
/// # Errors
/// Settings out of range; a demonstration that is malformed, about other objects, or whose target fits nowhere.
pub fn sample(
    settings: &Settings,
    seed: u64,
    lesson: &Lesson,
    demonstrations: &[Demonstration],
) -> Result<Draws, PosteriorError> {
    settings.check()?;
    if demonstrations.len() > MAX_DEMONSTRATIONS {
        return Err(EvidenceError::TooMany { got: demonstrations.len() }.into());
    }
    for demonstration in demonstrations {
        lesson.check(demonstration)?;
    }
    let placements: Vec<Placement<'_>> = demonstrations
        .iter()
        .map(|demonstration| Placement {
            scene: &demonstration.scene,
            at: demonstration.placement,
            beta: settings.beta * settings.confidence_factors[demonstration.confidence as usize],
            masked: true,
        })
        .collect();
    let grid = Grid::midpoints(settings.grid_side);
    let exact = Likelihood::new(lesson.n_features(), &placements, &grid);
    for (demonstration, n_free) in demonstrations.iter().zip(exact.n_free()) {
        if n_free == 0 {
            let (id, scene) = (demonstration.id.clone(), demonstration.scene.id.clone());
            return Err(EvidenceError::NoFreePlace { id, scene }.into());
        }
    }
    let force = force(settings, &exact, &placements, &grid);
    let (map_weights, map_log_likelihood) = most_likely(settings.prior, &exact, &force);
    let target = Target { prior: settings.prior, exact: &exact, force: &force };
    let evidence = evidence_hash(demonstrations);
    let chains = (0..settings.n_chains).map(|chain| Chain::new(target, generator(seed, &evidence, chain))).collect();
    let runners = run(settings, chains);
    let acceptance: f64 = runners.iter().map(|runner| runner.acceptance).sum();
    let mut draws = Draws {
        n_chains: settings.n_chains,
        per_chain: settings.per_chain(),
        n_features: lesson.n_features(),
        values: runners.iter().flat_map(|runner| runner.values.iter().copied()).collect(),
        log_likelihood: runners.iter().flat_map(|runner| runner.log_likelihood.iter().copied()).collect(),
        map_weights,
        map_log_likelihood,
        acceptance: acceptance / settings.n_draws as f64,
        rhat_max: f64::INFINITY,
        ess_bulk_min: 0.0,
        ess_tail_min: 0.0,
    };
    draws.diagnose();
    Ok(draws)
}

/// The likelihood on cells as wide as its sharpness allows: errors in the force cost acceptance, never exactness.
fn force(settings: &Settings, exact: &Likelihood, placements: &[Placement<'_>], grid: &Grid) -> Likelihood {
    let side = FORCE_SIDE as f64 * libm::sqrt(settings.beta / 100.0).max(1.0);
    let widest = (settings.grid_side as f64 / side) as usize;
    let coarser = (2..=widest).rev().find_map(|factor| exact.coarsened(placements, grid, factor));
    coarser.unwrap_or_else(|| exact.clone())
}

fn generator(seed: u64, evidence: &[u8; 32], chain: usize) -> ChaCha8Rng {
    let mut key = Sha256::new_with_prefix(b"apprentice chain 1");
    key.update(seed.to_le_bytes());
    key.update(evidence);
    key.update((chain as u64).to_le_bytes());
    ChaCha8Rng::from_seed(key.finalize().into())
}

/// A chain with what it found out and what it kept.
struct Runner<'a> {
    chain: Chain<'a>,
    step: DualAveraging,
    acceptance: f64,
    positions: Vec<f64>,
    values: Vec<f32>,
    log_likelihood: Vec<f64>,
}

/// Warms all chains up and lets them run.
fn run<'a>(settings: &Settings, chains: Vec<Chain<'a>>) -> Vec<Runner<'a>> {
    let n = chains[0].z.len();
    let per_chain = settings.per_chain();
    let mut runners: Vec<Runner<'a>> = chains
        .into_iter()
        .map(|chain| Runner {
            chain,
            step: DualAveraging::new(FIRST_STEP),
            acceptance: 0.0,
            positions: Vec::new(),
            values: Vec::with_capacity(n * per_chain),
            log_likelihood: Vec::with_capacity(per_chain),
        })
        .collect();

    // Three rounds on the coarse likelihood find the scale, a last one the step size for the exact one.
    let mut scale: Vec<f64> = (0..n * n).map(|i| if i % (n + 1) == 0 { 1.0 } else { 0.0 }).collect();
    for fifths in [1, 1, 2] {
        let length = settings.warmup * fifths / 5;
        in_parallel(&mut runners, settings.threads, |runner| runner.explore(length, &scale, Acceptance::Coarse));
        let positions: Vec<Vec<f64>> = runners.iter_mut().map(|r| std::mem::take(&mut r.positions)).collect();
        // Without any movement there is no covariance: keep the old one and let the diagnostics tell.
        scale = pooled_scale(&positions, n).unwrap_or(scale);
        for runner in &mut runners {
            runner.step = DualAveraging::new(runner.step.averaged().max(FIRST_STEP));
        }
    }
    in_parallel(&mut runners, settings.threads, |runner| {
        runner.chain.refresh_exact();
        runner.explore(settings.warmup / 5, &scale, Acceptance::Exact);
    });
    // One step size for all: chains that differ in it would differ in what they can reach.
    let log_steps: f64 = runners.iter().map(|r| libm::log(r.step.averaged())).sum();
    let step_size = libm::exp(log_steps / runners.len() as f64);
    in_parallel(&mut runners, settings.threads, |runner| runner.keep(per_chain, step_size, &scale));
    runners
}

impl Runner<'_> {
    /// Warm-up: adapts the step size, and remembers positions of the later half.
    fn explore(&mut self, length: usize, scale: &[f64], acceptance: Acceptance) {
        for i in 0..length {
            let accepted = self.chain.advance(self.step.step_size(), scale, acceptance);
            self.step.update(accepted);
            if i >= length / 2 {
                self.positions.extend_from_slice(&self.chain.z);
            }
        }
    }

    fn keep(&mut self, length: usize, step_size: f64, scale: &[f64]) {
        for _ in 0..length {
            self.acceptance += self.chain.advance(step_size, scale, Acceptance::Exact);
            self.values.extend(self.chain.w.iter().map(|&w| w as f32));
            self.log_likelihood.push(self.chain.exact);
        }
    }
}

/// Runs `work` on every runner. Runners share nothing, so what they do does not depend on the number of threads.
fn in_parallel<'a>(runners: &mut [Runner<'a>], threads: usize, work: impl Fn(&mut Runner<'a>) + Sync) {
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
