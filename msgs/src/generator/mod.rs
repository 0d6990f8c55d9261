//! Rust types from interface definitions.
//!
//! Run it with `cargo run --release -p apprentice_msgs --example generate`.

mod emit;
mod load;
mod resolve;

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use thiserror::Error;

use crate::interface::InterfaceError;

pub use load::load;

/// Command that writes the generated files anew.
pub const COMMAND: &str = "cargo run --release -p apprentice_msgs --example generate";

/// Package whose messages and services become the modules `msg` and `srv`.
pub const OWN_PACKAGE: &str = "apprentice_msgs";

/// Longest fixed array that a generated type may hold, elements.
pub const MAX_ARRAY: usize = 4096;

/// Why no Rust types can be generated.
#[derive(Debug, Error)]
pub enum GenerateError {
    /// A file or directory cannot be read.
    #[error("{}: {source}", path.display())]
    Io {
        /// The file or directory.
        path: PathBuf,
        /// What the system said.
        source: std::io::Error,
    },
    /// A definition cannot be read.
    #[error(transparent)]
    Interface(#[from] InterfaceError),
    /// A field has a type that is not among the definitions.
    #[error("{user}: got a field of type `{got}`, expected a message among the definitions")]
    Unknown {
        /// Message that has the field.
        user: String,
        /// The type that is missing.
        got: String,
    },
    /// A message contains itself.
    #[error("{got} contains itself, expected messages without cycles")]
    Cycle {
        /// One message of the cycle.
        got: String,
    },
    /// Something that the interface language has and these Rust types do not.
    #[error("{user}: got field `{field}` with {got}, expected {expected}")]
    Unsupported {
        /// Message that has the field.
        user: String,
        /// The field.
        field: String,
        /// What it has.
        got: String,
        /// What it may have.
        expected: &'static str,
    },
}

/// What kind of file a definition comes from.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Kind {
    /// `.msg`
    Message,
    /// `.srv`
    Service,
    /// `.action`
    Action,
}

impl Kind {
    /// Name of the directory, and ending of the files.
    pub fn directory(self) -> &'static str {
        match self {
            Kind::Message => "msg",
            Kind::Service => "srv",
            Kind::Action => "action",
        }
    }
}

/// One definition file.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Source {
    /// Package it belongs to.
    pub package: String,
    /// What it defines.
    pub kind: Kind,
    /// Name without package.
    pub name: String,
    /// Path below the package root, with `/`.
    pub path: String,
    /// Its text.
    pub text: String,
}

impl Source {
    /// `package/msg/Name`, `package/srv/Name` or `package/action/Name`.
    pub fn type_name(&self) -> String {
        format!("{}/{}/{}", self.package, self.kind.directory(), self.name)
    }
}

/// Rust files (name to text) for all of `sources`.
pub fn generate(sources: &[Source]) -> Result<BTreeMap<String, String>, GenerateError> {
    let resolved = resolve::resolve(sources)?;
    emit::emit(sources, &resolved)
}

/// Rust files for the definitions below `root`, the directory of the interface package.
pub fn generate_from(root: &Path) -> Result<BTreeMap<String, String>, GenerateError> {
    generate(&load(root)?)
}
