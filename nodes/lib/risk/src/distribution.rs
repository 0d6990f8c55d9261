//! A distribution on finitely many values: that of posterior draws, equally weighted or not.

use crate::error::{RiskError, check_finite, check_length};

/// Slack of a cumulated probability, so that rounding does not push a level to the next value.
const ROUNDING: f64 = 1e-12;

/// Ascending finite values with positive probabilities that sum to 1.
#[derive(Debug, Clone, PartialEq)]
pub struct Distribution {
    values: Vec<f64>,
    masses: Vec<f64>,
    /// P(X ≤ x) of each value.
    up_to: Vec<f64>,
}

impl Distribution {
    /// Every one of `values`, in any order, equally probable.
    ///
    /// # Errors
    /// No values, or one that is not finite.
    pub fn equal(values: &[f64]) -> Result<Self, RiskError> {
        check_finite("value", values)?;
        let mut values = values.to_vec();
        values.sort_unstable_by(f64::total_cmp);
        Self::equal_sorted(values)
    }

    /// [`Self::equal`] of finite values that ascend already.
    pub(crate) fn equal_sorted(values: Vec<f64>) -> Result<Self, RiskError> {
        let n = values.len();
        if n == 0 {
            return Err(RiskError::Empty { what: "values" });
        }
        let up_to = (1..=n).map(|rank| rank as f64 / n as f64).collect();
        Ok(Self { values, masses: vec![1.0 / n as f64; n], up_to })
    }

    /// `values`, in any order, with probabilities in proportion to `weights`.
    ///
    /// # Errors
    /// No values, as many weights as values not given, a number that is not finite, a negative weight, or none positive.
    pub fn weighted(values: &[f64], weights: &[f64]) -> Result<Self, RiskError> {
        check_length("weights", weights.len(), values.len())?;
        check_finite("value", values)?;
        check_finite("weight", weights)?;
        if values.is_empty() {
            return Err(RiskError::Empty { what: "values" });
        }
        if let Some(&got) = weights.iter().find(|&&weight| weight < 0.0) {
            return Err(RiskError::Parameter { name: "a weight", got, expected: "at least 0" });
        }
        let mut pairs: Vec<(f64, f64)> = values.iter().copied().zip(weights.iter().copied()).collect();
        pairs.sort_unstable_by(|a, b| a.0.total_cmp(&b.0).then(a.1.total_cmp(&b.1)));
        Self::weighted_sorted(pairs)
    }

    /// [`Self::weighted`] of values that ascend already, with finite weights of at least 0.
    pub(crate) fn weighted_sorted(mut points: Vec<(f64, f64)>) -> Result<Self, RiskError> {
        // As shares of the largest, so that no sum overflows.
        let largest = points.iter().map(|(_, weight)| *weight).fold(0.0, f64::max);
        if largest == 0.0 {
            return Err(RiskError::Parameter { name: "the largest weight", got: 0.0, expected: "above 0" });
        }
        points.iter_mut().for_each(|(_, weight)| *weight /= largest);
        let total: f64 = points.iter().map(|(_, weight)| weight).sum();
        points.iter_mut().for_each(|(_, weight)| *weight /= total);
        Ok(Self::of_possible(points.into_iter()))
    }

    /// Those of the ascending `points` that have a probability above 0.
    fn of_possible(points: impl Iterator<Item = (f64, f64)>) -> Self {
        let (values, masses): (Vec<f64>, Vec<f64>) = points.filter(|&(_, mass)| mass > 0.0).unzip();
        // Summed with what each addition lost, so that many small masses still hit their rank.
        let (mut below, mut lost) = (0.0, 0.0);
        let up_to = masses
            .iter()
            .map(|mass| {
                let added = mass - lost;
                let sum = below + added;
                lost = (sum - below) - added;
                below = sum;
                sum
            })
            .collect();
        Self { values, masses, up_to }
    }

    /// Values with their probabilities, ascending.
    pub fn points(&self) -> impl DoubleEndedIterator<Item = (f64, f64)> {
        self.values.iter().copied().zip(self.masses.iter().copied())
    }

    /// Smallest value.
    pub fn smallest(&self) -> f64 {
        self.values[0]
    }

    /// Largest value.
    pub fn largest(&self) -> f64 {
        self.values[self.values.len() - 1]
    }

    /// Expectation; exactly the value when all are equal.
    pub fn mean(&self) -> f64 {
        let base = self.smallest();
        base + self.points().map(|(x, mass)| mass * (x - base)).sum::<f64>()
    }

    /// Smallest value x with P(X ≤ x) ≥ `level` (dissertation eq. 4.17), rounding forgiven; the largest one for levels
    /// above 1.
    pub fn quantile(&self, level: f64) -> f64 {
        let rank = self.up_to.partition_point(|&up_to| up_to < level - ROUNDING);
        self.values[rank.min(self.values.len() - 1)]
    }

