//! Value at risk and conditional value at risk of returns over weighted draws, and the draws that make up the tail.

/// Slack of a cumulated probability, so that rounding does not put a sliver of the next draw into the tail.
const ROUNDING: f64 = 1e-12;

/// The lower tail of a return X at level α.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct LowerTail {
    /// sup{x : P(X ≥ x) ≥ α}; the largest value for α = 0.
    pub(crate) value_at_risk: f64,
    /// max_σ σ − E(σ − X)₊ / (1 − α) (dissertation eq. 7.4): the mean of the worst share 1 − α.
    pub(crate) conditional_value_at_risk: f64,
    /// q with 0 ≤ q_i ≤ p_i / (1 − α) and Σ q = 1 that minimises qᵀX: one number per draw.
    pub(crate) shares: Vec<f64>,
}

/// The lower tail of `values` with probabilities `masses`, which are positive and sum to 1; α in [0, 1).
pub(crate) fn lower_tail(values: &[f64], masses: &[f64], alpha: f64) -> LowerTail {
    let total = 1.0 - alpha;
    let mut order: Vec<(f64, u32)> = values.iter().copied().zip(0..).collect();
    let (place, before) = edge_of(&mut order, masses, total * (1.0 - ROUNDING));
    let (edge, index) = order[place];
    // How far the rest of the tail lies below its edge; equal values give exactly that value.
    let mut shares = vec![0.0; values.len()];
    let mut below = 0.0;
    for &(value, index) in &order[..place] {
        let share = masses[index as usize] / total;
        shares[index as usize] = share;
        below += share * (edge - value);
    }
    shares[index as usize] = (total - before) / total;
    // Where the tail ends exactly with a draw, the value at risk is the next one.
    let ends = before + masses[index as usize] <= total * (1.0 + ROUNDING);
    let next = order[place + 1..].iter().map(|(value, _)| *value).fold(f64::INFINITY, f64::min);
    LowerTail {
        value_at_risk: if ends && next < f64::INFINITY { next } else { edge },
        conditional_value_at_risk: edge - below,
        shares,
    }
}

/// The place of the first value, in ascending order, up to which the masses sum to `total`, or the last; and the sum before it.
/// Reorders such that what comes before is no larger and what comes after no smaller.
fn edge_of(order: &mut [(f64, u32)], masses: &[f64], total: f64) -> (usize, f64) {
    let (mut low, mut high, mut before) = (0, order.len(), 0.0);
    while high - low > 1 {
        let middle = (high - low) / 2;
        order[low..high].select_nth_unstable_by(middle, |a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        let mass: f64 = order[low..low + middle].iter().map(|(_, index)| masses[*index as usize]).sum();
        if before + mass >= total {
            high = low + middle;
        } else {
            before += mass;
            low += middle;
        }
    }
    (low, before)
}

#[cfg(test)]
mod tests {
    use super::lower_tail;
    use proptest::prelude::{prop_assert, proptest};
    use risk::{Distribution, Measure, Tail};

    #[test]
    fn the_value_at_risk_is_the_first_value_beyond_a_tail_that_ends_with_a_draw() {
        let values: Vec<f64> = (1..=2000).rev().map(f64::from).collect();
        let tail = lower_tail(&values, &[1.0 / 2000.0; 2000], 0.99);
        assert_eq!(tail.value_at_risk, 21.0);
        assert!((tail.conditional_value_at_risk - 10.5).abs() < 1e-12);
        assert_eq!(tail.shares.iter().filter(|share| **share > 0.0).count(), 20);
        let all = lower_tail(&values, &[1.0 / 2000.0; 2000], 0.0);
        assert_eq!(all.value_at_risk, 2000.0);
        assert!((all.conditional_value_at_risk - 1000.5).abs() < 1e-9);
        let equal = lower_tail(&[0.1; 7], &[1.0 / 7.0; 7], 0.9);
        assert_eq!((equal.value_at_risk, equal.conditional_value_at_risk), (0.1, 0.1));
    }

    proptest! {
        #[test]
        fn it_is_the_tail_of_the_risk_measures(
            points in proptest::collection::vec((-5_i32..5, 0.01..1.0_f64), 1..60),
            alpha in 0.01..0.999_f64,
        ) {
            let values: Vec<f64> = points.iter().map(|(value, _)| f64::from(*value)).collect();
            let total: f64 = points.iter().map(|(_, mass)| mass).sum();
            let masses: Vec<f64> = points.iter().map(|(_, mass)| mass / total).collect();
            let tail = lower_tail(&values, &masses, alpha);
            let distribution = Distribution::weighted(&values, &masses).expect("values");
            let measure = |measure: Measure| measure.of(&distribution, Tail::Lower).expect("a level");
            let cvar = measure(Measure::ConditionalValueAtRisk { alpha });
            prop_assert!((tail.conditional_value_at_risk - cvar).abs() < 1e-9);
            prop_assert!(tail.value_at_risk >= tail.conditional_value_at_risk - 1e-12);
            // q is in the envelope, and what it says is the CVaR.
            prop_assert!((tail.shares.iter().sum::<f64>() - 1.0).abs() < 1e-9);
            prop_assert!(tail.shares.iter().zip(&masses).all(|(q, p)| *q >= 0.0 && *q <= p / (1.0 - alpha) + 1e-9));
            let mean: f64 = tail.shares.iter().zip(&values).map(|(q, value)| q * value).sum();
            prop_assert!((mean - tail.conditional_value_at_risk).abs() < 1e-9);
        }

        #[test]
        fn equal_draws_have_the_value_at_risk_of_the_risk_measures(
            values in proptest::collection::vec(-5_i32..5, 1..60),
            alpha in 0.01..0.999_f64,
        ) {
            let values: Vec<f64> = values.into_iter().map(f64::from).collect();
            let tail = lower_tail(&values, &vec![1.0 / values.len() as f64; values.len()], alpha);
            let mut sorted = values.clone();
            sorted.sort_unstable_by(f64::total_cmp);
            prop_assert!(Some(tail.value_at_risk) == risk::value_at_risk(&sorted, alpha, Tail::Lower));
        }
    }
}
