//! Grids after figure G.1: nearly all cells have no feature, one cell is worth reaching, and walls of different colours,
//! each a feature of its own and none worth entering, stand in the way of a few starts.
//!
//! The dissertation shows one such grid without its numbers; these are drawn: 8 × 8 cells, 5 walls of 2 to 4 cells in a
//! row or column, 3 starts from which the goal can be reached round the walls.

use rand_chacha::ChaCha8Rng;

use crate::random::{exponential, index, uniform};
use crate::worlds::GridWorld;

/// Cells along a side.
pub const SIDE: usize = 8;
/// Walls.
pub const N_WALLS: usize = 5;
/// The goal, then each wall.
pub const N_FEATURES: usize = 1 + N_WALLS;
/// Starts.
pub const N_STARTS: usize = 3;

/// A grid, and weights on the L1 sphere: positive for the goal, negative for every wall. Deterministic moves, γ = 0.9, no
/// terminals. Let every cell be a start for the harder task of appendix G.
pub fn random(rng: &mut ChaCha8Rng) -> (GridWorld, Vec<f64>) {
    let (cells, mut free) = loop {
        let cells = walls_and_goal(rng);
        let free = around_goal(&cells);
        if free.len() >= N_STARTS {
            break (cells, free);
        }
    };
    let starts = (0..N_STARTS).map(|_| free.swap_remove(index(free.len(), rng))).collect();
    let mut features = vec![0.0; cells.len() * N_FEATURES];
    for (row, feature) in features.chunks_mut(N_FEATURES).zip(cells) {
        if let Some(feature) = feature {
            row[feature] = 1.0;
        }
    }
    let mut weights: Vec<f64> = (0..N_FEATURES).map(|_| exponential(rng)).collect();
    let norm: f64 = weights.iter().sum();
    weights.iter_mut().enumerate().for_each(|(feature, w)| *w *= if feature == 0 { 1.0 } else { -1.0 } / norm);
    let grid = GridWorld {
        rows: SIDE,
        columns: SIDE,
        n_features: N_FEATURES,
        features,
        slip: 0.0,
        gamma: 0.9,
        starts,
        terminals: vec![],
    };
    (grid, weights)
}

/// The feature of each cell.
fn walls_and_goal(rng: &mut ChaCha8Rng) -> [Option<usize>; SIDE * SIDE] {
    let mut cells = [None; SIDE * SIDE];
    cells[index(cells.len(), rng)] = Some(0);
    for wall in 1..=N_WALLS {
        let length = 2 + index(3, rng);
        let (across, along) = (index(SIDE, rng), index(SIDE - length + 1, rng));
        let step = if uniform(rng) < 0.5 { 1 } else { SIDE };
        let first = if step == 1 { across * SIDE + along } else { along * SIDE + across };
        // Where walls cross the first stays; the goal stays as well.
        for cell in (0..length).map(|i| first + i * step) {
            cells[cell].get_or_insert(wall);
        }
    }
    cells
}

/// Cells without a feature from which no wall bars the way to the goal.
fn around_goal(cells: &[Option<usize>]) -> Vec<usize> {
    let mut reached: Vec<bool> = cells.iter().map(|cell| *cell == Some(0)).collect();
    let mut queue: Vec<usize> = (0..cells.len()).filter(|&cell| reached[cell]).collect();
    let mut found = Vec::new();
    while let Some(cell) = queue.pop() {
        let (row, column) = (cell / SIDE, cell % SIDE);
        let next = [
            (row > 0).then(|| cell - SIDE),
            (row + 1 < SIDE).then_some(cell + SIDE),
            (column > 0).then(|| cell - 1),
            (column + 1 < SIDE).then_some(cell + 1),
        ];
        for cell in next.into_iter().flatten() {
            if !reached[cell] && cells[cell].is_none() {
                reached[cell] = true;
                found.push(cell);
                queue.push(cell);
            }
        }
    }
    found
}
