//! The folder of a session: everything needed to look at it, replay it, or go on with it.

use crate::{BringupError, Scenario, Settings};
use serde::{Deserialize, Serialize};
use std::fs::{File, TryLockError};
use std::io::Write;
use std::path::{Path, PathBuf};

const DEFAULT_SCENARIO: &str = "flowers";
const DEFAULT_SEED: i64 = 1;
/// Written before the first node starts.
const OWN_FILES: [&str; 4] = ["session.json", "session.yaml", "parameters.yaml", "session.lock"];

/// What a session was begun with (session.json).
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct SessionRecord {
    /// The scenario's name or path.
    pub scenario: String,
    /// The seed of every node.
    pub seed: i64,
    /// Version of the executable.
    pub version: String,
}

/// An open session; no other process has it.
#[derive(Debug)]
pub struct Session {
    /// The folder.
    pub dir: PathBuf,
    /// What it was begun with.
    pub record: SessionRecord,
    /// Whether it had been begun before.
    pub resumed: bool,
    /// Locked while the session is open.
    _lock: File,
}

impl Session {
    /// Begins a session, or goes on with the one in the folder; `stamp` names a new folder.
    ///
    /// # Errors
    /// When the folder cannot be used, holds something else, is in use, or was begun with another scenario or seed.
    pub fn open(settings: &Settings, stamp: &str) -> Result<Self, BringupError> {
        let dir = match settings.session.as_str() {
            "" => unused(&Path::new("bags").join(format!("session-{stamp}"))),
            given => PathBuf::from(given),
        };
        let unwritable = |source| BringupError::Write { path: dir.clone(), source };
        std::fs::create_dir_all(dir.join("logs")).map_err(unwritable)?;
        let lock = File::create(dir.join("session.lock")).map_err(unwritable)?;
        lock.try_lock().map_err(|error| match error {
            TryLockError::WouldBlock => BringupError::InUse { path: dir.clone() },
            TryLockError::Error(source) => unwritable(source),
        })?;
        let known = read_record(&dir);
        let resumed = known.is_some();
        let record = match known {
            Some(record) => continued(&dir, settings, record)?,
            None => begun(&dir, settings)?,
        };
        Ok(Self { dir, record, resumed, _lock: lock })
    }

    /// Takes back a beginning from which nothing came, so that the folder can begin otherwise; a continued session stays.
    pub fn abandon(self) {
        if self.resumed {
            return;
        }
        // What cannot be removed is left; the next beginning says what it thinks of it.
        for name in OWN_FILES {
            let _ = std::fs::remove_file(self.dir.join(name));
        }
        let _ = std::fs::remove_dir(self.dir.join("logs"));
        let _ = std::fs::remove_dir(&self.dir);
    }

    /// A file or folder of the session.
    pub fn path(&self, name: &str) -> PathBuf {
        self.dir.join(name)
    }
}

fn read_record(dir: &Path) -> Option<SessionRecord> {
    let text = std::fs::read_to_string(dir.join("session.json")).ok()?;
    serde_json::from_str(&text).ok()
}

/// Settings that are given must be the ones that the session was begun with.
fn continued(dir: &Path, settings: &Settings, record: SessionRecord) -> Result<SessionRecord, BringupError> {
    let differs = |name, was: String, got: String| BringupError::OtherSession { path: dir.to_owned(), name, was, got };
    if !settings.scenario.is_empty() && settings.scenario != record.scenario {
        return Err(differs("scenario", record.scenario, settings.scenario.clone()));
    }
    if settings.seed >= 0 && settings.seed != record.seed {
        return Err(differs("seed", record.seed.to_string(), settings.seed.to_string()));
    }
    Ok(record)
}

