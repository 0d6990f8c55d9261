//! The bag folder being written: its files, splits, flushes and `metadata.yaml`.

use std::collections::BTreeMap;
use std::fs::File;
use std::io::BufWriter;
use std::path::{Path, PathBuf};

use bag::{
    BagError, BagMetadata, BagReader, BagWriter, Contents, Limits, MetadataRecord, Topic, TopicId, WriterOptions,
};
use bag_files::{
    BagFilesError, Recovered, create_folder, file_name, list_files, next_index, recover_in_place, utc_text,
    write_metadata,
};

use crate::keepsakes::Keepsakes;

/// How a tape is written.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct TapeSettings {
    /// The bag's folder.
    pub folder: PathBuf,
    /// Compression of the chunks.
    pub compression: bag::Compression,
    /// A new file is started past this many bytes; 0: never.
    pub max_bytes_per_file: u64,
    /// Commit of this executable, for the bag's metadata.
    pub commit: String,
    /// When recording starts, ns since 1970.
    pub start_ns: u64,
}

/// Why recording cannot go on.
#[derive(Debug, thiserror::Error)]
pub enum TapeError {
    /// The folder or one of its files cannot be used.
    #[error(transparent)]
    Files(#[from] BagFilesError),
    /// The bag cannot be written.
    #[error("cannot write {path}: {source}; what was flushed before is kept")]
    Write {
        /// The file.
        path: PathBuf,
        /// The reason.
        source: BagError,
    },
    /// A message came before its topic was described.
    #[error("got a message of {topic}, expected its description first")]
    Undescribed {
        /// The topic.
        topic: String,
    },
}

/// Name of a finished file, and what is in it.
type Finished = (String, Contents);

/// The file that is being written.
struct Current {
    name: String,
    path: PathBuf,
    writer: BagWriter<BufWriter<File>>,
    /// The same file, for making it last.
    file: File,
    ids: BTreeMap<String, TopicId>,
}

/// A bag folder being recorded. Everything flushed survives the death of the process.
pub struct Tape {
    settings: TapeSettings,
    /// Every topic described, so that each file describes those it holds.
    topics: BTreeMap<String, Topic>,
    /// Files that are finished, with what is in them.
    finished: Vec<Finished>,
    /// Bytes of the files this tape has finished.
    finished_bytes: u64,
    next_index: u64,
    current: Current,
    keepsakes: Keepsakes,
    /// Topics were added since `metadata.yaml` was written.
    metadata_is_stale: bool,
}

impl Tape {
    /// Starts recording in a new folder, or continues in one that holds a bag: files its last recorder left unfinished
    /// are finished first, and a new file is begun. Gives what to tell the person about those.
    ///
    /// # Errors
    /// When the folder cannot be used or written.
    pub fn start(settings: TapeSettings) -> Result<(Tape, Vec<String>), TapeError> {
        create_folder(&settings.folder)?;
        let (finished, notes) = take_over(&settings.folder)?;
        let next_index = next_index(&settings.folder)?;
        let current = begin_file(&settings, next_index)?;
        let mut tape = Tape {
            settings,
            topics: BTreeMap::new(),
            finished,
            finished_bytes: 0,
            next_index: next_index + 1,
            current,
            keepsakes: Keepsakes::default(),
            metadata_is_stale: true,
        };
        tape.flush()?;
        Ok((tape, notes))
    }

    /// Describes a topic.
    ///
    /// # Errors
    /// When writing fails, or the topic was described differently before.
    pub fn describe(&mut self, topic: &Topic) -> Result<(), TapeError> {
        self.current.add(topic)?;
        self.topics.insert(topic.name.clone(), topic.clone());
        self.metadata_is_stale = true;
        Ok(())
    }

    /// Writes a message of a topic that was described. Times in ns, `cdr` with its 4-byte header.
    ///
    /// # Errors
    /// When writing fails.
    pub fn write(&mut self, topic: &str, log_time: u64, publish_time: u64, cdr: &[u8]) -> Result<(), TapeError> {
        let undescribed = || TapeError::Undescribed { topic: topic.to_owned() };
        let described = self.topics.get(topic).ok_or_else(undescribed)?;
        let limit = self.settings.max_bytes_per_file;
        if limit > 0 && self.current.writer.bytes() >= limit && self.current.writer.contents().message_count > 0 {
            let type_name = described.type_name.clone();
            self.split()?;
            self.keepsakes.see(topic, &type_name, log_time, cdr);
        } else {
            self.keepsakes.see(topic, &described.type_name, log_time, cdr);
        }
        let id = *self.current.ids.get(topic).ok_or_else(undescribed)?;
        self.current.writer.write(id, log_time, publish_time, cdr).map_err(write_error(&self.current.path))
    }

    /// Puts everything received so far on the disk.
    ///
    /// # Errors
    /// When writing fails.
    pub fn flush(&mut self) -> Result<(), TapeError> {
        let failed = || write_error(&self.current.path);
        self.current.writer.flush().map_err(failed())?;
        self.current.file.sync_data().map_err(BagError::Write).map_err(failed())?;
        if self.metadata_is_stale {
            self.write_metadata()?;
        }
        Ok(())
    }

    /// Bytes written by this tape, with those not yet flushed.
    pub fn bytes(&self) -> u64 {
        self.finished_bytes + self.current.writer.bytes()
    }

