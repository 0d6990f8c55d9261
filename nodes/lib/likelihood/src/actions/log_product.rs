//! The sum of logarithms as the logarithm of a product: one logarithm for hundreds of factors.

/// Products outside this range are taken the logarithm of before anything overflows.
const RANGE: std::ops::Range<f64> = 1e-100..1e100;
/// Factors outside this range are taken the logarithm of by themselves.
const FACTORS: std::ops::Range<f64> = 1e-20..1e20;
/// Most repeats of a factor that are multiplied one by one: 10^(20 · 8) stays in the range of floating point.
const REPEATS: f64 = 8.0;

/// Σ count · log(factor).
#[derive(Debug, Clone, Copy)]
pub struct LogProduct {
    product: f64,
    log: f64,
}

impl Default for LogProduct {
    fn default() -> Self {
        Self { product: 1.0, log: 0.0 }
    }
}

impl LogProduct {
    /// Adds `count` times log(factor), for a count that is a whole number.
    #[inline(always)]
    pub fn multiply(&mut self, factor: f64, count: f64) {
        if !(FACTORS.contains(&factor) && count <= REPEATS) {
            self.log += count * libm::log(factor);
            return;
        }
        for _ in 0..count as usize {
            self.product *= factor;
        }
        if !RANGE.contains(&self.product) {
            self.log += libm::log(self.product);
            self.product = 1.0;
        }
    }

    /// The sum.
    pub fn log(self) -> f64 {
        self.log + libm::log(self.product)
    }
}

#[cfg(test)]
mod tests {
    use super::LogProduct;
    use proptest::prelude::{prop_assert, proptest};

    proptest! {
        #[test]
        fn is_the_sum_of_logarithms(factors in proptest::collection::vec((-300.0..300.0_f64, 1_u32..20), 0..400)) {
            let (mut product, mut sum, mut size) = (LogProduct::default(), 0.0, 0.0_f64);
            for (i, (exponent, count)) in factors.into_iter().enumerate() {
                // Most factors are of ordinary size, as in use.
                let factor = if i % 5 == 0 { libm::exp10(exponent) } else { libm::exp10(exponent / 20.0) };
                product.multiply(factor, f64::from(count));
                sum += f64::from(count) * libm::log(factor);
                size += f64::from(count) * libm::log(factor).abs();
            }
            prop_assert!((product.log() - sum).abs() <= 1e-13 * (1.0 + size), "{} and {sum}", product.log());
        }
    }

    #[test]
    fn nothing_is_hidden() {
        let mut product = LogProduct::default();
        product.multiply(2.0, 1.0);
        product.multiply(0.0, 1.0);
        assert_eq!(product.log(), f64::NEG_INFINITY);
        product.multiply(f64::NAN, 1.0);
        assert!(product.log().is_nan());
    }
}
