//! Trajectories of a policy.

use rand_chacha::ChaCha8Rng;

use crate::MdpError;
use crate::model::Mdp;
use crate::policy::Policy;
use crate::random::categorical;

/// At most `length` (state, action) pairs of `policy` from `start` on. A terminal state is the last one.
///
/// # Errors
/// A policy that is not one of `mdp`; a start out of range.
pub fn rollout(
    mdp: &Mdp,
    policy: &Policy,
    start: usize,
    length: usize,
    rng: &mut ChaCha8Rng,
) -> Result<Vec<(usize, usize)>, MdpError> {
    policy.check(mdp)?;
    if start >= mdp.n_states() {
        let (name, what, below) = ("rollout", "state", mdp.n_states());
        return Err(MdpError::OutOfRange { name, index: 0, what, got: start, below });
    }
    let mut pairs = Vec::new();
    let mut state = start;
    while pairs.len() < length {
        let action = match policy {
            Policy::Deterministic(actions) => actions[state],
            Policy::Stochastic(p) => {
                categorical(p[state * mdp.n_actions()..][..mdp.n_actions()].iter().copied(), 1.0, rng)
            }
        };
        pairs.push((state, action));
        let (targets, probabilities) = mdp.row(state, action);
        if targets.is_empty() {
            break;
        }
        state = targets[categorical(probabilities.iter().copied(), 1.0, rng)] as usize;
    }
    Ok(pairs)
}
