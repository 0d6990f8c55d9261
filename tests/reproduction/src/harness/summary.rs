//! A finished figure in short: what is printed, kept as JSON and put into the report.

use super::{Claim, ReproductionError, TextTable};
use serde::{Deserialize, Serialize};
use serde_json::{Value, json};
use std::path::Path;

/// A finished figure without the numbers of its replicates.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Summary {
    /// `fig-4.2` …
    pub name: String,
    /// What it shows.
    pub title: String,
    /// Seed.
    pub seed: u64,
    /// Replicates.
    pub replicates: usize,
    /// Whether these are as many as the dissertation has.
    pub full: bool,
    /// Seconds on the wall, rounded.
    pub wall_seconds: f64,
    /// CPU seconds of all threads, rounded.
    pub cpu_seconds: f64,
    /// Threads.
    pub threads: usize,
    /// What must be known to read it.
    pub notes: Vec<String>,
    /// Tables.
    pub tables: Vec<TextTable>,
    /// What is claimed and whether it holds.
    pub claims: Vec<Claim>,
}

impl Summary {
    /// Reads one that [`Self::write`] wrote; `None` where there is none.
    ///
    /// # Errors
    /// A file that cannot be read, or is no summary.
    pub fn read(path: &Path) -> Result<Option<Self>, ReproductionError> {
        let fail = |message: String| ReproductionError::File { path: path.display().to_string(), message };
        match std::fs::read(path) {
            Ok(bytes) => serde_json::from_slice(&bytes)
                .map(Some)
                .map_err(|error| fail(format!("{error}; remove the file to make the figure anew"))),
            Err(error) if error.kind() == std::io::ErrorKind::NotFound => Ok(None),
            Err(error) => Err(fail(error.to_string())),
        }
    }

    /// Writes it as JSON.
    ///
    /// # Errors
    /// A file that cannot be written.
    pub fn write(&self, path: &Path) -> Result<(), ReproductionError> {
        write_json(&json!(self), path)
    }

    /// The same with the numbers of every replicate under `data`.
    ///
    /// # Errors
    /// A file that cannot be written.
    pub fn write_with(&self, data: &Value, path: &Path) -> Result<(), ReproductionError> {
        let mut whole = json!(self);
        whole["data"] = data.clone();
        write_json(&whole, path)
    }

    /// For a terminal.
    pub fn print(&self) {
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
        println!("\n{:.0} s on {} threads, {:.0} CPU seconds", self.wall_seconds, self.threads, self.cpu_seconds);
    }
}

fn write_json(value: &Value, path: &Path) -> Result<(), ReproductionError> {
    let fail = |message: String| ReproductionError::File { path: path.display().to_string(), message };
    let mut bytes = serde_json::to_vec_pretty(value).map_err(|error| fail(error.to_string()))?;
    bytes.push(b'\n');
    std::fs::write(path, bytes).map_err(|error| fail(error.to_string()))
}
