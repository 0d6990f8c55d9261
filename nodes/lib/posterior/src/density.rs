//! The coordinates in which a posterior is sampled, and its log density there.

use rand_chacha::ChaCha8Rng;

use crate::draws::Kept;

/// A log density on all of Rⁿ with its prior in it, as one chain evaluates it.
pub(crate) trait Density: Send {
    /// Number n of coordinates.
    fn n(&self) -> usize;

    /// A draw from the prior.
    fn start(&mut self, generator: &mut ChaCha8Rng) -> Vec<f64>;

    /// A log density near the exact one, or that itself, and its gradient. −∞ where the density is zero.
    fn force(&mut self, z: &[f64], gradient: &mut [f64]) -> Point;

    /// The log density.
    fn exact(&mut self, z: &[f64]) -> Point;

    /// Whether [`Density::force`] gives the density itself.
    fn force_is_exact(&self) -> bool;

    /// The normal n of a plane through the origin beyond which, where n·z < 0, the density is zero.
    fn wall(&self) -> Option<&[f64]>;

    /// Adds the draw at z, whose log-likelihood is known, to what is kept.
    fn keep(&mut self, z: &[f64], log_likelihood: f64, generator: &mut ChaCha8Rng, kept: &mut Kept);
}

/// A density at one place.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Point {
    /// Log density up to a constant.
    pub(crate) log_density: f64,
    /// The log-likelihood in it.
    pub(crate) log_likelihood: f64,
}
