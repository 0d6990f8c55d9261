//! The navigation task of figure 4.6: 5 × 5 cells, white or red, two starts, and one end in the centre.

use crate::worlds::GridWorld;

/// White and red.
pub const N_FEATURES: usize = 2;
/// Starts: the left one is shown, the right one must be guessed.
pub const STARTS: [usize; 2] = [5, 4];
/// The end.
pub const TERMINAL: usize = 12;
/// The weights a demonstration is made with.
pub const WEIGHTS: [f64; N_FEATURES] = [-0.1, -0.9];
/// 1 where a cell is red.
const CELLS: [usize; 25] = [
    0, 0, 0, 1, 0, //
    0, 1, 0, 1, 0, //
    0, 1, 0, 1, 0, //
    0, 1, 0, 1, 0, //
    0, 1, 0, 0, 0,
];

/// The grid: deterministic moves, γ = 0.95.
pub fn world() -> GridWorld {
    let (starts, terminals) = (STARTS.to_vec(), vec![TERMINAL]);
    GridWorld { starts, terminals, gamma: 0.95, ..GridWorld::one_hot(5, 5, &CELLS, N_FEATURES) }
}
