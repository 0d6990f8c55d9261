//! The exponential function, branch-free so that loops over a grid vectorise, and with the same bits on every machine.
#![allow(clippy::excessive_precision)]

/// `1 / k!` for k = 13 down to 0.
const TAYLOR: [f64; 14] = [
    1.605_904_383_682_161_3e-10,
    2.087_675_698_786_810_0e-9,
    2.505_210_838_544_171_9e-8,
    2.755_731_922_398_589_1e-7,
    2.755_731_922_398_589_1e-6,
    2.480_158_730_158_730_2e-5,
    1.984_126_984_126_984_1e-4,
    1.388_888_888_888_889_0e-3,
    8.333_333_333_333_333_3e-3,
    4.166_666_666_666_666_6e-2,
    1.666_666_666_666_666_7e-1,
    0.5,
    1.0,
    1.0,
];
/// Adding it rounds to the nearest integer and leaves that integer in the low bits.
const ROUND: f64 = 6_755_399_441_055_744.0;
/// ln 2 in two parts: the first has trailing zeros, so that its products with exponents are exact.
const LN_2_HIGH: f64 = 6.931_471_803_691_238_2e-1;
const LN_2_LOW: f64 = 1.908_214_929_270_587_7e-10;

/// `e^x` to within 2 units in the last place for −700 ≤ x ≤ 700; outside it saturates at `e^±700`, NaN stays NaN.
///
/// Only additions and multiplications, never fused: the result does not depend on the machine or its C library.
#[inline(always)]
pub fn exp(x: f64) -> f64 {
    let x = if x < -700.0 { -700.0 } else { x };
    let x = if x > 700.0 { 700.0 } else { x };
    let shifted = x * std::f64::consts::LOG2_E + ROUND;
    let n = shifted - ROUND;
    let r = (x - n * LN_2_HIGH) - n * LN_2_LOW;
    let mut p = TAYLOR[0];
    p = p * r + TAYLOR[1];
    p = p * r + TAYLOR[2];
    p = p * r + TAYLOR[3];
    p = p * r + TAYLOR[4];
    p = p * r + TAYLOR[5];
    p = p * r + TAYLOR[6];
    p = p * r + TAYLOR[7];
    p = p * r + TAYLOR[8];
    p = p * r + TAYLOR[9];
    p = p * r + TAYLOR[10];
    p = p * r + TAYLOR[11];
    p = p * r + TAYLOR[12];
    p = p * r + TAYLOR[13];
    let exponent = shifted.to_bits().wrapping_shl(52);
    f64::from_bits(p.to_bits().wrapping_add(exponent))
}

#[cfg(test)]
mod tests {
    use super::exp;
    use proptest::prelude::{prop_assert, proptest};

    proptest! {
        #[test]
        fn agrees_with_the_library_to_two_units_in_the_last_place(x in -700.0..700.0_f64) {
            let exact = x.exp();
            prop_assert!((exp(x) - exact).abs() <= 2.0 * f64::EPSILON * exact, "{} vs {}", exp(x), exact);
        }
    }

    #[test]
    fn knows_its_ends() {
        assert_eq!(exp(0.0), 1.0);
        assert!(exp(-1e9) > 0.0 && exp(-1e9) < 1e-300);
        assert!(exp(1e9).is_finite());
        assert!(exp(f64::NAN).is_nan());
    }
}