    /// The distribution of −X.
    pub fn negated(&self) -> Self {
        Self::of_possible(self.points().rev().map(|(x, mass)| (-x, mass)))
    }

    /// The distribution that has the share `shift` of probability moved from the smallest values to `worst`, which is at
    /// least the largest: its distribution function is max(F − shift, 0) below `worst`.
    pub(crate) fn shifted_up(&self, shift: f64, worst: f64) -> Self {
        let shift = shift.clamp(0.0, 1.0);
        let mut to_move = shift;
        let mut points: Vec<(f64, f64)> = self
            .points()
            .map(|(x, mass)| {
                let taken = f64::min(mass, to_move);
                to_move -= taken;
                (x, mass - taken)
            })
            .collect();
        points.push((worst, shift - to_move));
        Self::of_possible(points.into_iter())
    }
}

#[cfg(test)]
mod tests {
    use super::Distribution;
    use crate::error::RiskError;
    use proptest::prelude::{prop_assert, prop_assert_eq, proptest};

    #[test]
    fn equal_weights_are_no_weights() {
        let values = [3.0, -1.0, 2.0, 2.0];
        let (equal, weighted) = (Distribution::equal(&values), Distribution::weighted(&values, &[0.7; 4]));
        let (equal, weighted) = (equal.expect("values"), weighted.expect("values"));
        assert!(equal.points().eq(weighted.points()));
        assert_eq!((equal.smallest(), equal.largest(), equal.mean()), (-1.0, 3.0, 1.5));
        assert_eq!([0.25, 0.26, 0.75, 0.76, 1.0].map(|level| equal.quantile(level)), [-1.0, 2.0, 2.0, 3.0, 3.0]);
    }

    #[test]
    fn weights_weigh() {
        let x = Distribution::weighted(&[1.0, 10.0, 5.0], &[6.0, 1.0, 3.0]).expect("values");
        assert!((x.mean() - 3.1).abs() < 1e-15);
        assert_eq!([0.6, 0.61, 0.9, 0.91].map(|level| x.quantile(level)), [1.0, 5.0, 5.0, 10.0]);
        // A value without weight is no quantile.
        let x = Distribution::weighted(&[1.0, 2.0, 3.0], &[0.0, 1.0, 0.0]).expect("values");
        assert_eq!([0.0, 0.5, 1.0].map(|level| x.quantile(level)), [2.0, 2.0, 2.0]);
        assert_eq!((x.smallest(), x.largest()), (2.0, 2.0));
    }

    #[test]
    fn a_million_draws_hit_their_rank() {
        let n = 1_000_000_u32;
        let x = Distribution::equal(&(1..=n).map(f64::from).collect::<Vec<_>>()).expect("values");
        for (level, rank) in [(0.95, 950_000.0), (0.3, 300_000.0), (0.999_999, 999_999.0)] {
            assert_eq!(x.quantile(level), rank);
            assert_eq!(x.negated().negated().quantile(level), rank);
        }
    }

    #[test]
    fn refuses_bad_input() {
        assert_eq!(Distribution::equal(&[]), Err(RiskError::Empty { what: "values" }));
        assert!(matches!(Distribution::equal(&[1.0, f64::NAN]), Err(RiskError::NotFinite { index: 1, .. })));
        assert!(matches!(
            Distribution::weighted(&[1.0], &[1.0, 2.0]),
            Err(RiskError::Length { got: 2, expected: 1, .. })
        ));
        assert!(matches!(Distribution::weighted(&[1.0], &[-1.0]), Err(RiskError::Parameter { .. })));
        assert!(matches!(Distribution::weighted(&[1.0], &[0.0]), Err(RiskError::Parameter { .. })));
    }

    proptest! {
        #[test]
        fn shifting_lowers_the_distribution_function_by_the_shift(
            values in proptest::collection::vec(-5_i32..5, 1..40),
            shift in 0.0..1.0_f64,
            at in -6_i32..6,
        ) {
            let values: Vec<f64> = values.into_iter().map(f64::from).collect();
            let x = Distribution::equal(&values).expect("values");
            let worse = x.shifted_up(shift, 7.0);
            let below = |d: &Distribution| {
                d.points().filter(|&(value, _)| value <= f64::from(at)).map(|(_, mass)| mass).sum::<f64>()
            };
            prop_assert!((below(&worse) - (below(&x) - shift).max(0.0)).abs() < 1e-12);
            prop_assert!((worse.points().map(|(_, mass)| mass).sum::<f64>() - 1.0).abs() < 1e-12);
            prop_assert!(worse.mean() >= x.mean() - 1e-12);
            prop_assert_eq!(worse.largest(), if shift > 0.0 { 7.0 } else { x.largest() });
        }
    }
}
