//! Sessions that were recorded before: which there are, and what was said in them.

use crate::protocol::RecordingView;
use apprentice_msgs::msg::EvidenceLog;
use apprentice_msgs::{Message, from_cdr};
use bag_files::open_bag;
use std::path::{Path, PathBuf};

/// Entries of the folder that are looked at, at most.
const MAX_ENTRIES: usize = 2000;
/// Recordings that are offered, the newest.
const MAX_OFFERED: usize = 100;
/// Where a session keeps its bag.
const OF_SESSION: &str = "bag";

/// The recordings in a folder, the newest first: bags, and sessions with a bag. None where the folder cannot be read.
pub(crate) fn list(folder: &Path) -> Vec<RecordingView> {
    let entries = std::fs::read_dir(folder).into_iter().flatten().take(MAX_ENTRIES).flatten();
    let mut found: Vec<RecordingView> = entries
        .filter_map(|entry| {
            let name = entry.file_name().into_string().ok()?;
            let bag = open_bag(&bag_of(&entry.path())).ok()?;
            // What holds no evidence has nothing to offer.
            bag.topics().iter().find(|found| found.topic.type_name == EvidenceLog::TYPE)?;
            let seconds = |ns: u64| ns as f64 / 1e9;
            Some(RecordingView {
                name,
                began_s: bag.metadata.start.map(seconds),
                duration_s: seconds(bag.metadata.duration),
                bytes: bag.files.iter().map(|file| file.bytes).sum(),
            })
        })
        .collect();
    found
        .sort_by(|a, b| f64::total_cmp(&b.began_s.unwrap_or(0.0), &a.began_s.unwrap_or(0.0)).then(a.name.cmp(&b.name)));
    found.truncate(MAX_OFFERED);
    found
}

/// Everything that was said in a recording of the folder: the longest log of evidence in it.
///
/// # Errors
/// In a sentence: no such recording, a damaged one, or one of several lessons.
pub(crate) fn read(folder: &Path, name: &str) -> Result<EvidenceLog, String> {
    // Only what stands in the folder itself can be named.
    let is_plain = Path::new(name).file_name().is_some_and(|only| only == name);
    if !is_plain {
        return Err(format!("'{}' is no name of a recording", name.chars().take(64).collect::<String>()));
    }
    let bag = open_bag(&bag_of(&folder.join(name))).map_err(|error| error.to_string())?;
    let mut longest: Option<(String, EvidenceLog)> = None;
    for message in bag.messages() {
        let message = message.map_err(|error| error.to_string())?;
        if message.topic.type_name != EvidenceLog::TYPE {
            continue;
        }
        let topic = &message.topic.name;
        let log: EvidenceLog = from_cdr(&message.data).map_err(|error| format!("{topic} cannot be read: {error}"))?;
        match &longest {
            Some((of, _)) if of != topic => {
                return Err(format!("it holds two lessons, on {of} and on {topic}; a page takes up only one"));
            }
            Some((_, known)) if known.records.len() >= log.records.len() => {}
            _ => longest = Some((topic.clone(), log)),
        }
    }
    longest.map(|(_, log)| log).ok_or_else(|| "nothing was said in it".to_owned())
}

/// A session's bag, or the bag itself.
fn bag_of(path: &Path) -> PathBuf {
    let of_session = path.join(OF_SESSION);
    if of_session.is_dir() { of_session } else { path.to_owned() }
}

#[cfg(test)]
mod tests {
    use super::{list, read};
    use std::path::Path;

    #[test]
    fn only_recordings_in_the_folder_can_be_named() {
        let folder = Path::new(env!("CARGO_MANIFEST_DIR"));
        for name in ["", ".", "..", "../operator_ui", "/etc", "src/../src", "a/b"] {
            assert!(read(folder, name).is_err(), "{name}");
        }
        assert!(read(folder, "src").expect_err("no bag").contains("src"));
        assert!(list(folder).is_empty() && list(Path::new("/nowhere/at/all")).is_empty());
    }
}
