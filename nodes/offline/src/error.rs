//! What can go wrong with a command, and which exit code tells of it.

use std::io;

use diagnostics::WeightsError;
use likelihood::actions::ActionError;
use likelihood::preferences::PreferenceError;
use mdp::MdpError;
use picture::PictureError;
use posterior::{ModelError, PosteriorError};
use risk::RiskError;
use robust::RobustError;

/// Why a command gives no answer. "No bound" and "not mixed" are answers.
#[derive(Debug, thiserror::Error)]
pub enum OfflineError {
    /// A file that is missing, or may not be read.
    #[error("{file}: cannot be read: {source}")]
    Unreadable {
        /// Its name.
        file: String,
        /// What the system says.
        source: io::Error,
    },
    /// A directory where a file is expected.
    #[error("{file}: is a directory, expected a file")]
    Directory {
        /// Its name.
        file: String,
    },
    /// Bytes that are no text.
    #[error("{file}, line {line}: holds {got}, expected UTF-8 text")]
    NotText {
        /// Name of the file.
        file: String,
        /// From 1.
        line: u64,
        /// What it holds.
        got: &'static str,
    },
    /// A line longer than any that these formats need.
    #[error("{file}, line {line}: is longer than {} bytes", crate::files::MAX_LINE_BYTES)]
    LongLine {
        /// Name of the file.
        file: String,
        /// From 1.
        line: u64,
    },
    /// A file larger than supported.
    #[error("{file}: is larger than {most} bytes")]
    LargeFile {
        /// Name of the file.
        file: String,
        /// Most bytes.
        most: u64,
    },
    /// More rows, columns or numbers than supported.
    #[error("{file}: holds {got} {what}, but at most {most} are supported")]
    TooMany {
        /// Name of the file.
        file: String,
        /// Of what.
        what: &'static str,
        /// How many, or more.
        got: usize,
        /// Most of them.
        most: usize,
    },
    /// A file without content.
    #[error("{file}: holds nothing, expected {expected}")]
    Empty {
        /// Name of the file.
        file: String,
        /// What it should hold.
        expected: String,
    },
    /// A field that holds something else.
    #[error("{file}, line {line}, column {column} ({name}): got '{got}', expected {expected}")]
    Field {
        /// Name of the file.
        file: String,
        /// From 1.
        line: u64,
        /// From 1.
        column: usize,
        /// What the column holds.
        name: String,
        /// The field.
        got: String,
        /// What it should be.
        expected: String,
    },
    /// A line of too few or too many fields.
    #[error("{file}, line {line}: got {got} {}, expected {expected} ({why})", if *got == 1 { "field" } else { "fields" })]
    FieldCount {
        /// Name of the file.
        file: String,
        /// From 1.
        line: u64,
        /// Fields of the line.
        got: usize,
        /// How many it should have.
        expected: String,
        /// Why so many.
        why: String,
    },
    /// A header line that does not name the columns.
    #[error(
        "{file}, line {line}: got the column '{got}'; a header line names each column once, the first {n_required} of these \
         at least: {expected}"
    )]
    Header {
        /// Name of the file.
        file: String,
        /// From 1.
        line: u64,
        /// The column, or the whole line.
        got: String,
        /// Columns there may be.
        expected: String,
        /// How many of them there must be.
        n_required: usize,
    },
    /// A decision process or policy that is none.
    #[error("{file}: {error}")]
    Mdp {
        /// Name of the file.
        file: String,
        /// What is wrong.
        error: MdpError,
    },
    /// Files that are about different numbers of weights.
    #[error("{file}: has {got} {what}, but {other} has {expected}")]
    Widths {
        /// Name of the file.
        file: String,
        /// Of what.
        what: &'static str,
        /// How many.
        got: usize,
        /// What it must agree with.
        other: String,
        /// How many that has.
        expected: usize,
    },
    /// Flags that need or exclude each other, or a value out of range.
    #[error("{flag}: {problem}")]
    Flag {
        /// The flag.
        flag: String,
        /// What is wrong with it, with got and expected.
        problem: String,
    },
    /// Preferences without a likelihood.
    #[error("preferences: {0}")]
    Preferences(#[from] PreferenceError),
    /// Actions without a likelihood.
    #[error("actions: {0}")]
    Actions(#[from] ActionError),
    /// Evidence, prior and settings that do not fit together.
    #[error(transparent)]
    Model(#[from] ModelError),
    /// The same, found when drawing.
    #[error(transparent)]
    Posterior(#[from] PosteriorError),
    /// Losses that cannot be judged.
    #[error(transparent)]
    Risk(#[from] RiskError),
    /// Importance weights that say nothing.
    #[error(transparent)]
    Weights(#[from] WeightsError),
    /// A problem that cannot be optimised.
    #[error(transparent)]
    Robust(#[from] RobustError),
    /// A picture that cannot be drawn.
    #[error("{file}: {error}")]
    Picture {
        /// Name of the file it was to be.
        file: String,
        /// Why not.
        error: PictureError,
    },
    /// A file that cannot be written.
    #[error("{file}: cannot be written: {source}")]
    Unwritable {
        /// Its name.
        file: String,
        /// What the system says.
        source: io::Error,
    },
    /// Standard output that cannot be written.
    #[error("standard output cannot be written: {0}")]
    Output(io::Error),
    /// A signal to end.
    #[error("interrupted; no file was written")]
    Interrupted,
}

impl OfflineError {
    /// 2 for bad input, 1 for a failure, 130 for an interrupt as shells have it.
    pub fn exit_code(&self) -> u8 {
        match self {
            Self::Unwritable { .. } | Self::Output(_) => 1,
            Self::Interrupted => 130,
            _ => 2,
        }
    }
}
