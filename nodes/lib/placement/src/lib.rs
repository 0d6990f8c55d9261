//! Where to put the target, how wrong that may be, and how an arm gets it there.
//!
//! Everything here is a function of its arguments: no clock, files or global generator, and the same bits for any number
//! of threads. Names that end in `_m` are metres in the table's frame, others normalised coordinates.

mod climb;
mod hill;
mod losses;
mod region;
mod tabulated;
mod tail;

pub use losses::{LossBatch, SceneLosses, placement_losses, placement_optima};
pub use tail::cvar;
