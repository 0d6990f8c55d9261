//! Rank normalisation: values replaced by the normal scores of their ranks, so that no moment needs to exist.

use crate::normal::normal_quantile;

/// Indices that sort `values` ascending; values must not be NaN.
pub(super) fn order(values: &[f64]) -> Vec<u32> {
    let mut keyed: Vec<(f64, u32)> = values.iter().copied().zip(0..).collect();
    keyed.sort_unstable_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
    keyed.into_iter().map(|(_, index)| index).collect()
}

/// Φ⁻¹((r − 3/8) / (n + 1/4)) for the rank r of every value, ties sharing their mean rank.
pub(super) fn scores(values: &[f64], order: &[u32]) -> Vec<f64> {
    let n = values.len();
    let mut scores = vec![0.0; n];
    let mut first = 0;
    while first < n {
        let value = values[order[first] as usize];
        let mut last = first;
        while last + 1 < n && values[order[last + 1] as usize] == value {
            last += 1;
        }
        let rank = (first + last) as f64 / 2.0 + 1.0;
        let score = normal_quantile((rank - 0.375) / (n as f64 + 0.25));
        for &index in &order[first..=last] {
            scores[index as usize] = score;
        }
        first = last + 1;
    }
    scores
}

/// |x − median| with the order that sorts it, merged outwards from the median in linear time.
pub(super) fn folded(values: &[f64], order: &[u32]) -> (Vec<f64>, Vec<u32>) {
    let n = values.len();
    let at = |rank: usize| values[order[rank] as usize];
    let median = if n % 2 == 1 { at(n / 2) } else { (at(n / 2 - 1) + at(n / 2)) / 2.0 };
    let distances: Vec<f64> = values.iter().map(|x| (x - median).abs()).collect();
    let (below, above) = order.split_at(n / 2);
    let (mut below, mut above) = (below.iter().rev().peekable(), above.iter().peekable());
    let mut merged = Vec::with_capacity(n);
    loop {
        let next = match (below.peek(), above.peek()) {
            (Some(&&b), Some(&&a)) => {
                if distances[b as usize] <= distances[a as usize] {
                    below.next()
                } else {
                    above.next()
                }
            }
            (Some(_), None) => below.next(),
            (None, _) => above.next(),
        };
        match next {
            Some(&index) => merged.push(index),
            None => return (distances, merged),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{folded, order, scores};
    use proptest::prelude::{prop_assert, prop_assert_eq, proptest};

    #[test]
    fn ties_share_their_mean_rank() {
        let values = [3.0, 1.0, 3.0, 2.0];
        let z = scores(&values, &order(&values));
        assert_eq!(z[0], z[2]);
        assert_eq!(z[0], super::normal_quantile((3.5 - 0.375) / 4.25));
        assert_eq!(z[3], super::normal_quantile((2.0 - 0.375) / 4.25));
    }

    proptest! {
        #[test]
        fn folding_sorts_distances_from_the_median(values in proptest::collection::vec(-5_i32..5, 1..60)) {
            let values: Vec<f64> = values.into_iter().map(f64::from).collect();
            let (distances, merged) = folded(&values, &order(&values));
            prop_assert!(merged.windows(2).all(|w| distances[w[0] as usize] <= distances[w[1] as usize]));
            let mut seen = merged.clone();
            seen.sort_unstable();
            prop_assert_eq!(seen, (0..values.len() as u32).collect::<Vec<_>>());
        }
    }
}
