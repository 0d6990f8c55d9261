//! A finished figure: what is printed, drawn and written.

use super::plot::Picture;
use super::{Claim, Options, ReproductionError, TextTable};
use serde::Serialize;
use serde_json::{Value, json};
use std::path::Path;

/// A finished figure.
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

impl Outcome {
    /// Prints it, and writes the files asked for.
    pub fn deliver(&self, options: &Options) -> Result<(), ReproductionError> {
        println!("{}: {} ({} replicates, seed {})", self.name, self.title, self.replicates, self.seed);
        for table in &self.tables {
            println!("\n{}", table.text());
        }
        println!("\nClaims");
        for claim in &self.claims {
            println!("  {}", claim.line());
        }
        if !self.notes.is_empty() {
            println!("\nNotes");
            for note in &self.notes {
                println!("  {note}");
            }
        }
        if let Some(path) = &options.json {
            self.write_json(path)?;
        }
        if let Some(path) = &options.svg {
            self.picture.write(path)?;
        }
        Ok(())
    }

    fn write_json(&self, path: &Path) -> Result<(), ReproductionError> {
        let whole = json!({
            "name": self.name,
            "title": self.title,
            "replicates": self.replicates,
            "seed": self.seed,
            "notes": self.notes,
            "tables": self.tables,
            "claims": self.claims,
            "data": self.data,
        });
        let fail = |message: String| ReproductionError::File { path: path.display().to_string(), message };
        let bytes = serde_json::to_vec_pretty(&whole).map_err(|error| fail(error.to_string()))?;
        std::fs::write(path, bytes).map_err(|error| fail(error.to_string()))
    }
}

/// Numbers as JSON.
pub fn to_value(data: &impl Serialize) -> Value {
    serde_json::to_value(data).expect("plain numbers and names always serialise")
}
