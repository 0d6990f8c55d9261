//! The posterior of reward weights given evidence of all kinds: priors, samplers, the most probable weights.

mod collapsed_density;
mod density;
mod draws;
mod evaluator;
mod evidence;
mod full_density;
mod hmc;
mod linear;
mod map;
mod model;
mod most_likely;
mod placement_term;
mod prior;
mod random;
mod reweight;
mod sampler;
mod settings;
mod table;
pub mod walks;
mod warmup;

pub use draws::{BetaDraws, Draws, Warm};
pub use evidence::evidence_hash;
pub use likelihood::placements::{
    Confidence, Demonstration, EvidenceError, GRID_SIDE_RANGE, Lesson, MAX_DEMONSTRATIONS,
};
pub use model::{EvidenceKind, MAX_FEATURES, Model, ModelError, ModelEvaluator, Rationality, Term, TermLikelihood};
pub use placement_term::PlacementTerm;
pub use reweight::log_weights;
pub use sampler::{draw, draw_from, draw_unless};
pub use settings::{
    BETA_RANGE, CHAINS_RANGE, DRAWS_PER_CHAIN_RANGE, FACTOR_RANGE, Prior, Run, Settings, SettingsError, THREADS_RANGE,
    WARMUP_RANGE,
};
pub use table::{PosteriorError, sample};
