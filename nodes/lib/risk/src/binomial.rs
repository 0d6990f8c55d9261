//! The binomial distribution to near machine precision for any n, with the same bits on every machine.
#![allow(clippy::excessive_precision)]

use std::f64::consts::TAU;

/// Terms below this share of the sum so far no longer change it.
const NEGLIGIBLE: f64 = 1e-18;

/// F(k; n, p) = P(X ≤ k) for X binomial; p in [0, 1]. NaN for p outside.
pub fn cdf(k: u64, n: u64, p: f64) -> f64 {
    if !(0.0..=1.0).contains(&p) {
        return f64::NAN;
    }
    if k >= n || p == 0.0 {
        return 1.0;
    }
    if p == 1.0 {
        return 0.0;
    }
    // Sum the shorter tail, from its largest term outwards: every term is positive and falls faster than the last.
    let q = 1.0 - p;
    if (k as f64) < n as f64 * p { lower_tail(k, n, p, q) } else { 1.0 - lower_tail(n - k - 1, n, q, p) }
}

/// Smallest k with F(k; n, p) ≥ q; q and p in [0, 1].
pub fn quantile(q: f64, n: u64, p: f64) -> u64 {
    let (mut low, mut high) = (0, n);
    while low < high {
        let middle = low + (high - low) / 2;
        if cdf(middle, n, p) >= q {
            high = middle;
        } else {
            low = middle + 1;
        }
    }
    low
}

/// P(X ≤ k) for k below the mean; `q` is 1 − p, given apart because a small p is lost in 1 − (1 − p).
fn lower_tail(k: u64, n: u64, p: f64, q: f64) -> f64 {
    let odds = q / p;
    let (mut term, mut sum) = (1.0, 1.0);
    let mut i = k;
    while i > 0 {
        term *= i as f64 / (n - i + 1) as f64 * odds;
        sum += term;
        if term < NEGLIGIBLE * sum {
            break;
        }
        i -= 1;
    }
    mass(k, n, p, q) * sum
}

/// P(X = k) by the saddle-point expansion (Loader 2000): no cancellation however large n is. 0 < p < 1, q = 1 − p, k < n.
fn mass(k: u64, n: u64, p: f64, q: f64) -> f64 {
    if k == 0 {
        let log_q = if p < 0.5 { libm::log1p(-p) } else { libm::log(q) };
        return libm::exp(n as f64 * log_q);
    }
    let (n_, k_, rest) = (n as f64, k as f64, (n - k) as f64);
    let exponent =
        stirling_error(n) - stirling_error(k) - stirling_error(n - k) - deviance(k_, n_ * p) - deviance(rest, n_ * q);
    libm::exp(exponent) * libm::sqrt(n_ / (TAU * k_ * rest))
}

/// ln n! − ln(√(2πn) (n/e)ⁿ).
fn stirling_error(n: u64) -> f64 {
    /// For n = 1 to 15.
    const SMALL: [f64; 15] = [
        0.081_061_466_795_327_258_219_670_264,
        0.041_340_695_955_409_294_093_822_081,
        0.027_677_925_684_998_339_148_789_292,
        0.020_790_672_103_765_093_111_522_771,
        0.016_644_691_189_821_192_163_194_865,
        0.013_876_128_823_070_747_998_745_727,
        0.011_896_709_945_891_770_095_055_724,
        0.010_411_265_261_972_096_497_478_567,
        0.009_255_462_182_712_732_917_728_637,
        0.008_330_563_433_362_871_256_469_318,
        0.007_573_675_487_951_840_794_972_024,
        0.006_942_840_107_209_529_865_664_152,
        0.006_408_994_188_004_207_068_439_631,
        0.005_951_370_112_758_847_735_624_416,
        0.005_554_733_551_962_801_371_038_690,
    ];
    if n == 0 {
        return 0.0;
    }
    if let Some(error) = usize::try_from(n).ok().and_then(|n| SMALL.get(n - 1)) {
        return *error;
    }
    let n = n as f64;
    let s = 1.0 / (n * n);
    (1.0 / 12.0
        - s * (1.0 / 360.0 - s * (1.0 / 1260.0 - s * (1.0 / 1680.0 - s * (1.0 / 1188.0 - s * 691.0 / 360_360.0)))))
        / n
}

/// x ln(x/μ) + μ − x, without cancellation near x = μ.
fn deviance(x: f64, mu: f64) -> f64 {
    let gap = x - mu;
    if gap.abs() >= 0.1 * (x + mu) {
        return x * libm::log(x / mu) - gap;
    }
    let v = gap / (x + mu);
    let mut sum = gap * v;
    let mut term = 2.0 * x * v;
    let mut odd = 1.0;
    loop {
        term *= v * v;
        odd += 2.0;
        let next = sum + term / odd;
        if next == sum {
            return sum;
        }
        sum = next;
    }
}

#[cfg(test)]
mod tests {
    use super::{cdf, quantile};
    use proptest::prelude::{prop_assert, proptest};

    /// (n, p, k, F(k)) in 40-digit arithmetic.
    const REFERENCE: &[(u64, f64, u64, f64)] = &include!("binomial_reference.in");

    #[test]
    fn cdf_is_exact_to_1e_12() {
        for &(n, p, k, f) in REFERENCE {
            assert!((cdf(k, n, p) - f).abs() < 1e-12, "n {n} p {p} k {k}: {:.17} vs {f:.17}", cdf(k, n, p));
        }
    }

    #[test]
    fn ends_are_exact() {
        assert_eq!(cdf(5, 5, 0.3), 1.0);
        assert_eq!(cdf(4, 5, 1.0), 0.0);
        assert_eq!(cdf(0, 5, 0.0), 1.0);
        assert!(cdf(0, 5, 1.5).is_nan());
        assert_eq!(quantile(1.0, 5, 0.3), 5);
        assert_eq!(quantile(0.0, 5, 0.3), 0);
    }

    proptest! {
        #[test]
        fn quantile_inverts_cdf(n in 1_u64..5000, p in 0.001..0.999_f64, q in 0.0001..0.9999_f64) {
            let k = quantile(q, n, p);
            prop_assert!(cdf(k, n, p) >= q);
            prop_assert!(k == 0 || cdf(k - 1, n, p) < q);
        }

        #[test]
        fn both_tails_add_up(n in 1_u64..100_000, p in 0.001..0.999_f64, share in 0.0..1.0_f64) {
            let k = ((n - 1) as f64 * share) as u64;
            let other = cdf(n - k - 1, n, 1.0 - p);
            prop_assert!((cdf(k, n, p) + other - 1.0).abs() < 1e-12);
        }
    }
}
