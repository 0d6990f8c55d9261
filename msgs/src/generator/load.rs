//! The definition files of the interface package and of the standard packages beside it.

use std::fs;
use std::path::{Path, PathBuf};

use super::{GenerateError, Kind, OWN_PACKAGE, Source};
use crate::interface::{InterfaceError, MAX_TEXT_BYTES, Problem};

/// Reads `msg/`, `srv/` and `action/` below `root`, and the same below each `standard/<package>/`.
/// The order is that of the type names.
pub fn load(root: &Path) -> Result<Vec<Source>, GenerateError> {
    let mut sources = Vec::new();
    load_package(root, OWN_PACKAGE, "", &mut sources)?;
    for package in entries(&root.join("standard"))? {
        let name = package.file_name().unwrap_or_default().to_string_lossy();
        load_package(root, &name, &format!("standard/{name}/"), &mut sources)?;
    }
    sources.sort_by_key(Source::type_name);
    Ok(sources)
}

fn load_package(root: &Path, package: &str, prefix: &str, sources: &mut Vec<Source>) -> Result<(), GenerateError> {
    for kind in [Kind::Message, Kind::Service, Kind::Action] {
        let directory = root.join(format!("{prefix}{}", kind.directory()));
        if !directory.is_dir() {
            continue;
        }
        for file in entries(&directory)? {
            if file.extension().is_none_or(|ending| ending != kind.directory()) {
                continue;
            }
            let name = file.file_stem().unwrap_or_default().to_string_lossy();
            let path = format!("{prefix}{0}/{name}.{0}", kind.directory());
            sources.push(Source {
                package: package.to_owned(),
                kind,
                name: name.clone().into_owned(),
                text: read(&file, &path)?,
                path,
            });
        }
    }
    Ok(())
}

/// Paths in `directory`, sorted.
fn entries(directory: &Path) -> Result<Vec<PathBuf>, GenerateError> {
    let fail = |source| GenerateError::Io { path: directory.to_owned(), source };
    let mut paths = fs::read_dir(directory)
        .map_err(fail)?
        .map(|entry| entry.map(|entry| entry.path()))
        .collect::<Result<Vec<_>, _>>()
        .map_err(fail)?;
    paths.sort();
    Ok(paths)
}

fn read(file: &Path, path: &str) -> Result<String, GenerateError> {
    let fail = |source| GenerateError::Io { path: file.to_owned(), source };
    let length = usize::try_from(fs::metadata(file).map_err(fail)?.len()).unwrap_or(usize::MAX);
    if length > MAX_TEXT_BYTES {
        return Err(GenerateError::Interface(InterfaceError {
            file: path.to_owned(),
            line: 0,
            problem: Problem::TooLong { got: length, expected: MAX_TEXT_BYTES },
        }));
    }
    fs::read_to_string(file).map_err(fail)
}
