//! The navigation tasks of chapter 4: random worlds, demonstrations, the author's walk and our posterior on them.

mod best;
mod bounds;
mod claims;
mod demonstrations;
mod judged;
mod least_risk;
mod printed_projection;
mod problem;
mod published;

pub use best::{Evidence, PERFECT, Quality, believe};
pub use bounds::{ALPHAS, DELTA, accurate, printed_bound};
pub use claims::at_least_alpha;
pub use demonstrations::{Demonstration, Demonstrator, choices, demonstrate, discounted_counts};
pub use judged::{BoundKind, Judged, accuracy, error, paired_errors, without_bound};
pub use least_risk::Solved;
pub use printed_projection::last_by_printed_projection;
pub use problem::Problem;
pub use published::{Walk, keep, walk, walk_on};

/// What the random numbers of a replicate are for.
pub mod purpose {
    /// Features of the cells and the true weights.
    pub const WORLD: u32 = 0;
    /// Demonstrations.
    pub const DEMONSTRATIONS: u32 = 1;
    /// The author's walk.
    pub const WALK: u32 = 2;
    /// Our chains.
    pub const CHAINS: u32 = 3;
    /// Evaluation policies.
    pub const POLICIES: u32 = 4;
    /// A Boltzmann-rational person, and ranks among equals.
    pub const BOLTZMANN: u32 = 5;
}
