//! What can be wrong with a bag on disk, each with the path.

use std::io;
use std::path::{Path, PathBuf};

use bag::{BagError, MetadataError};

/// Why a bag on disk could not be opened, made or recovered.
#[derive(Debug, thiserror::Error)]
pub enum BagFilesError {
    /// There is nothing at the path.
    #[error("there is no bag at {path}: expected a folder with metadata.yaml, or an .mcap file")]
    Missing {
        /// The path given.
        path: PathBuf,
    },
    /// The folder holds no bag.
    #[error("{path} is no bag: it holds neither metadata.yaml nor .mcap files")]
    Empty {
        /// The folder.
        path: PathBuf,
    },
    /// A folder for a new bag holds other things.
    #[error("{path} cannot take a new bag: it holds '{found}', which is no part of a bag; give an empty or new folder")]
    Occupied {
        /// The folder.
        path: PathBuf,
        /// What is in the way.
        found: String,
    },
    /// A file that `metadata.yaml` names is not there.
    #[error("{path} is missing, although metadata.yaml names it; `apprentice bag recover` writes metadata.yaml anew")]
    MissingFile {
        /// The file.
        path: PathBuf,
    },
    /// `metadata.yaml` cannot be used.
    #[error("{path}: {source}")]
    Metadata {
        /// Path of `metadata.yaml`.
        path: PathBuf,
        /// What is wrong with it.
        source: MetadataError,
    },
    /// An MCAP file cannot be read or written.
    #[error("{path}: {source}")]
    Bag {
        /// The file.
        path: PathBuf,
        /// What is wrong with it.
        source: BagError,
    },
    /// The system refuses.
    #[error("cannot {what} {path}: {source}")]
    Io {
        /// "open", "create"…
        what: &'static str,
        /// The file or folder.
        path: PathBuf,
        /// The system's reason.
        source: io::Error,
    },
}

impl BagFilesError {
    pub(crate) fn io(what: &'static str, path: &Path) -> impl FnOnce(io::Error) -> BagFilesError {
        move |source| BagFilesError::Io { what, path: path.to_owned(), source }
    }

    pub(crate) fn bag(path: &Path) -> impl FnOnce(BagError) -> BagFilesError {
        move |source| BagFilesError::Bag { path: path.to_owned(), source }
    }
}
