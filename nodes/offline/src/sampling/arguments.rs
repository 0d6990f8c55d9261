//! The flags that say what is sampled and how.

use clap::ValueEnum;
use posterior::{Prior, Run};

use super::walk::WalkSettings;
use crate::OfflineError;
use crate::evidence::{Evidence, flag};
use crate::files::MAX_NUMBERS;

/// Where weights lie before any evidence.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(super) enum PriorName {
    /// Uniform where the squares of the weights sum to 1
    L2Sphere,
    /// Uniform where the sizes of the weights sum to 1
    L1Sphere,
    /// Independent normal weights of mean 0 and standard deviation --prior-scale
    Gaussian,
    /// Independent Laplace weights of mean 0 and mean size --prior-scale
    Laplace,
}

/// How the posterior is sampled.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(super) enum Sampler {
    /// Hamiltonian Monte Carlo
    Hmc,
    /// The dissertation's walk on the L1 sphere (chapter 4), as a reference
    L1Walk,
    /// The dissertation's walk on the L2 sphere (chapter 6), as a reference
    L2Walk,
}

/// Prior, sampler and size of a run.
#[derive(Debug, Clone, clap::Args)]
pub struct SamplingArguments {
    /// Prior of the weights [default: l2-sphere, or the sphere of the walk]
    #[arg(long, value_name = "PRIOR", help_heading = "Prior")]
    pub(super) prior: Option<PriorName>,
    /// Standard deviation of a Gaussian prior, mean size of a Laplace one [default: 1]
    #[arg(long, value_name = "SCALE", help_heading = "Prior")]
    pub(super) prior_scale: Option<f64>,
    /// Row of --features whose return is known not to be negative: that of the worst demonstration
    #[arg(long, value_name = "ROW", requires = "features", help_heading = "Prior")]
    pub(super) nonnegative_return: Option<usize>,

    /// How to sample
    #[arg(long, value_name = "SAMPLER", default_value = "hmc", help_heading = "Sampling")]
    pub(super) sampler: Sampler,
    /// Draws in all, a multiple of --chains
    #[arg(long, value_name = "N", default_value_t = 4000, help_heading = "Sampling")]
    pub(super) draws: usize,
    /// Chains
    #[arg(long, value_name = "M", default_value_t = 4, help_heading = "Sampling")]
    pub(super) chains: usize,
    /// Iterations of a chain that find step size and scale and are not kept (hmc)
    #[arg(long, value_name = "N", default_value_t = 400, help_heading = "Sampling")]
    pub(super) warmup: usize,
    /// Where the random numbers come from: same seed, same draws
    #[arg(long, value_name = "SEED", default_value_t = 0, help_heading = "Sampling")]
    pub(super) seed: u64,
    /// Threads; the draws do not depend on it [default: as many as the machine has]
    #[arg(long, value_name = "N", help_heading = "Sampling")]
    pub(super) threads: Option<usize>,
    /// Length of a step along each pair of weights (l1-walk) [default: 0.01]
    #[arg(long, value_name = "LENGTH", help_heading = "Sampling")]
    pub(super) step: Option<f64>,
    /// Standard deviation of a step of each weight (l2-walk) [default: 0.005]
    #[arg(long, value_name = "SIGMA", help_heading = "Sampling")]
    pub(super) sigma: Option<f64>,
    /// Steps of a chain before the first draw (walks) [default: 100 of l1-walk, 5000 of l2-walk]
    #[arg(long, value_name = "N", help_heading = "Sampling")]
    pub(super) burn_in: Option<usize>,
    /// Steps from one draw to the next (walks) [default: 20]
    #[arg(long, value_name = "N", help_heading = "Sampling")]
    pub(super) every: Option<usize>,
}

/// More steps of all walks together are refused.
const MAX_STEPS: usize = 1 << 33;

impl SamplingArguments {
    /// Where the random numbers come from.
    pub fn seed(&self) -> u64 {
        self.seed
    }

    /// The size of the run, checked.
    pub(super) fn run(&self, n_features: usize) -> Result<Run, OfflineError> {
        let threads = self.threads.unwrap_or_else(available_threads);
        let run = Run { n_draws: self.draws, n_chains: self.chains, warmup: self.warmup, threads };
        run.check().map_err(posterior::PosteriorError::from)?;
        if self.draws.saturating_mul(n_features) > MAX_NUMBERS {
            let problem = format!(
                "got {}, expected at most {}: {n_features} weights of each are kept, {MAX_NUMBERS} numbers in all",
                self.draws,
                MAX_NUMBERS / n_features
            );
            return Err(flag("--draws", problem));
        }
        Ok(run)
    }

