//! What every figure shares: replicates in parallel, statistics, claims, tables and plots.

mod claim;
mod error;
mod options;
mod outcome;
pub mod plot;
mod replicates;
mod seeds;
mod statistics;
mod text_table;

pub use claim::Claim;
pub use error::ReproductionError;
pub use options::Options;
pub use outcome::{Outcome, to_value};
pub use replicates::replicates;
pub use seeds::generator;
pub use statistics::{Estimate, bootstrap_interval, least_successes, sum_in_order, uniformity};
pub use text_table::TextTable;