    /// Ends the recording: attachments, summary, `metadata.yaml`. Gives what is in the folder.
    ///
    /// # Errors
    /// When writing fails.
    pub fn finish(mut self) -> Result<BagMetadata, TapeError> {
        for attachment in self.keepsakes.attachments() {
            self.current.writer.attach(&attachment).map_err(write_error(&self.current.path))?;
        }
        let (name, contents) = finish_file(self.current, &self.keepsakes)?;
        self.finished.push((name, contents));
        let metadata = BagMetadata::from_files(self.finished.iter().map(|(name, contents)| (name.as_str(), contents)));
        write_metadata(&self.settings.folder, &metadata)?;
        Ok(metadata)
    }

    /// Finishes the file and begins the next one, which describes the same topics.
    fn split(&mut self) -> Result<(), TapeError> {
        let mut next = begin_file(&self.settings, self.next_index)?;
        for topic in self.topics.values() {
            next.add(topic)?;
        }
        self.next_index += 1;
        self.finished_bytes += self.current.writer.bytes();
        let full = std::mem::replace(&mut self.current, next);
        self.finished.push(finish_file(full, &self.keepsakes)?);
        self.metadata_is_stale = true;
        self.flush()
    }

    fn write_metadata(&mut self) -> Result<(), TapeError> {
        let current = self.current.writer.contents();
        let finished = self.finished.iter().map(|(name, contents)| (name.as_str(), contents));
        let metadata = BagMetadata::from_files(finished.chain([(self.current.name.as_str(), &current)]));
        write_metadata(&self.settings.folder, &metadata)?;
        self.metadata_is_stale = false;
        Ok(())
    }
}

impl Current {
    fn add(&mut self, topic: &Topic) -> Result<(), TapeError> {
        let id = self.writer.add_topic(topic).map_err(write_error(&self.path))?;
        self.ids.insert(topic.name.clone(), id);
        Ok(())
    }
}

/// Finishes what an earlier recorder left in the folder; gives its files and what was done to them.
fn take_over(folder: &Path) -> Result<(Vec<Finished>, Vec<String>), TapeError> {
    let paths = list_files(folder)?;
    if paths.is_empty() {
        return Ok((Vec::new(), Vec::new()));
    }
    // Only the last file can be unfinished unless the folder was tampered with; whole ones are merely opened.
    let whole = |path: &PathBuf| {
        let file = File::open(path).ok()?;
        Some(BagReader::open(file, Limits::default()).ok()?.contents().clone())
    };
    let name_of = |path: &Path| path.file_name().unwrap_or_default().to_string_lossy().into_owned();
    let opened: Vec<_> = paths.iter().map(whole).collect();
    if opened.iter().all(Option::is_some) {
        let files = paths.iter().zip(opened).filter_map(|(path, contents)| Some((name_of(path), contents?)));
        return Ok((files.collect(), Vec::new()));
    }
    let mut notes = Vec::new();
    let mut files = Vec::new();
    for file in recover_in_place(folder)? {
        let name = name_of(&file.path);
        let messages = file.contents.message_count;
        match file.outcome {
            Recovered::Whole => {}
            Recovered::Finished => notes.push(format!("finished {name} of an earlier recording: {messages} messages")),
            Recovered::Salvaged { damage, original } => notes.push(format!(
                "saved {messages} messages of {name}, the rest is in {}: {}",
                original.display(),
                damage.join("; ")
            )),
        }
        files.push((name, file.contents));
    }
    Ok((files, notes))
}

fn begin_file(settings: &TapeSettings, index: u64) -> Result<Current, TapeError> {
    let name = file_name(&settings.folder, index);
    let path = settings.folder.join(&name);
    let io = |source| BagFilesError::Io { what: "create", path: path.clone(), source };
    let file = File::create_new(&path).map_err(io)?;
    let kept = file.try_clone().map_err(io)?;
    let options = WriterOptions { compression: settings.compression, ..WriterOptions::default() };
    let mut writer = BagWriter::new(BufWriter::new(file), &options).map_err(write_error(&path))?;
    let record = MetadataRecord {
        name: "apprentice".to_owned(),
        values: BTreeMap::from([
            ("version".to_owned(), env!("CARGO_PKG_VERSION").to_owned()),
            ("commit".to_owned(), settings.commit.clone()),
            ("recording started".to_owned(), utc_text(settings.start_ns)),
        ]),
    };
    writer.add_metadata(&record).map_err(write_error(&path))?;
    Ok(Current { name, path, writer, file: kept, ids: BTreeMap::new() })
}

fn finish_file(mut current: Current, keepsakes: &Keepsakes) -> Result<Finished, TapeError> {
    let failed = || write_error(&current.path);
    let nodes = keepsakes.metadata();
    if !nodes.values.is_empty() {
        current.writer.add_metadata(&nodes).map_err(failed())?;
    }
    let (_, contents) = current.writer.finish().map_err(failed())?;
    current.file.sync_all().map_err(BagError::Write).map_err(failed())?;
    Ok((current.name, contents))
}

fn write_error(path: &Path) -> impl FnOnce(BagError) -> TapeError + use<> {
    let path = path.to_owned();
    move |source| TapeError::Write { path, source }
}
