//! The YAML of `metadata.yaml`: emitted as version 5, parsed in every version.

use std::fmt::Write as _;

use serde::Deserialize;

use crate::qos::first_line;
use crate::{BagMetadata, FileMetadata, MetadataError, TopicMetadata};

/// What rosbag2 writes as the start of a bag without messages.
const NO_START: i64 = i64::MAX;

/// The fields that only decide whether the bag can be read.
pub(crate) struct Head {
    pub(crate) version: u32,
    pub(crate) storage: String,
    pub(crate) compression_mode: String,
    pub(crate) compression_format: String,
}

#[derive(Deserialize)]
struct Document {
    rosbag2_bagfile_information: Information,
}

#[derive(Deserialize)]
struct Information {
    version: u32,
    storage_identifier: String,
    #[serde(default)]
    duration: Duration,
    #[serde(default)]
    starting_time: Start,
    #[serde(default)]
    message_count: u64,
    #[serde(default)]
    topics_with_message_count: Vec<TopicWithCount>,
    #[serde(default)]
    compression_format: String,
    #[serde(default)]
    compression_mode: String,
    relative_file_paths: Vec<String>,
    #[serde(default)]
    files: Vec<File>,
}

#[derive(Deserialize, Default, Clone, Copy)]
struct Duration {
    nanoseconds: i64,
}

#[derive(Deserialize, Clone, Copy)]
struct Start {
    nanoseconds_since_epoch: i64,
}

impl Default for Start {
    fn default() -> Start {
        Start { nanoseconds_since_epoch: NO_START }
    }
}

impl Start {
    fn time(self, message_count: u64) -> Option<u64> {
        let with_messages = message_count > 0 && self.nanoseconds_since_epoch != NO_START;
        u64::try_from(self.nanoseconds_since_epoch).ok().filter(|_| with_messages)
    }
}

#[derive(Deserialize)]
struct TopicWithCount {
    topic_metadata: TopicFields,
    #[serde(default)]
    message_count: u64,
}

#[derive(Deserialize)]
struct TopicFields {
    name: String,
    r#type: String,
    #[serde(default)]
    serialization_format: String,
    #[serde(default)]
    offered_qos_profiles: Qos,
}

/// A text up to version 8, a list since version 9.
#[derive(Deserialize)]
#[serde(untagged)]
enum Qos {
    Text(String),
    List(Vec<crate::OfferedQos>),
}

impl Default for Qos {
    fn default() -> Qos {
        Qos::Text(String::new())
    }
}

#[derive(Deserialize)]
struct File {
    path: String,
    #[serde(default)]
    starting_time: Start,
    #[serde(default)]
    duration: Duration,
    #[serde(default)]
    message_count: u64,
}

/// Parses the text without judging it.
pub(crate) fn parse(text: &str) -> Result<(BagMetadata, Head), MetadataError> {
    let document: Document =
        serde_saphyr::from_str(text).map_err(|error| MetadataError::Malformed(first_line(&error.to_string())))?;
    let info = document.rosbag2_bagfile_information;
    let span = |duration: Duration| u64::try_from(duration.nanoseconds).unwrap_or(0);
    let topics = info.topics_with_message_count.into_iter().map(|topic| TopicMetadata {
        name: topic.topic_metadata.name,
        type_name: topic.topic_metadata.r#type,
        serialization_format: topic.topic_metadata.serialization_format,
        offered_qos_profiles: match topic.topic_metadata.offered_qos_profiles {
            Qos::Text(text) => text,
            Qos::List(list) => crate::OfferedQos::list_to_yaml(&list),
        },
        message_count: topic.message_count,
    });
    // The paths are in `relative_file_paths` in every version; `files` adds counts to them.
    let files = info.relative_file_paths.into_iter().map(|path| {
        let known = info.files.iter().find(|file| file.path == path);
        FileMetadata {
            start: known.and_then(|file| file.starting_time.time(file.message_count)),
            duration: known.map_or(0, |file| span(file.duration)),
            message_count: known.map_or(0, |file| file.message_count),
            path,
        }
    });
    let metadata = BagMetadata {
        start: info.starting_time.time(info.message_count),
        duration: span(info.duration),
        message_count: info.message_count,
        topics: topics.collect(),
        files: files.collect(),
    };
    let head = Head {
        version: info.version,
        storage: info.storage_identifier,
        compression_mode: info.compression_mode,
        compression_format: info.compression_format,
    };
    Ok((metadata, head))
}

/// The text rosbag2's version 5 has, key by key.
pub(crate) fn emit(metadata: &BagMetadata) -> String {
    let mut text = String::from("rosbag2_bagfile_information:\n  version: 5\n  storage_identifier: mcap\n");
    let start = |start: Option<u64>| start.and_then(|ns| i64::try_from(ns).ok()).unwrap_or(NO_START);
    let mut line = |line: String| {
        writeln!(text, "  {line}").expect("writing to a string cannot fail");
    };
    line(format!("duration:\n    nanoseconds: {}", metadata.duration));
    line(format!("starting_time:\n    nanoseconds_since_epoch: {}", start(metadata.start)));
    line(format!("message_count: {}", metadata.message_count));
    line(list("topics_with_message_count", metadata.topics.is_empty()));
    for topic in &metadata.topics {
        line(format!("  - topic_metadata:\n        name: {}", quoted(&topic.name)));
        line(format!("      type: {}", quoted(&topic.type_name)));
        line(format!("      serialization_format: {}", quoted(&topic.serialization_format)));
        line(format!("      offered_qos_profiles: {}", quoted(&topic.offered_qos_profiles)));
        line(format!("    message_count: {}", topic.message_count));
    }
    line("compression_format: \"\"\n  compression_mode: \"\"".to_owned());
    line(list("relative_file_paths", metadata.files.is_empty()));
    for file in &metadata.files {
        line(format!("  - {}", quoted(&file.path)));
    }
    line(list("files", metadata.files.is_empty()));
    for file in &metadata.files {
        line(format!("  - path: {}", quoted(&file.path)));
        line(format!("    starting_time:\n        nanoseconds_since_epoch: {}", start(file.start)));
        line(format!("    duration:\n        nanoseconds: {}", file.duration));
        line(format!("    message_count: {}", file.message_count));
    }
    text
}

fn list(name: &str, empty: bool) -> String {
    if empty { format!("{name}: []") } else { format!("{name}:") }
}

/// A YAML string: bare where that is safe, else in double quotes with escapes.
fn quoted(text: &str) -> String {
    let first_is_safe = text.starts_with(|c: char| c.is_ascii_alphabetic() || c == '/');
    let plain = first_is_safe && text.chars().all(|c| c.is_ascii_alphanumeric() || "_/.-".contains(c));
    // A bare word could also be a YAML keyword, all of which lack '/' and '_'.
    if plain && (text.contains(['/', '_']) || text == "cdr") {
        return text.to_owned();
    }
    let mut quoted = String::from("\"");
    for c in text.chars() {
        match c {
            '"' => quoted.push_str("\\\""),
            '\\' => quoted.push_str("\\\\"),
            '\n' => quoted.push_str("\\n"),
            c if c.is_control() || c == '\u{2028}' || c == '\u{2029}' || c == '\u{feff}' => {
                write!(quoted, "\\U{:08x}", u32::from(c)).expect("writing to a string cannot fail");
            }
            c => quoted.push(c),
        }
    }
    quoted.push('"');
    quoted
}
