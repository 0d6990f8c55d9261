//! The files of the tree, without what is built, recorded or installed.

use std::fs;
use std::path::{Path, PathBuf};

/// One text file of the tree.
pub struct File {
    /// Path from the top of the tree, with `/`.
    pub path: String,
    pub text: String,
}

/// The top of the tree.
pub fn top() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// Every text file.
pub fn all() -> Vec<File> {
    let mut paths = Vec::new();
    walk(top(), &mut paths);
    paths.sort();
    let named = |path: PathBuf| {
        let text = String::from_utf8(fs::read(&path).ok()?).ok()?;
        let path = path.strip_prefix(top()).expect("the walk starts there").to_string_lossy().into_owned();
        Some(File { path, text })
    };
    paths.into_iter().filter_map(named).collect()
}

/// Every Rust file that people wrote.
pub fn rust() -> Vec<File> {
    all().into_iter().filter(|file| file.path.ends_with(".rs") && !file.path.contains("/generated/")).collect()
}

fn walk(folder: &Path, into: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(folder).expect("the tree can be read").flatten() {
        let (path, name) = (entry.path(), entry.file_name());
        let kind = entry.file_type().expect("the tree can be read");
        if kind.is_file() {
            into.push(path);
        } else if kind.is_dir() && !is_ignored(folder, &name.to_string_lossy()) {
            walk(&path, into);
        }
    }
}

/// What `.gitignore` leaves out, and git's own folder.
fn is_ignored(parent: &Path, name: &str) -> bool {
    let recorded = parent == top().join("bags") && name != "golden";
    recorded || ["target", ".git", ".venv", "node_modules", "__pycache__"].contains(&name)
}

/// The entries of the dependency tables of a `Cargo.toml`, the tests' among them.
pub fn dependencies(manifest: &str) -> Vec<String> {
    let mut inside = false;
    let mut found = Vec::new();
    for line in manifest.lines().map(str::trim) {
        if let Some(section) = line.strip_prefix('[') {
            inside = section.trim_end_matches(']').ends_with("dependencies") && !section.starts_with("workspace");
        } else if inside && let Some(end) = line.find(['.', ' ', '=']) {
            found.push(line[..end].to_owned());
        }
    }
    found
}
