//! The dissertation's own walks, as a reference for the sampler that is meant to be used.

use posterior::walks::{PairOrder, l1_proposal, l2_proposal, metropolis};
use posterior::{BetaDraws, Draws, Model, ModelError, Prior, Run, Warm};
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;
use sha2::{Digest, Sha256};

use super::summary::{Parameter, summaries};
use crate::OfflineError;
use crate::evidence::flag;

/// Steps of one stretch of a burn-in: what it visits is kept until its end.
const STRETCH: usize = 1000;
/// Draws from the prior to try before a chain has no start.
const MAX_STARTS: usize = 1000;

/// Which walk.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct WalkSettings {
    /// Steps along pairs of weights on the L1 sphere, else normal steps on the L2 sphere.
    pub(super) along_pairs: bool,
    /// Length of a step, or standard deviation of each weight in one.
    pub(super) size: f64,
    /// Steps before the first draw.
    pub(super) burn_in: usize,
    /// Steps from one draw to the next.
    pub(super) every: usize,
    /// Start with all weights −1/k, as the author's program does, else with a draw from the prior.
    pub(super) start_equal: bool,
}

/// What one chain kept.
struct Chain {
    values: Vec<f64>,
    log_likelihood: Vec<f64>,
    /// Sum over steps of draws, of whether they were accepted.
    accepted: f64,
    best: (f64, Vec<f64>),
}

/// Draws of the walk: every [`WalkSettings::every`]th place after the burn-in. The most probable weights are the most likely
/// ones that it visited.
pub(super) fn walk(
    model: &Model<'_>,
    run: &Run,
    settings: &WalkSettings,
    seed: u64,
    evidence: &[u8; 32],
) -> Result<Draws, OfflineError> {
    run.check().map_err(posterior::PosteriorError::from)?;
    model.check()?;
    if let Some(term) = model.terms.iter().find(|term| term.rationality.is_learned()) {
        let name = term.kind.name();
        let problem =
            format!("got learn for the {name}, expected a number: the walks sample weights alone, see --sampler");
        return Err(flag("--beta", problem));
    }
    let indices: Vec<usize> = (0..run.n_chains).collect();
    let share = indices.len().div_ceil(run.threads);
    let chains: Result<Vec<Chain>, OfflineError> = std::thread::scope(|scope| {
        let one = |chain: &usize| walk_chain(model, run, settings, chain_generator(seed, evidence, *chain));
        let running: Vec<_> =
            indices.chunks(share).map(|part| scope.spawn(move || part.iter().map(one).collect::<Vec<_>>())).collect();
        running.into_iter().flat_map(|part| part.join().expect("a chain does not panic")).collect()
    });
    let chains = chains?;
    let betas = model.median_betas();
    let fixed = |term: &posterior::Term<'_>| BetaDraws { kind: term.kind, values: vec![term.rationality.median()] };
    let mut best = &chains[0].best;
    for chain in &chains[1..] {
        if chain.best.0 > best.0 {
            best = &chain.best;
        }
    }
    let n_steps = (settings.every * run.n_draws) as f64;
    let mut draws = Draws {
        n_chains: run.n_chains,
        per_chain: run.per_chain(),
        n_features: model.n_features,
        values: chains.iter().flat_map(|chain| chain.values.iter().copied()).collect(),
        log_likelihood: chains.iter().flat_map(|chain| chain.log_likelihood.iter().copied()).collect(),
        betas: model.terms.iter().map(fixed).collect(),
        map_weights: best.1.clone(),
        map_betas: betas,
        map_log_likelihood: best.0,
        acceptance: chains.iter().map(|chain| chain.accepted).sum::<f64>() / n_steps,
        rhat_max: f64::INFINITY,
        ess_bulk_min: 0.0,
        ess_bulk_median: 0.0,
        ess_tail_min: 0.0,
        warm: Warm::default(),
    };
    diagnose(&mut draws, run.threads);
    Ok(draws)
}

/// Fills in R̂ and the effective sample sizes, over the weights and the log-likelihood.
fn diagnose(draws: &mut Draws, threads: usize) {
    let parameters: Vec<Parameter> =
        (0..draws.n_features).map(Parameter::Weight).chain([Parameter::LogLikelihood]).collect();
    let judged = summaries(draws, &parameters, threads);
    draws.rhat_max = judged.iter().fold(0.0, |worst, x| x.rhat.max(worst));
    draws.ess_tail_min = judged.iter().fold(f64::INFINITY, |worst, x| x.ess_tail.min(worst));
    let mut bulk: Vec<f64> = judged.iter().map(|x| x.ess_bulk).collect();
    bulk.sort_unstable_by(f64::total_cmp);
    draws.ess_bulk_min = bulk[0];
    draws.ess_bulk_median = bulk[bulk.len() / 2];
}

