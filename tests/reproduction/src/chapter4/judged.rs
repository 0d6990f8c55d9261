//! A policy with its true loss and the bounds on it, and what many of them say about a bound.

use super::accurate;
use crate::harness::Estimate;
use serde::Serialize;

/// A policy judged once.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Judged {
    /// Its true loss.
    pub loss: f64,
    /// Bounds on the value at risk in the order of [`super::ALPHAS`]; none where the draws are not worth one.
    pub bounds: [Option<f64>; 3],
    /// The worst-case feature count bound.
    pub worst_case: f64,
}

/// Which bound.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum BoundKind {
    /// On the value at risk at this place of [`super::ALPHAS`].
    ValueAtRisk(usize),
    /// The worst-case feature count bound.
    WorstCase,
}

impl BoundKind {
    /// All, the widest first.
    pub const ALL: [Self; 4] = [Self::WorstCase, Self::ValueAtRisk(0), Self::ValueAtRisk(1), Self::ValueAtRisk(2)];

    /// `VaR .95`, `WFCB`.
    pub fn name(self) -> &'static str {
        match self {
            Self::ValueAtRisk(i) => ["VaR .99", "VaR .95", "VaR .90"][i],
            Self::WorstCase => "WFCB",
        }
    }

    /// Of one judgement.
    pub fn of(self, judged: &Judged) -> Option<f64> {
        match self {
            Self::ValueAtRisk(i) => judged.bounds[i],
            Self::WorstCase => Some(judged.worst_case),
        }
    }
}

/// Share of bounds that hold, among the replicates that have one.
pub fn accuracy(judged: &[Judged], kind: BoundKind) -> Estimate {
    let held: Vec<f64> = judged
        .iter()
        .filter_map(|judged| kind.of(judged).map(|bound| f64::from(u8::from(accurate(bound, judged.loss)))))
        .collect();
    Estimate::of(&held)
}

/// Bound minus loss of every replicate that has a bound (equation 4.21).
pub fn errors(judged: &[Judged], kind: BoundKind) -> Vec<f64> {
    judged.iter().filter_map(|judged| kind.of(judged).map(|bound| bound - judged.loss)).collect()
}

/// Mean bound error.
pub fn error(judged: &[Judged], kind: BoundKind) -> Estimate {
    Estimate::of(&errors(judged, kind))
}

/// (ours, other) errors of the replicates where both have a bound.
pub fn paired_errors(ours: &[Judged], others: &[Judged], kind: BoundKind) -> Vec<(f64, f64)> {
    let one = |judged: &Judged| kind.of(judged).map(|bound| bound - judged.loss);
    ours.iter().zip(others).filter_map(|(ours, other)| Some((one(ours)?, one(other)?))).collect()
}

/// Replicates without this bound.
pub fn without_bound(judged: &[Judged], kind: BoundKind) -> usize {
    judged.iter().filter(|judged| kind.of(judged).is_none()).count()
}

#[cfg(test)]
mod tests {
    use super::{BoundKind, Judged, accuracy, error, paired_errors, without_bound};

    #[test]
    fn only_replicates_with_a_bound_count() {
        let judged = |loss, bound| Judged { loss, bounds: [None, bound, None], worst_case: 2.0 };
        let all = [judged(1.0, Some(1.5)), judged(1.0, Some(0.9)), judged(1.0, None), judged(1.0, Some(0.99995))];
        let kind = BoundKind::ValueAtRisk(1);
        assert_eq!(without_bound(&all, kind), 1);
        // Two of three hold: the last is within the tolerance of 1e-4.
        assert!((accuracy(&all, kind).mean - 2.0 / 3.0).abs() < 1e-15);
        assert!((error(&all, kind).mean - 0.39995 / 3.0).abs() < 1e-12);
        assert_eq!(error(&all, BoundKind::WorstCase).mean, 1.0);
        assert_eq!(paired_errors(&all, &all[1..], kind).len(), 1);
    }
}
