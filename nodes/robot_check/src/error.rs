//! Why there is no answer.

use arm::{Problem, SrdfError, UrdfError};
use robot_files::{FoldersError, TextError};
use std::path::PathBuf;
use thiserror::Error;

/// Inputs that cannot be used.
#[derive(Debug, Error)]
pub enum RobotError {
    /// A file cannot be read.
    #[error(transparent)]
    Text(#[from] TextError),
    /// A folder is not there.
    #[error(transparent)]
    Folders(#[from] FoldersError),
    /// The description is wrong.
    #[error("{}: {source}", path.display())]
    Urdf {
        /// The file.
        path: PathBuf,
        /// What is wrong.
        source: UrdfError,
    },
    /// Collision meshes are missing or broken.
    #[error(
        "{}: {} of its collision meshes cannot be used:\n{}\ngive the folder that holds their packages with --package-path DIR, \
         or go on with --bounding-shapes, a guess for each",
        path.display(), problems.len(), problems.iter().map(|p| format!("  line {}: {}", p.line, p.what)).collect::<Vec<_>>().join("\n")
    )]
    Meshes {
        /// The description.
        path: PathBuf,
        /// One for each use of a mesh.
        problems: Vec<Problem>,
    },
    /// The SRDF is wrong.
    #[error("{}: {source}", path.display())]
    Srdf {
        /// The file.
        path: PathBuf,
        /// What is wrong.
        source: SrdfError,
    },
    /// The joint positions are wrong.
    #[error("{}: {problem}", path.display())]
    Joints {
        /// The file.
        path: PathBuf,
        /// What is wrong, and what to do.
        problem: String,
    },
}

impl RobotError {
    /// The same as problems: each with its line (0: none), what, and advice.
    pub fn problems(&self) -> Vec<Problem> {
        let of = |line: usize, message: String| {
            let message = message.strip_prefix(&format!("line {line}: ")).map_or(message.clone(), String::from);
            let (what, advice) = message.split_once("; ").unwrap_or((&message, ""));
            Problem { line, what: what.into(), advice: advice.into() }
        };
        match self {
            Self::Urdf { source, .. } => vec![of(source.line(), source.to_string())],
            Self::Meshes { problems, .. } => problems.clone(),
            Self::Srdf { source, .. } => {
                let line = if let SrdfError::Syntax { line, .. } = source { *line } else { 0 };
                vec![of(line, source.to_string())]
            }
            other => vec![of(0, other.to_string())],
        }
    }
}
