//! What comes out of a figure.

use super::plot::Picture;
use super::{Claim, TextTable};
use serde::Serialize;
use serde_json::Value;

/// What comes out of a figure.
#[derive(Debug)]
pub struct Outcome {
    /// `fig-4.2` …
    pub name: &'static str,
    /// What it shows.
    pub title: &'static str,
    /// Replicates.
    pub replicates: usize,
    /// Seed.
    pub seed: u64,
    /// What must be known to read it.
    pub notes: Vec<String>,
    /// Tables; the first is the one for the report.
    pub tables: Vec<TextTable>,
    /// What is claimed and whether it holds.
    pub claims: Vec<Claim>,
    /// The picture.
    pub picture: Picture,
    /// All numbers of every replicate.
    pub data: Value,
}

/// Numbers as JSON.
pub fn to_value(data: &impl Serialize) -> Value {
    serde_json::to_value(data).expect("plain numbers and names always serialise")
}
