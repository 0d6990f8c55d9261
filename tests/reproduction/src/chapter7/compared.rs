//! Every policy of figures 7.4 and 7.5, chosen by one posterior and judged by fresh draws of it.

use super::corridor::{Corridor, N_CHAINS, red_share};
use super::{lambdas, lower_mean, purpose};
use crate::harness::{ReproductionError, extent, generator};
use mdp::worlds::{DOWN, LEFT};
use mdp::{Policy, feature_counts};
use robust::{
    Bootstrap, MaxEntropySettings, Objective, OutOfSample, Problem, Settings, Signs, Solution, lpal, max_entropy,
    optimal_policy, out_of_sample, performance,
};
use serde::Serialize;

/// Level of the tail, and draws of ours that policies are chosen and judged by.
pub(super) const ALPHA: f64 = 0.95;
const N_DRAWS: usize = 2000;
const N_FRESH: usize = extent(20_000, 2000);

/// Whose draws of the posterior policies are chosen by.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Posterior {
    /// The dissertation's walk: 300 draws.
    Published,
    /// Four chains of ours: 2,000 draws.
    Ours,
}

/// The policies, in the order of [`Compared::policies`].
pub const POLICIES: [&str; 5] =
    ["Maximum Entropy IRL", "LPAL", "BROIL robust, λ = 0", "BROIL regret, λ = 0", "BROIL, λ = 1"];

/// One policy, judged.
#[derive(Debug, Clone, Serialize)]
pub struct Judged {
    /// π(a|s): S × A.
    pub policy: Vec<f64>,
    /// μ.
    pub feature_counts: Vec<f64>,
    /// Share of visits that are of red cells.
    pub red: f64,
    /// Mean return and CVaR of the return and of the return above the demonstration's, by the draws that it was chosen by.
    pub chosen_by: [f64; 3],
    /// The same by fresh draws of the posterior.
    pub fresh: [f64; 3],
}

/// One posterior with all its policies.
#[derive(Debug, Clone, Serialize)]
pub struct Compared {
    /// As in [`POLICIES`].
    pub policies: Vec<Judged>,
    /// By λ.
    pub robust: Vec<Judged>,
    /// By λ.
    pub regret: Vec<Judged>,
    /// Draws that policies were chosen by.
    #[serde(skip)]
    pub draws: Vec<f64>,
    /// Largest gap of any solution as a share of its unit, and whether each was optimal.
    pub largest_gap: f64,
    /// Whether all solutions are optimal.
    pub all_optimal: bool,
}

/// Chooses and judges every policy.
pub fn compare(
    corridor: &Corridor,
    posterior: Posterior,
    seed: u64,
    replicate: usize,
) -> Result<Compared, ReproductionError> {
    let draws = match posterior {
        Posterior::Published => corridor.walked(&mut generator(seed, replicate, purpose::WALK))?,
        Posterior::Ours => corridor.sampled(N_DRAWS, &mut generator(seed, replicate, purpose::DRAWS))?,
    };
    let fresh = corridor.sampled(N_FRESH, &mut generator(seed, replicate, purpose::FRESH))?;
    let judge = |policy: &Policy| corridor.judge(policy, &draws, &fresh);
    let settings = Settings::default();
    let mdp = &corridor.mdp;
    let regret_objective = Objective::Regret { expert: &corridor.expert };
    let frontier = |objective| -> Result<Vec<Solution>, ReproductionError> {
        Ok(Problem::new(mdp, &draws, None, objective, 1)?.frontier(ALPHA, &lambdas(), &settings)?)
    };
    let (robust, regret) = (frontier(Objective::Robust)?, frontier(regret_objective)?);
    let apprentice = lpal(mdp, &corridor.expert, Signs::Unknown, &settings)?;
    let entropy = max_entropy(mdp, &corridor.undiscounted, &MaxEntropySettings::dissertation(mdp))?;
    let mean: Vec<f64> =
        (0..2).map(|j| draws.iter().skip(j).step_by(2).sum::<f64>() / (draws.len() / 2) as f64).collect();
    let neutral = optimal_policy(mdp, &mean)?;
    let solutions = || robust.iter().chain(&regret);
    let policies = [&entropy.policy, &apprentice.policy, &robust[0].policy, &regret[0].policy, &neutral.policy];
    Ok(Compared {
        policies: policies.into_iter().map(judge).collect::<Result<_, _>>()?,
        largest_gap: solutions().map(|s| s.gap() / s.unit).fold(0.0, f64::max),
        all_optimal: solutions().all(|s| s.outcome.name() == "optimal"),
        robust: robust.iter().map(|s| judge(&s.policy)).collect::<Result<_, _>>()?,
        regret: regret.iter().map(|s| judge(&s.policy)).collect::<Result<_, _>>()?,
        draws,
    })
}

impl Corridor {
    /// Returns of a policy with these feature counts under each draw, and those above the demonstration's.
    pub fn returns(&self, counts: &[f64], draws: &[f64]) -> Result<[Vec<f64>; 2], ReproductionError> {
        let under = |objective| performance(&self.mdp, draws, objective, counts, 1);
        Ok([under(Objective::Robust)?, under(Objective::Regret { expert: &self.expert })?])
    }

    fn judge(&self, policy: &Policy, draws: &[f64], fresh: &[f64]) -> Result<Judged, ReproductionError> {
        let counts = feature_counts(&self.mdp, policy)?;
        let judged = |draws: &[f64]| -> Result<[f64; 3], ReproductionError> {
            let [returns, regrets] = self.returns(&counts, draws)?;
            let mean = crate::harness::sum_in_order(&returns) / returns.len() as f64;
            Ok([mean, lower_mean(&returns, ALPHA), lower_mean(&regrets, ALPHA)])
        };
        let n_actions = self.mdp.n_actions();
        let all = |state| (0..n_actions).map(move |action| policy.probability(n_actions, state, action));
        Ok(Judged {
            policy: (0..self.mdp.n_states()).flat_map(all).collect(),
            red: red_share(&self.mdp, policy)?,
            chosen_by: judged(draws)?,
            fresh: judged(fresh)?,
            feature_counts: counts,
        })
    }

    /// CVaR of the return, or of the return above the demonstration's, by fresh draws with a 95 % interval.
    pub fn fresh_tail(
        &self,
        judged: &Judged,
        regret: bool,
        seed: u64,
        replicate: usize,
    ) -> Result<OutOfSample, ReproductionError> {
        let fresh = self.sampled(N_FRESH, &mut generator(seed, replicate, purpose::FRESH))?;
        let values = &self.returns(&judged.feature_counts, &fresh)?[usize::from(regret)];
        Ok(out_of_sample(values, N_CHAINS, None, ALPHA, &Bootstrap { seed, ..Bootstrap::default() })?)
    }
}

impl Judged {
    /// π(a|s) of the grid's four actions.
    pub fn probability(&self, state: usize, action: usize) -> f64 {
        self.policy[4 * state + action]
    }

    /// Whether some of the cells above the corridor (1 to 4) mostly goes down into it.
    pub fn enters_red(&self, cell: usize) -> bool {
        self.probability(cell, DOWN) > 0.5
    }

    /// Whether every cell above the corridor mostly goes left, around it.
    pub fn goes_around(&self) -> bool {
        (1..=4).all(|cell| self.probability(cell, LEFT) > 0.5)
    }

    /// Whether some cell but the end mixes its actions.
    pub fn is_stochastic(&self) -> bool {
        self.policy.chunks(4).take(14).any(|row| row.iter().all(|p| *p < 0.99))
    }
}
