//! The ambiguous demonstration of figure 7.4: 3 × 5 cells, a red corridor of which the demonstration tells little.

use crate::worlds::{DOWN, GridWorld, LEFT, RIGHT};

/// White and red.
pub const N_FEATURES: usize = 2;
/// The end, bottom right.
pub const TERMINAL: usize = 14;
/// The demonstration as (state, action); it ends in [`TERMINAL`].
pub const DEMONSTRATION: [(usize, usize); 7] =
    [(1, LEFT), (0, DOWN), (5, DOWN), (10, RIGHT), (11, RIGHT), (12, RIGHT), (13, RIGHT)];
/// The weights the demonstration was made with, before their length was made 1.
pub const WEIGHTS: [f64; N_FEATURES] = [-0.1, -0.9];
/// 1 where a cell is red.
const CELLS: [usize; 15] = [
    0, 0, 0, 0, 0, //
    0, 1, 1, 1, 1, //
    0, 0, 0, 0, 0,
];

/// The grid: deterministic moves, every cell a start, γ = 0.99 as the author's program has it (the text says 0.95).
pub fn world() -> GridWorld {
    GridWorld { terminals: vec![TERMINAL], gamma: 0.99, ..GridWorld::one_hot(3, 5, &CELLS, N_FEATURES) }
}
