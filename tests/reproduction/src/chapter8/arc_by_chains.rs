//! What ARC costs as it was published: a chain of Bayesian IRL for every label of every step that may be shown.

use super::compare::Situation;
use super::{BETA, cpu_seconds, purpose};
use crate::chapter4::{Walk, walk_on};
use crate::harness::{ReproductionError, extent, generator};
use likelihood::actions::{Choice, ChoiceVerdict};
use mdp::random::index;
use mdp::{Policy, Solver, rollout};

/// Trajectories that are weighed, as in the author's program,
pub const PATHS: usize = 8;
/// and of which one is timed.
const TIMED: usize = 1;
/// His chain.
const CHAIN: Walk = Walk { steps: extent(10_000, 300), burn: 50, every: 20 };

/// What it took.
#[derive(Debug, Clone, Copy)]
pub struct ByChains {
    /// Chains.
    pub n_chains: usize,
    /// Steps of each.
    pub steps: usize,
    /// Seconds of processor time for all [`PATHS`], from one of them.
    pub seconds: f64,
}

/// Runs an eighth of the chains that one query needs, and reckons what all would take: of each of 8 trajectories, which follow the
/// policies of random draws from random starts, every step with the label good and with the label bad; and one chain more for every step after the first, with the
/// more probable labels of those before taken for granted. The divergences between chains, by which the author compares
/// them, are left out, so his program takes longer still.
///
/// # Errors
/// Never for these worlds.
pub fn arc_by_chains(situation: &Situation, length: usize, seed: u64) -> Result<ByChains, ReproductionError> {
    let Situation { mdp, shown, .. } = situation;
    let mut rng = generator(seed, 0, purpose::QUESTIONS + 100);
    let k = mdp.n_features();
    let mut n_chains = 0;
    let base = walk_on(mdp, shown.clone(), BETA, CHAIN, &mut rng)?.draws;
    let begin = cpu_seconds();
    for _ in 0..TIMED {
        let draw = index(base.len() / k, &mut rng) * k;
        let policy = Policy::Deterministic(Solver::new(mdp).solve(&base[draw..draw + k]).policy().to_vec());
        let start = index(mdp.n_states(), &mut rng);
        let mut assumed = shown.clone();
        for (step, (state, action)) in rollout(mdp, &policy, start, length, &mut rng)?.into_iter().enumerate() {
            for verdict in [ChoiceVerdict::Good, ChoiceVerdict::Bad] {
                let mut labelled = assumed.clone();
                labelled.push(Choice { verdict, ..Choice::taken(state, action) });
                walk_on(mdp, labelled, BETA, CHAIN, &mut rng)?;
                n_chains += 1;
            }
            assumed.push(Choice { verdict: ChoiceVerdict::Good, ..Choice::taken(state, action) });
            if step + 1 < length {
                walk_on(mdp, assumed.clone(), BETA, CHAIN, &mut rng)?;
                n_chains += 1;
            }
        }
    }
    let share = PATHS as f64 / TIMED as f64;
    Ok(ByChains { n_chains: n_chains * PATHS / TIMED, steps: CHAIN.steps, seconds: share * (cpu_seconds() - begin) })
}
