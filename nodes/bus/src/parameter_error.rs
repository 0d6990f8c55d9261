//! What can be wrong with parameters, said so that a person can put it right.

use std::path::PathBuf;

use thiserror::Error;

/// Where a parameter was given.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Place {
    /// On the command line, as this text.
    CommandLine(String),
    /// In a file, at a line (from 1; 0 when unknown).
    File(PathBuf, u64),
    /// In a recorded text, at a line.
    Text(u64),
}

impl std::fmt::Display for Place {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Place::CommandLine(text) => write!(f, "command line, `{text}`"),
            Place::File(path, 0) => write!(f, "{}", path.display()),
            Place::File(path, line) => write!(f, "{}:{line}", path.display()),
            Place::Text(line) => write!(f, "recorded parameters, line {line}"),
        }
    }
}

/// Parameters that cannot be taken.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum ParameterError {
    /// Not an error: the help text was asked for.
    #[error("{0}")]
    Help(String),
    /// A parameter file cannot be read.
    #[error("cannot read the parameter file {}: {reason}", path.display())]
    Read {
        /// The file.
        path: PathBuf,
        /// The system's reason.
        reason: String,
    },
    /// A parameter file is absurdly large.
    #[error("the parameter file {} has {got} bytes; at most {limit} are read", path.display())]
    TooLarge {
        /// The file.
        path: PathBuf,
        /// Its size, bytes.
        got: u64,
        /// The limit, bytes.
        limit: u64,
    },
    /// The text is no YAML, or breaks the parser's limits.
    #[error("{place}: not valid YAML: {reason}")]
    Yaml {
        /// Where.
        place: Box<Place>,
        /// The parser's words.
        reason: String,
    },
    /// The YAML is not a parameter file.
    #[error("{place}: got {got}, expected {expected}")]
    Structure {
        /// Where.
        place: Box<Place>,
        /// What was found.
        got: String,
        /// What belongs there.
        expected: String,
    },
    /// No such parameter.
    #[error("{place}: the node `{node}` has no parameter `{name}`{suggestion}")]
    Unknown {
        /// Where.
        place: Box<Place>,
        /// The node.
        node: String,
        /// The name given.
        name: String,
        /// "; did you mean …?", or which there are.
        suggestion: String,
    },
    /// A value of the wrong type.
    #[error("{place}: parameter `{name}`: got the {got}, expected {expected}")]
    Type {
        /// Where.
        place: Box<Place>,
        /// The parameter.
        name: String,
        /// Type and value given.
        got: String,
        /// The type wanted.
        expected: String,
    },
    /// A value out of range.
    #[error("{place}: parameter `{name}`: got {got}, expected {expected}{suggestion}")]
    OutOfRange {
        /// Where.
        place: Box<Place>,
        /// The parameter.
        name: String,
        /// The value given.
        got: String,
        /// The range or the choices.
        expected: String,
        /// "; did you mean …?" or nothing.
        suggestion: String,
    },
    /// Parameters that are good one by one but not together.
    #[error("the parameters of `{node}` do not fit together: {reason}")]
    Together {
        /// The node.
        node: String,
        /// The node's words.
        reason: String,
    },
    /// The node's settings do not agree with their table; a defect of the program.
    #[error("the settings of `{node}` do not agree with their table: {reason}")]
    Definition {
        /// The node.
        node: String,
        /// How.
        reason: String,
    },
    /// The node's name or namespace is not allowed.
    #[error(transparent)]
    Name(#[from] crate::names::NameError),
}
