//! The files of a bag folder: names, listing, and `metadata.yaml` written in one piece.

use std::fs::{self, File};
use std::io::Write;
use std::path::{Path, PathBuf};

use bag::BagMetadata;

use crate::BagFilesError;

/// Name of the file that makes a folder a bag.
pub const METADATA_FILE: &str = "metadata.yaml";
/// Most entries of a folder that are looked at.
const MAX_ENTRIES: usize = 100_000;

/// Makes the folder of a bag, or takes one that is empty or already holds a bag.
///
/// # Errors
/// When the path is no folder, holds other things, or the system refuses.
pub fn create_folder(path: &Path) -> Result<(), BagFilesError> {
    fs::create_dir_all(path).map_err(BagFilesError::io("create the folder", path))?;
    let names = entries(path)?;
    let is_bag = names.iter().any(|name| name == METADATA_FILE || name.ends_with(".mcap"));
    match names.into_iter().find(|name| !name.starts_with('.')) {
        Some(found) if !is_bag => Err(BagFilesError::Occupied { path: path.to_owned(), found }),
        _ => Ok(()),
    }
}

/// Paths of the folder's `.mcap` files in the order in which they were recorded: by number, then name.
///
/// # Errors
/// When the folder cannot be read.
pub fn list_files(folder: &Path) -> Result<Vec<PathBuf>, BagFilesError> {
    let mut names = entries(folder)?;
    names.retain(|name| name.ends_with(".mcap"));
    names.sort_by_key(|name| (index_of(name), name.clone()));
    Ok(names.into_iter().map(|name| folder.join(name)).collect())
}

/// The number of the next file of a folder: one more than the highest there is, 0 in an empty folder.
///
/// # Errors
/// When the folder cannot be read.
pub fn next_index(folder: &Path) -> Result<u64, BagFilesError> {
    let names = entries(folder)?;
    // Files kept aside by a recovery count too, so that no number is used twice.
    let used = names.iter().filter_map(|name| index_of(name.strip_suffix(".damaged").unwrap_or(name)));
    Ok(used.max().map_or(0, |highest| highest.saturating_add(1)))
}

/// rosbag2's name of the `index`-th file: `FOLDER_INDEX.mcap`.
pub fn file_name(folder: &Path, index: u64) -> String {
    let name = folder.file_name().map_or_else(|| "bag".into(), |name| name.to_string_lossy());
    format!("{name}_{index}.mcap")
}

/// Writes `metadata.yaml` so that there is a whole one at every moment.
///
/// # Errors
/// When the system refuses.
pub fn write_metadata(folder: &Path, metadata: &BagMetadata) -> Result<(), BagFilesError> {
    let draft = folder.join(".metadata.yaml.new");
    let mut file = File::create(&draft).map_err(BagFilesError::io("create", &draft))?;
    file.write_all(metadata.to_yaml().as_bytes())
        .and_then(|()| file.sync_all())
        .map_err(BagFilesError::io("write", &draft))?;
    let path = folder.join(METADATA_FILE);
    fs::rename(&draft, &path).map_err(BagFilesError::io("write", &path))?;
    sync_folder(folder)
}

/// Makes renames in a folder last through a power cut.
pub(crate) fn sync_folder(folder: &Path) -> Result<(), BagFilesError> {
    File::open(folder).and_then(|folder| folder.sync_all()).map_err(BagFilesError::io("write the folder", folder))
}

/// `N` of `anything_N.mcap`.
fn index_of(name: &str) -> Option<u64> {
    name.strip_suffix(".mcap")?.rsplit_once('_')?.1.parse().ok()
}

fn entries(folder: &Path) -> Result<Vec<String>, BagFilesError> {
    let failed = || BagFilesError::io("read the folder", folder);
    let mut names = Vec::new();
    for entry in fs::read_dir(folder).map_err(failed())?.take(MAX_ENTRIES) {
        names.push(entry.map_err(failed())?.file_name().to_string_lossy().into_owned());
    }
    names.sort();
    Ok(names)
}
