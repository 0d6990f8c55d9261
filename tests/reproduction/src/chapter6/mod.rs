//! The grids of section 6.5: Bayesian IRL beside Bayesian REX, as published and as we do it, and both kinds of evidence in one
//! posterior.

mod comparison;
mod evidence;
mod learn;

pub use comparison::{Comparison, Printed, run};
pub use evidence::{Ranked, Shown, World, ranked_by_return, repeated_starts};
pub use learn::Learned;

/// What the random numbers of a replicate are for.
pub mod purpose {
    /// Features of the cells and the true weights.
    pub const WORLD: u32 = 0;
    /// Demonstrations.
    pub const DEMONSTRATIONS: u32 = 1;
    /// The author's walks.
    pub const WALK: u32 = 2;
    /// Our chains.
    pub const CHAINS: u32 = 3;
}
