//! Some of a posterior's draws, with what is best to do under each: what questions are chosen by, and answers held against.

use crate::WorldInputs;
use crate::draws::{SCORED, evenly_spaced, rationality, weights_of};
use apprentice_msgs::msg::Posterior;
use exchange::check_posterior;
use inquiry::DrawnOptima;
use mdp::Solver;

/// Fewer say nothing of a 0.95-quantile.
const MIN_SCORED: usize = 20;
/// Action values that are kept at a time, at most.
const MAX_VALUES: usize = 20_000_000;

/// See the module.
pub(crate) struct WorldDraws {
    /// Numbers of the draws in the posterior.
    pub chosen: Vec<usize>,
    /// Their weights, row by row.
    pub weights: Vec<f64>,
    /// What is optimal under each.
    pub optima: DrawnOptima,
    /// What the robot would do by the MAP weights.
    pub map: Vec<usize>,
}

impl WorldDraws {
    /// From what a question is chosen by.
    ///
    /// # Errors
    /// In a sentence: parts that do not fit together, or a world that is too large.
    pub fn new(inputs: &WorldInputs<'_>) -> Result<Self, String> {
        let WorldInputs { posterior, world, .. } = *inputs;
        check_posterior(posterior).map_err(|error| error.to_string())?;
        let (mdp, k) = (&world.mdp, world.feature_names.len());
        if posterior.world.hash != world.hash || posterior.feature_names.len() != k {
            return Err("the posterior is about another world".to_owned());
        }
        let n_draws = posterior.n_draws as usize;
        let n = SCORED.min(n_draws).min(MAX_VALUES / (mdp.n_states() * mdp.n_actions()));
        if n < MIN_SCORED.min(n_draws) {
            return Err(format!("a world of {} states is too large to ask about", mdp.n_states()));
        }
        let chosen = evenly_spaced(n, n_draws);
        let weights = weights_of(posterior, &chosen);
        let optima = DrawnOptima::new(mdp, &weights, 1).map_err(|error| error.to_string())?;
        let map = Solver::new(mdp).solve(&posterior.map_weights).policy().to_vec();
        Ok(Self { chosen, weights, optima, map })
    }

    /// How rational answers of a kind are by the posterior, for all draws or for each, and their rate of wrong ones.
    pub fn rationality(&self, posterior: &Posterior, kind: &str) -> (Vec<f64>, f64) {
        rationality(posterior, &self.chosen, kind)
    }
}
