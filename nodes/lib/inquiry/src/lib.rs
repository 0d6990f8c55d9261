//! What to ask next: hypothetical tables, and the choice among them by the bound on the loss (dissertation section 8.2.4).

mod candidates;
mod choice;

pub use candidates::candidates;
pub use choice::{Choice, Judged, choose};
