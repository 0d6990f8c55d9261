//! What is known of the expert, for the bounds that need no posterior.

use mdp::{Features, Mdp};
use risk::{hoeffding_loss_bound, worst_case_feature_count_bound};

use crate::OfflineError;

/// Feature counts of the expert.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Expert {
    /// Discounted, one for each feature.
    pub(super) counts: Vec<f64>,
}

impl Expert {
    /// Mean over demonstrations of Σ_t γᵗ φ(s_t, a_t); at least one.
    pub(super) fn of_trajectories(trajectories: &[Vec<(usize, usize)>], mdp: &Mdp) -> Self {
        let mut counts = vec![0.0; mdp.n_features()];
        for trajectory in trajectories {
            let mut discount = 1.0 / trajectories.len() as f64;
            for &(state, action) in trajectory {
                for (count, phi) in counts.iter_mut().zip(mdp.features(state, action)) {
                    *count += discount * phi;
                }
                discount *= mdp.gamma();
            }
        }
        Self { counts }
    }

    /// Worst-case feature count bound of a policy (eq. 4.16).
    pub(super) fn worst_case(&self, policy: &[f64]) -> Result<f64, OfflineError> {
        Ok(worst_case_feature_count_bound(&self.counts, policy)?)
    }
}

/// The bound of Syed and Schapire, and what keeps it from holding.
pub(super) fn hoeffding(mdp: &Mdp, n_demonstrations: u64, delta: f64) -> Result<(f64, Option<String>), OfflineError> {
    let bound = hoeffding_loss_bound(n_demonstrations, mdp.n_features(), mdp.gamma(), delta)?;
    let values = match mdp.feature_table() {
        Features::State(values) | Features::StateAction(values) => values,
    };
    let outside = values.iter().find(|phi| !(0.0..=1.0).contains(*phi));
    let warning = outside.map(|phi| {
        format!("the Hoeffding bound holds for features from 0 to 1, but the process has a feature of {phi}")
    });
    Ok((bound, warning))
}
