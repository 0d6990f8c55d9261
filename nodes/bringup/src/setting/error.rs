//! Why a table cannot be set.

use crate::BringupError;
use std::path::PathBuf;
use thiserror::Error;

/// See the module.
#[derive(Debug, Error)]
pub enum SettingError {
    /// Parameters that are no setting.
    #[error("{path}: {reason}")]
    Parameters {
        /// The file.
        path: PathBuf,
        /// Why, in a sentence.
        reason: String,
    },
    /// What would keep a lesson from beginning, too.
    #[error(transparent)]
    Bringup(#[from] BringupError),
    /// No such setting.
    #[error(
        "there is no setting '{got}'; known: breakfast, or the path of a parameter file with a section /**/setting"
    )]
    Unknown {
        /// Got.
        got: String,
    },
    /// The folder was begun with another setting.
    #[error("{path} was begun with other parameters; continue it with those, or begin a new folder with --session")]
    Other {
        /// The folder.
        path: PathBuf,
    },
    /// A flag that is the setting's own.
    #[error("{flag} is given to each lesson by the setting itself; leave it out after the --")]
    OwnFlag {
        /// The flag.
        flag: String,
    },
    /// A lesson cannot be started.
    #[error("cannot start a lesson: {0}")]
    Start(std::io::Error),
    /// A lesson ended without saying how.
    #[error("the lesson about '{id}' failed with exit code {code}; its messages stand above, its log in {logs}")]
    Lesson {
        /// What was to be placed.
        id: String,
        /// Of the process.
        code: i32,
        /// Folder of the log files.
        logs: PathBuf,
    },
}