fn walk_chain(
    model: &Model<'_>,
    run: &Run,
    settings: &WalkSettings,
    mut generator: ChaCha8Rng,
) -> Result<Chain, OfflineError> {
    let betas = model.median_betas();
    let mut evaluator = model.evaluator();
    let mut log_density = |w: &[f64]| {
        let negative = |features: &Vec<f64>| features.iter().zip(w).map(|(x, w)| x * w).sum::<f64>() < 0.0;
        if model.nonnegative_return.as_ref().is_some_and(negative) {
            return f64::NEG_INFINITY;
        }
        evaluator.log_likelihood(w, &betas)
    };
    let mut place = start(model, settings, &mut log_density, &mut generator)?;
    let mut chain = Chain { values: vec![], log_likelihood: vec![], accepted: 0.0, best: (f64::NEG_INFINITY, vec![]) };
    let mut go = |place: &[f64], n_steps: usize| {
        let propose = |w: &mut [f64], generator: &mut ChaCha8Rng| match settings.along_pairs {
            true => l1_proposal(w, settings.size, PairOrder::Shuffled, generator),
            false => l2_proposal(w, settings.size, generator),
        };
        metropolis(&mut log_density, place.to_vec(), n_steps, propose, &mut generator)
    };
    let k = model.n_features;
    let mut left = settings.burn_in;
    while left > 0 {
        let n_steps = left.min(STRETCH);
        place = go(&place, n_steps).values[(n_steps - 1) * k..].to_vec();
        left -= n_steps;
    }
    for _ in 0..run.per_chain() {
        let visited = go(&place, settings.every);
        for (height, w) in visited.log_likelihood.iter().zip(visited.values.chunks_exact(k)) {
            if *height > chain.best.0 {
                chain.best = (*height, w.to_vec());
            }
        }
        place = visited.values[(settings.every - 1) * k..].to_vec();
        chain.values.extend_from_slice(&place);
        chain.log_likelihood.push(visited.log_likelihood[settings.every - 1]);
        chain.accepted += visited.acceptance * settings.every as f64;
    }
    Ok(chain)
}

fn start(
    model: &Model<'_>,
    settings: &WalkSettings,
    log_density: &mut impl FnMut(&[f64]) -> f64,
    generator: &mut ChaCha8Rng,
) -> Result<Vec<f64>, OfflineError> {
    let k = model.n_features;
    // A chain that starts where the prior is zero never moves: that start is drawn anew.
    let equal = vec![-1.0 / k as f64; k];
    if settings.start_equal && log_density(&equal).is_finite() {
        return Ok(equal);
    }
    for _ in 0..MAX_STARTS {
        let w = match model.prior {
            Prior::L1Sphere => mdp::random::l1_sphere(k, generator),
            _ => l2_sphere(k, generator),
        };
        if log_density(&w).is_finite() {
            return Ok(w);
        }
    }
    Err(ModelError::NoStart { tries: MAX_STARTS }.into())
}

/// Uniform where the squares of the weights sum to 1.
fn l2_sphere(k: usize, generator: &mut ChaCha8Rng) -> Vec<f64> {
    // From the origin a normal step divided by its length is uniform, whatever its size.
    let mut w = vec![0.0; k];
    l2_proposal(&mut w, 1.0, generator);
    w
}

/// The generator of one chain, a function of seed, evidence and chain.
fn chain_generator(seed: u64, evidence: &[u8; 32], chain: usize) -> ChaCha8Rng {
    let mut key = Sha256::new_with_prefix(b"apprentice walk 1");
    key.update(seed.to_le_bytes());
    key.update(evidence);
    key.update((chain as u64).to_le_bytes());
    ChaCha8Rng::from_seed(key.finalize().into())
}

#[cfg(test)]
mod tests {
    use super::{WalkSettings, walk};
    use posterior::{Model, Prior, Run};

    fn flat(prior: Prior, nonnegative_return: Option<Vec<f64>>) -> Model<'static> {
        Model { n_features: 3, prior, nonnegative_return, terms: vec![] }
    }

    /// Without evidence a walk gives the prior back: E w² = 2/(k(k+1)) on the L1 sphere, 1/k on the L2 sphere.
    #[test]
    fn without_evidence_the_walks_give_the_prior() {
        let run = Run { n_draws: 20_000, n_chains: 4, warmup: 100, threads: 2 };
        for (prior, along_pairs, want) in [(Prior::L1Sphere, true, 1.0 / 6.0), (Prior::L2Sphere, false, 1.0 / 3.0)] {
            let settings = WalkSettings { along_pairs, size: 0.5, burn_in: 100, every: 5, start_equal: false };
            let draws = walk(&flat(prior, None), &run, &settings, 3, &[0; 32]).expect("draws");
            let square = draws.values.iter().map(|w| w * w).sum::<f64>() / draws.values.len() as f64;
            assert!((square - want).abs() < 0.01, "{prior:?}: {square}, {want}");
            assert!(draws.rhat_max < 1.05 && draws.acceptance == 1.0, "{}", draws.rhat_max);
        }
    }

    #[test]
    fn the_prior_is_zero_where_the_known_return_is_negative() {
        let run = Run { n_draws: 4000, n_chains: 4, warmup: 100, threads: 3 };
        let settings = WalkSettings { along_pairs: true, size: 0.1, burn_in: 10, every: 2, start_equal: false };
        let model = flat(Prior::L1Sphere, Some(vec![1.0, 0.0, 0.0]));
        let draws = walk(&model, &run, &settings, 1, &[0; 32]).expect("draws");
        assert!(draws.values.chunks_exact(3).all(|w| w[0] >= 0.0));
        let repeated = WalkSettings { start_equal: true, burn_in: 0, ..settings };
        let from_elsewhere = walk(&model, &run, &repeated, 1, &[0; 32]).expect("draws");
        assert!(from_elsewhere.values.chunks_exact(3).all(|w| w[0] >= 0.0));
        let other = walk(&model, &Run { threads: 1, ..run.clone() }, &settings, 1, &[0; 32]).expect("draws");
        assert_eq!(draws, other);
        assert_ne!(draws.values, walk(&model, &run, &settings, 2, &[0; 32]).expect("draws").values);
    }
}
