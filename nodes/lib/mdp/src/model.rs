//! A checked tabular Markov decision process without its reward weights (dissertation section 3.1, MDP\R).

use crate::MdpError;
use crate::check::{Rows, check};
use crate::parts::{Features, MdpParts};

/// States, actions, sparse transitions, features, discount factor and initial distribution; immutable and valid.
///
/// Return = Σ_t γᵗ wᵀφ(s_t, a_t), t from 0. A terminal state has no transitions; its features count once.
#[derive(Debug, Clone, PartialEq)]
pub struct Mdp {
    gamma: f64,
    n_states: usize,
    n_actions: usize,
    n_features: usize,
    initial: Vec<f64>,
    rows: Rows,
    features: Features,
    actions: Vec<String>,
    shape: Option<[usize; 2]>,
}

impl Mdp {
    /// Checks `parts`.
    ///
    /// # Errors
    /// Whatever is not a process: see [`MdpError`].
    pub fn new(parts: MdpParts) -> Result<Self, MdpError> {
        let rows = check(&parts)?;
        let MdpParts { gamma, n_states, n_actions, n_features, initial, features, actions, shape, .. } = parts;
        Ok(Self { gamma, n_states, n_actions, n_features, initial, rows, features, actions, shape })
    }

    /// The parts again, transitions ordered by state, action and target.
    pub fn parts(&self) -> MdpParts {
        let mut transitions = Vec::with_capacity(self.rows.targets.len());
        for state in 0..self.n_states {
            for action in 0..self.n_actions {
                transitions.extend(self.successors(state, action).map(|(target, p)| (state, action, target, p)));
            }
        }
        MdpParts {
            gamma: self.gamma,
            n_states: self.n_states,
            n_actions: self.n_actions,
            n_features: self.n_features,
            initial: self.initial.clone(),
            transitions,
            features: self.features.clone(),
            actions: self.actions.clone(),
            shape: self.shape,
        }
    }

    /// Discount factor γ.
    pub fn gamma(&self) -> f64 {
        self.gamma
    }

    /// States S.
    pub fn n_states(&self) -> usize {
        self.n_states
    }

    /// Actions A.
    pub fn n_actions(&self) -> usize {
        self.n_actions
    }

    /// Features k.
    pub fn n_features(&self) -> usize {
        self.n_features
    }

    /// Transitions of positive probability.
    pub fn n_transitions(&self) -> usize {
        self.rows.targets.len()
    }

    /// Probability of starting in each state.
    pub fn initial(&self) -> &[f64] {
        &self.initial
    }

    /// Where `action` in `state` leads and how probably, targets ascending; nothing for a terminal state.
    pub fn successors(&self, state: usize, action: usize) -> impl Iterator<Item = (usize, f64)> {
        let (targets, probabilities) = self.row(state, action);
        targets.iter().zip(probabilities).map(|(&target, &probability)| (target as usize, probability))
    }

    /// The same as two slices.
    pub(crate) fn row(&self, state: usize, action: usize) -> (&[u32], &[f64]) {
        let row = state * self.n_actions + action;
        let range = self.rows.starts[row] as usize..self.rows.starts[row + 1] as usize;
        (&self.rows.targets[range.clone()], &self.rows.probabilities[range])
    }

    /// Whether the process ends in `state`.
    pub fn is_terminal(&self, state: usize) -> bool {
        self.row(state, 0).0.is_empty()
    }

    /// φ(s, a): k numbers.
    pub fn features(&self, state: usize, action: usize) -> &[f64] {
        let (values, row) = match &self.features {
            Features::State(values) => (values, state),
            Features::StateAction(values) => (values, state * self.n_actions + action),
        };
        &values[row * self.n_features..][..self.n_features]
    }

    /// Whether φ(s, a) is given for every action and not just φ(s).
    pub fn features_depend_on_action(&self) -> bool {
        matches!(self.features, Features::StateAction(_))
    }

    /// All features, row by row, as they were given.
    pub fn feature_table(&self) -> &Features {
        &self.features
    }

    /// Names of the actions; empty if they have none.
    pub fn actions(&self) -> &[String] {
        &self.actions
    }

    /// Rows and columns when the states are the cells of a grid, row by row.
    pub fn shape(&self) -> Option<[usize; 2]> {
        self.shape
    }
}
