//! Which order statistic of a sample bounds a quantile with a stated confidence (dissertation section 4.4; the index of
//! its Algorithm 1 is one too small, method notes 1.1).

use crate::binomial;

/// 1-based index j of the smallest order statistic of `n` independent draws that is at least the α-quantile with
/// probability 1 − δ: P(VaR_α > Z_j) ≤ δ. `None` when even the largest draw does not reach it, that is for n < [`n_min`].
pub fn order_index(n: usize, alpha: f64, delta: f64) -> Option<usize> {
    let index = binomial::quantile(1.0 - delta, n as u64, alpha) as usize + 1;
    (index <= n).then_some(index)
}

/// Fewest independent draws that bound the α-quantile with confidence 1 − δ: ⌈ln δ / ln α⌉; α and δ in (0, 1).
pub fn n_min(alpha: f64, delta: f64) -> usize {
    ceil_rank(libm::log(delta) / libm::log(alpha)).max(1)
}

/// ⌈x⌉, where a value within rounding error of an integer is that integer (0.95 · 100 is 95).
pub(crate) fn ceil_rank(x: f64) -> usize {
    let nearest = libm::round(x);
    let slack = 1e-12 * x.abs().max(1.0);
    (if (x - nearest).abs() <= slack { nearest } else { libm::ceil(x) }) as usize
}

#[cfg(test)]
mod tests {
    use super::{ceil_rank, n_min, order_index};
    use crate::binomial::cdf;
    use proptest::prelude::{prop_assert, prop_assert_eq, proptest};

    #[test]
    fn indices_match_the_reference() {
        // n, α, δ, j, F(j − 1): method notes section 2.
        let cases = [
            (30, 0.90, 0.05, 30, 0.957609),
            (59, 0.95, 0.05, 59, 0.951505),
            (100, 0.90, 0.05, 96, 0.976289),
            (100, 0.95, 0.05, 99, 0.962919),
            (495, 0.95, 0.05, 479, 0.961893),
            (500, 0.90, 0.05, 462, 0.960660),
            (1000, 0.99, 0.05, 996, 0.971314),
            (2000, 0.95, 0.05, 1917, 0.957685),
            (10_000, 0.95, 0.05, 9537, 0.954264),
        ];
        for (n, alpha, delta, j, confidence) in cases {
            assert_eq!(order_index(n, alpha, delta), Some(j), "n {n}, alpha {alpha}");
            assert!((cdf(j as u64 - 1, n as u64, alpha) - confidence).abs() < 5e-7);
        }
        assert_eq!(order_index(58, 0.95, 0.05), None);
        assert_eq!(order_index(0, 0.95, 0.05), None);
    }

    #[test]
    fn n_min_matches_the_reference() {
        let table = [(0.90, [22, 29, 44]), (0.95, [45, 59, 90]), (0.99, [230, 299, 459]), (0.999, [2302, 2995, 4603])];
        for (alpha, row) in table {
            for (delta, n) in [0.10, 0.05, 0.01].into_iter().zip(row) {
                assert_eq!(n_min(alpha, delta), n, "alpha {alpha}, delta {delta}");
            }
        }
        assert_eq!(n_min(0.5, 0.25), 2);
    }

    #[test]
    fn ranks_forgive_rounding() {
        assert_eq!(ceil_rank(0.95 * 100.0), 95);
        assert_eq!(ceil_rank(0.55 * 100.0), 55);
        assert_eq!(ceil_rank(95.001), 96);
    }

    proptest! {
        #[test]
        fn an_index_exists_exactly_from_n_min_on(alpha in 0.5..0.995_f64, delta in 0.001..0.3_f64) {
            let n = n_min(alpha, delta);
            prop_assert_eq!(order_index(n, alpha, delta), Some(n));
            prop_assert_eq!(order_index(n - 1, alpha, delta), None);
        }

        #[test]
        fn the_index_is_the_smallest_that_is_safe(n in 60_usize..3000, alpha in 0.5..0.95_f64, delta in 0.01..0.3_f64) {
            if let Some(j) = order_index(n, alpha, delta) {
                prop_assert!(cdf(j as u64 - 1, n as u64, alpha) >= 1.0 - delta);
                prop_assert!(j < 2 || cdf(j as u64 - 2, n as u64, alpha) < 1.0 - delta);
            }
        }
    }
}
