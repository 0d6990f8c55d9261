//! Random processes without structure (Archibald, McKinnon and Thomas 1995), to test and measure with.

use rand_chacha::ChaCha8Rng;

use crate::parts::{Features, MdpParts};
use crate::random::{exponential, index, uniform};
use crate::{Mdp, MdpError};

/// What a random process looks like.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Garnet {
    /// States.
    pub n_states: usize,
    /// Actions.
    pub n_actions: usize,
    /// Features, each uniform in [−1, 1].
    pub n_features: usize,
    /// States that each action may lead to.
    pub branching: usize,
    /// Discount factor.
    pub gamma: f64,
    /// Probability that a state is terminal.
    pub terminal: f64,
    /// Whether features depend on actions too.
    pub by_action: bool,
}

impl Garnet {
    /// Draws one; it starts in any state with probabilities drawn as well.
    ///
    /// # Errors
    /// Sizes or a discount factor out of range.
    pub fn random(&self, rng: &mut ChaCha8Rng) -> Result<Mdp, MdpError> {
        let Self { n_states, n_actions, n_features, .. } = *self;
        crate::error::check_sizes(n_states, n_actions, n_features)?;
        crate::error::check_transitions(n_states.saturating_mul(n_actions).saturating_mul(self.branching))?;
        let mut transitions = Vec::new();
        for state in 0..n_states {
            if uniform(rng) < self.terminal {
                continue;
            }
            for action in 0..n_actions {
                let mut targets: Vec<usize> = (0..self.branching.max(1)).map(|_| index(n_states, rng)).collect();
                targets.sort_unstable();
                targets.dedup();
                let shares = distribution(targets.len(), rng);
                transitions.extend(targets.into_iter().zip(shares).map(|(target, p)| (state, action, target, p)));
            }
        }
        let rows = if self.by_action { n_states * n_actions } else { n_states };
        let values = (0..rows * n_features).map(|_| 2.0 * uniform(rng) - 1.0).collect();
        let features = if self.by_action { Features::StateAction(values) } else { Features::State(values) };
        let initial = distribution(n_states, rng);
        let (gamma, actions, shape) = (self.gamma, vec![], None);
        Mdp::new(MdpParts { gamma, n_states, n_actions, n_features, initial, transitions, features, actions, shape })
    }
}

/// Probabilities uniform on the simplex.
fn distribution(n: usize, rng: &mut ChaCha8Rng) -> Vec<f64> {
    let mut shares: Vec<f64> = (0..n).map(|_| exponential(rng)).collect();
    let total: f64 = shares.iter().sum();
    shares.iter_mut().for_each(|share| *share /= total);
    shares
}
