//! A node as an operating-system process of its own.

use crate::log_line::{each_line, parse};
use crate::{Console, Exit, Level};
use rustix::process::{Pid, Signal, WaitId, WaitIdOptions, kill_process, waitid};
use std::fs::{File, OpenOptions};
use std::io::Write;
use std::os::unix::process::{CommandExt, ExitStatusExt};
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::sync::mpsc::channel;
use std::sync::{Arc, Mutex, PoisonError};
use std::time::Duration;

/// A log file is begun anew when it would grow past this; one older file is kept.
const MAX_LOG_BYTES: u64 = 16 << 20;
/// After a process has ended, its last lines have this long to be read.
const LAST_WORDS: Duration = Duration::from_millis(300);
/// The page's address holds a secret and stays out of log files; bringup shows it itself.
const PAGE_ADDRESS: &str = "operator page: ";
const STACK_BYTES: usize = 256 << 10;

/// Where a node's lines go: all to its log file, those that matter to the terminal too.
#[derive(Debug)]
pub struct NodeLog {
    name: &'static str,
    console: Console,
    shown_from: Level,
    path: PathBuf,
    file: Mutex<Option<(File, u64)>>,
}

impl NodeLog {
    /// A log that appends to `<dir>/<name>.log`; without a writable file only the terminal is left.
    pub fn new(name: &'static str, dir: &Path, console: Console, shown_from: Level) -> Self {
        let path = dir.join(format!("{name}.log"));
        let file = open(&path).ok();
        Self { name, console, shown_from, path, file: Mutex::new(file) }
    }

    fn take(&self, line: &str) {
        if line.starts_with(PAGE_ADDRESS) {
            return;
        }
        let mut held = self.file.lock().unwrap_or_else(PoisonError::into_inner);
        if held.as_ref().is_some_and(|(_, bytes)| *bytes > MAX_LOG_BYTES) {
            *held = std::fs::rename(&self.path, self.path.with_extension("log.1")).and_then(|()| open(&self.path)).ok();
        }
        if let Some((file, bytes)) = held.as_mut() {
            *bytes += line.len() as u64 + 1;
            // A full disk must not end the lesson.
            let _ = writeln!(file, "{line}");
        }
        drop(held);
        let (level, text) = parse(line);
        if level >= self.shown_from && !line.is_empty() {
            self.console.log(self.name, level, text);
        }
    }
}

fn open(path: &Path) -> std::io::Result<(File, u64)> {
    let file = OpenOptions::new().create(true).append(true).open(path)?;
    let bytes = file.metadata()?.len();
    Ok((file, bytes))
}

/// A running process, or one that has ended and not been reaped.
#[derive(Debug)]
pub struct Child {
    process: std::process::Child,
}

impl Child {
    /// Starts a process in a process group of its own, so that the terminal's Ctrl-C reaches only its parent, and calls
    /// `ended` once when it has ended. Its lines go to the log.
    ///
    /// # Errors
    /// When the system cannot start it.
    pub fn start(
        executable: &Path,
        args: &[String],
        log: &Arc<NodeLog>,
        ended: impl FnOnce() + Send + 'static,
    ) -> std::io::Result<Self> {
        let mut process = Command::new(executable)
            .args(args)
            .env("APPRENTICE_PARENT_PID", std::process::id().to_string())
            .stdin(Stdio::null())
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .process_group(0)
            .spawn()?;
        let pid = Pid::from_child(&process);
        let (reading, read) = channel::<()>();
        if let Some(stream) = process.stdout.take() {
            let (log, reading) = (Arc::clone(log), reading.clone());
            thread(move || {
                each_line(stream, |line| log.take(line));
                drop(reading);
            })?;
        }
        if let Some(stream) = process.stderr.take() {
            let log = Arc::clone(log);
            thread(move || {
                each_line(stream, |line| log.take(line));
                drop(reading);
            })?;
        }
        thread(move || {
            // Waits without reaping: the process keeps its id until `reap`, so that no signal can reach a stranger.
            let options = WaitIdOptions::EXITED | WaitIdOptions::NOWAIT;
            while let Err(rustix::io::Errno::INTR) = waitid(WaitId::Pid(pid), options) {}
            // Ends early when both readers have; something that the process started may hold its output open for longer.
            let _ = read.recv_timeout(LAST_WORDS);
            ended();
        })?;
        Ok(Self { process })
    }

    /// The process's id.
    pub fn id(&self) -> u32 {
        self.process.id()
    }

    /// Asks the process to end.
    pub fn terminate(&self) {
        self.signal(Signal::TERM);
    }

    /// Ends the process.
    pub fn kill(&self) {
        self.signal(Signal::KILL);
    }

    fn signal(&self, signal: Signal) {
        // Until it is reaped the process exists, so the only error left is one of permission, which waiting shows.
        let _ = kill_process(Pid::from_child(&self.process), signal);
    }

    /// How an ended process ended.
    pub fn reap(mut self) -> Exit {
        match self.process.wait() {
            Ok(status) => match (status.code(), status.signal()) {
                (Some(code), _) => Exit::Code(code),
                (None, Some(signal)) => Exit::Signal(signal),
                (None, None) => Exit::NotStarted(status.to_string()),
            },
            Err(error) => Exit::NotStarted(error.to_string()),
        }
    }
}

fn thread(work: impl FnOnce() + Send + 'static) -> std::io::Result<()> {
    std::thread::Builder::new().stack_size(STACK_BYTES).spawn(work).map(drop)
}
