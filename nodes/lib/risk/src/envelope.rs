//! A distribution that is worse than the true one with a stated confidence, from the empirical one.

use crate::distribution::Distribution;

/// Levels at which the number of effective draws is looked at; the smallest counts.
pub(crate) const LEVELS: [f64; 7] = [0.05, 0.1, 0.25, 0.5, 0.75, 0.9, 0.95];

/// √(ln(1/δ) / (2n)), at most 1: P(sup_x (F_n(x) − F(x)) > ε) ≤ δ for n independent draws (Dvoretzky, Kiefer and
/// Wolfowitz, with the constant of Massart 1990, whose one-sided form asks for δ ≤ ½; a larger δ is taken as ½).
pub fn distribution_shift(n: usize, delta: f64) -> f64 {
    libm::sqrt(libm::log(1.0 / delta.min(0.5)) / (2.0 * n as f64)).min(1.0)
}

/// Fewest independent draws of which the shift is below `share`.
pub(crate) fn draws_for_shift(share: f64, delta: f64) -> usize {
    (libm::log(1.0 / delta.min(0.5)) / (2.0 * share * share)) as usize + 1
}

/// The distribution whose distribution function is max(F̂ − shift, 0) below `worst` and 1 there: with the confidence of
/// [`distribution_shift`] the true loss, which never exceeds `worst`, is stochastically smaller, so that every monotone
/// law-invariant measure of it is at most that of this one, all of them at once.
pub(crate) fn envelope(empirical: &Distribution, shift: f64, worst: f64) -> Distribution {
    empirical.shifted_up(shift, worst.max(empirical.largest()))
}

#[cfg(test)]
mod tests {
    use super::{distribution_shift, draws_for_shift};

    #[test]
    fn the_shift_is_massarts() {
        assert!((distribution_shift(1000, 0.05) - (20.0_f64.ln() / 2000.0).sqrt()).abs() < 1e-16);
        assert_eq!((distribution_shift(0, 0.05), distribution_shift(1, 0.001)), (1.0, 1.0));
        assert_eq!(distribution_shift(100, 0.9), distribution_shift(100, 0.5));
    }

    #[test]
    fn enough_draws_make_the_shift_small_enough() {
        for share in [0.1, 0.05, 0.01] {
            let n = draws_for_shift(share, 0.05);
            assert!(distribution_shift(n, 0.05) < share && distribution_shift(n - 1, 0.05) >= share, "{share}: {n}");
        }
        assert_eq!(draws_for_shift(0.05, 0.05), 600);
    }
}
