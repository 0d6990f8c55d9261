//! Solutions of (I − γP) x = b: banded LU factors where the band is narrow enough, else sweeps with a bound on their error.

mod banded;
mod chain;
mod conjugate;
mod order;
mod sweeps;

pub(crate) use banded::Banded;
pub(crate) use chain::Chain;
pub(crate) use order::{Order, narrow_order};
pub(crate) use sweeps::{Sweeps, precision};

/// xᵀy, summed in four lanes, which vector instructions add.
pub(crate) fn dot(x: &[f64], y: &[f64]) -> f64 {
    let (x_blocks, y_blocks) = (x.chunks_exact(4), y.chunks_exact(4));
    let rest: f64 = x_blocks.remainder().iter().zip(y_blocks.remainder()).map(|(x, y)| x * y).sum();
    let mut lanes = [0.0; 4];
    for (x, y) in x_blocks.zip(y_blocks) {
        for ((lane, x), y) in lanes.iter_mut().zip(x).zip(y) {
            *lane += x * y;
        }
    }
    (lanes[0] + lanes[1]) + (lanes[2] + lanes[3]) + rest
}
