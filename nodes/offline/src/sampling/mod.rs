//! From evidence to draws of its posterior.

mod arguments;
mod summary;
mod walk;

pub(crate) use arguments::{SamplingArguments, available_threads};
pub(crate) use summary::{Parameter, Summary, summaries};

use posterior::{Draws, Model, Prior, draw};

use crate::OfflineError;
use crate::evidence::Evidence;

/// Draws with all that was decided about them.
#[derive(Debug, Clone)]
pub(crate) struct Sample {
    pub(crate) draws: Draws,
    pub(crate) prior: Prior,
    pub(crate) evidence_hash: [u8; 32],
    pub(crate) threads: usize,
    /// Log-likelihood of weights that are all zero: of answers given at random.
    pub(crate) indifferent: f64,
}

/// Samples the posterior.
///
/// # Errors
/// Settings out of range or that do not fit together, a model without a posterior.
pub(crate) fn sample(
    evidence: &Evidence,
    arguments: &SamplingArguments,
    reproduce: bool,
) -> Result<Sample, OfflineError> {
    let prior = arguments.prior()?;
    let run = arguments.run(evidence.n_features)?;
    let model = Model {
        n_features: evidence.n_features,
        prior,
        nonnegative_return: arguments.known_return(evidence)?,
        terms: evidence.terms()?,
    };
    let evidence_hash = evidence.hash();
    let draws = match arguments.walk(reproduce)? {
        None => draw(&model, &run, arguments.seed, &evidence_hash)?,
        Some(settings) => walk::walk(&model, &run, &settings, arguments.seed, &evidence_hash)?,
    };
    let indifferent = model.log_likelihood(&vec![0.0; model.n_features], &draws.map_betas);
    Ok(Sample { draws, prior, evidence_hash, threads: run.threads, indifferent })
}
