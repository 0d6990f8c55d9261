//! The navigation tasks of section 4.5: 9 × 9 cells, 8 features of which one is active per cell, noisy moves, no terminals.

use rand_chacha::ChaCha8Rng;

use crate::random::index;
use crate::worlds::GridWorld;

/// Features.
pub const N_FEATURES: usize = 8;
/// Cells along a side.
pub const SIDE: usize = 9;
/// Where demonstrations start, in turn; the initial distribution is uniform over them.
pub const STARTS: [usize; 9] = [10, 13, 16, 37, 40, 43, 64, 67, 70];
/// Weights of the world "rep 0".
pub const REP_0_WEIGHTS: [f64; N_FEATURES] = [
    -0.129_605_425_644_401_56,
    -0.006_771_994_740_955_85,
    0.060_765_662_192_873_65,
    0.039_678_303_288_216_484,
    -0.013_279_747_249_363_004,
    0.283_726_219_114_143_3,
    -0.091_186_687_285_744_46,
    -0.374_985_960_484_301_66,
];
/// Feature of each cell of the world "rep 0".
const REP_0_CELLS: &[u8] = b"567456255712474466707421275407653570165636665221561420577017774140157611372267045";

/// The world whose exact values are known (method notes section 6).
pub fn rep_0() -> GridWorld {
    let cells: Vec<usize> = REP_0_CELLS.iter().map(|digit| usize::from(digit - b'0')).collect();
    world(&cells)
}

/// A world with a feature drawn for every cell.
pub fn random(rng: &mut ChaCha8Rng) -> GridWorld {
    let cells: Vec<usize> = (0..SIDE * SIDE).map(|_| index(N_FEATURES, rng)).collect();
    world(&cells)
}

fn world(cells: &[usize]) -> GridWorld {
    GridWorld { slip: 0.15, starts: STARTS.to_vec(), ..GridWorld::one_hot(SIDE, SIDE, cells, N_FEATURES) }
}
