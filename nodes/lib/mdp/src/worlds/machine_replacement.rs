//! Machine replacement (section 7.3.1, figure 7.2): a machine ages by a step unless it is repaired, at uncertain costs.

use rand_chacha::ChaCha8Rng;

use crate::parts::{Features, MdpParts};
use crate::random::normal;
use crate::{Mdp, MdpError};

/// Ages.
pub const N_STATES: usize = 4;
/// Do nothing.
pub const WAIT: usize = 0;
/// Replace parts.
pub const REPAIR: usize = 1;
/// Scales of the cost of doing nothing at each age, which is Gamma(½, scale).
pub const SCALES: [f64; N_STATES] = [20.0, 40.0, 80.0, 190.0];
/// Mean cost of a repair, which is normal with variance 1.
pub const REPAIR_COST: f64 = 100.0;

/// The process for `n_states` ages: doing nothing leads from s to s + 1 and from the last age to the first, repairing leads
/// to the first. One feature per state and action, feature a·S + s; γ = 0.95; every age equally likely at the start.
///
/// # Errors
/// Sizes out of range.
pub fn world(n_states: usize) -> Result<Mdp, MdpError> {
    crate::error::check_sizes(n_states, 2, n_states.saturating_mul(2))?;
    let n_features = 2 * n_states;
    let mut features = vec![0.0; n_features * n_features];
    let mut transitions = Vec::with_capacity(n_features);
    for state in 0..n_states {
        for action in [WAIT, REPAIR] {
            features[(state * 2 + action) * n_features + action * n_states + state] = 1.0;
        }
        transitions.push((state, WAIT, (state + 1) % n_states, 1.0));
        transitions.push((state, REPAIR, 0, 1.0));
    }
    Mdp::new(MdpParts {
        gamma: 0.95,
        n_states,
        n_actions: 2,
        n_features,
        initial: vec![1.0 / n_states as f64; n_states],
        transitions,
        features: Features::StateAction(features),
        actions: vec!["wait".into(), "repair".into()],
        shape: None,
    })
}

/// `n` draws of the weights of [`world`] with [`N_STATES`] ages, n × 8: costs of each state and action, negated.
pub fn draws(n: usize, rng: &mut ChaCha8Rng) -> Vec<f64> {
    let mut draws = Vec::with_capacity(n * 2 * N_STATES);
    for _ in 0..n {
        // Gamma(½, scale) is scale/2 times the square of a standard normal.
        draws.extend(SCALES.iter().map(|scale| {
            let z = normal(rng);
            -0.5 * scale * z * z
        }));
        draws.extend((0..N_STATES).map(|_| -REPAIR_COST - normal(rng)));
    }
    draws
}
