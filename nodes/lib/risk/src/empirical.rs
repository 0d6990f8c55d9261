//! Value at risk and conditional value at risk of an empirical distribution, exactly, in either tail.

use crate::order_statistic::ceil_rank;

/// Which end of the distribution is the bad one (method notes 1.9: three conventions are in use).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Tail {
    /// Large values are bad: losses.
    Upper,
    /// Small values are bad: returns.
    Lower,
}

/// Empirical value at risk at level α of ascending values: X_(⌈αn⌉) of losses, X_(n+1−⌈αn⌉) of returns.
/// `None` without values.
pub fn value_at_risk(sorted: &[f64], alpha: f64, tail: Tail) -> Option<f64> {
    let n = sorted.len();
    let rank = ceil_rank(alpha * n as f64).clamp(1, n.max(1));
    let index = match tail {
        Tail::Upper => rank - 1,
        Tail::Lower => n.checked_sub(rank)?,
    };
    sorted.get(index).copied()
}

/// Empirical conditional value at risk at level α of ascending values: the mean of the worst share 1 − α, the value at the
/// edge counted in part (Rockafellar and Uryasev 2002). `None` without values; α = 1 gives the worst value.
pub fn cvar(sorted: &[f64], alpha: f64, tail: Tail) -> Option<f64> {
    let n = sorted.len();
    let edge = value_at_risk(sorted, alpha, tail)?;
    let rank = ceil_rank(alpha * n as f64).clamp(1, n);
    let share = n as f64 * (1.0 - alpha);
    let beyond = match tail {
        Tail::Upper => &sorted[rank..],
        Tail::Lower => &sorted[..n - rank],
    };
    if beyond.is_empty() && share <= f64::EPSILON * n as f64 {
        return Some(edge);
    }
    let edge_share = (share - beyond.len() as f64).max(0.0);
    // As a mean plus a correction, so that equal values give exactly that value.
    let excess: f64 = beyond.iter().map(|x| x - edge).sum();
    Some(edge + excess / (beyond.len() as f64 + edge_share))
}

#[cfg(test)]
mod tests {
    use super::{Tail, cvar, value_at_risk};
    use proptest::prelude::{prop_assert, proptest};

    fn one_to(n: usize) -> Vec<f64> {
        (1..=n).map(|i| i as f64).collect()
    }

    #[test]
    fn equal_weights_average_the_worst() {
        // Method notes section 7: n = 2000, α = .99 is the mean of the worst 20; n = 300, α = .95 of the worst 15.
        let close = |got: Option<f64>, want: f64| assert!((got.expect("values") - want).abs() < 1e-9, "{got:?} {want}");
        close(cvar(&one_to(2000), 0.99, Tail::Upper), 1990.5);
        close(cvar(&one_to(2000), 0.99, Tail::Lower), 10.5);
        close(cvar(&one_to(300), 0.95, Tail::Upper), 293.0);
        // A fractional edge: the worst 2.5 of 10.
        close(cvar(&one_to(10), 0.75, Tail::Upper), (10.0 + 9.0 + 0.5 * 8.0) / 2.5);
        close(cvar(&one_to(10), 0.75, Tail::Lower), (1.0 + 2.0 + 0.5 * 3.0) / 2.5);
        close(cvar(&one_to(10), 1.0, Tail::Upper), 10.0);
        assert_eq!(cvar(&[], 0.9, Tail::Upper), None);
    }

    #[test]
    fn value_at_risk_is_an_order_statistic() {
        assert_eq!(value_at_risk(&one_to(100), 0.95, Tail::Upper), Some(95.0));
        assert_eq!(value_at_risk(&one_to(100), 0.95, Tail::Lower), Some(6.0));
        assert_eq!(value_at_risk(&one_to(3), 0.95, Tail::Upper), Some(3.0));
        assert_eq!(value_at_risk(&[], 0.95, Tail::Lower), None);
    }

    proptest! {
        #[test]
        fn the_tails_mirror_and_cvar_is_beyond_var(mut x in proptest::collection::vec(-10.0..10.0_f64, 1..200), alpha in 0.01..0.999_f64) {
            x.sort_unstable_by(f64::total_cmp);
            let mirrored: Vec<f64> = x.iter().rev().map(|x| -x).collect();
            let upper = cvar(&x, alpha, Tail::Upper).expect("values");
            let lower = cvar(&mirrored, alpha, Tail::Lower).expect("values");
            prop_assert!((upper + lower).abs() < 1e-9);
            prop_assert!(upper >= value_at_risk(&x, alpha, Tail::Upper).expect("values"));
            prop_assert!(upper <= x[x.len() - 1] + 1e-9);
        }
    }
}
