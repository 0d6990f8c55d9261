//! What placement demonstrations say about the weights of a reward: likelihood, prior, sampler and diagnostics.

pub mod diagnostics;
mod normal;

pub use normal::normal_quantile;
