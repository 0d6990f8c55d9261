//! What can be wrong with draws, weights, levels or demonstrations, each with where it is, what was got and what was expected.

use diagnostics::SeriesError;
use mdp::MdpError;

/// Why there is nothing to optimise.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum RobustError {
    /// No draws, weights, demonstrations or λ at all.
    #[error("no {what} given, but at least one is needed")]
    Empty {
        /// What is missing.
        what: &'static str,
    },
    /// A list of the wrong length.
    #[error("{what}: {got} numbers, but {expected} are expected ({why})")]
    Length {
        /// Which list.
        what: &'static str,
        /// How many numbers it has.
        got: usize,
        /// How many it should have.
        expected: usize,
        /// What that number is.
        why: &'static str,
    },
    /// Draws that are no whole number of rows.
    #[error("draws: {got} numbers are no whole number of rows of {n_features}, one weight per feature of the process")]
    Ragged {
        /// How many numbers there are.
        got: usize,
        /// Length of a row.
        n_features: usize,
    },
    /// A number that is NaN or infinite.
    #[error("{what}: number {index} is {got}, but must be finite")]
    NotFinite {
        /// Which list.
        what: &'static str,
        /// Its place, from 0.
        index: usize,
        /// Its value.
        got: f64,
    },
    /// A number too large to compute with.
    #[error("{what}: number {index} is {got:e}, but at most {most:e} in size can be handled")]
    TooLarge {
        /// Which list.
        what: &'static str,
        /// Its place, from 0.
        index: usize,
        /// Its value.
        got: f64,
        /// Largest size.
        most: f64,
    },
    /// A posterior weight below 0.
    #[error("posterior weight {index} is {got}, but must be at least 0")]
    NegativeWeight {
        /// Its draw, from 0.
        index: usize,
        /// Its value.
        got: f64,
    },
    /// Posterior weights that are no distribution.
    #[error("posterior weights sum to {got}, but must sum to 1 within {tolerance:e}")]
    WeightSum {
        /// Their sum.
        got: f64,
        /// How far it may be off.
        tolerance: f64,
    },
    /// A number outside its range.
    #[error("{name} is {got}, but must be {expected}")]
    Range {
        /// Which number.
        name: &'static str,
        /// Its value.
        got: f64,
        /// Its range in words.
        expected: &'static str,
    },
    /// A demonstration with a state or an action that the process does not have.
    #[error("demonstration {demonstration}, step {step}: {what} {got}, but must be below {below}")]
    Demonstration {
        /// Which, from 0.
        demonstration: usize,
        /// Step in it, from 0.
        step: usize,
        /// `state` or `action`.
        what: &'static str,
        /// Its value.
        got: usize,
        /// How many there are.
        below: usize,
    },
    /// A problem larger than this program handles.
    #[error("{what} is {got}, but at most {most} are handled")]
    Size {
        /// Which size.
        what: &'static str,
        /// Its value.
        got: usize,
        /// Largest allowed.
        most: usize,
    },
    /// Chains that are not equally long, or too short.
    #[error(transparent)]
    Chains(#[from] SeriesError),
    /// What the process itself objects to.
    #[error(transparent)]
    Process(#[from] MdpError),
}

/// Refuses NaN, infinities and numbers beyond [`MAX_SIZE`].
pub(crate) fn check_numbers(what: &'static str, numbers: &[f64]) -> Result<(), RobustError> {
    for (index, &got) in numbers.iter().enumerate() {
        if !got.is_finite() {
            return Err(RobustError::NotFinite { what, index, got });
        }
        if got.abs() > MAX_SIZE {
            return Err(RobustError::TooLarge { what, index, got, most: MAX_SIZE });
        }
    }
    Ok(())
}

/// Refuses a list that is not of the expected length.
pub(crate) fn check_length(
    what: &'static str,
    got: usize,
    expected: usize,
    why: &'static str,
) -> Result<(), RobustError> {
    if got == expected { Ok(()) } else { Err(RobustError::Length { what, got, expected, why }) }
}

/// Largest size of a weight or a feature count: returns and their squares stay finite.
pub(crate) const MAX_SIZE: f64 = 1e100;
