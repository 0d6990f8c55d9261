//! The commands, a file each.

pub mod bound;
pub mod evaluate;
pub mod infer;
mod infer_report;
pub mod likelihood;
pub mod optimize;
