//! Rank normalisation: values replaced by the normal scores of their ranks, so that no moment needs to exist.

use crate::normal::normal_quantile;

/// Indices that sort `values` ascending, equal ones in the order in which they stand; values must not be NaN.
pub(super) fn order(values: &[f64]) -> Vec<u32> {
    // Value and index in one integer: sorting integers takes no branches.
    let key = |x: f64| {
        let bits = x.to_bits();
        if x.is_sign_negative() { !bits } else { bits | 1 << 63 }
    };
    let mut keyed: Vec<u128> =
        values.iter().zip(0_u32..).map(|(&x, index)| u128::from(key(x)) << 32 | u128::from(index)).collect();
    keyed.sort_unstable();
    keyed.into_iter().map(|key| key as u32).collect()
}

/// Φ⁻¹((r − 3/8) / (n + 1/4)) for the ranks r = 1 … n.
#[derive(Debug, Clone)]
pub(super) struct NormalScores(Vec<f64>);

impl NormalScores {
    pub(super) fn new(n: usize) -> Self {
        let mut table = vec![0.0; n];
        for below in 0..n / 2 {
            let score = score(below as f64 + 1.0, n);
            (table[below], table[n - 1 - below]) = (score, -score);
        }
        Self(table)
    }

    /// The score of the rank of every value, in the order from which `order` sorted them into `ascending`; ties share their
    /// mean rank.
    pub(super) fn of(&self, ascending: &[f64], order: &[u32]) -> Vec<f64> {
        let n = self.0.len();
        let mut scores = vec![0.0; n];
        let mut first = 0;
        while first < n {
            let mut last = first;
            while last + 1 < n && ascending[last + 1] == ascending[first] {
                last += 1;
            }
            let between = first + last;
            let score =
                if between.is_multiple_of(2) { self.0[between / 2] } else { score(between as f64 / 2.0 + 1.0, n) };
            for &index in &order[first..=last] {
                scores[index as usize] = score;
            }
            first = last + 1;
        }
        scores
    }
}

fn score(rank: f64, n: usize) -> f64 {
    normal_quantile((rank - 0.375) / (n as f64 + 0.25))
}

/// |x − median| of the values that `order` sorted into `ascending`, itself ascending, and the order that sorts it so: merged
/// outwards from the median in linear time.
pub(super) fn folded(ascending: &[f64], order: &[u32]) -> (Vec<f64>, Vec<u32>) {
    let n = ascending.len();
    let median = if n % 2 == 1 { ascending[n / 2] } else { (ascending[n / 2 - 1] + ascending[n / 2]) / 2.0 };
    let (mut distances, mut merged) = (Vec::with_capacity(n), Vec::with_capacity(n));
    // Taken are the ranks below..above. Which side comes next is as good as random, so nothing may branch on it.
    let (mut below, mut above) = (n / 2, n / 2);
    for _ in 0..n {
        let left = if below > 0 { median - ascending[below - 1] } else { f64::INFINITY };
        let right = if above < n { ascending[above] - median } else { f64::INFINITY };
        let take_left = left <= right;
        merged.push(order[if take_left { below.wrapping_sub(1) } else { above }]);
        distances.push(if take_left { left } else { right });
        below -= usize::from(take_left);
        above += usize::from(!take_left);
    }
    (distances, merged)
}

#[cfg(test)]
mod tests {
    use super::{NormalScores, folded, order};
    use proptest::prelude::{prop_assert, prop_assert_eq, proptest};

    #[test]
    fn ties_share_their_mean_rank() {
        let values = [3.0, 1.0, 3.0, 2.0];
        let z = NormalScores::new(4).of(&[1.0, 2.0, 3.0, 3.0], &order(&values));
        assert_eq!(z[0], z[2]);
        assert_eq!(z[0], super::normal_quantile((3.5 - 0.375) / 4.25));
        assert_eq!(z[3], super::normal_quantile((2.0 - 0.375) / 4.25));
        // The middle of an odd number is the median.
        assert_eq!(NormalScores::new(3).of(&[-1.0, 2.0, 5.0], &[1, 2, 0])[2], 0.0);
    }

    #[test]
    fn orders_negative_and_signed_zero_values() {
        assert_eq!(order(&[0.0, -3.0, 2.0, -0.0, -1e-300, -3.0]), [1, 5, 4, 3, 0, 2]);
    }

    proptest! {
        #[test]
        fn folding_sorts_distances_from_the_median(values in proptest::collection::vec(-5_i32..5, 1..60)) {
            let values: Vec<f64> = values.into_iter().map(f64::from).collect();
            let mut ascending = values.clone();
            ascending.sort_unstable_by(f64::total_cmp);
            let median = (ascending[(values.len() - 1) / 2] + ascending[values.len() / 2]) / 2.0;
            let (distances, merged) = folded(&ascending, &order(&values));
            prop_assert!(distances.is_sorted());
            for (distance, &index) in distances.iter().zip(&merged) {
                prop_assert_eq!(*distance, (values[index as usize] - median).abs());
            }
            let mut seen = merged.clone();
            seen.sort_unstable();
            prop_assert_eq!(seen, (0..values.len() as u32).collect::<Vec<_>>());
        }
    }
}
