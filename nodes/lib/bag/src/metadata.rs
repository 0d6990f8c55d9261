//! What rosbag2's `metadata.yaml` says about a folder of bag files.

use std::path::{Component, Path};

use crate::metadata_yaml;

/// Most bytes of `metadata.yaml` that are parsed.
const MAX_BYTES: usize = 4 << 20;
/// Versions of the format that are read.
const VERSIONS: std::ops::RangeInclusive<u32> = 1..=9;

/// Why a `metadata.yaml` cannot be used.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum MetadataError {
    /// Not the YAML rosbag2 writes.
    #[error("metadata.yaml is not what rosbag2 writes: {0}")]
    Malformed(String),
    /// Longer than any real one.
    #[error("metadata.yaml is {got} bytes long, at most {limit} are read")]
    TooLong {
        /// Its length in bytes.
        got: usize,
        /// The longest read.
        limit: usize,
    },
    /// A version of the format this crate does not know.
    #[error("metadata.yaml has version {got}, expected 1 to 9")]
    Version {
        /// Its version.
        got: u32,
    },
    /// Another storage than MCAP.
    #[error("the bag is stored as '{got}', expected 'mcap'; `ros2 bag convert` makes one of the other")]
    Storage {
        /// Its storage.
        got: String,
    },
    /// Whole files or single messages are compressed, which MCAP does better by chunk.
    #[error("the bag is compressed by {mode} with '{format}', which is not supported; `ros2 bag convert` unpacks it")]
    Compressed {
        /// rosbag2's compression mode.
        mode: String,
        /// rosbag2's compression format.
        format: String,
    },
    /// A file path that leads out of the bag's folder.
    #[error("metadata.yaml names the file '{path}', expected a path inside the bag's own folder")]
    PathOutside {
        /// The path.
        path: String,
    },
}

/// One topic of a folder.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct TopicMetadata {
    /// Fully qualified name.
    pub name: String,
    /// `pkg/msg/Name`.
    pub type_name: String,
    /// `cdr` in ROS 2.
    pub serialization_format: String,
    /// The publishers' QoS as YAML text; empty where unknown.
    pub offered_qos_profiles: String,
    /// Messages in all files.
    pub message_count: u64,
}

/// One file of a folder.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct FileMetadata {
    /// Path relative to the folder.
    pub path: String,
    /// Log time of the first message in ns; `None` without messages.
    pub start: Option<u64>,
    /// From first to last message, in ns.
    pub duration: u64,
    /// Messages in the file.
    pub message_count: u64,
}

/// A folder of bag files. Lists each file once, in recording order.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct BagMetadata {
    /// Log time of the first message in ns; `None` without messages.
    pub start: Option<u64>,
    /// From first to last message, in ns.
    pub duration: u64,
    /// Messages in all files.
    pub message_count: u64,
    /// The topics.
    pub topics: Vec<TopicMetadata>,
    /// The files.
    pub files: Vec<FileMetadata>,
}

impl BagMetadata {
    /// Joins what is in each file of a folder.
    pub fn from_files<'a>(files: impl IntoIterator<Item = (&'a str, &'a crate::Contents)>) -> BagMetadata {
        let mut metadata = BagMetadata::default();
        let mut end = None;
        for (path, contents) in files {
            metadata.message_count += contents.message_count;
            metadata.start = earliest(metadata.start, contents.start);
            end = end.max(contents.end);
            for found in &contents.topics {
                metadata.add_topic(found);
            }
            metadata.files.push(FileMetadata {
                path: path.to_owned(),
                start: contents.start,
                duration: contents.duration(),
                message_count: contents.message_count,
            });
        }
        if let (Some(start), Some(end)) = (metadata.start, end) {
            metadata.duration = end.saturating_sub(start);
        }
        metadata.topics.sort_by(|a, b| a.name.cmp(&b.name));
        metadata
    }

    fn add_topic(&mut self, found: &crate::TopicContents) {
        if let Some(known) = self.topics.iter_mut().find(|known| known.name == found.topic.name) {
            known.message_count += found.message_count;
            return;
        }
        self.topics.push(TopicMetadata {
            name: found.topic.name.clone(),
            type_name: found.topic.type_name.clone(),
            serialization_format: found.topic.message_encoding.clone(),
            offered_qos_profiles: found.topic.offered_qos_text().to_owned(),
            message_count: found.message_count,
        });
    }

    /// The text of a version 5 `metadata.yaml`, which Humble and everything later reads.
    pub fn to_yaml(&self) -> String {
        metadata_yaml::emit(self)
    }

    /// Reads the text of any version from 1 to 9.
    ///
    /// # Errors
    /// When the text is too long, not such a file, of another storage, compressed as a whole, or names files outside its
    /// own folder.
    pub fn parse(text: &str) -> Result<BagMetadata, MetadataError> {
        if text.len() > MAX_BYTES {
            return Err(MetadataError::TooLong { got: text.len(), limit: MAX_BYTES });
        }
        let (metadata, head) = metadata_yaml::parse(text)?;
        if !VERSIONS.contains(&head.version) {
            return Err(MetadataError::Version { got: head.version });
        }
        if head.storage != "mcap" {
            return Err(MetadataError::Storage { got: head.storage });
        }
        if !head.compression_mode.is_empty() && !head.compression_mode.eq_ignore_ascii_case("none") {
            return Err(MetadataError::Compressed { mode: head.compression_mode, format: head.compression_format });
        }
        for file in &metadata.files {
            let inside = |part| matches!(part, Component::Normal(_) | Component::CurDir);
            if file.path.is_empty() || file.path.contains('\\') || !Path::new(&file.path).components().all(inside) {
                return Err(MetadataError::PathOutside { path: file.path.clone() });
            }
        }
        Ok(metadata)
    }
}

/// The earlier of two times, of which either may be missing.
fn earliest(a: Option<u64>, b: Option<u64>) -> Option<u64> {
    match (a, b) {
        (Some(a), Some(b)) => Some(a.min(b)),
        (a, b) => a.or(b),
    }
}
