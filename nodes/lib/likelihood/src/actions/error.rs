//! What can be wrong with choices.

/// Why choices have no likelihood.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum ActionError {
    /// A state or action that the process does not have.
    #[error("choice {index}: {what} is {got}, but must lie in 0..{below}")]
    OutOfRange {
        /// 0-based index of the choice.
        index: usize,
        /// `state` or `action`.
        what: &'static str,
        /// Its value.
        got: usize,
        /// One more than the largest allowed.
        below: usize,
    },
    /// A confidence factor that is not positive and finite.
    #[error("choice {index}: its confidence factor is {got}, but must be positive and finite")]
    Factor {
        /// 0-based index of the choice.
        index: usize,
        /// Its value.
        got: f64,
    },
    /// An action judged bad in a process that has no other.
    #[error("choice {index} is judged bad, but there is no other action to take")]
    NoAlternative {
        /// 0-based index of the choice.
        index: usize,
    },
    /// A rate of wrong answers outside [0, 1).
    #[error("the rate of wrong answers is {got}, but must lie in [0, 1)")]
    WrongRate {
        /// Its value.
        got: f64,
    },
}
