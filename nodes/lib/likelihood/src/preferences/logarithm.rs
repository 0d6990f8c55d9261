//! The natural logarithm, branch-free so that loops vectorise, and with the same bits on every machine.
#![allow(clippy::excessive_precision)]

/// Coefficients of (log((1 + s) / (1 − s)) − 2 s) / s in powers of s², minimax for |s| ≤ 0.1716 (FreeBSD's `e_log.c`).
const MINIMAX: [f64; 7] = [
    6.666_666_666_666_735_13e-1,
    3.999_999_999_940_941_908e-1,
    2.857_142_874_366_239_149e-1,
    2.222_219_843_214_978_396e-1,
    1.818_357_216_161_805_012e-1,
    1.531_383_769_920_937_332e-1,
    1.479_819_860_511_658_591e-1,
];
const LN_2_HIGH: f64 = 6.931_471_803_691_238_2e-1;
const LN_2_LOW: f64 = 1.908_214_929_270_587_7e-10;
/// Bits of √½: mantissas are taken from [√½, √2).
const SQRT_HALF: u64 = 0x3fe6_a09e_667f_3bcd;
/// Exponent of 1 in the bits of a number.
const ONE: u64 = 0x3ff0_0000_0000_0000;
const EXPONENT: u64 = 0xfff0_0000_0000_0000;
/// 2^52 + 1023: an integer in the low bits of 2^52, less this, is that integer without the bias.
const TWO_TO_52: u64 = 0x4330_0000_0000_0000;
const TWO_TO_52_AND_BIAS: f64 = 4_503_599_627_370_496.0 + 1_023.0;

/// `ln x` to within a unit in the last place for positive normal x; anything else gives an arbitrary number.
#[inline(always)]
pub(super) fn log(x: f64) -> f64 {
    let shifted = x.to_bits().wrapping_sub(SQRT_HALF).wrapping_add(ONE);
    let exponent = f64::from_bits(shifted >> 52 | TWO_TO_52) - TWO_TO_52_AND_BIAS;
    let scale = (shifted & EXPONENT).wrapping_sub(ONE);
    let f = f64::from_bits(x.to_bits().wrapping_sub(scale)) - 1.0;
    let half_square = 0.5 * f * f;
    let s = f / (2.0 + f);
    let z = s * s;
    let mut series = MINIMAX[6];
    series = series * z + MINIMAX[5];
    series = series * z + MINIMAX[4];
    series = series * z + MINIMAX[3];
    series = series * z + MINIMAX[2];
    series = series * z + MINIMAX[1];
    series = series * z + MINIMAX[0];
    exponent * LN_2_HIGH - ((half_square - (s * (half_square + series * z) + exponent * LN_2_LOW)) - f)
}

#[cfg(test)]
mod tests {
    use super::log;
    use proptest::prelude::{prop_assert, proptest};

    proptest! {
        #[test]
        fn agrees_with_the_library(exponent in -1000.0..1000.0_f64, near_one in 0.5..2.0_f64) {
            for x in [exponent.exp2(), near_one] {
                let exact = libm::log(x);
                prop_assert!((log(x) - exact).abs() <= 2.0 * f64::EPSILON * exact.abs(), "{} vs {}", log(x), exact);
            }
        }
    }

    #[test]
    fn knows_powers_of_two() {
        assert_eq!(log(1.0), 0.0);
        for exponent in -1022..1024 {
            let x = f64::from(exponent).exp2();
            assert!((log(x) - libm::log(x)).abs() <= f64::EPSILON * libm::log(x).abs(), "2^{exponent}");
        }
    }
}
