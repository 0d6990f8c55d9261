//! What policies are computed from: the draws of the posterior in two halves, and the demonstrations in force.

use crate::Settings;
use crate::settings::Objective;
use apprentice_msgs::msg::{ActionDemonstration, Posterior};
use exchange::World;
use robust::{RobustError, expert_feature_counts};
use thiserror::Error;

/// Everything that a policy of one revision depends on, besides the settings and the preference.
#[derive(Debug, Clone, Copy)]
pub struct Inputs<'a> {
    /// The draws.
    pub posterior: &'a Posterior,
    /// The world that the posterior names.
    pub world: &'a World,
    /// The action demonstrations in force at its revision; only regret looks at them.
    pub demonstrations: &'a [&'a ActionDemonstration],
}

/// Why there is nothing to optimise yet.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum MissingInput {
    /// Draws that are not to be trusted.
    #[error("no policy, because the chains of the posterior disagree: {reason}")]
    NotMixed {
        /// As the posterior says.
        reason: String,
    },
    /// Another world.
    #[error("no policy, because the world has {world} features but the posterior {posterior} weights")]
    Features {
        /// Of the world.
        world: usize,
        /// Of the posterior.
        posterior: usize,
    },
    /// Pairs of states and actions that say nothing of a return.
    #[error(
        "no policy, because regret is measured against demonstrations that follow a path, and '{id}' does not: no action \
         leads from state {from} to state {to} in the way it shows; objective robust or evd needs no path"
    )]
    NoPath {
        /// Of the demonstration.
        id: String,
        /// A state.
        from: u32,
        /// The one shown after it.
        to: u32,
    },
    /// The library refuses.
    #[error("no policy, because {0}")]
    Robust(#[from] RobustError),
}

/// Draws by which policies are chosen, and draws by which they are judged.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Halves {
    /// N × k: by these.
    pub chosen_by: Vec<f64>,
    /// First draws of each chain, of which `chosen_by` are; 0: all of them.
    pub draws_used: u32,
    /// M × k, chain after chain: by these judged; none when chains have one draw.
    pub held_out: Vec<f64>,
    /// Chains of which they are.
    pub n_chains: usize,
}

impl Halves {
    /// The first half of each chain, thinned to the number of draws that is set, and the second half. Chains that have mixed
    /// forget within a few draws, so that the second half judges fairly what was chosen by the first.
    pub fn new(settings: &Settings, posterior: &Posterior) -> Self {
        let k = posterior.feature_names.len().max(1);
        let n_chains = (posterior.n_chains as usize).max(1);
        let per_chain = posterior.draws.len() / k / n_chains;
        let used = per_chain / 2;
        let cut = if used == 0 { per_chain } else { used };
        let chains = || posterior.draws.chunks_exact((per_chain * k).max(1));
        let first: Vec<&[f32]> = chains().flat_map(|chain| chain[..cut * k].chunks_exact(k)).collect();
        let wanted = usize::try_from(settings.n_draws).unwrap_or(1).clamp(1, first.len().max(1));
        let rows = (0..wanted.min(first.len())).map(|i| first[i * first.len() / wanted]);
        Self {
            chosen_by: rows.flatten().map(|&w| f64::from(w)).collect(),
            draws_used: u32::try_from(used).unwrap_or(u32::MAX),
            held_out: chains().flat_map(|chain| &chain[cut * k..]).map(|&w| f64::from(w)).collect(),
            n_chains,
        }
    }
}

/// What the demonstrations collect, k numbers; none for objectives that do not ask, and where nothing was demonstrated.
pub(crate) fn expert(settings: &Settings, inputs: &Inputs<'_>) -> Result<Option<Vec<f64>>, MissingInput> {
    if settings.objective != Objective::Regret || inputs.demonstrations.is_empty() {
        return Ok(None);
    }
    let paths = inputs.demonstrations.iter().map(|shown| path(shown, inputs.world)).collect::<Result<Vec<_>, _>>()?;
    Ok(Some(expert_feature_counts(&inputs.world.mdp, &paths, inputs.world.mdp.gamma())?))
}

/// The steps of a demonstration, when each leads to the next.
fn path(shown: &ActionDemonstration, world: &World) -> Result<Vec<(usize, usize)>, MissingInput> {
    let steps: Vec<(usize, usize)> =
        shown.states.iter().zip(&shown.actions).map(|(&s, &a)| (s as usize, a as usize)).collect();
    let known = |&(s, a): &(usize, usize)| s < world.mdp.n_states() && a < world.mdp.n_actions();
    let leads = |from: (usize, usize), to: (usize, usize)| {
        known(&from) && world.mdp.successors(from.0, from.1).any(|(target, p)| target == to.0 && p > 0.0)
    };
    match steps.windows(2).find(|pair| !leads(pair[0], pair[1])) {
        None => Ok(steps),
        Some(pair) => {
            let number = |state: usize| u32::try_from(state).unwrap_or(u32::MAX);
            Err(MissingInput::NoPath { id: shown.id.clone(), from: number(pair[0].0), to: number(pair[1].0) })
        }
    }
}
