//! Greedy policies, the first of the actions that tie.

use crate::linear::precision;

/// How close two values count as equal, for weights whose values are at most `scale` (a bound from weights and features
/// alone, so that the tolerance does not depend on the way to a solution).
#[derive(Debug, Clone, Copy)]
pub(super) struct Tolerances {
    /// Actions whose Q* lie within this of the best tie, and the first of them is taken: 1e-11 of the scale, or 100 times
    /// the precision of values at a long horizon.
    pub(super) tie: f64,
    /// Gains below this are rounding: one precision of the scale.
    pub(super) rounding: f64,
}

impl Tolerances {
    pub(super) fn new(gamma: f64, scale: f64) -> Self {
        let rounding = precision(gamma) * scale;
        Self { tie: 100.0 * rounding, rounding }
    }
}

/// Scratch for greedy choices.
#[derive(Debug, Clone)]
pub(super) struct Greedy {
    /// max_a Q(s, a).
    pub(super) best: Vec<f64>,
    /// First action within the tie tolerance of the best, as a number that vector instructions compare.
    pub(super) first: Vec<f64>,
}

impl Greedy {
    pub(super) fn new(n_states: usize) -> Self {
        Self { best: vec![0.0; n_states], first: vec![0.0; n_states] }
    }

    /// From Q, all states of an action together.
    pub(super) fn set(&mut self, q: &[f64], tie: f64) {
        let n = self.best.len();
        self.best.copy_from_slice(&q[..n]);
        for q in q.chunks_exact(n).skip(1) {
            for (best, q) in self.best.iter_mut().zip(q) {
                *best = if *q > *best { *q } else { *best };
            }
        }
        let last = q.len() / n - 1;
        self.first.fill(last as f64);
        for (action, q) in q.chunks_exact(n).enumerate().take(last).rev() {
            let action = action as f64;
            for ((first, q), best) in self.first.iter_mut().zip(q).zip(&self.best) {
                *first = if *q >= *best - tie { action } else { *first };
            }
        }
    }

    /// Largest of best − value.
    pub(super) fn gain(&self, values: &[f64]) -> f64 {
        // Lanes of their own, or the maximum is a chain of dependent comparisons.
        let mut most = [0.0_f64; 8];
        let (best, values) = (self.best.chunks(8), values.chunks(8));
        for (best, values) in best.zip(values) {
            for ((most, best), value) in most.iter_mut().zip(best).zip(values) {
                let gain = best - value;
                *most = if gain > *most { gain } else { *most };
            }
        }
        most.into_iter().fold(0.0, f64::max)
    }
}
