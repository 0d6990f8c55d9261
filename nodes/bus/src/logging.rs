//! The process's logger: `[LEVEL] [node]: text` on standard error, and records for each node's `/rosout`.

use std::{
    cell::Cell,
    io::{IsTerminal, Write},
    sync::{
        Arc, Once, OnceLock, PoisonError, RwLock,
        atomic::{AtomicU64, Ordering},
        mpsc::SyncSender,
    },
};

use log::{Level, LevelFilter, Log, Metadata, Record};

/// Crates whose lines are shown only when debugging, and never go to `/rosout`.
const FOREIGN: &[&str] = &[
    "rustdds",
    "ros2_client",
    "mio",
    "polling",
    "async_io",
    "async_std",
    "smol",
    "cdr_encoding",
    "netdev",
    "hyper",
    "tungstenite",
    "tokio",
    "tower",
];

/// Longest text of one line, in bytes.
const MAX_TEXT_BYTES: usize = 16_000;

/// One line for `/rosout`.
#[derive(Debug, Clone)]
pub(crate) struct LogLine {
    pub(crate) level: Level,
    pub(crate) text: String,
    pub(crate) file: String,
    pub(crate) line: u32,
    pub(crate) function: String,
}

/// One node that logs.
pub(crate) struct NodeLog {
    id: u64,
    logger: String,
    level: LevelFilter,
    stderr: bool,
    rosout: Option<SyncSender<LogLine>>,
}

/// Keeps a node known to the logger until it is dropped.
pub(crate) struct Attached {
    id: u64,
}

static NODES: RwLock<Vec<Arc<NodeLog>>> = RwLock::new(Vec::new());
static NEXT_ID: AtomicU64 = AtomicU64::new(1);
static INSTALL: Once = Once::new();
static COLOURS: OnceLock<bool> = OnceLock::new();

thread_local! {
    /// The node that this thread works for; 0 for none.
    static CURRENT: Cell<u64> = const { Cell::new(0) };
}

/// Makes a node known and the logger the process's, unless another one already is.
/// The calling thread then works for this node.
pub(crate) fn attach(logger: &str, level: LevelFilter, stderr: bool, rosout: Option<SyncSender<LogLine>>) -> Attached {
    let id = NEXT_ID.fetch_add(1, Ordering::Relaxed);
    let mut nodes = NODES.write().unwrap_or_else(PoisonError::into_inner);
    nodes.push(Arc::new(NodeLog { id, logger: logger.to_owned(), level, stderr, rosout }));
    INSTALL.call_once(|| {
        // Another logger may have been installed first (a test harness); then that one is used.
        let _ = log::set_logger(&BusLogger);
    });
    log::set_max_level(nodes.iter().map(|node| node.level).max().unwrap_or(LevelFilter::Off));
    drop(nodes);
    let attached = Attached { id };
    attached.enter();
    attached
}

impl Attached {
    /// The calling thread works for this node from now on.
    pub(crate) fn enter(&self) {
        enter(self.id);
    }

    /// The node's number, for [`enter`] on other threads.
    pub(crate) fn id(&self) -> u64 {
        self.id
    }
}

impl Drop for Attached {
    fn drop(&mut self) {
        NODES.write().unwrap_or_else(PoisonError::into_inner).retain(|node| node.id != self.id);
    }
}

/// The calling thread works for the node with this number.
pub(crate) fn enter(id: u64) {
    CURRENT.with(|current| current.set(id));
}

/// The node that the calling thread works for, or the only one there is.
fn current() -> Option<Arc<NodeLog>> {
    let id = CURRENT.try_with(Cell::get).unwrap_or(0);
    let nodes = NODES.read().unwrap_or_else(PoisonError::into_inner);
    nodes.iter().find(|node| node.id == id).or_else(|| nodes.first().filter(|_| nodes.len() == 1)).cloned()
}

/// The process's logger.
struct BusLogger;

/// Whether a line comes from a crate of others.
fn is_foreign(target: &str) -> bool {
    let root = target.split("::").next().unwrap_or(target);
    FOREIGN.contains(&root)
}

impl Log for BusLogger {
    fn enabled(&self, metadata: &Metadata<'_>) -> bool {
        let level = current().map_or(LevelFilter::Info, |node| node.level);
        if is_foreign(metadata.target()) {
            // What matters to the user comes back as errors; these lines are for finding defects.
            (level >= LevelFilter::Debug && metadata.level() <= Level::Warn) || level >= LevelFilter::Trace
        } else {
            metadata.level() <= level
        }
    }

    fn log(&self, record: &Record<'_>) {
        if !self.enabled(record.metadata()) {
            return;
        }
        let node = current();
        let mut text = record.args().to_string();
        if text.len() > MAX_TEXT_BYTES {
            let end = (0..=MAX_TEXT_BYTES).rev().find(|end| text.is_char_boundary(*end)).unwrap_or(0);
            text.truncate(end);
            text.push('…');
        }
        if is_foreign(record.target()) {
            let logger = format!("{} ({})", logger_name(&node), record.target());
            write_stderr(record.level(), &logger, &text);
            return;
        }
        if node.as_ref().is_none_or(|node| node.stderr) {
            write_stderr(record.level(), &logger_name(&node), &text);
        }
        if let Some(rosout) = node.as_ref().and_then(|node| node.rosout.as_ref()) {
            // A full channel means that the graph is slower than the log; standard error has the line.
            let _ = rosout.try_send(LogLine {
                level: record.level(),
                text,
                file: record.file().unwrap_or_default().to_owned(),
                line: record.line().unwrap_or(0),
                function: record.module_path().unwrap_or_default().to_owned(),
            });
        }
    }

    fn flush(&self) {
        let _ = std::io::stderr().flush();
    }
}

/// What stands in the brackets.
fn logger_name(node: &Option<Arc<NodeLog>>) -> String {
    node.as_ref().map_or_else(|| "apprentice".to_owned(), |node| node.logger.clone())
}

/// Writes one line; colours only on a terminal that wants them.
fn write_stderr(level: Level, logger: &str, text: &str) {
    let colours = *COLOURS
        .get_or_init(|| std::io::stderr().is_terminal() && std::env::var_os("NO_COLOR").is_none_or(|no| no.is_empty()));
    let (name, colour) = match level {
        Level::Error => ("ERROR", "\x1b[31m"),
        Level::Warn => ("WARN", "\x1b[33m"),
        Level::Info => ("INFO", ""),
        Level::Debug => ("DEBUG", "\x1b[90m"),
        Level::Trace => ("TRACE", "\x1b[90m"),
    };
    let (start, end) = if colours && !colour.is_empty() { (colour, "\x1b[0m") } else { ("", "") };
    // A closed standard error is no reason to stop a robot.
    let _ = writeln!(std::io::stderr().lock(), "{start}[{name}] [{logger}]: {text}{end}");
}
