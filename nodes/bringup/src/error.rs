//! Why a lesson cannot begin.

use bus::{ArgumentError, NameError, ParameterError};
use std::path::PathBuf;
use thiserror::Error;

/// Every one is bad input or a world that cannot be used; nothing has been started.
#[derive(Debug, Error)]
pub enum BringupError {
    /// The ROS part of the command line.
    #[error(transparent)]
    Arguments(#[from] ArgumentError),
    /// A parameter of bringup itself.
    #[error(transparent)]
    Parameters(#[from] ParameterError),
    /// A name that ROS would refuse.
    #[error(transparent)]
    Name(#[from] NameError),
    /// No scenario of that name.
    #[error(
        "there is no scenario '{got}'{hint}; known are flowers, spoon, grid and driving; or give the path of a .yaml file"
    )]
    UnknownScenario {
        /// Got.
        got: String,
        /// The nearest name, in words; may be empty.
        hint: String,
    },
    /// A parameter file cannot be read.
    #[error("cannot read {path:?}: {source}")]
    Read {
        /// Which.
        path: PathBuf,
        /// Why.
        source: std::io::Error,
    },
    /// A parameter file is too long.
    #[error("{path:?} is longer than {max} bytes; parameter files are short: is this one?")]
    ParametersTooLong {
        /// Which.
        path: PathBuf,
        /// Allowed.
        max: u64,
    },
    /// The session's folder cannot be made or written.
    #[error("cannot write {path:?}: {source}; choose another folder with --session DIR")]
    Write {
        /// What.
        path: PathBuf,
        /// Why.
        source: std::io::Error,
    },
    /// A folder that holds something else.
    #[error(
        "{path:?} is not empty and holds no session (session.json is missing or unreadable); choose another --session DIR"
    )]
    NotASession {
        /// Which.
        path: PathBuf,
    },
    /// Two lessons in one folder.
    #[error("the session {path:?} is in use by another apprentice; stop that one, or choose another --session DIR")]
    InUse {
        /// Which.
        path: PathBuf,
    },
    /// Two lessons on one graph would answer each other's questions.
    #[error("another apprentice teaches on ROS domain {domain} in {namespace}; stop that one, or choose --domain-id N")]
    DomainInUse {
        /// The domain.
        domain: String,
        /// The namespace.
        namespace: String,
    },
    /// A session is continued as it was begun.
    #[error("the session {path:?} was begun with {name} {was}, not {got}; leave --{name} out, or begin a new session")]
    OtherSession {
        /// Which.
        path: PathBuf,
        /// The option.
        name: &'static str,
        /// Then.
        was: String,
        /// Now.
        got: String,
    },
    /// The summary cannot be written where it should be.
    #[error("cannot write the summary {path:?}: {source}")]
    Summary {
        /// Which.
        path: PathBuf,
        /// Why.
        source: std::io::Error,
    },
    /// The executable cannot start itself.
    #[error("cannot start {what}: {source}")]
    Start {
        /// What.
        what: &'static str,
        /// Why.
        source: std::io::Error,
    },
    /// The graph cannot be joined.
    #[error("cannot join the ROS graph: {0}")]
    Bus(String),
}

impl BringupError {
    /// 2 for what the person can correct on the command line, 1 for the rest; 0 for help that was asked for.
    pub fn exit_code(&self) -> u8 {
        match self {
            Self::Parameters(ParameterError::Help(_)) => 0,
            Self::Start { .. } | Self::Bus(_) => 1,
            _ => 2,
        }
    }
}
