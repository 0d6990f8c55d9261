//! What can be wrong with a process, a policy or weights, each with where it is, what was got and what was expected.

use crate::limits::{
    MAX_GAMMA, MAX_GAMMA_LARGE, MAX_NUMBERS, MAX_STATES, MAX_STATES_LONG, MAX_TRANSITIONS, SUM_TOLERANCE,
};

/// Why there is no process, policy or answer.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum MdpError {
    /// A count that must be at least 1.
    #[error("{name} is 0, but must be at least 1")]
    Zero {
        /// `n_states`, `n_actions` or `n_features`.
        name: &'static str,
    },
    /// More than this program handles.
    #[error("{name} is {got}, but at most {most} are handled")]
    TooLarge {
        /// Which size.
        name: &'static str,
        /// Its value.
        got: u128,
        /// Largest allowed: [`MAX_STATES`], [`MAX_TRANSITIONS`] or [`MAX_NUMBERS`].
        most: usize,
    },
    /// A discount factor out of range.
    #[error("gamma is {got}, but must lie in [0, {MAX_GAMMA}]")]
    Gamma {
        /// Its value.
        got: f64,
    },
    /// A discount factor too close to 1 for so many states.
    #[error(
        "gamma is {gamma} with {n_states} states, but above {MAX_STATES_LONG} states it must be at most {MAX_GAMMA_LARGE}"
    )]
    Horizon {
        /// Discount factor.
        gamma: f64,
        /// States.
        n_states: usize,
    },
    /// A list or table of the wrong size.
    #[error("{name} has {got} entries, but {expected} are expected ({why})")]
    Length {
        /// Which list.
        name: &'static str,
        /// Its length.
        got: usize,
        /// What it must be.
        expected: usize,
        /// What that number is.
        why: &'static str,
    },
    /// A row of features or of a policy of another length than the rest.
    #[error("row {row} of {name} has {got} entries, but {expected} are expected")]
    Row {
        /// Which table.
        name: &'static str,
        /// 0-based row.
        row: usize,
        /// Its length.
        got: usize,
        /// What it must be.
        expected: usize,
    },
    /// NaN or infinite.
    #[error("{name}[{index}] is {got}, but must be a finite number")]
    NotFinite {
        /// Which list.
        name: &'static str,
        /// 0-based index in the flat list.
        index: usize,
        /// Its value.
        got: f64,
    },
    /// A probability outside [0, 1].
    #[error("{name}[{index}] is {got}, but a probability must lie in [0, 1]")]
    Probability {
        /// Which list.
        name: &'static str,
        /// 0-based index in the flat list.
        index: usize,
        /// Its value.
        got: f64,
    },
    /// Probabilities that do not sum to 1.
    #[error("{name} sums to {got}, but must sum to 1 within {SUM_TOLERANCE:e}")]
    Sum {
        /// Which list.
        name: &'static str,
        /// Its sum.
        got: f64,
    },
    /// An index out of range.
    #[error("{name} {index}: {what} is {got}, but must lie in 0..{below}")]
    OutOfRange {
        /// Which list: `transition`, `policy` …
        name: &'static str,
        /// 0-based index of the entry.
        index: usize,
        /// `state`, `action` or `target`.
        what: &'static str,
        /// Its value.
        got: usize,
        /// One more than the largest allowed.
        below: usize,
    },
    /// A transition with a probability outside [0, 1] or not finite.
    #[error("transition {index} ({state}, {action} → {target}) has probability {got}, but it must lie in [0, 1]")]
    TransitionProbability {
        /// 0-based index in the list.
        index: usize,
        /// From.
        state: usize,
        /// By.
        action: usize,
        /// To.
        target: usize,
        /// The probability.
        got: f64,
    },
    /// The same transition twice.
    #[error("the transition ({state}, {action} → {target}) is given twice: state its whole probability once")]
    Duplicate {
        /// From.
        state: usize,
        /// By.
        action: usize,
        /// To.
        target: usize,
    },
    /// Probabilities of a state and action that do not sum to 1.
    #[error(
        "the transitions of state {state}, action {action} sum to {got}, but must sum to 1 within {SUM_TOLERANCE:e}"
    )]
    TransitionSum {
        /// State.
        state: usize,
        /// Action.
        action: usize,
        /// Sum of the row.
        got: f64,
    },
    /// A state in which some actions lead somewhere and others nowhere.
    #[error(
        "state {state} has transitions for some actions but none for action {action}: a terminal state has none at all, any \
         other state has some for every action"
    )]
    PartlyTerminal {
        /// State.
        state: usize,
        /// First action without transitions.
        action: usize,
    },
    /// Rows × columns that are not the number of states.
    #[error("shape is {rows} × {columns}, but there are {n_states} states")]
    Shape {
        /// Rows.
        rows: usize,
        /// Columns.
        columns: usize,
        /// States.
        n_states: usize,
    },
    /// Probabilities of a policy in one state that do not sum to 1.
    #[error("the policy in state {state} sums to {got}, but must sum to 1 within {SUM_TOLERANCE:e}")]
    PolicySum {
        /// State.
        state: usize,
        /// Sum.
        got: f64,
    },
    /// Text that is no such JSON.
    #[error("not the JSON of {what}: {message}")]
    Json {
        /// `a decision process` or `a policy`.
        what: &'static str,
        /// What the parser says, with line and column.
        message: String,
    },
    /// Keys that exclude or need each other.
    #[error("exactly one of features and state_action_features is expected, but {got} given")]
    FeatureKeys {
        /// `both are` or `neither is`.
        got: &'static str,
    },
    /// A discount factor outside [0, 1] for a finite horizon.
    #[error("discount is {got}, but over a finite horizon it must lie in [0, 1]")]
    Discount {
        /// Its value.
        got: f64,
    },
    /// An equation that could not be solved well enough.
    #[error("solved to within {got:e} of the largest value after {sweeps} sweeps, but {wanted:e} is wanted")]
    NotConverged {
        /// Bound on the relative error.
        got: f64,
        /// What it was to be.
        wanted: f64,
        /// Sweeps made.
        sweeps: usize,
    },
}

