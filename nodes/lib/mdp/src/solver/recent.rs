//! Values found under recent weights, and what they let expect under others: a tenth of the time that a frontier of robust
//! policies takes with 10,000 states.

use std::collections::VecDeque;

/// Weights remembered at most.
const MAX_ENTRIES: usize = 16;
/// Numbers remembered at most.
const MAX_NUMBERS: usize = 2_000_000;
/// Longest weights for which the equations are worth solving.
const MAX_FEATURES: usize = 64;
/// Share of the diagonal that is added to it, so that weights in fewer than k directions are no obstacle.
const RIDGE: f64 = 1e-10;
/// Largest sum of shares by size that is still called an interpolation.
const MAX_SHARES: f64 = 4.0;

/// Weights and their values, the latest last.
#[derive(Debug, Clone)]
pub(super) struct Recent {
    entries: VecDeque<(Vec<f64>, Vec<f64>)>,
    capacity: usize,
}

impl Recent {
    pub(super) fn new(n_states: usize, n_features: usize) -> Self {
        let capacity =
            if n_features > MAX_FEATURES { 0 } else { (MAX_NUMBERS / n_states.max(1)).clamp(2, MAX_ENTRIES) };
        Self { entries: VecDeque::with_capacity(capacity), capacity }
    }

    /// Remembers the values of finite weights.
    pub(super) fn add(&mut self, w: &[f64], values: &[f64]) {
        if self.capacity == 0 {
            return;
        }
        // The room of what is forgotten serves again.
        let mut entry =
            if self.entries.len() == self.capacity { self.entries.pop_front() } else { None }.unwrap_or_default();
        entry.0.clear();
        entry.0.extend_from_slice(w);
        entry.1.clear();
        entry.1.extend_from_slice(values);
        self.entries.push_back(entry);
    }

    /// Replaces `values` by Σ c_i V_i with Σ c_i w_i = w, where remembered weights lie close enough around w; whether it did.
    ///
    /// V* is the largest of functions that are linear in the weights, so this is wrong only in second order of how far the
    /// remembered weights lie. Of all c that fit, those of least Σ c_i² |w_i − w|² are taken: near weights count most.
    pub(super) fn expect(&self, w: &[f64], values: &mut [f64]) -> bool {
        let Some(shares) = self.shares(w) else { return false };
        values.fill(0.0);
        for (share, (_, known)) in shares.iter().zip(&self.entries).filter(|(share, _)| **share != 0.0) {
            values.iter_mut().zip(known).for_each(|(value, known)| *value += share * known);
        }
        true
    }

    fn shares(&self, w: &[f64]) -> Option<Vec<f64>> {
        let k = w.len();
        let size: f64 = w.iter().map(|x| x * x).sum();
        if self.entries.is_empty() || size == 0.0 {
            return None;
        }
        let trust: Vec<f64> =
            self.entries.iter().map(|(known, _)| size / (distance(known, w) + 1e-16 * size)).collect();
        // (Σ t_i w_i w_iᵀ) y = w, c_i = t_i w_iᵀ y.
        let mut matrix = vec![0.0; k * k];
        for (trust, (known, _)) in trust.iter().zip(&self.entries) {
            for (row, x) in matrix.chunks_exact_mut(k).zip(known) {
                row.iter_mut().zip(known).for_each(|(sum, y)| *sum += trust * x * y);
            }
        }
        let y = solve(&mut matrix, w)?;
        let shares: Vec<f64> = trust
            .iter()
            .zip(&self.entries)
            .map(|(trust, (known, _))| trust * known.iter().zip(&y).map(|(x, y)| x * y).sum::<f64>())
            .collect();
        let mut rest = w.to_vec();
        for (share, (known, _)) in shares.iter().zip(&self.entries) {
            rest.iter_mut().zip(known).for_each(|(rest, x)| *rest -= share * x);
        }
        // Better than the nearest of them alone, or not worth it.
        let missed: f64 = rest.iter().map(|x| x * x).sum();
        let nearest = self.entries.iter().map(|(known, _)| distance(known, w)).fold(f64::INFINITY, f64::min);
        let total: f64 = shares.iter().map(|share| share.abs()).sum();
        // Not `>`, which would let pass what is not a number.
        (total <= MAX_SHARES && missed <= nearest.max(1e-20 * size)).then_some(shares)
    }
}