fn begun(dir: &Path, settings: &Settings) -> Result<SessionRecord, BringupError> {
    if is_occupied(dir) {
        return Err(BringupError::NotASession { path: dir.to_owned() });
    }
    let name = if settings.scenario.is_empty() { DEFAULT_SCENARIO } else { settings.scenario.as_str() };
    let scenario = Scenario::find(name)?;
    let record = SessionRecord {
        scenario: scenario.name,
        seed: if settings.seed < 0 { DEFAULT_SEED } else { settings.seed },
        version: env!("CARGO_PKG_VERSION").to_owned(),
    };
    let json = serde_json::to_string_pretty(&record).expect("a record of strings and a number is JSON") + "\n";
    // The record comes last: a folder without it was never begun.
    for (name, text) in [("parameters.yaml", &scenario.text), ("session.json", &json)] {
        let path = dir.join(name);
        write_whole(&path, text).map_err(|source| BringupError::Write { path, source })?;
    }
    Ok(record)
}

/// Whether a folder holds anything that `open` did not just make; what an aborted beginning left does not count.
fn is_occupied(dir: &Path) -> bool {
    let ours = |name: &std::ffi::OsStr| name == "logs" || OWN_FILES.iter().any(|own| name == *own);
    std::fs::read_dir(dir).is_ok_and(|entries| entries.flatten().any(|entry| !ours(&entry.file_name())))
}

/// The path, or the path with the first of -2, -3, … that does not exist.
pub(crate) fn unused(path: &Path) -> PathBuf {
    let numbered = |n: u32| PathBuf::from(format!("{}-{n}", path.display()));
    if path.exists() { (2..).map(numbered).find(|path| !path.exists()).unwrap_or_default() } else { path.to_owned() }
}

/// Writes a file so that a reader sees all of it or nothing.
pub(crate) fn write_whole(path: &Path, text: &str) -> std::io::Result<()> {
    let mut name = path.file_name().unwrap_or_default().to_owned();
    name.push(".part");
    let part = path.with_file_name(name);
    let mut file = File::create(&part)?;
    file.write_all(text.as_bytes())?;
    file.sync_all()?;
    std::fs::rename(&part, path)
}

#[cfg(test)]
mod tests {
    use super::Session;
    use crate::Settings;

    fn at(dir: &std::path::Path) -> Settings {
        Settings { session: dir.to_string_lossy().into_owned(), ..Settings::default() }
    }

    #[test]
    fn a_session_is_continued_as_it_was_begun_and_by_one_at_a_time() {
        let root = tempfile::tempdir().expect("a folder");
        let dir = root.path().join("a/b");
        let begun = Settings { scenario: "spoon".to_owned(), seed: 9, ..at(&dir) };
        let first = Session::open(&begun, "").expect("begins");
        assert!(!first.resumed);
        assert!(Session::open(&at(&dir), "").expect_err("locked").to_string().contains("in use"));
        drop(first);
        let again = Session::open(&at(&dir), "").expect("goes on");
        assert!(again.resumed);
        assert_eq!((again.record.scenario.as_str(), again.record.seed), ("spoon", 9));
        drop(again);
        for (settings, wanted) in [
            (Settings { seed: 8, ..at(&dir) }, "seed 9, not 8"),
            (Settings { scenario: "flowers".to_owned(), ..at(&dir) }, "scenario spoon, not flowers"),
        ] {
            let error = Session::open(&settings, "").expect_err("another session").to_string();
            assert!(error.contains(wanted), "{error}");
        }
    }

    #[test]
    fn an_abandoned_beginning_leaves_nothing_and_a_continued_session_everything() {
        let root = tempfile::tempdir().expect("a folder");
        let dir = root.path().join("s");
        Session::open(&at(&dir), "").expect("begins").abandon();
        assert!(!dir.exists());
        drop(Session::open(&at(&dir), "").expect("begins"));
        Session::open(&at(&dir), "").expect("goes on").abandon();
        assert!(dir.join("session.json").exists());
    }

    #[test]
    fn a_folder_with_other_things_in_it_is_left_alone() {
        let root = tempfile::tempdir().expect("a folder");
        std::fs::write(root.path().join("thesis.tex"), "").expect("writes");
        let error = Session::open(&at(root.path()), "").expect_err("not a session").to_string();
        assert!(error.contains("not empty"), "{error}");
        assert!(!root.path().join("parameters.yaml").exists());
    }
}
