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
