//! What placement demonstrations say about the weights of a reward: likelihood, prior, sampler and diagnostics.

mod demonstration;
pub mod diagnostics;
mod draws;
mod evidence;
mod hmc;
mod likelihood;
mod linear;
mod most_likely;
mod normal;
mod sampler;
mod settings;
mod sphere;
mod warmup;

pub use demonstration::{Confidence, Demonstration, EvidenceError, Lesson, MAX_DEMONSTRATIONS};
pub use draws::Draws;
pub use evidence::evidence_hash;
pub use likelihood::{Likelihood, Placement};
pub use normal::normal_quantile;
pub use sampler::{PosteriorError, sample};
pub use settings::{
    BETA_RANGE, CHAINS_RANGE, DRAWS_PER_CHAIN_RANGE, FACTOR_RANGE, GRID_SIDE_RANGE, Prior, Settings, SettingsError,
    THREADS_RANGE, WARMUP_RANGE,
};
