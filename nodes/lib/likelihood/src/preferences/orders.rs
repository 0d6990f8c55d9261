//! Orders of several items as comparisons of pairs.

use std::collections::HashMap;

use super::{Answer, MAX_ANSWERS, PreferenceError, Verdict};

/// All pairs (less, more) of a ranking from worst to best, in the order of the ranking: n (n − 1) / 2 of them.
///
/// # Errors
/// An item ranked twice, or more than [`MAX_ANSWERS`] pairs.
pub fn ranking(order: &[usize]) -> Result<Vec<(usize, usize)>, PreferenceError> {
    let n_pairs = order.len().saturating_mul(order.len().saturating_sub(1)) / 2;
    if n_pairs > MAX_ANSWERS {
        return Err(PreferenceError::TooManyAnswers { got: n_pairs });
    }
    let mut positions = HashMap::with_capacity(order.len());
    for (second, &item) in order.iter().enumerate() {
        if let Some(first) = positions.insert(item, second) {
            return Err(PreferenceError::RankedTwice { item, first, second });
        }
    }
    let mut pairs = Vec::with_capacity(n_pairs);
    for (worse, &less) in order.iter().enumerate() {
        pairs.extend(order[worse + 1..].iter().map(|&more| (less, more)));
    }
    Ok(pairs)
}

/// Demonstrations of someone who gets better, in the order of time: every later one is preferred to every earlier one, with
/// the confidence `factor` (1: as sure as a direct answer).
///
/// # Errors
/// As [`ranking`]; the factor is checked with the other answers.
pub fn time_ordered(order: &[usize], factor: f64) -> Result<Vec<Answer>, PreferenceError> {
    let weak = |(less, more)| Answer { less, more, factor, verdict: Verdict::Strict };
    Ok(ranking(order)?.into_iter().map(weak).collect())
}