/// Refuses sizes out of range before anything of that size is allocated.
pub(crate) fn check_sizes(n_states: usize, n_actions: usize, n_features: usize) -> Result<(), MdpError> {
    for (name, got) in [("n_states", n_states), ("n_actions", n_actions), ("n_features", n_features)] {
        if got == 0 {
            return Err(MdpError::Zero { name });
        }
    }
    if n_states > MAX_STATES {
        return Err(MdpError::TooLarge { name: "n_states", got: n_states as u128, most: MAX_STATES });
    }
    let rows = (n_states as u128).saturating_mul(n_actions as u128);
    if rows > MAX_TRANSITIONS as u128 {
        return Err(MdpError::TooLarge { name: "n_states × n_actions", got: rows, most: MAX_TRANSITIONS });
    }
    let numbers = (n_states as u128).saturating_mul(n_actions as u128).saturating_mul(n_features as u128);
    if numbers > MAX_NUMBERS as u128 {
        let name = "n_states × n_actions × n_features";
        return Err(MdpError::TooLarge { name, got: numbers, most: MAX_NUMBERS });
    }
    Ok(())
}

/// Refuses more transitions than are handled.
pub(crate) fn check_transitions(got: usize) -> Result<(), MdpError> {
    if got > MAX_TRANSITIONS {
        return Err(MdpError::TooLarge { name: "transitions", got: got as u128, most: MAX_TRANSITIONS });
    }
    Ok(())
}

/// Refuses weights of the wrong number or not finite.
pub(crate) fn check_weights(w: &[f64], n_features: usize) -> Result<(), MdpError> {
    if w.len() != n_features {
        let why = "one per feature";
        return Err(MdpError::Length { name: "weights", got: w.len(), expected: n_features, why });
    }
    check_finite("weights", w)
}

/// Refuses NaN and infinities.
pub(crate) fn check_finite(name: &'static str, values: &[f64]) -> Result<(), MdpError> {
    match values.iter().position(|x| !x.is_finite()) {
        Some(index) => Err(MdpError::NotFinite { name, index, got: values[index] }),
        None => Ok(()),
    }
}
