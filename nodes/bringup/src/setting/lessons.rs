//! One lesson as a process of its own.

use super::{Lesson, Outcome, SettingError};
use rustix::process::{Pid, Signal, kill_process};
use scene::Point;
use serde::Deserialize;
use signal_hook::consts::{SIGHUP, SIGINT, SIGTERM};
use signal_hook::iterator::Signals;
use std::io::Read;
use std::os::unix::process::{CommandExt, ExitStatusExt};
use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::Duration;

/// How often the process and the signals are looked at.
const POLL: Duration = Duration::from_millis(50);
/// A longer summary is none.
const MAX_SUMMARY: u64 = 1 << 20;

/// Where the files of a lesson are.
#[derive(Debug, Clone)]
pub(crate) struct Files {
    /// Of the session.
    pub session: PathBuf,
    /// What makes the lesson about its thing.
    pub parameters: PathBuf,
    /// How it ended.
    pub summary: PathBuf,
}

impl Files {
    /// In the folder of a setting.
    pub fn of(folder: &Path, lesson: &Lesson) -> Self {
        let name = format!("{}-{}", lesson.number, plain(&lesson.id));
        Self {
            parameters: folder.join(format!("{name}.yaml")),
            summary: folder.join(format!("{name}.json")),
            session: folder.join(name),
        }
    }
}

/// An id as part of a file's name.
fn plain(id: &str) -> String {
    id.chars().take(64).map(|c| if c.is_ascii_alphanumeric() || "-_".contains(c) { c } else { '_' }).collect()
}

/// What the summary of a lesson says, of all that stands there.
#[derive(Debug, Deserialize)]
struct Summary {
    state: String,
    why: String,
    questions_asked: u64,
    last_bound_m: Option<f64>,
    placement_m: Option<[f64; 2]>,
    placed: Option<bool>,
    placed_reason: Option<String>,
}

/// How a lesson ended, and in words.
pub(crate) type Ending = (Outcome, String);

/// How a lesson ended, when its summary says that it did.
pub(crate) fn ending(files: &Files) -> Option<Ending> {
    let mut text = String::new();
    std::fs::File::open(&files.summary).ok()?.take(MAX_SUMMARY).read_to_string(&mut text).ok()?;
    let summary: Summary = serde_json::from_str(&text).ok()?;
    let questions = summary.questions_asked;
    match (summary.state.as_str(), summary.placement_m) {
        ("taught" | "finished", _) if summary.placed == Some(false) => {
            let why = summary.placed_reason.unwrap_or_default();
            Some((Outcome::Left, format!("left off: the robot did not put it there: {why}")))
        }
        ("taught" | "finished", Some([x, y])) if x.is_finite() && y.is_finite() => {
            let bound = summary
                .last_bound_m
                .map_or("without a bound".to_owned(), |m| format!("at worst {:.1} cm off", 100.0 * m));
            let words = format!("at ({x:.3}, {y:.3}) m, {bound}, {} after {questions} questions", summary.state);
            Some((Outcome::Placed(Point::new(x, y)), words))
        }
        ("taught" | "finished", _) => Some((Outcome::Left, "left off: the robot found no place for it".to_owned())),
        ("stopped" | "gave_up", _) => {
            Some((Outcome::Left, format!("left off after {questions} questions: {}", summary.why)))
        }
        _ => None,
    }
}

/// Runs a lesson to its end: `None` when it came to one, or the exit code when it was ended from outside.
pub(crate) fn run(
    executable: &Path,
    arguments: &[String],
    id: &str,
    files: &Files,
    signals: &mut Signals,
) -> Result<Option<i32>, SettingError> {
    // In a group of its own, so that each Ctrl-C reaches it once: through here.
    let mut child = Command::new(executable).args(arguments).process_group(0).spawn().map_err(SettingError::Start)?;
    let pid = Pid::from_child(&child);
    let status = loop {
        for signal in signals.pending().filter_map(Signal::from_named_raw) {
            // It may have ended this very moment.
            let _ = kill_process(pid, signal);
        }
        if let Some(status) = child.try_wait().map_err(SettingError::Start)? {
            break status;
        }
        std::thread::sleep(POLL);
    };
    let code = status.code().unwrap_or_else(|| 128 + status.signal().unwrap_or(0));
    match code {
        0 => Ok(None),
        _ if [SIGHUP, SIGINT, SIGTERM].contains(&(code - 128)) => Ok(Some(code)),
        _ => Err(SettingError::Lesson { id: id.to_owned(), code, logs: files.session.join("logs") }),
    }
}

#[cfg(test)]
mod tests {
    use super::{Files, Lesson, Outcome, ending};
    use scene::Point;

    #[test]
    fn only_a_lesson_that_is_over_has_an_ending() {
        let folder = tempfile::tempdir().expect("a folder");
        let lesson = Lesson { number: 2, id: "../tea cup".into(), label: "cup".into(), parameters: String::new() };
        let files = Files::of(folder.path(), &lesson);
        assert_eq!(files.session, folder.path().join("2-___tea_cup"));
        assert_eq!(ending(&files), None);
        let of = |state: &str, placement: &str| {
            let text = format!(
                "{{\"state\":\"{state}\",\"why\":\"w\",\"questions_asked\":3,\"last_bound_m\":0.05,\"placement_m\":{placement}}}"
            );
            std::fs::write(&files.summary, text).expect("writes");
            ending(&files).map(|(outcome, _)| outcome)
        };
        assert_eq!(of("taught", "[0.5,0.25]"), Some(Outcome::Placed(Point::new(0.5, 0.25))));
        assert_eq!(of("finished", "[0.5,0.25]"), Some(Outcome::Placed(Point::new(0.5, 0.25))));
        assert_eq!(of("taught", "null"), Some(Outcome::Left));
        assert_eq!(of("gave_up", "[0.5,0.25]"), Some(Outcome::Left));
        assert_eq!(of("asking", "[0.5,0.25]"), None);
        assert_eq!(of("taught", "[0.5"), None, "half a file says nothing");
    }
}
