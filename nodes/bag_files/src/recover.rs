//! Making a bag on disk whole again, where it is.

use std::fs::{self, File};
use std::io::{BufWriter, Read};
use std::path::{Path, PathBuf};

use bag::{BagError, BagMetadata, BagReader, BagWriter, Contents, Limits, WriterOptions, recover};

use crate::BagFilesError;
use crate::folder::{list_files, sync_folder, write_metadata};
use crate::open::relative;

/// What became of one file.
#[derive(Debug, PartialEq, Eq)]
pub enum Recovered {
    /// It was finished and undamaged, and is as it was.
    Whole,
    /// It had not been finished; now it is, with every message that was in it.
    Finished,
    /// It was cut short or damaged: what could be read is kept, the original is aside.
    Salvaged {
        /// What was wrong, one line each.
        damage: Vec<String>,
        /// Where the original is now.
        original: PathBuf,
    },
}

/// One file after a recovery.
#[derive(Debug)]
pub struct RecoveredFile {
    /// Where it is.
    pub path: PathBuf,
    /// What is in it now.
    pub contents: Contents,
    /// What became of it.
    pub outcome: Recovered,
}

/// Makes every file of a bag folder whole and writes its `metadata.yaml` anew; or does so with a bare `.mcap` file.
///
/// # Errors
/// When there is no bag, a file is no MCAP file, or the system refuses. The originals are untouched then.
pub fn recover_in_place(path: &Path) -> Result<Vec<RecoveredFile>, BagFilesError> {
    let kind = fs::metadata(path).map_err(|_| BagFilesError::Missing { path: path.to_owned() })?;
    if !kind.is_dir() {
        return Ok(vec![recover_file(path)?]);
    }
    let paths = list_files(path)?;
    if paths.is_empty() {
        return Err(BagFilesError::Empty { path: path.to_owned() });
    }
    let files = paths.iter().map(|file| recover_file(file)).collect::<Result<Vec<_>, _>>()?;
    let names: Vec<_> = files.iter().map(|file| relative(path, &file.path)).collect();
    let metadata = BagMetadata::from_files(names.iter().map(String::as_str).zip(files.iter().map(|f| &f.contents)));
    write_metadata(path, &metadata)?;
    Ok(files)
}

fn recover_file(path: &Path) -> Result<RecoveredFile, BagFilesError> {
    let open = || File::open(path).map_err(BagFilesError::io("open", path));
    if cut_within_magic(open()?) {
        return start_anew(path);
    }
    let reader = BagReader::open_tolerant(open()?, Limits::default()).map_err(BagFilesError::bag(path))?;
    if reader.damage().is_empty() {
        let contents = reader.contents().clone();
        return Ok(RecoveredFile { path: path.to_owned(), contents, outcome: Recovered::Whole });
    }
    drop(reader);
    let draft = beside(path, "recovering");
    let output = File::create(&draft).map_err(BagFilesError::io("create", &draft))?;
    let synced = output.try_clone().map_err(BagFilesError::io("create", &draft))?;
    let report = recover(open()?, BufWriter::new(output), Limits::default(), &WriterOptions::default());
    let report = report.map_err(BagFilesError::bag(path))?;
    synced.sync_all().map_err(BagFilesError::io("write", &draft))?;
    let outcome = if report.complete() {
        Recovered::Finished
    } else {
        let original = beside(path, "damaged");
        fs::rename(path, &original).map_err(BagFilesError::io("rename", path))?;
        Recovered::Salvaged { damage: report.damage.iter().map(ToString::to_string).collect(), original }
    };
    fs::rename(&draft, path).map_err(BagFilesError::io("write", path))?;
    if let Some(folder) = path.parent().filter(|folder| !folder.as_os_str().is_empty()) {
        sync_folder(folder)?;
    }
    Ok(RecoveredFile { path: path.to_owned(), contents: report.contents, outcome })
}

/// Whether the file ends before its magic does: its recorder was killed before it could write a thing.
fn cut_within_magic(file: File) -> bool {
    let mut start = Vec::new();
    // What BagWriter writes first, by writing an empty bag.
    let magic = BagWriter::new(Vec::new(), &WriterOptions::default()).and_then(BagWriter::finish);
    let Ok((magic, _)) = magic else { return false };
    file.take(8).read_to_end(&mut start).is_ok() && start.len() < 8 && magic.starts_with(&start)
}

/// Replaces a file without a byte of content by an empty bag.
fn start_anew(path: &Path) -> Result<RecoveredFile, BagFilesError> {
    let failed = |error: BagError| BagFilesError::Bag { path: path.to_owned(), source: error };
    let output = File::create(path).map_err(BagFilesError::io("create", path))?;
    let writer = BagWriter::new(output, &WriterOptions::default()).map_err(failed)?;
    let (_, contents) = writer.finish().map_err(failed)?;
    Ok(RecoveredFile { path: path.to_owned(), contents, outcome: Recovered::Finished })
}

/// The path with another ending: `a_0.mcap.ENDING`.
fn beside(path: &Path, ending: &str) -> PathBuf {
    let mut name = path.as_os_str().to_owned();
    name.push(".");
    name.push(ending);
    PathBuf::from(name)
}
