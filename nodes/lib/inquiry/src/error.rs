//! Why nothing can be asked: input that is not what it must be.

use likelihood::preferences::PreferenceError;
use mdp::MdpError;
use risk::RiskError;

/// Why questions cannot be judged at all.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum InquiryError {
    /// Lists that belong together differ in length.
    #[error("{got} {what}, but {expected} are needed")]
    Length {
        /// What was counted.
        what: &'static str,
        /// How many there are.
        got: usize,
        /// How many there should be.
        expected: usize,
    },
    /// Nothing to judge with.
    #[error("no {what} given, but at least one is needed")]
    Empty {
        /// What is missing.
        what: &'static str,
    },
    /// A number outside its range.
    #[error("{what} {index} is {got}, but must be {expected}")]
    Number {
        /// What kind of number.
        what: &'static str,
        /// Its place, from 0.
        index: usize,
        /// Its value.
        got: f64,
        /// Its range in words.
        expected: &'static str,
    },
    /// The answers of a question do not make a distribution under a draw.
    #[error("under draw {draw} the answers have probability {got} in all, not 1")]
    NotADistribution {
        /// Which draw, from 0.
        draw: usize,
        /// Their sum.
        got: f64,
    },
    /// A critique of too many steps.
    #[error("a critique of {got} steps; 1 to {most} are supported")]
    Steps {
        /// Steps given.
        got: usize,
        /// Most that are supported.
        most: usize,
    },
    /// A world, policy or weights that do not fit.
    #[error(transparent)]
    World(#[from] MdpError),
    /// A level that is none.
    #[error(transparent)]
    Risk(#[from] RiskError),
    /// A model of comparing that is none.
    #[error(transparent)]
    Comparison(#[from] PreferenceError),
}

/// Nothing when there are `expected` of them.
pub(crate) fn check_length(what: &'static str, got: usize, expected: usize) -> Result<(), InquiryError> {
    if got == expected { Ok(()) } else { Err(InquiryError::Length { what, got, expected }) }
}

/// Nothing when all lie in the range that `inside` tells.
pub(crate) fn check_numbers(
    what: &'static str,
    numbers: &[f64],
    expected: &'static str,
    inside: impl Fn(f64) -> bool,
) -> Result<(), InquiryError> {
    match numbers.iter().position(|&x| !inside(x)) {
        Some(index) => Err(InquiryError::Number { what, index, got: numbers[index], expected }),
        None => Ok(()),
    }
}
