//! What demonstrations show of an expert.

use mdp::Mdp;

use crate::error::RobustError;

/// μ̂_E = (1/|D|) Σ_τ Σ_t discountᵗ φ(s_t, a_t) (dissertation section 7.2.2): k numbers. A demonstration is a list of (state,
/// action); one that reaches a terminal state holds that state last, with any action. `discount` is γ for feature counts as
/// they are everywhere else in this crate but for [`crate::Horizon::Steps`], which goes with 1.
///
/// # Errors
/// No demonstrations, an empty one, or a state or action that `mdp` does not have; a discount outside [0, 1].
pub fn expert_feature_counts(
    mdp: &Mdp,
    demonstrations: &[Vec<(usize, usize)>],
    discount: f64,
) -> Result<Vec<f64>, RobustError> {
    if demonstrations.is_empty() {
        return Err(RobustError::Empty { what: "demonstrations" });
    }
    if !(0.0..=1.0).contains(&discount) {
        return Err(RobustError::Range { name: "discount", got: discount, expected: "from 0 to 1" });
    }
    let mut counts = vec![0.0; mdp.n_features()];
    for (demonstration, steps) in demonstrations.iter().enumerate() {
        if steps.is_empty() {
            return Err(RobustError::Empty { what: "steps in a demonstration" });
        }
        let mut weight = 1.0 / demonstrations.len() as f64;
        for (step, &(state, action)) in steps.iter().enumerate() {
            for (what, got, below) in [("state", state, mdp.n_states()), ("action", action, mdp.n_actions())] {
                if got >= below {
                    return Err(RobustError::Demonstration { demonstration, step, what, got, below });
                }
            }
            counts.iter_mut().zip(mdp.features(state, action)).for_each(|(sum, phi)| *sum += weight * phi);
            weight *= discount;
        }
    }
    Ok(counts)
}
