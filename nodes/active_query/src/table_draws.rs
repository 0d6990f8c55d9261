//! Some of a posterior's draws: what questions about tables are chosen by, and answers held against.

use crate::draws::{SCORED, evenly_spaced, rationality, weights_of};
use apprentice_msgs::msg::Posterior;
use exchange::check_posterior;
use inquiry::Belief;
use inquiry::table::TableDraws;

/// See the module.
pub(crate) struct DrawnRewards {
    /// Weights, row by row.
    pub weights: Vec<f64>,
    /// k.
    pub n_features: usize,
    /// Rationality of placements: one for all draws, or one a draw.
    placement_betas: Vec<f64>,
    /// Rationality of comparisons, and their rate of wrong answers.
    pub comparisons: (Vec<f64>, f64),
}

impl DrawnRewards {
    /// Of a posterior about a table.
    ///
    /// # Errors
    /// In a sentence: parts that do not fit together.
    pub fn new(posterior: &Posterior) -> Result<Self, String> {
        check_posterior(posterior).map_err(|error| error.to_string())?;
        let n_draws = posterior.n_draws as usize;
        let chosen = evenly_spaced(SCORED.min(n_draws), n_draws);
        Ok(Self {
            weights: weights_of(posterior, &chosen),
            n_features: posterior.feature_names.len(),
            placement_betas: rationality(posterior, &chosen, "placements").0,
            comparisons: rationality(posterior, &chosen, "preferences"),
        })
    }

    /// Draws.
    pub fn n(&self) -> usize {
        self.weights.len() / self.n_features
    }

    /// One of them.
    pub fn of(&self, draw: usize) -> &[f64] {
        &self.weights[draw * self.n_features..][..self.n_features]
    }

    /// All weigh the same.
    pub fn belief(&self) -> Result<Belief, inquiry::InquiryError> {
        Belief::equal(self.n())
    }

    /// What answers to "where?" follow.
    pub fn placing(&self) -> TableDraws<'_> {
        TableDraws { weights: &self.weights, n_features: self.n_features, betas: &self.placement_betas }
    }

    /// What answers to "which of two?" follow.
    pub fn comparing(&self) -> TableDraws<'_> {
        TableDraws { betas: &self.comparisons.0, ..self.placing() }
    }
}
