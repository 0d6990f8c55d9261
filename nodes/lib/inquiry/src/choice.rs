//! Ask about the table with the largest bound, or stop when even that is below ε.

/// How the robot's placement in one candidate table was judged.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Judged {
    /// Upper confidence bound on the loss, metres; `None` when there is no bound.
    pub bound_m: Option<f64>,
    /// Empirical quantile of the loss, metres; may be NaN when there is no placement.
    pub point_estimate_m: f64,
}

/// What to do next.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Choice {
    /// Ask about the candidate with this index.
    Ask(usize),
    /// Every candidate has a bound, and the largest lies below ε.
    Taught {
        /// That bound, metres.
        bound_m: f64,
    },
    /// There is nothing to ask: no candidate has a placement.
    Nothing,
}

/// The candidate with the largest bound (C* = argmax α-VaR, section 8.2.4), or that the lesson is over.
///
/// A candidate without a bound is one about which nothing may be claimed, so it is asked before those with one; among
/// several the larger point estimate comes first, and of equals the first.
pub fn choose(judged: &[Judged], epsilon_m: f64) -> Choice {
    let key = |j: &Judged| (j.bound_m.is_none(), j.bound_m.unwrap_or(j.point_estimate_m));
    let askable = judged.iter().enumerate().filter(|(_, j)| !key(j).1.is_nan());
    let best = askable.reduce(|best, next| {
        let ((a, x), (b, y)) = (key(best.1), key(next.1));
        if (b && !a) || (a == b && y > x) { next } else { best }
    });
    match best {
        None => Choice::Nothing,
        Some((_, Judged { bound_m: Some(bound_m), .. })) if *bound_m < epsilon_m => {
            Choice::Taught { bound_m: *bound_m }
        }
        Some((index, _)) => Choice::Ask(index),
    }
}

#[cfg(test)]
mod tests {
    use super::{Choice, Judged, choose};

    fn bound(m: f64) -> Judged {
        Judged { bound_m: Some(m), point_estimate_m: 0.5 * m }
    }
    fn none(point_estimate_m: f64) -> Judged {
        Judged { bound_m: None, point_estimate_m }
    }

    #[test]
    fn the_largest_bound_is_asked() {
        assert_eq!(choose(&[bound(0.1), bound(0.3), bound(0.2), bound(0.3)], 0.1), Choice::Ask(1));
    }

    #[test]
    fn taught_only_when_every_candidate_has_a_bound_below_epsilon() {
        assert_eq!(choose(&[bound(0.05), bound(0.09)], 0.1), Choice::Taught { bound_m: 0.09 });
        assert_eq!(choose(&[bound(0.05), bound(0.1)], 0.1), Choice::Ask(1));
        assert_eq!(choose(&[bound(0.05), none(0.01)], 0.1), Choice::Ask(1));
    }

    #[test]
    fn without_bounds_the_largest_estimate_is_asked() {
        assert_eq!(choose(&[none(0.1), bound(0.9), none(0.2)], 0.1), Choice::Ask(2));
    }

    #[test]
    fn a_table_where_nothing_can_be_placed_is_never_asked_nor_claimed() {
        assert_eq!(choose(&[none(f64::NAN), bound(0.2)], 0.1), Choice::Ask(1));
        assert_eq!(choose(&[none(f64::NAN)], 0.1), Choice::Nothing);
        assert_eq!(choose(&[], 0.1), Choice::Nothing);
    }
}
