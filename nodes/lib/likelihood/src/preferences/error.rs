//! Why comparisons cannot be learned from.

use super::{MAX_ANSWERS, MAX_FACTOR, MAX_FEATURES, MAX_ITEMS, MAX_NUMBERS, MAX_VALUE, Verdict};

/// What is wrong with items, answers or their model; each says where, what it got and what it expected.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum PreferenceError {
    /// No features, or too many.
    #[error("items have {got} features, expected 1 to {MAX_FEATURES}")]
    FeatureCount {
        /// Features given.
        got: usize,
    },
    /// The features are not whole rows.
    #[error("{got} feature values are not whole rows of {n_features}")]
    Ragged {
        /// Numbers given.
        got: usize,
        /// Length of a row.
        n_features: usize,
    },
    /// See [`MAX_ITEMS`] and [`MAX_NUMBERS`].
    #[error(
        "{got} items of {n_features} features: at most {MAX_ITEMS} items and {MAX_NUMBERS} feature values are supported"
    )]
    TooManyItems {
        /// Items given.
        got: usize,
        /// Features of each.
        n_features: usize,
    },
    /// NaN, infinite or too large to be squared.
    #[error("feature {feature} of item {item} is {got}, expected a number of magnitude at most {MAX_VALUE:e}")]
    FeatureValue {
        /// Row.
        item: usize,
        /// Column.
        feature: usize,
        /// The value.
        got: f64,
    },
    /// See [`MAX_ANSWERS`].
    #[error("{got} answers, but at most {MAX_ANSWERS} are supported")]
    TooManyAnswers {
        /// Answers given, or pairs of a ranking.
        got: usize,
    },
    /// An answer about an item that does not exist.
    #[error("answer {answer} is about item {got}, but there are {n_items} items, counted from 0")]
    UnknownItem {
        /// Position of the answer.
        answer: usize,
        /// The item it names.
        got: usize,
        /// Items there are.
        n_items: usize,
    },
    /// An item compared with itself.
    #[error("answer {answer} compares item {item} with itself, expected two different items")]
    SameItem {
        /// Position of the answer.
        answer: usize,
        /// The item.
        item: usize,
    },
    /// A confidence factor out of range.
    #[error("answer {answer} has the confidence factor {got}, expected a number above 0 and at most {MAX_FACTOR}")]
    Factor {
        /// Position of the answer.
        answer: usize,
        /// The factor.
        got: f64,
    },
    /// An answer that was not offered, so that no reward explains it.
    #[error(
        "answer {answer} is {verdict:?}, which the answer model never gives: its {parameter} is 0, expected above 0"
    )]
    NotOffered {
        /// Position of the answer.
        answer: usize,
        /// What was answered.
        verdict: Verdict,
        /// The parameter that would allow it.
        parameter: &'static str,
    },
    /// A parameter of the answer model out of range.
    #[error("the {parameter} of the answer model is {got}, expected {expected}")]
    Model {
        /// Name of the parameter.
        parameter: &'static str,
        /// Its value.
        got: f64,
        /// Its range.
        expected: &'static str,
    },
    /// An item twice in one ranking.
    #[error("item {item} stands at positions {first} and {second} of the ranking, expected every item once")]
    RankedTwice {
        /// The item.
        item: usize,
        /// Its first position.
        first: usize,
        /// Its second position.
        second: usize,
    },
}
