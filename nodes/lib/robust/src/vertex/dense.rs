//! Small dense linear equations.

/// P M = L U of a square matrix, by rows with partial pivoting.
#[derive(Debug, Clone)]
pub(crate) struct Factors {
    n: usize,
    /// L below the diagonal (its ones left out) and U on and above it, row by row.
    entries: Vec<f64>,
    /// Row of M at each row of L U.
    rows: Vec<usize>,
}

/// Pivots below this share of the largest entry mean that the matrix is singular.
const SINGULAR: f64 = 1e-13;

impl Factors {
    /// Factors of the n × n matrix `entries`, row by row; `None` when it is singular to rounding.
    pub(crate) fn new(n: usize, mut entries: Vec<f64>) -> Option<Self> {
        let mut rows: Vec<usize> = (0..n).collect();
        let largest = entries.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
        for column in 0..n {
            let size = |row: usize| entries[row * n + column].abs();
            let pivot = (column..n).fold(column, |best, row| if size(row) > size(best) { row } else { best });
            if size(pivot).is_nan() || size(pivot) <= SINGULAR * largest {
                return None;
            }
            if pivot != column {
                (0..n).for_each(|j| entries.swap(column * n + j, pivot * n + j));
                rows.swap(column, pivot);
            }
            for row in column + 1..n {
                let share = entries[row * n + column] / entries[column * n + column];
                entries[row * n + column] = share;
                for j in column + 1..n {
                    entries[row * n + j] -= share * entries[column * n + j];
                }
            }
        }
        Some(Self { n, entries, rows })
    }

    /// x with M x = b.
    pub(crate) fn solve(&self, b: &[f64]) -> Vec<f64> {
        let n = self.n;
        let mut x: Vec<f64> = self.rows.iter().map(|&row| b[row]).collect();
        for row in 0..n {
            for j in 0..row {
                x[row] -= self.entries[row * n + j] * x[j];
            }
        }
        for row in (0..n).rev() {
            for j in row + 1..n {
                x[row] -= self.entries[row * n + j] * x[j];
            }
            x[row] /= self.entries[row * n + row];
        }
        x
    }

    /// y with Mᵀ y = c.
    pub(crate) fn solve_transposed(&self, c: &[f64]) -> Vec<f64> {
        let n = self.n;
        let mut x = c.to_vec();
        for row in 0..n {
            for j in 0..row {
                x[row] -= self.entries[j * n + row] * x[j];
            }
            x[row] /= self.entries[row * n + row];
        }
        for row in (0..n).rev() {
            for j in row + 1..n {
                x[row] -= self.entries[j * n + row] * x[j];
            }
        }
        let mut y = vec![0.0; n];
        for (place, &row) in self.rows.iter().enumerate() {
            y[row] = x[place];
        }
        y
    }
}

#[cfg(test)]
mod tests {
    use super::Factors;
    use proptest::prelude::{prop_assert, proptest};

    #[test]
    fn singular_matrices_are_refused() {
        assert!(Factors::new(2, vec![1.0, 2.0, 2.0, 4.0]).is_none());
        assert!(Factors::new(2, vec![0.0; 4]).is_none());
        assert!(Factors::new(1, vec![f64::NAN]).is_none());
        assert!(Factors::new(2, vec![0.0, 1.0, 1.0, 0.0]).is_some());
    }

    proptest! {
        #[test]
        fn equations_are_solved_both_ways(
            entries in proptest::collection::vec(-1.0..1.0_f64, 36),
            b in proptest::collection::vec(-1.0..1.0_f64, 6),
        ) {
            // A strong diagonal keeps it regular, out of order so that rows have to be exchanged.
            let mut entries = entries;
            (0..6).for_each(|row| entries[row * 6 + (row + 2) % 6] += 7.0);
            let factors = Factors::new(6, entries.clone()).expect("a regular matrix");
            let (x, y) = (factors.solve(&b), factors.solve_transposed(&b));
            for i in 0..6 {
                let forward: f64 = (0..6).map(|j| entries[i * 6 + j] * x[j]).sum();
                let transposed: f64 = (0..6).map(|j| entries[j * 6 + i] * y[j]).sum();
                prop_assert!((forward - b[i]).abs() < 1e-12 && (transposed - b[i]).abs() < 1e-12);
            }
        }
    }
}
