//! Opening a bag given as a folder, as its `metadata.yaml`, or as a bare `.mcap` file.

use std::fs::{self, File};
use std::io::Read;
use std::path::{Path, PathBuf};

use bag::{Attachment, BagError, BagMetadata, BagReader, Contents, Damage, Limits, MetadataRecord};

use crate::folder::{METADATA_FILE, list_files};
use crate::{BagFilesError, BagMessages};

/// Most bytes of `metadata.yaml` that are read.
const MAX_METADATA_BYTES: u64 = 4 << 20;

/// One MCAP file of a bag.
#[derive(Debug)]
pub struct BagFile {
    /// Where it is.
    pub path: PathBuf,
    /// Its size in bytes.
    pub bytes: u64,
    /// What is in it.
    pub contents: Contents,
    /// What is wrong with it; a file that was not finished or is cut short is opened nevertheless.
    pub damage: Vec<Damage>,
    /// Its metadata records.
    pub metadata: Vec<MetadataRecord>,
}

/// A bag on disk, with what is in it.
#[derive(Debug)]
pub struct OpenBag {
    /// The path it was opened by.
    pub path: PathBuf,
    /// Its files, in recording order.
    pub files: Vec<BagFile>,
    /// All files together.
    pub metadata: BagMetadata,
}

/// Opens a bag. Files that were not finished are read up to their last whole chunk.
///
/// # Errors
/// When there is no bag, its `metadata.yaml` cannot be used, a file is missing, or a file is damaged within.
pub fn open_bag(path: &Path) -> Result<OpenBag, BagFilesError> {
    let (folder, paths) = files_of(path)?;
    let mut files = Vec::with_capacity(paths.len());
    for file in paths {
        let bytes = fs::metadata(&file).map_or(0, |metadata| metadata.len());
        let reader = open_file(&file)?;
        files.push(BagFile {
            bytes,
            contents: reader.contents().clone(),
            metadata: reader.metadata().to_vec(),
            damage: reader.into_damage(),
            path: file,
        });
    }
    let names: Vec<_> = files.iter().map(|file| relative(&folder, &file.path)).collect();
    let metadata = BagMetadata::from_files(names.iter().map(String::as_str).zip(files.iter().map(|f| &f.contents)));
    Ok(OpenBag { path: path.to_owned(), files, metadata })
}

impl OpenBag {
    /// Every message of every file in the order of log times, then of files, then within the file.
    pub fn messages(&self) -> BagMessages {
        BagMessages::new(&self.files)
    }

    /// Every attachment of every file.
    ///
    /// # Errors
    /// When one is damaged or its file has become unreadable.
    pub fn attachments(&self) -> Result<Vec<Attachment>, BagFilesError> {
        let mut all = Vec::new();
        for file in self.files.iter().filter(|file| file.contents.attachment_count > 0) {
            all.extend(open_file(&file.path)?.attachments().map_err(BagFilesError::bag(&file.path))?);
        }
        Ok(all)
    }

    /// Every topic with its count in all files, by name.
    pub fn topics(&self) -> Vec<bag::TopicContents> {
        let mut all: Vec<bag::TopicContents> = Vec::new();
        for found in self.files.iter().flat_map(|file| &file.contents.topics) {
            match all.iter_mut().find(|known| known.topic.name == found.topic.name) {
                Some(known) => known.message_count += found.message_count,
                None => all.push(found.clone()),
            }
        }
        all.sort_by(|a, b| a.topic.name.cmp(&b.topic.name));
        all
    }

    /// What is wrong, file by file; empty for a finished, undamaged bag.
    pub fn damage(&self) -> impl Iterator<Item = (&Path, &Damage)> {
        self.files.iter().flat_map(|file| file.damage.iter().map(|damage| (file.path.as_path(), damage)))
    }
}

/// Opens one file; one that was not finished, or is cut short, up to its last whole chunk.
pub(crate) fn open_file(path: &Path) -> Result<BagReader<File>, BagFilesError> {
    let file = || File::open(path).map_err(BagFilesError::io("open", path));
    match BagReader::open(file()?, Limits::default()) {
        Err(BagError::Unfinished { .. } | BagError::Truncated { .. }) => {
            BagReader::open_tolerant(file()?, Limits::default()).map_err(BagFilesError::bag(path))
        }
        other => other.map_err(BagFilesError::bag(path)),
    }
}

/// The bag's folder and the paths of its files.
fn files_of(path: &Path) -> Result<(PathBuf, Vec<PathBuf>), BagFilesError> {
    let kind = fs::metadata(path).map_err(|_| BagFilesError::Missing { path: path.to_owned() })?;
    let parent = || path.parent().map_or_else(PathBuf::new, Path::to_path_buf);
    if kind.is_dir() {
        return folder_files(path);
    }
    if path.file_name().is_some_and(|name| name == METADATA_FILE) {
        let folder = parent();
        return folder_files(if folder.as_os_str().is_empty() { Path::new(".") } else { &folder });
    }
    Ok((parent(), vec![path.to_owned()]))
}

fn folder_files(folder: &Path) -> Result<(PathBuf, Vec<PathBuf>), BagFilesError> {
    let metadata = folder.join(METADATA_FILE);
    if !metadata.exists() {
        let files = list_files(folder)?;
        if files.is_empty() {
            return Err(BagFilesError::Empty { path: folder.to_owned() });
        }
        return Ok((folder.to_owned(), files));
    }
    let mut text = String::new();
    let file = File::open(&metadata).map_err(BagFilesError::io("open", &metadata))?;
    // One byte more than allowed, so that the parser refuses what is too long.
    file.take(MAX_METADATA_BYTES + 1).read_to_string(&mut text).map_err(BagFilesError::io("read", &metadata))?;
    let parsed = BagMetadata::parse(&text).map_err(|source| BagFilesError::Metadata { path: metadata, source })?;
    let files: Vec<_> = parsed.files.iter().map(|file| folder.join(&file.path)).collect();
    match files.iter().find(|file| !file.is_file()) {
        Some(missing) => Err(BagFilesError::MissingFile { path: missing.clone() }),
        None => Ok((folder.to_owned(), files)),
    }
}

/// The path as `metadata.yaml` names it.
pub(crate) fn relative(folder: &Path, path: &Path) -> String {
    path.strip_prefix(folder).unwrap_or(path).to_string_lossy().into_owned()
}
