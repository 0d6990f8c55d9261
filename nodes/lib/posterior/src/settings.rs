//! How the posterior is defined and how it is sampled.

use std::ops::RangeInclusive;

use likelihood::placements::GRID_SIDE_RANGE;

use crate::Rationality;

/// Where weights lie before any evidence.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Prior {
    /// Uniform on the sphere ‖w‖₁ = 1.
    L1Sphere,
    /// Uniform on the sphere ‖w‖₂ = 1.
    L2Sphere,
    /// Independent normal weights of mean 0.
    Gaussian {
        /// Their standard deviation.
        scale: f64,
    },
    /// Independent Laplace weights of mean 0: density exp(−|w|/scale)/(2 scale).
    Laplace {
        /// Their mean size.
        scale: f64,
    },
}

/// How a posterior is sampled.
#[derive(Debug, Clone, PartialEq)]
pub struct Run {
    /// Draws over all chains; a multiple of `n_chains`.
    pub n_draws: usize,
    /// Chains.
    pub n_chains: usize,
    /// Iterations per chain that are spent on finding step size and scale, and are not kept.
    pub warmup: usize,
    /// Threads to sample on. The draws do not depend on it.
    pub threads: usize,
}

impl Default for Run {
    fn default() -> Self {
        Self { n_draws: 4000, n_chains: 4, warmup: 400, threads: 2 }
    }
}

/// Settings of a posterior of placements; [`Settings::default`] is the table task.
#[derive(Debug, Clone, PartialEq)]
pub struct Settings {
    /// How sharply a person prefers better placements, in 1/reward.
    pub rationality: Rationality,
    /// Prior of the weights.
    pub prior: Prior,
    /// Draws over all chains; a multiple of `n_chains`.
    pub n_draws: usize,
    /// Chains.
    pub n_chains: usize,
    /// Iterations per chain that are spent on finding step size and scale, and are not kept.
    pub warmup: usize,
    /// Threads to sample on. The draws do not depend on it.
    pub threads: usize,
    /// Cells per axis of the grid on which the likelihood is normalised.
    pub grid_side: usize,
    /// Factor on β for a demonstration that is sure, fairly sure, a guess.
    pub confidence_factors: [f64; 3],
}

impl Default for Settings {
    fn default() -> Self {
        Self {
            rationality: Rationality::Fixed(100.0),
            prior: Prior::L1Sphere,
            n_draws: 4000,
            n_chains: 4,
            warmup: 400,
            threads: 2,
            grid_side: 64,
            confidence_factors: [1.0, 0.5, 0.2],
        }
    }
}

/// Allowed β.
pub const BETA_RANGE: RangeInclusive<f64> = 1e-3..=1e4;
/// Allowed number of chains.
pub const CHAINS_RANGE: RangeInclusive<usize> = 4..=64;
/// Allowed draws per chain.
pub const DRAWS_PER_CHAIN_RANGE: RangeInclusive<usize> = 10..=100_000;
/// Allowed warm-up iterations.
pub const WARMUP_RANGE: RangeInclusive<usize> = 100..=100_000;
/// Allowed number of threads.
pub const THREADS_RANGE: RangeInclusive<usize> = 1..=256;
/// Allowed factors of confidence.
pub const FACTOR_RANGE: RangeInclusive<f64> = 1e-3..=1.0;

/// A setting outside its range.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum SettingsError {
    /// A number outside its range.
    #[error("{name} is {got}, but must lie between {least} and {most}")]
    Range {
        /// Field of [`Settings`].
        name: &'static str,
        /// Got.
        got: f64,
        /// Smallest allowed.
        least: f64,
        /// Largest allowed.
        most: f64,
    },
    /// Chains must be equally long.
    #[error("n_draws is {n_draws}, but must be a multiple of n_chains, which is {n_chains}")]
    Uneven {
        /// Got.
        n_draws: usize,
        /// Got.
        n_chains: usize,
    },
}

impl Settings {
    /// Checks every field.
    ///
    /// # Errors
    /// The first field out of range.
    pub fn check(&self) -> Result<(), SettingsError> {
        in_range("beta", self.rationality.median(), &BETA_RANGE)?;
        self.run().check()?;
        count_in_range("grid_side", self.grid_side, &GRID_SIDE_RANGE)?;
        for factor in self.confidence_factors {
            in_range("confidence_factors", factor, &FACTOR_RANGE)?;
        }
        Ok(())
    }

    /// How to sample.
    pub fn run(&self) -> Run {
        Run { n_draws: self.n_draws, n_chains: self.n_chains, warmup: self.warmup, threads: self.threads }
    }
}

impl Run {
    /// Checks every field.
    ///
    /// # Errors
    /// The first field out of range.
    pub fn check(&self) -> Result<(), SettingsError> {
        count_in_range("n_chains", self.n_chains, &CHAINS_RANGE)?;
        if !self.n_draws.is_multiple_of(self.n_chains) {
            return Err(SettingsError::Uneven { n_draws: self.n_draws, n_chains: self.n_chains });
        }
        count_in_range("n_draws / n_chains", self.per_chain(), &DRAWS_PER_CHAIN_RANGE)?;
        count_in_range("warmup", self.warmup, &WARMUP_RANGE)?;
        count_in_range("threads", self.threads, &THREADS_RANGE)
    }

    /// Draws per chain.
    pub fn per_chain(&self) -> usize {
        self.n_draws / self.n_chains
    }
}

fn in_range(name: &'static str, got: f64, range: &RangeInclusive<f64>) -> Result<(), SettingsError> {
    if range.contains(&got) {
        return Ok(());
    }
    Err(SettingsError::Range { name, got, least: *range.start(), most: *range.end() })
}

fn count_in_range(name: &'static str, got: usize, range: &RangeInclusive<usize>) -> Result<(), SettingsError> {
    in_range(name, got as f64, &(*range.start() as f64..=*range.end() as f64))
}

#[cfg(test)]
mod tests {
    use super::{Settings, SettingsError};
    use crate::Rationality;

    #[test]
    fn names_the_field_and_its_range() {
        assert_eq!(Settings::default().check(), Ok(()));
        let error =
            Settings { rationality: Rationality::Fixed(0.0), ..Settings::default() }.check().expect_err("refused");
        assert_eq!(error.to_string(), "beta is 0, but must lie between 0.001 and 10000");
        let refused = |settings: Settings| settings.check().is_err();
        assert!(refused(Settings { rationality: Rationality::Fixed(f64::NAN), ..Settings::default() }));
        assert!(refused(Settings { n_chains: 3, n_draws: 300, ..Settings::default() }));
        assert!(refused(Settings { grid_side: 1000, ..Settings::default() }));
        assert!(refused(Settings { n_draws: usize::MAX - 3, ..Settings::default() }));
        assert!(refused(Settings { confidence_factors: [1.0, 0.5, 0.0], ..Settings::default() }));
        assert_eq!(
            Settings { n_draws: 4001, ..Settings::default() }.check(),
            Err(SettingsError::Uneven { n_draws: 4001, n_chains: 4 })
        );
    }
}
