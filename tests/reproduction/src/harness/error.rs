//! Why a figure cannot be made.

#[cfg(feature = "lessons")]
use crate::lesson::LessonError;
use inquiry::InquiryError;
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
    /// Questions that cannot be judged.
    #[error(transparent)]
    Inquiry(#[from] InquiryError),
    /// Losses that cannot be judged.
    #[error(transparent)]
    Risk(#[from] RiskError),
    /// Robust policies that cannot be asked for.
    #[error(transparent)]
    Robust(#[from] robust::RobustError),
    /// A picture that cannot be drawn.
    #[error(transparent)]
    Picture(#[from] picture::PictureError),
    /// A lesson of the table task that cannot be held.
    #[cfg(feature = "lessons")]
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
    /// A figure that there is not.
    #[error("there is no figure {name}; `reproduction --help` lists them")]
    UnknownFigure {
        /// As asked for.
        name: String,
    },
    /// Figures that could not be made, each with a line of its own before.
    #[error("could not be made: {names}")]
    Failed {
        /// Which.
        names: String,
    },
    /// Too few replicates for any statistic.
    #[error("{got} replicates, but a standard error needs at least 2")]
    Replicates {
        /// Asked for.
        got: usize,
    },
}
