//! Why a figure cannot be made.

use crate::lesson::LessonError;
use likelihood::actions::ActionError;
use likelihood::preferences::PreferenceError;
use mdp::MdpError;
use posterior::PosteriorError;
use risk::RiskError;
use thiserror::Error;

/// Why a figure cannot be made.
#[derive(Debug, Error)]
pub enum ReproductionError {
    /// A world or policy that is none.
    #[error(transparent)]
    Mdp(#[from] MdpError),
    /// Demonstrated actions that do not fit.
    #[error(transparent)]
    Actions(#[from] ActionError),
    /// Preferences that do not fit.
    #[error(transparent)]
    Preferences(#[from] PreferenceError),
    /// No posterior.
    #[error(transparent)]
    Posterior(#[from] PosteriorError),
    /// Losses that cannot be judged.
    #[error(transparent)]
    Risk(#[from] RiskError),
    /// A lesson of the table task that cannot be held.
    #[error(transparent)]
    Lesson(#[from] LessonError),
    /// A file that cannot be written.
    #[error("{path}: {message}")]
    File {
        /// Which.
        path: String,
        /// What went wrong.
        message: String,
    },
    /// Too few replicates for any statistic.
    #[error("{got} replicates, but a standard error needs at least 2")]
    Replicates {
        /// Asked for.
        got: usize,
    },
}
