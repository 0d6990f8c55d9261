//! Means with standard errors, bootstrap intervals, and how many successes a promised rate allows at least.

use mdp::random::index;
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;
use serde::Serialize;

/// Resamples of a bootstrap.
const RESAMPLES: usize = 4000;
/// Chance with which a method that keeps its promise may still be called a failure.
const FALSE_ALARM: f64 = 1e-3;

/// A mean over replicates.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Estimate {
    /// Mean.
    pub mean: f64,
    /// Standard error of the mean: s/√n.
    pub standard_error: f64,
    /// Replicates.
    pub n: usize,
}

impl Estimate {
    /// Of values of independent replicates; NaN where there are too few to say.
    pub fn of(values: &[f64]) -> Self {
        let n = values.len() as f64;
        let mean = sum_in_order(values) / n;
        let squares: Vec<f64> = values.iter().map(|x| (x - mean) * (x - mean)).collect();
        let standard_error = libm::sqrt(sum_in_order(&squares) / (n - 1.0) / n);
        Self { mean, standard_error, n: values.len() }
    }

    /// `0.152 ± .011` with the digits that the standard error warrants.
    pub fn text(&self) -> String {
        if !self.mean.is_finite() {
            return "–".into();
        }
        // Two digits of the standard error, at most four decimals.
        let decimals = if self.standard_error > 0.0 && self.standard_error.is_finite() {
            (1.0 - libm::floor(libm::log10(self.standard_error))).clamp(0.0, 4.0) as usize
        } else {
            3
        };
        format!("{:.decimals$} ± {:.decimals$}", self.mean, self.standard_error)
    }

    /// Whether `value`, known within `other_standard_error`, lies within two standard errors of the difference.
    pub fn agrees_with(&self, value: f64, other_standard_error: f64) -> bool {
        let error = libm::hypot(self.standard_error, other_standard_error);
        (self.mean - value).abs() <= 2.0 * error
    }
}

/// Sum from the first to the last: the same bits on every machine.
pub fn sum_in_order(values: &[f64]) -> f64 {
    values.iter().fold(0.0, |sum, x| sum + x)
}

/// 95 % bootstrap interval (percentiles of 4,000 resampled means) of the mean of `values`. For a paired comparison give the
/// differences of the pairs.
pub fn bootstrap_interval(values: &[f64], seed: u64) -> [f64; 2] {
    let mut generator = ChaCha8Rng::seed_from_u64(seed);
    let n = values.len();
    let mut means: Vec<f64> = (0..RESAMPLES)
        .map(|_| (0..n).map(|_| values[index(n, &mut generator)]).fold(0.0, |sum, x| sum + x) / n as f64)
        .collect();
    means.sort_unstable_by(f64::total_cmp);
    let at = |share: f64| means[(share * (RESAMPLES - 1) as f64).round() as usize];
    [at(0.025), at(0.975)]
}

/// Fewest successes in n trials that still allow a success rate of `alpha`: fewer have a chance below one in a thousand.
pub fn least_successes(n: usize, alpha: f64) -> usize {
    risk::quantile(FALSE_ALARM, n as u64, alpha) as usize
}

/// χ² of values in (0, 1) against the uniform distribution over equal bins: bins − 1 degrees of freedom.
pub fn uniformity(values: &[f64], bins: usize) -> f64 {
    let mut counts = vec![0.0; bins];
    for value in values {
        counts[((value * bins as f64) as usize).min(bins - 1)] += 1.0;
    }
    let expected = values.len() as f64 / bins as f64;
    counts.iter().map(|count| (count - expected) * (count - expected) / expected).sum()
}

#[cfg(test)]
mod tests {
    use super::{Estimate, bootstrap_interval, least_successes, uniformity};
    use mdp::random::{exponential, uniform};
    use rand_chacha::ChaCha8Rng;
    use rand_chacha::rand_core::SeedableRng;

    #[test]
    fn standard_errors_are_exact_on_a_small_sample() {
        // Mean 3, sum of squares 10, s² = 10/4, s/√5 = √.5.
        let estimate = Estimate::of(&[1.0, 2.0, 3.0, 4.0, 5.0]);
        assert_eq!(estimate.mean, 3.0);
        assert!((estimate.standard_error - 0.5_f64.sqrt()).abs() < 1e-15);
        assert_eq!(estimate.text(), "3.00 ± 0.71");
        assert!(estimate.agrees_with(4.4, 0.0) && !estimate.agrees_with(4.5, 0.0) && estimate.agrees_with(4.5, 0.3));
    }

    /// Over 1,000 samples of 60 exponentials (skewed, as losses are) the 95 % interval holds the mean 1 in about 93.5 % of all cases:
    /// percentile intervals of skewed samples fall a little short. Standard error of the share: .8 %.
    #[test]
    fn bootstrap_intervals_cover_about_as_often_as_they_say() {
        let mut generator = ChaCha8Rng::seed_from_u64(5);
        let covered = (0..1000)
            .filter(|&seed| {
                let sample: Vec<f64> = (0..60).map(|_| exponential(&mut generator)).collect();
                let [low, high] = bootstrap_interval(&sample, seed);
                (low..=high).contains(&1.0)
            })
            .count();
        assert!((910..=965).contains(&covered), "{covered} of 1000");
    }

    #[test]
    fn thresholds_are_those_of_the_method_notes() {
        // Section 3: issued bounds over 200 worlds hold at least 166, 179, 192 times.
        for (alpha, least) in [(0.9, 166), (0.95, 179), (0.99, 192)] {
            let got = least_successes(200, alpha);
            assert!(got.abs_diff(least) <= 1, "{alpha}: {got}");
        }
    }

    /// χ²₉ has mean 9 and variance 18, and exceeds 27.88 once in a thousand.
    #[test]
    fn uniform_values_have_the_chi_squared_distribution() {
        let mut generator = ChaCha8Rng::seed_from_u64(6);
        let many: Vec<f64> = (0..500)
            .map(|_| uniformity(&(0..200).map(|_| uniform(&mut generator)).collect::<Vec<f64>>(), 10))
            .collect();
        let mean = Estimate::of(&many);
        assert!((mean.mean - 9.0).abs() < 4.0 * mean.standard_error, "{mean:?}");
        assert!(many.iter().filter(|x| **x > 27.88).count() <= 4);
        assert!(uniformity(&(0..200).map(|_| 0.3 * uniform(&mut generator)).collect::<Vec<f64>>(), 10) > 100.0);
    }
}
