//! Policies, deterministic or stochastic, and their JSON file.
//!
//! A policy file holds `{"policy": [a, …]}`, the action in each of S states, or `{"policy": [[p, …], …]}`, S rows of A
//! probabilities.

use serde::{Deserialize, Serialize};

use crate::MdpError;
use crate::json::flatten;
use crate::limits::SUM_TOLERANCE;
use crate::model::Mdp;

/// What to do in each state.
#[derive(Debug, Clone, PartialEq)]
pub enum Policy {
    /// The action in each state: S numbers below A.
    Deterministic(Vec<usize>),
    /// π(a|s): S × A, row by row; every row sums to 1.
    Stochastic(Vec<f64>),
}

#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Text {
    policy: Rows,
}

#[derive(Serialize, Deserialize)]
#[serde(untagged, expecting = "a list of actions, or a list of rows of probabilities")]
enum Rows {
    Actions(Vec<usize>),
    Probabilities(Vec<Vec<f64>>),
}

impl Policy {
    /// The policy that takes every action equally often.
    pub fn uniform(mdp: &Mdp) -> Self {
        Self::Stochastic(vec![1.0 / mdp.n_actions() as f64; mdp.n_states() * mdp.n_actions()])
    }

    /// Refuses a policy that is not one of `mdp`.
    ///
    /// # Errors
    /// A wrong number of states, actions out of range, probabilities outside [0, 1] or rows that do not sum to 1.
    pub fn check(&self, mdp: &Mdp) -> Result<(), MdpError> {
        let (n_states, n_actions) = (mdp.n_states(), mdp.n_actions());
        let (got, expected, why) = match self {
            Self::Deterministic(actions) => (actions.len(), n_states, "n_states"),
            Self::Stochastic(probabilities) => (probabilities.len(), n_states * n_actions, "n_states × n_actions"),
        };
        if got != expected {
            return Err(MdpError::Length { name: "policy", got, expected, why });
        }
        match self {
            Self::Deterministic(actions) => match actions.iter().position(|&action| action >= n_actions) {
                Some(index) => {
                    let (name, what) = ("policy in state", "action");
                    Err(MdpError::OutOfRange { name, index, what, got: actions[index], below: n_actions })
                }
                None => Ok(()),
            },
            Self::Stochastic(probabilities) => {
                if let Some(index) = probabilities.iter().position(|p| !(0.0..=1.0).contains(p)) {
                    return Err(MdpError::Probability { name: "policy", index, got: probabilities[index] });
                }
                for (state, row) in probabilities.chunks(n_actions).enumerate() {
                    let got: f64 = row.iter().sum();
                    if (got - 1.0).abs() > SUM_TOLERANCE {
                        return Err(MdpError::PolicySum { state, got });
                    }
                }
                Ok(())
            }
        }
    }

    /// π(a|s) of a policy over `n_actions` actions.
    pub fn probability(&self, n_actions: usize, state: usize, action: usize) -> f64 {
        match self {
            Self::Deterministic(actions) => f64::from(u8::from(actions[state] == action)),
            Self::Stochastic(probabilities) => probabilities[state * n_actions + action],
        }
    }

    /// The same but for `action` in `state`.
    pub(crate) fn with_action(&self, n_actions: usize, state: usize, action: usize) -> Self {
        let mut changed = self.clone();
        match &mut changed {
            Self::Deterministic(actions) => actions[state] = action,
            Self::Stochastic(probabilities) => {
                let row = &mut probabilities[state * n_actions..][..n_actions];
                row.fill(0.0);
                row[action] = 1.0;
            }
        }
        changed
    }

    /// Calls `f` with every action taken in `state` and its probability.
    pub(crate) fn for_each_action(&self, n_actions: usize, state: usize, mut f: impl FnMut(usize, f64)) {
        match self {
            Self::Deterministic(actions) => f(actions[state], 1.0),
            Self::Stochastic(probabilities) => {
                for (action, &p) in probabilities[state * n_actions..][..n_actions].iter().enumerate() {
                    if p > 0.0 {
                        f(action, p);
                    }
                }
            }
        }
    }

    /// Reads a policy of `mdp`.
    ///
    /// # Errors
    /// Text that is no such JSON; everything that [`Policy::check`] refuses.
    pub fn from_json(bytes: &[u8], mdp: &Mdp) -> Result<Self, MdpError> {
        let text: Text = serde_json::from_slice(bytes)
            .map_err(|error| MdpError::Json { what: "a policy", message: error.to_string() })?;
        let policy = match text.policy {
            Rows::Actions(actions) => Self::Deterministic(actions),
            Rows::Probabilities(rows) => Self::Stochastic(flatten("policy", rows, mdp.n_actions())?),
        };
        policy.check(mdp)?;
        Ok(policy)
    }

    /// The policy as JSON, rows of `n_actions` probabilities where it is stochastic; every number reads back as the same
    /// bits.
    pub fn to_json(&self, n_actions: usize) -> String {
        let policy = match self {
            Self::Deterministic(actions) => Rows::Actions(actions.clone()),
            Self::Stochastic(p) => Rows::Probabilities(p.chunks(n_actions).map(<[f64]>::to_vec).collect()),
        };
        serde_json::to_string(&Text { policy }).expect("numbers always serialise")
    }
}