/// |x − y|².
fn distance(x: &[f64], y: &[f64]) -> f64 {
    x.iter().zip(y).map(|(x, y)| (x - y) * (x - y)).sum()
}

/// Solves a symmetric positive definite system, a little of its diagonal added, by Cholesky's method.
fn solve(matrix: &mut [f64], right: &[f64]) -> Option<Vec<f64>> {
    let k = right.len();
    let trace: f64 = (0..k).map(|i| matrix[i * k + i]).sum();
    (0..k).for_each(|i| matrix[i * k + i] += RIDGE * trace / k as f64);
    for j in 0..k {
        for i in j..k {
            let before: f64 = (0..j).map(|l| matrix[i * k + l] * matrix[j * k + l]).sum();
            let left = matrix[i * k + j] - before;
            if i == j {
                if left.is_nan() || left <= 0.0 {
                    return None;
                }
                matrix[i * k + j] = left.sqrt();
            } else {
                matrix[i * k + j] = left / matrix[j * k + j];
            }
        }
    }
    let mut x = right.to_vec();
    for i in 0..k {
        let before: f64 = (0..i).map(|l| matrix[i * k + l] * x[l]).sum();
        x[i] = (x[i] - before) / matrix[i * k + i];
    }
    for i in (0..k).rev() {
        let after: f64 = (i + 1..k).map(|l| matrix[l * k + i] * x[l]).sum();
        x[i] = (x[i] - after) / matrix[i * k + i];
    }
    Some(x)
}

#[cfg(test)]
mod tests {
    use super::Recent;

    #[test]
    fn what_is_linear_in_the_weights_is_expected_exactly() {
        let value = |w: &[f64; 2]| vec![3.0 * w[0] - w[1], w[0] + 2.0 * w[1], 0.5 * w[1]];
        let mut recent = Recent::new(3, 2);
        let mut values = vec![7.0; 3];
        assert!(!recent.expect(&[1.0, 1.0], &mut values) && values == [7.0; 3], "nothing is known yet");
        for w in [[1.0, 0.2], [0.9, 0.3], [1.1, 0.1]] {
            recent.add(&w, &value(&w));
        }
        let w = [1.0, 0.25];
        assert!(recent.expect(&w, &mut values));
        for (expected, x) in value(&w).iter().zip(&values) {
            assert!((expected - x).abs() < 1e-8, "{expected} {x}");
        }
        // What was asked before is known, up to what the ridge takes.
        assert!(recent.expect(&[0.9, 0.3], &mut values));
        assert!(value(&[0.9, 0.3]).iter().zip(&values).all(|(x, y)| (x - y).abs() < 1e-8));
        // Too far away to be said from these.
        assert!(!recent.expect(&[-1.0, 5.0], &mut values));
        // Weights of nothing have no direction.
        assert!(!recent.expect(&[0.0, 0.0], &mut values));
    }

    #[test]
    fn the_oldest_is_forgotten_and_long_weights_are_left_alone() {
        let mut recent = Recent::new(2_000_000, 1);
        for i in 0..5 {
            recent.add(&[f64::from(i)], &[0.0]);
        }
        assert_eq!(recent.entries.iter().map(|entry| entry.0[0]).collect::<Vec<_>>(), [3.0, 4.0]);
        let mut recent = Recent::new(10, 1000);
        recent.add(&[1.0; 1000], &[0.0; 10]);
        assert!(!recent.expect(&[1.0; 1000], &mut [0.0; 10]));
    }
}
