//! What is asked for on the command line, the same for every figure.

use super::ReproductionError;
use clap::Parser;
use std::path::PathBuf;

/// How to run a figure.
#[derive(Debug, Clone, Parser)]
pub struct Options {
    /// Independent repetitions; by default as many as the dissertation has
    #[arg(long)]
    pub replicates: Option<usize>,
    /// Seed; every replicate derives its own from it
    #[arg(long, default_value_t = 1)]
    pub seed: u64,
    /// Threads; the numbers do not depend on it
    #[arg(long, default_value_t = std::thread::available_parallelism().map_or(1, usize::from))]
    pub threads: usize,
    /// Everything, with the numbers of every replicate, as JSON
    #[arg(long)]
    pub json: Option<PathBuf>,
    /// The figure as SVG
    #[arg(long)]
    pub svg: Option<PathBuf>,
}

impl Options {
    /// Replicates to run: as asked for, or as many as the dissertation has.
    pub fn count(&self, of_the_dissertation: usize) -> Result<usize, ReproductionError> {
        match self.replicates.unwrap_or(of_the_dissertation) {
            got @ (0 | 1) => Err(ReproductionError::Replicates { got }),
            n => Ok(n),
        }
    }
}
