//! LU factors of I − γP in a band. The matrix is diagonally dominant by rows and an M-matrix, so no pivoting is needed:
//! factors stay in the band and solutions are accurate (Golub and Van Loan, section 4.1).

use crate::linear::Order;

/// Factors in the given order; column j holds rows j − b to j + b, L below and U from the diagonal up.
#[derive(Debug, Clone)]
pub(crate) struct Banded {
    order: Order,
    columns: Vec<f64>,
}

impl Banded {
    /// Numbers that factors of `n` states in a band take.
    pub(crate) fn size(n: usize, bandwidth: usize) -> usize {
        n * (2 * bandwidth + 1)
    }

    /// Multiplications it takes to factor, about.
    pub(crate) fn work(n: usize, bandwidth: usize) -> f64 {
        let (n, b) = (n as f64, bandwidth as f64);
        n * b * b - b * b * b * (2.0 / 3.0)
    }

    /// Factors I − W, W given as (state, target, weight) any number of times.
    pub(crate) fn new(order: &Order, entries: impl Iterator<Item = (usize, usize, f64)>) -> Self {
        let (n, b) = (order.states.len(), order.bandwidth);
        let width = 2 * b + 1;
        let mut columns = vec![0.0; Self::size(n, b)];
        for j in 0..n {
            columns[j * width + b] = 1.0;
        }
        for (state, target, weight) in entries {
            let (i, j) = (order.places[state] as usize, order.places[target] as usize);
            columns[j * width + b + i - j] -= weight;
        }
        for p in 0..n {
            let below = b.min(n - 1 - p);
            let (done, rest) = columns.split_at_mut((p + 1) * width);
            let lower = &mut done[p * width + b..];
            let pivot = lower[0];
            let lower = &mut lower[1..=below];
            lower.iter_mut().for_each(|x| *x /= pivot);
            for ahead in 1..=below {
                // Row p of column p + ahead stands `ahead` above its diagonal.
                let column = &mut rest[(ahead - 1) * width + b - ahead..];
                let factor = column[0];
                if factor != 0.0 {
                    for (x, l) in column[1..=below].iter_mut().zip(lower.iter()) {
                        *x -= factor * l;
                    }
                }
            }
        }
        Self { order: order.clone(), columns }
    }

    /// Replaces the n × `width` right-hand sides `x`, row by row, by the solutions.
    pub(crate) fn solve(&self, x: &mut [f64], width: usize) {
        let mut permuted = vec![0.0; x.len()];
        for (place, &state) in self.order.states.iter().enumerate() {
            permuted[place * width..][..width].copy_from_slice(&x[state as usize * width..][..width]);
        }
        if width == 1 {
            self.solve_one(&mut permuted);
        } else {
            self.solve_many(&mut permuted, width);
        }
        for (place, &state) in self.order.states.iter().enumerate() {
            x[state as usize * width..][..width].copy_from_slice(&permuted[place * width..][..width]);
        }
    }

    /// Replaces `x` by the solution of the transposed equations.
    pub(crate) fn solve_transposed(&self, x: &mut [f64]) {
        let (n, b) = (self.order.states.len(), self.order.bandwidth);
        let mut y: Vec<f64> = self.order.states.iter().map(|&state| x[state as usize]).collect();
        for j in 0..n {
            let above = b.min(j);
            let upper = &self.columns[j * (2 * b + 1) + b - above..][..=above];
            let sum: f64 = y[j - above..j].iter().zip(upper).map(|(y, u)| y * u).sum();
            y[j] = (y[j] - sum) / upper[above];
        }
        for j in (0..n).rev() {
            let below = b.min(n - 1 - j);
            let lower = &self.columns[j * (2 * b + 1) + b + 1..][..below];
            let sum: f64 = y[j + 1..].iter().zip(lower).map(|(y, l)| y * l).sum();
            y[j] -= sum;
        }
        for (y, &state) in y.into_iter().zip(&self.order.states) {
            x[state as usize] = y;
        }
    }

    fn solve_one(&self, x: &mut [f64]) {
        let (n, b) = (self.order.states.len(), self.order.bandwidth);
        for j in 0..n {
            let value = x[j];
            if value != 0.0 {
                let below = b.min(n - 1 - j);
                let lower = &self.columns[j * (2 * b + 1) + b + 1..][..below];
                for (x, l) in x[j + 1..].iter_mut().zip(lower) {
                    *x -= value * l;
                }
            }
        }
        for j in (0..n).rev() {
            let above = b.min(j);
            let upper = &self.columns[j * (2 * b + 1) + b - above..][..=above];
            let value = x[j] / upper[above];
            x[j] = value;
            for (x, u) in x[j - above..j].iter_mut().zip(upper) {
                *x -= value * u;
            }
        }
    }

    fn solve_many(&self, x: &mut [f64], width: usize) {
        let (n, b) = (self.order.states.len(), self.order.bandwidth);
        for j in 0..n {
            let below = b.min(n - 1 - j);
            let lower = &self.columns[j * (2 * b + 1) + b + 1..][..below];
            let (done, rest) = x.split_at_mut((j + 1) * width);
            let row = &done[j * width..];
            for (l, x) in lower.iter().zip(rest.chunks_exact_mut(width)) {
                subtract(x, *l, row);
            }
        }
        for j in (0..n).rev() {
            let above = b.min(j);
            let upper = &self.columns[j * (2 * b + 1) + b - above..][..=above];
            let (done, rest) = x.split_at_mut(j * width);
            let row = &mut rest[..width];
            row.iter_mut().for_each(|x| *x /= upper[above]);
            for (u, x) in upper.iter().zip(done[(j - above) * width..].chunks_exact_mut(width)) {
                subtract(x, *u, row);
            }
        }
    }
}

/// x −= factor · y.
fn subtract(x: &mut [f64], factor: f64, y: &[f64]) {
    if factor != 0.0 {
        for (x, y) in x.iter_mut().zip(y) {
            *x -= factor * y;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::Banded;
    use crate::linear::narrow_order;
    use proptest::prelude::{prop_assert, proptest};

    proptest! {
        #[test]
        fn solutions_solve(n in 1_usize..40, reach in 1_usize..6, width in 1_usize..4, seed in 0.0..1.0_f64) {
            // A chain that jumps up to `reach` ahead or stays, with irregular probabilities.
            let entries: Vec<(usize, usize, f64)> = (0..n)
                .flat_map(|i| {
                    let p = (seed * 17.0 + i as f64 * 0.618).fract();
                    [(i, (i + 1 + i % reach) % n, 0.99 * p), (i, i, 0.99 * (1.0 - p))]
                })
                .collect();
            let order = narrow_order(n, entries.iter().map(|entry| (entry.0, entry.1)));
            let right: Vec<f64> = (0..n * width).map(|i| (i as f64 * 0.7 + seed).sin()).collect();
            let mut x = right.clone();
            Banded::new(&order, entries.iter().copied()).solve(&mut x, width);
            let mut residual = right;
            for (i, r) in residual.iter_mut().enumerate() {
                *r -= x[i];
            }
            for (from, to, weight) in entries {
                for c in 0..width {
                    residual[from * width + c] += weight * x[to * width + c];
                }
            }
            prop_assert!(residual.iter().all(|r| r.abs() < 1e-11));
        }
    }
}
