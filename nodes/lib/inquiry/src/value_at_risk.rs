//! α-VaR of losses under weighted draws, per situation: what ActiveVaR asks by (eq. 8.2, Algorithm 5).

use crate::{Belief, InquiryError, Losses};

/// Slack of a cumulated probability, for rounding.
const ROUNDING: f64 = 1e-12;

/// α-quantile of the loss in every situation under the belief: the smallest x with P(loss ≤ x) ≥ α.
///
/// # Errors
/// α outside (0, 1); losses of other draws than the belief's.
pub fn values_at_risk(losses: &Losses, belief: &Belief, alpha: f64) -> Result<Vec<f64>, InquiryError> {
    check_alpha(alpha)?;
    crate::error::check_length("draws with losses", losses.n_draws(), belief.n())?;
    let mut order: Vec<u32> = Vec::with_capacity(belief.n());
    let of = |situation: usize| {
        let row = losses.of(situation);
        order.clear();
        order.extend(0..row.len() as u32);
        order.sort_unstable_by(|&a, &b| row[b as usize].total_cmp(&row[a as usize]));
        descending_quantile(row, &order, belief.weights(), 1.0 - alpha)
    };
    Ok((0..losses.n_situations()).map(of).collect())
}

/// Smallest value whose excess has at most the probability `tail`; `order` sorts `values` descending, and `weights` may have any
/// positive sum that `tail` refers to.
pub(crate) fn descending_quantile(values: &[f64], order: &[u32], weights: &[f64], tail: f64) -> f64 {
    let (mut above, mut found) = (0.0, f64::NEG_INFINITY);
    for &index in order {
        let (value, weight) = (values[index as usize], weights[index as usize]);
        if weight == 0.0 {
            continue;
        }
        if above > tail + ROUNDING {
            break;
        }
        found = value;
        above += weight;
    }
    found
}

pub(crate) fn check_alpha(alpha: f64) -> Result<(), InquiryError> {
    crate::error::check_numbers("alpha", &[alpha], "strictly between 0 and 1", |a| a > 0.0 && a < 1.0)
}

#[cfg(test)]
mod tests {
    use super::values_at_risk;
    use crate::{Belief, Losses};
    use proptest::prelude::{prop_assert_eq, proptest};
    use risk::Distribution;

    #[test]
    fn by_hand() {
        let losses = Losses::new(4, vec![3.0, 1.0, 2.0, 4.0, 0.0, 0.0, 0.0, 0.0]).expect("losses");
        let equal = Belief::equal(4).expect("draws");
        assert_eq!(values_at_risk(&losses, &equal, 0.75).expect("a level"), [3.0, 0.0]);
        assert_eq!(values_at_risk(&losses, &equal, 0.76).expect("a level"), [4.0, 0.0]);
        let sure = Belief::weighted(&[0.0, 1.0, 0.0, 0.0]).expect("draws");
        assert_eq!(values_at_risk(&losses, &sure, 0.95).expect("a level"), [1.0, 0.0]);
        assert!(values_at_risk(&losses, &equal, 1.0).is_err());
        assert!(values_at_risk(&losses, &Belief::equal(3).expect("draws"), 0.9).is_err());
    }

    proptest! {
        /// Against the definition, as `risk` computes it.
        #[test]
        fn is_the_quantile_of_the_weighted_draws(
            draws in proptest::collection::vec((0_u8..8, 1_u32..6), 1..40), alpha in 0.05..0.99_f64,
        ) {
            let values: Vec<f64> = draws.iter().map(|d| f64::from(d.0)).collect();
            let weights: Vec<f64> = draws.iter().map(|d| f64::from(d.1)).collect();
            let belief = Belief::weighted(&weights).expect("weights");
            let losses = Losses::new(values.len(), values.clone()).expect("losses");
            let got = values_at_risk(&losses, &belief, alpha).expect("a level")[0];
            let expected = Distribution::weighted(&values, &weights).expect("a distribution").quantile(alpha);
            prop_assert_eq!(got, expected);
        }
    }
}