    /// The prior, checked against the sampler.
    pub(super) fn prior(&self) -> Result<Prior, OfflineError> {
        let of_sampler = match self.sampler {
            Sampler::Hmc => None,
            Sampler::L1Walk => Some(PriorName::L1Sphere),
            Sampler::L2Walk => Some(PriorName::L2Sphere),
        };
        if let (Some(prior), Some(wanted)) = (self.prior, of_sampler)
            && prior != wanted
        {
            let problem = format!("got {}, expected {}: the walk stays on it", word(prior), word(wanted));
            return Err(flag("--prior", problem));
        }
        let prior = self.prior.or(of_sampler).unwrap_or(PriorName::L2Sphere);
        let scale = self.prior_scale.unwrap_or(1.0);
        match prior {
            PriorName::L1Sphere | PriorName::L2Sphere if self.prior_scale.is_some() => {
                let problem = format!("got {scale}, expected none: a sphere has no scale; see --prior");
                Err(flag("--prior-scale", problem))
            }
            PriorName::L1Sphere => Ok(Prior::L1Sphere),
            PriorName::L2Sphere => Ok(Prior::L2Sphere),
            PriorName::Gaussian => Ok(Prior::Gaussian { scale }),
            PriorName::Laplace => Ok(Prior::Laplace { scale }),
        }
    }

    /// Features of the trajectory whose return is known not to be negative.
    pub(super) fn known_return(&self, evidence: &Evidence) -> Result<Option<Vec<f64>>, OfflineError> {
        let Some(row) = self.nonnegative_return else { return Ok(None) };
        match evidence.item(row) {
            Some(features) => Ok(Some(features.to_vec())),
            None => {
                let problem = format!("got {row}, expected a row of the features: 0 to {}", evidence.n_items() - 1);
                Err(flag("--nonnegative-return", problem))
            }
        }
    }

    /// The walk to take; `None` for Hamiltonian Monte Carlo.
    pub(super) fn walk(&self, reproduce: bool) -> Result<Option<WalkSettings>, OfflineError> {
        let only = |given: bool, name: &str, sampler: &str| match given {
            true => Err(flag(name, format!("expected none: it belongs to --sampler {sampler}"))),
            false => Ok(()),
        };
        if self.sampler != Sampler::L1Walk {
            only(self.step.is_some(), "--step", "l1-walk")?;
        }
        if self.sampler != Sampler::L2Walk {
            only(self.sigma.is_some(), "--sigma", "l2-walk")?;
        }
        let (size, name, burn_in) = match self.sampler {
            Sampler::Hmc => {
                only(self.burn_in.is_some(), "--burn-in", "l1-walk or l2-walk")?;
                only(self.every.is_some(), "--every", "l1-walk or l2-walk")?;
                return Ok(None);
            }
            Sampler::L1Walk => (self.step.unwrap_or(0.01), "--step", 100),
            Sampler::L2Walk => (self.sigma.unwrap_or(0.005), "--sigma", 5000),
        };
        if !(size > 0.0 && size <= 4.0) {
            return Err(flag(name, format!("got {size}, expected a number above 0 and at most 4")));
        }
        let (burn_in, every) = (self.burn_in.unwrap_or(burn_in), self.every.unwrap_or(20));
        let steps = every.checked_mul(self.draws).and_then(|n| burn_in.checked_mul(self.chains)?.checked_add(n));
        if every == 0 || steps.is_none_or(|steps| steps > MAX_STEPS) {
            let problem = format!("got {every}, expected at least 1, and {MAX_STEPS} steps of all chains at most");
            return Err(flag("--every", problem));
        }
        let along_pairs = self.sampler == Sampler::L1Walk;
        Ok(Some(WalkSettings { along_pairs, size, burn_in, every, start_equal: reproduce && along_pairs }))
    }
}

impl SamplingArguments {
    /// Name of the sampler.
    pub(crate) fn sampler_name(&self) -> String {
        word(self.sampler)
    }
}

/// Threads of this machine, within what a run takes.
pub(crate) fn available_threads() -> usize {
    std::thread::available_parallelism().map_or(1, usize::from).min(*posterior::THREADS_RANGE.end())
}

fn word(value: impl ValueEnum) -> String {
    value.to_possible_value().map_or_else(String::new, |value| value.get_name().to_owned())
}
