//! The grids of section 6.5: 6 × 6 cells, 4 binary features of which one is active per cell, deterministic moves, no
//! terminals, every cell a start.

use rand_chacha::ChaCha8Rng;

use crate::worlds::GridWorld;

/// Features.
pub const N_FEATURES: usize = 4;
/// Cells along a side.
pub const SIDE: usize = 6;

/// A world with a feature drawn for every cell.
pub fn random(rng: &mut ChaCha8Rng) -> GridWorld {
    GridWorld::random(SIDE, SIDE, N_FEATURES, rng)
}
