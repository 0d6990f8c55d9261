//! Keeps every line that the nodes of this process log, so that tests can count them.

use log::{Level, LevelFilter, Log, Metadata, Record};
use std::sync::{Mutex, Once, PoisonError};
use std::time::Duration;

static LINES: Mutex<Vec<(Level, String)>> = Mutex::new(Vec::new());
static INSTALL: Once = Once::new();

struct Keep;

impl Log for Keep {
    fn enabled(&self, _: &Metadata<'_>) -> bool {
        true
    }

    fn log(&self, record: &Record<'_>) {
        let line = (record.level(), record.args().to_string());
        LINES.lock().unwrap_or_else(PoisonError::into_inner).push(line);
    }

    fn flush(&self) {}
}

/// Takes the place of the nodes' own logger; to be called before the first node starts.
pub fn keep() {
    INSTALL.call_once(|| {
        log::set_logger(&Keep).expect("no node has installed its logger yet");
        log::set_max_level(LevelFilter::Info);
    });
}

/// The lines of warnings and errors that hold `part`.
pub fn warnings(part: &str) -> Vec<String> {
    let lines = LINES.lock().unwrap_or_else(PoisonError::into_inner);
    lines
        .iter()
        .filter(|(level, text)| *level <= Level::Warn && text.contains(part))
        .map(|(_, text)| text.clone())
        .collect()
}

/// The same, after waiting a little for the first: a node logs just after it has answered.
pub fn wait_for_warning(part: &str) -> Vec<String> {
    for _ in 0..500 {
        let told = warnings(part);
        if !told.is_empty() {
            return told;
        }
        std::thread::sleep(Duration::from_millis(10));
    }
    Vec::new()
}
