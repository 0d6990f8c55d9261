//! Small dense linear algebra with a fixed order of operations, so that results have the same bits on every machine.

/// Lower Cholesky factor of a symmetric matrix (row-major, n × n); `None` unless it is positive definite.
pub(crate) fn cholesky(matrix: &[f64], n: usize) -> Option<Vec<f64>> {
    let mut factor = vec![0.0; n * n];
    for i in 0..n {
        for j in 0..=i {
            let products = (0..j).map(|k| factor[i * n + k] * factor[j * n + k]);
            let rest = matrix[i * n + j] - products.sum::<f64>();
            if i == j {
                if !(rest > 0.0 && rest.is_finite()) {
                    return None;
                }
                factor[i * n + i] = libm::sqrt(rest);
            } else {
                factor[i * n + j] = rest / factor[j * n + j];
            }
        }
    }
    Some(factor)
}

/// out = L v.
pub(crate) fn lower_times(factor: &[f64], v: &[f64], out: &mut [f64]) {
    let n = v.len();
    for (i, (out, row)) in out.iter_mut().zip(factor.chunks_exact(n)).enumerate() {
        *out = dot(&row[..=i], &v[..=i]);
    }
}

/// out = Lᵀ v.
pub(crate) fn upper_times(factor: &[f64], v: &[f64], out: &mut [f64]) {
    let n = v.len();
    out.fill(0.0);
    for (i, (v, row)) in v.iter().zip(factor.chunks_exact(n)).enumerate() {
        for (out, a) in out[..=i].iter_mut().zip(row) {
            *out += a * v;
        }
    }
}

/// out = A v for a row-major n × n matrix.
pub(crate) fn times(matrix: &[f64], v: &[f64], out: &mut [f64]) {
    for (out, row) in out.iter_mut().zip(matrix.chunks_exact(v.len())) {
        *out = dot(row, v);
    }
}

/// Inner product in four fixed lanes, so that it vectorises and its bits do not depend on the vector width.
#[inline]
pub(crate) fn dot(a: &[f64], b: &[f64]) -> f64 {
    let mut lanes = [0.0; 4];
    let (a_lanes, b_lanes) = (a.chunks_exact(4), b.chunks_exact(4));
    let rest: f64 = a_lanes.remainder().iter().zip(b_lanes.remainder()).map(|(a, b)| a * b).sum();
    for (a, b) in a_lanes.zip(b_lanes) {
        for ((lane, a), b) in lanes.iter_mut().zip(a).zip(b) {
            *lane += a * b;
        }
    }
    (lanes[0] + lanes[1]) + (lanes[2] + lanes[3]) + rest
}

/// Σ x².
#[inline]
pub(crate) fn norm_squared(x: &[f64]) -> f64 {
    dot(x, x)
}

/// Largest eigenvalue of a positive semidefinite matrix, a little overestimated, by power iteration.
pub(crate) fn largest_eigenvalue(matrix: &[f64], n: usize) -> f64 {
    let mut v: Vec<f64> = (0..n).map(|i| 1.0 + (i % 7) as f64 / 7.0).collect();
    let mut next = vec![0.0; n];
    let mut norm = 0.0;
    for _ in 0..40 {
        times(matrix, &v, &mut next);
        norm = libm::sqrt(dot(&next, &next));
        if norm == 0.0 {
            return 0.0;
        }
        for (v, next) in v.iter_mut().zip(&next) {
            *v = next / norm;
        }
    }
    1.1 * norm
}

#[cfg(test)]
mod tests {
    use super::{cholesky, largest_eigenvalue, lower_times, times, upper_times};

    const A: [f64; 9] = [4.0, 2.0, 0.4, 2.0, 5.0, 1.0, 0.4, 1.0, 3.0];

    #[test]
    fn factor_multiplies_back() {
        let factor = cholesky(&A, 3).expect("positive definite");
        let v = [1.0, -2.0, 0.5];
        let (mut half, mut whole, mut product) = ([0.0; 3], [0.0; 3], [0.0; 3]);
        upper_times(&factor, &v, &mut half);
        lower_times(&factor, &half, &mut whole);
        times(&A, &v, &mut product);
        for i in 0..3 {
            assert!((whole[i] - product[i]).abs() < 1e-14);
        }
        assert!(cholesky(&[1.0, 2.0, 2.0, 1.0], 2).is_none());
        let top = largest_eigenvalue(&A, 3);
        assert!((6.8..8.0).contains(&top), "{top}");
    }
}
