//! From the names of meshes to files inside given folders.

use crate::text::{TextError, read_bytes};
use arm::MAX_MESH_BYTES;
use std::io;
use std::path::{Component, Path, PathBuf};
use thiserror::Error;

/// Folders in which meshes are looked for.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Folders {
    /// Where packages are; resolved, so that no link leads astray.
    roots: Vec<PathBuf>,
    /// Of the description, for relative names; resolved.
    here: Option<PathBuf>,
}

/// A folder that is none.
#[derive(Debug, Error)]
#[error("the package path {}: {source}", folder.display())]
pub struct FoldersError {
    /// As given.
    pub folder: PathBuf,
    /// Why not.
    pub source: io::Error,
}

impl Folders {
    /// Meshes are looked for in `roots` (folders that hold packages, or are packages) and in the folder of the description and
    /// below it. When the description lies in a folder that has a package's name, that package is found without being given.
    ///
    /// # Errors
    /// A root that is not there.
    pub fn new(roots: &[PathBuf], description: Option<&Path>) -> Result<Self, FoldersError> {
        let resolve =
            |folder: &PathBuf| folder.canonicalize().map_err(|source| FoldersError { folder: folder.clone(), source });
        let roots = roots.iter().map(resolve).collect::<Result<_, _>>()?;
        let here = description.and_then(|file| file.canonicalize().ok()?.parent().map(Path::to_owned));
        Ok(Self { roots, here })
    }

    /// The bytes behind the name of a mesh, or why there are none; the function that [`arm::Robot::read`] asks for.
    ///
    /// # Errors
    /// In words: a name that leads out of the folders, is of no known kind, or of no file, or a file beyond
    /// [`MAX_MESH_BYTES`].
    pub fn find(&self, name: &str) -> Result<Vec<u8>, String> {
        let path = self.resolve(name)?;
        read_bytes(&path, MAX_MESH_BYTES).map_err(|error| match error {
            TextError::TooLarge { max, .. } => format!("more than {max} bytes; simplify the mesh"),
            error => error.to_string(),
        })
    }

    fn resolve(&self, name: &str) -> Result<PathBuf, String> {
        if let Some(rest) = name.strip_prefix("package://").or_else(|| name.strip_prefix("model://")) {
            return self.in_package(rest);
        }
        if let Some(path) = name.strip_prefix("file://") {
            return self.inside(Path::new(path));
        }
        if let Some((kind, _)) = name.split_once("://") {
            return Err(format!("names of the kind {kind}:// are not read; use package:// or a relative path"));
        }
        let path = Path::new(name);
        match &self.here {
            _ if path.is_absolute() => self.inside(path),
            Some(here) => self.inside(&here.join(path)),
            None => Err("it is relative, and the description has no folder; use package://".into()),
        }
    }

    /// `NAME/PATH` of a package.
    fn in_package(&self, rest: &str) -> Result<PathBuf, String> {
        let relative = Path::new(rest);
        let (package, inner) = rest.split_once('/').unwrap_or((rest, ""));
        if package.is_empty() || inner.is_empty() || !relative.components().all(|c| matches!(c, Component::Normal(_))) {
            return Err("a package:// name must be NAME/PATH, without '..'".into());
        }
        let mut tried = Vec::new();
        let named = |root: &&PathBuf| root.file_name().is_some_and(|name| name == package);
        // A package may hold a folder of its own name, so both readings are tried.
        let around = self
            .here
            .iter()
            .flat_map(|here| here.ancestors())
            .filter(|dir| dir.file_name().is_some_and(|n| n == package));
        let candidates = (self.roots.iter().map(|root| (root.clone(), root.join(relative))))
            .chain(self.roots.iter().filter(named).map(|root| (root.clone(), root.join(inner))))
            .chain(around.map(|dir| (dir.to_owned(), dir.join(inner))));
        for (root, candidate) in candidates {
            match candidate.canonicalize() {
                Ok(path) if path.starts_with(&root) => return Ok(path),
                Ok(_) => return Err(format!("{} leads out of {} by a link", candidate.display(), root.display())),
                Err(_) => tried.push(candidate.display().to_string()),
            }
        }
        Err(if tried.is_empty() {
            format!("no folder was given that may hold the package '{package}'; use --package-path DIR")
        } else {
            format!("not found; looked at {}; use --package-path DIR", tried.join(", "))
        })
    }

    /// A path that must lie in one of the folders once all links and `..` are resolved.
    fn inside(&self, path: &Path) -> Result<PathBuf, String> {
        let resolved = path.canonicalize().map_err(|error| format!("{}: {error}", path.display()))?;
        if self.roots.iter().chain(&self.here).any(|root| resolved.starts_with(root)) {
            Ok(resolved)
        } else {
            Err(format!("{} is outside of the folders that were given; use --package-path DIR", resolved.display()))
        }
    }
}
