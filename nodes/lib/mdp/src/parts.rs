//! A process as plain data, before it has been checked.

/// Everything a process is made of; [`crate::Mdp::new`] checks it.
#[derive(Debug, Clone, PartialEq)]
pub struct MdpParts {
    /// Discount factor γ in [0, [`crate::MAX_GAMMA`]].
    pub gamma: f64,
    /// States S, at least 1.
    pub n_states: usize,
    /// Actions A, at least 1, the same in every state.
    pub n_actions: usize,
    /// Features k, at least 1.
    pub n_features: usize,
    /// Probability of starting in each state: S numbers that sum to 1.
    pub initial: Vec<f64>,
    /// (state, action, target, probability) in any order, each triple at most once. A state without any is terminal.
    pub transitions: Vec<(usize, usize, usize, f64)>,
    /// φ.
    pub features: Features,
    /// Names of the actions, A of them or none.
    pub actions: Vec<String>,
    /// Rows and columns when the states are the cells of a grid, row by row.
    pub shape: Option<[usize; 2]>,
}

/// The features φ that rewards are linear in.
#[derive(Debug, Clone, PartialEq)]
pub enum Features {
    /// φ(s): S × k, row by row.
    State(Vec<f64>),
    /// φ(s, a): S·A × k, row s·A + a.
    StateAction(Vec<f64>),
}

impl Features {
    pub(crate) fn name(&self) -> &'static str {
        match self {
            Self::State(_) => "features",
            Self::StateAction(_) => "state_action_features",
        }
    }

    pub(crate) fn values(&self) -> &[f64] {
        match self {
            Self::State(values) | Self::StateAction(values) => values,
        }
    }
}
