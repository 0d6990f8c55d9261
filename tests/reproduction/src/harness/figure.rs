//! A figure or table with a command of its own, and one that has been made.

use super::{Options, Outcome, ReproductionError, Summary, seconds};

/// A figure or table of the dissertation.
#[derive(Debug, Clone, Copy)]
pub struct Figure {
    /// Its command, `fig-4.2` …, and the name that its outcome has.
    pub name: &'static str,
    /// What the command shows, in a few words.
    pub about: &'static str,
    /// Makes it.
    pub run: fn(&Options) -> Result<Outcome, ReproductionError>,
}

/// A figure that has been made, with what it took.
#[derive(Debug)]
pub struct Made {
    /// What came out.
    pub outcome: Outcome,
    /// The same in short, with what it took.
    pub summary: Summary,
}

impl Figure {
    /// Makes it and takes the time.
    ///
    /// # Errors
    /// What keeps it from being made.
    pub fn make(&self, options: &Options) -> Result<Made, ReproductionError> {
        let (wall, cpu) = (seconds::on_the_wall(), seconds::of_cpu());
        let outcome = (self.run)(options)?;
        let summary = Summary {
            name: outcome.name.into(),
            title: outcome.title.into(),
            seed: outcome.seed,
            replicates: outcome.replicates,
            full: options.replicates.is_none(),
            wall_seconds: (seconds::on_the_wall() - wall).round(),
            cpu_seconds: (seconds::of_cpu() - cpu).round(),
            threads: options.threads,
            notes: outcome.notes.clone(),
            tables: outcome.tables.clone(),
            claims: outcome.claims.clone(),
        };
        Ok(Made { outcome, summary })
    }
}

impl Made {
    /// Prints it, and writes the files asked for.
    ///
    /// # Errors
    /// A file that cannot be written.
    pub fn deliver(&self, options: &Options) -> Result<(), ReproductionError> {
        self.summary.print();
        if let Some(path) = &options.json {
            self.summary.write_with(&self.outcome.data, path)?;
        }
        if let Some(path) = &options.svg {
            self.outcome.picture.write(path)?;
        }
        Ok(())
    }
}
