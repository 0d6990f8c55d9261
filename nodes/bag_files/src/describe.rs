//! What `apprentice bag info` says, as a table or as JSON.

use std::collections::BTreeMap;
use std::fmt::{self, Display, Formatter};

use bag::MetadataRecord;
use serde::Serialize;

use crate::{OpenBag, utc_text};

/// One topic, described.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct TopicInfo {
    /// Fully qualified name.
    pub name: String,
    /// `pkg/msg/Name`.
    pub type_name: String,
    /// Messages in the bag.
    pub message_count: u64,
    /// How they are encoded; `cdr` in ROS 2.
    pub encoding: String,
    /// Reliability and durability of each recorded publisher, in words.
    pub qos: Vec<String>,
    /// Whether the bag explains the type.
    pub has_schema: bool,
}

/// A bag, described. Prints as a table; serializes as JSON.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct BagInfo {
    /// The path it was opened by.
    pub path: String,
    /// Its files.
    pub files: Vec<String>,
    /// Size of all files in bytes.
    pub bytes: u64,
    /// Log time of the first message, ns since 1970.
    pub start_ns: Option<u64>,
    /// From first to last message, in ns.
    pub duration_ns: u64,
    /// All messages.
    pub message_count: u64,
    /// The topics, by name.
    pub topics: Vec<TopicInfo>,
    /// Names of the attachments.
    pub attachments: Vec<String>,
    /// Metadata records: name, then entries.
    pub metadata: Vec<(String, BTreeMap<String, String>)>,
    /// What is wrong, one line each.
    pub damage: Vec<String>,
}

impl BagInfo {
    /// Describes an opened bag.
    pub fn of(bag: &OpenBag) -> BagInfo {
        let mut damage: Vec<_> = bag.damage().map(|(path, damage)| format!("{}: {damage}", path.display())).collect();
        let attachments = bag.attachments().unwrap_or_else(|error| {
            damage.push(error.to_string());
            Vec::new()
        });
        let topics = bag.topics().into_iter().map(|found| TopicInfo {
            name: found.topic.name.clone(),
            type_name: found.topic.type_name.clone(),
            message_count: found.message_count,
            encoding: found.topic.message_encoding.clone(),
            qos: match found.topic.offered_qos() {
                Ok(all) => all.iter().map(|qos| format!("{:?}, {:?}", qos.reliability, qos.durability)).collect(),
                Err(error) => vec![error.to_string()],
            },
            has_schema: !found.topic.schema.is_empty(),
        });
        BagInfo {
            path: bag.path.display().to_string(),
            files: bag.files.iter().map(|file| file.path.display().to_string()).collect(),
            bytes: bag.files.iter().map(|file| file.bytes).sum(),
            start_ns: bag.metadata.start,
            duration_ns: bag.metadata.duration,
            message_count: bag.metadata.message_count,
            topics: topics.collect(),
            attachments: attachments.into_iter().map(|attachment| attachment.name).collect(),
            metadata: distinct(bag.files.iter().flat_map(|file| &file.metadata)),
            damage,
        }
    }

    /// The description as indented JSON.
    pub fn to_json(&self) -> String {
        serde_json::to_string_pretty(self).expect("strings and numbers always serialize")
    }
}

/// The records without repetitions: every file of a split bag starts with the same ones.
fn distinct<'a>(records: impl Iterator<Item = &'a MetadataRecord>) -> Vec<(String, BTreeMap<String, String>)> {
    let mut distinct = Vec::new();
    for record in records.map(|record| (record.name.clone(), record.values.clone())) {
        if !distinct.contains(&record) {
            distinct.push(record);
        }
    }
    distinct
}

/// Text from a bag for a terminal: without control characters, and not longer than a line.
fn plain(text: &str) -> String {
    const MAX_CHARS: usize = 100;
    let mut plain: String = text.chars().take(MAX_CHARS).flat_map(char::escape_debug).collect();
    if text.chars().nth(MAX_CHARS).is_some() {
        plain.push('…');
    }
    plain
}

impl Display for BagInfo {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        writeln!(f, "bag       {}", self.path)?;
        for file in &self.files {
            writeln!(f, "file      {file}")?;
        }
        writeln!(f, "size      {:.1} kB", self.bytes as f64 / 1e3)?;
        if let Some(start) = self.start_ns {
            writeln!(f, "start     {}", utc_text(start))?;
        }
        writeln!(f, "duration  {:.3} s", self.duration_ns as f64 / 1e9)?;
        writeln!(f, "messages  {}", self.message_count)?;
        let width = |of: fn(&TopicInfo) -> &str| self.topics.iter().map(|topic| of(topic).len()).max().unwrap_or(0);
        let (names, types) = (width(|topic| &topic.name), width(|topic| &topic.type_name));
        for topic in &self.topics {
            let (name, type_name, count) = (plain(&topic.name), plain(&topic.type_name), topic.message_count);
            let qos = topic.qos.join("; ");
            writeln!(f, "{}", format!("topic     {name:names$}  {type_name:types$}  {count:>8}  {qos}").trim_end())?;
        }
        for attachment in &self.attachments {
            writeln!(f, "attached  {}", plain(attachment))?;
        }
        for (name, entries) in &self.metadata {
            let entries: Vec<_> =
                entries.iter().map(|(key, value)| format!("{}={}", plain(key), plain(value))).collect();
            writeln!(f, "metadata  {}: {}", plain(name), entries.join(", "))?;
        }
        for damage in &self.damage {
            writeln!(f, "WARNING   {damage}")?;
        }
        Ok(())
    }
}
