//! Why nothing can be said about a loss: input that is not what it must be.

use diagnostics::SeriesError;

use crate::bound::MIN_CHAINS;

/// Why losses cannot be judged at all.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum RiskError {
    /// Not equally long chains of finite numbers.
    #[error(transparent)]
    Series(#[from] SeriesError),
    /// Too few chains to see whether they agree.
    #[error("{got} chains, but a bound needs at least {MIN_CHAINS}")]
    TooFewChains {
        /// Chains given.
        got: usize,
    },
    /// A level outside (0, 1).
    #[error("{name} is {got}, but must lie strictly between 0 and 1")]
    Level {
        /// Which level: `alpha` or `delta`, say.
        name: &'static str,
        /// Its value.
        got: f64,
    },
    /// A number outside its range.
    #[error("{name} is {got}, but must be {expected}")]
    Parameter {
        /// Which number.
        name: &'static str,
        /// Its value.
        got: f64,
        /// Its range in words.
        expected: &'static str,
    },
    /// Two lists that belong together differ in length.
    #[error("{got} {what}, but {expected} are needed")]
    Length {
        /// What was counted.
        what: &'static str,
        /// How many there are.
        got: usize,
        /// How many there should be.
        expected: usize,
    },
    /// Nothing to judge.
    #[error("no {what} given, but at least one is needed")]
    Empty {
        /// What is missing.
        what: &'static str,
    },
    /// A number is NaN or infinite.
    #[error("{what} {index} is {value}, not a finite number")]
    NotFinite {
        /// What kind of number.
        what: &'static str,
        /// Its place in the list, from 0.
        index: usize,
        /// Its value.
        value: f64,
    },
    /// A policy has not as many draws as the first one.
    #[error("policy {policy} has {got} draws, but policy 0 has {expected}")]
    PolicyLength {
        /// Its place in the list, from 0.
        policy: usize,
        /// Its draws.
        got: usize,
        /// Draws of the first policy.
        expected: usize,
    },
    /// A draw of a policy is NaN or infinite.
    #[error("draw {index} of policy {policy} is {value}, not a finite number")]
    PolicyDraw {
        /// The policy's place in the list, from 0.
        policy: usize,
        /// The draw's place in the slice.
        index: usize,
        /// Its value.
        value: f64,
    },
    /// A draw is worse than what was said to be the worst possible value.
    #[error("draw {index} is {got}, but {worst} was said to be the worst possible value")]
    BeyondWorst {
        /// Its place in the slice.
        index: usize,
        /// Its value.
        got: f64,
        /// The value said to be the worst.
        worst: f64,
    },
}

/// `value` when it lies strictly between 0 and 1.
pub(crate) fn check_level(name: &'static str, value: f64) -> Result<(), RiskError> {
    if value > 0.0 && value < 1.0 { Ok(()) } else { Err(RiskError::Level { name, got: value }) }
}

/// Nothing when `values` are all finite.
pub(crate) fn check_finite(what: &'static str, values: &[f64]) -> Result<(), RiskError> {
    match values.iter().position(|x| !x.is_finite()) {
        Some(index) => Err(RiskError::NotFinite { what, index, value: values[index] }),
        None => Ok(()),
    }
}

/// Nothing when there are `expected` of them.
pub(crate) fn check_length(what: &'static str, got: usize, expected: usize) -> Result<(), RiskError> {
    if got == expected { Ok(()) } else { Err(RiskError::Length { what, got, expected }) }
}
