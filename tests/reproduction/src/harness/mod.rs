//! What every figure shares: replicates in parallel, statistics, claims, tables and plots.

mod claim;
mod error;
mod extent;
mod figure;
mod options;
mod outcome;
pub mod plot;
mod replicates;
mod seconds;
mod seeds;
mod statistics;
mod summary;
mod text_table;

pub use claim::{Claim, ClaimKind};
pub use error::ReproductionError;
pub use extent::extent;
pub use figure::Figure;
pub use options::Options;
pub use outcome::{Outcome, to_value};
pub use replicates::replicates;
pub use seeds::generator;
pub use statistics::{Estimate, bootstrap_interval, least_successes, sum_in_order, uniformity};
pub use summary::Summary;
pub use text_table::TextTable;
