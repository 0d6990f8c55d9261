//! One running `apprentice`, with a session folder and a DDS domain of its own; one at a time on this machine.

use apprentice_msgs::msg::EvidenceRecord;
use reward_posterior::{Entry, read_journal};
use rustix::process::{Pid, Signal, kill_process};
use std::fs::{self, File};
use std::io::{BufRead, BufReader, Read};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, ExitStatus, Output, Stdio};
use std::sync::atomic::{AtomicU32, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

static ONE_AT_A_TIME: Mutex<()> = Mutex::new(());
static STARTED: AtomicU32 = AtomicU32::new(0);

/// Cyclone DDS on loopback, where lessons are.
pub const LOOPBACK: &str = "<CycloneDDS><Domain><General><Interfaces><NetworkInterface name=\"lo\" multicast=\"true\"/></Interfaces></General></Domain></CycloneDDS>";

/// Parameters of a lesson about a table that does not end: the bound is out of reach.
pub const ENDLESS: &str = "/**:
  reward_posterior:
    ros__parameters:
      n_draws: 2000
  active_query:
    ros__parameters:
      epsilon_m: 0.001
      max_questions: 10000
      n_candidates: 10
";

/// How long a poll waits before it looks again.
const POLL: Duration = Duration::from_millis(20);

/// The right to run a suite: two cores hold one, and figures of two would disturb each other.
pub struct Turn {
    _here: MutexGuard<'static, ()>,
    _machine: File,
}

impl Turn {
    /// Waits for it.
    pub fn take() -> Turn {
        let here = ONE_AT_A_TIME.lock().unwrap_or_else(PoisonError::into_inner);
        let machine = File::create(folder("").join("turn.lock")).expect("the folder of the tests can be written");
        machine.lock().expect("files can be locked");
        Turn { _here: here, _machine: machine }
    }
}

/// A folder of this run below `target`, which stays for people to look at; an old one is removed.
pub fn fresh_folder(name: &str) -> PathBuf {
    let path = folder(name);
    fs::remove_dir_all(&path).expect("an old folder can be removed");
    folder(name)
}

fn folder(name: &str) -> PathBuf {
    let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join("end_to_end").join(name);
    fs::create_dir_all(&path).expect("the folder of the tests can be written");
    path
}

/// A DDS domain that no other suite of this run uses.
pub fn fresh_domain() -> u32 {
    // Up to 100, so that no port lies among the ephemeral ones.
    1 + (std::process::id() + 7 * STARTED.fetch_add(1, Ordering::Relaxed)) % 99
}

/// `apprentice` in a domain, on loopback.
pub fn apprentice(domain: u32, arguments: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_apprentice"));
    command
        .args(arguments)
        .env("ROS_DOMAIN_ID", domain.to_string())
        .env("ROS_AUTOMATIC_DISCOVERY_RANGE", "LOCALHOST")
        .env("NO_COLOR", "1")
        .env_remove("RMW_IMPLEMENTATION")
        .stdin(Stdio::null());
    command
}

/// Runs `apprentice` to its end, which must come soon.
pub fn run(arguments: &[&str]) -> Output {
    let mut process = Process::start(apprentice(fresh_domain(), arguments), &arguments.join(" "));
    let status = process.wait(Duration::from_secs(120));
    let (stdout, stderr) = process.output();
    Output { status, stdout: stdout.into_bytes(), stderr: stderr.into_bytes() }
}

/// A child process whose words are kept. Dropping it kills it.
pub struct Process {
    what: String,
    child: Child,
    words: [Arc<Mutex<String>>; 2],
    readers: Vec<std::thread::JoinHandle<()>>,
}

impl Process {
    /// Starts it; `what` names it in failures.
    pub fn start(mut command: Command, what: &str) -> Process {
        let mut child = command
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .unwrap_or_else(|error| panic!("cannot start {what}: {error}"));
        let streams: [Option<Box<dyn Read + Send>>; 2] = [
            child.stdout.take().map(|stream| Box::new(stream) as Box<dyn Read + Send>),
            child.stderr.take().map(|stream| Box::new(stream) as Box<dyn Read + Send>),
        ];
        let words: [Arc<Mutex<String>>; 2] = Default::default();
        let keep = |(stream, words): (Option<Box<dyn Read + Send>>, &Arc<Mutex<String>>)| {
            let (stream, words) = (stream.expect("both streams are piped"), Arc::clone(words));
            std::thread::spawn(move || {
                for line in BufReader::new(stream).split(b'\n').map_while(Result::ok) {
                    let mut words = words.lock().unwrap_or_else(PoisonError::into_inner);
                    words.push_str(&String::from_utf8_lossy(&line));
                    words.push('\n');
                }
            })
        };
        let readers = streams.into_iter().zip(&words).map(keep).collect();
        Process { what: what.to_owned(), child, words, readers }
    }

    /// Standard output and standard error so far.
    pub fn output(&self) -> (String, String) {
        let read = |i: usize| self.words[i].lock().unwrap_or_else(PoisonError::into_inner).clone();
        (read(0), read(1))
    }

    /// Its process number.
    pub fn pid(&self) -> Pid {
        Pid::from_child(&self.child)
    }

    /// Whether it has ended.
    pub fn ended(&mut self) -> Option<ExitStatus> {
        self.child.try_wait().expect("a child can be waited for")
    }

    /// Waits for its end.
    pub fn wait(&mut self, limit: Duration) -> ExitStatus {
        let start = now();
        loop {
            if let Some(status) = self.ended() {
                for reader in self.readers.drain(..) {
                    // A grandchild may hold the pipe; its words are not waited for.
                    if reader.is_finished() || start.elapsed() < limit {
                        wait_a_little_for(&reader);
                    }
                }
                return status;
            }
            assert!(start.elapsed() < limit, "{} did not end in {limit:?}\n{}", self.what, self.dump());
            std::thread::sleep(POLL);
        }
    }

    /// What it said, for failures.
    pub fn dump(&self) -> String {
        let (stdout, stderr) = self.output();
        format!("--- {}: stdout\n{}--- stderr\n{}", self.what, tail(&stdout), tail(&stderr))
    }
}

fn wait_a_little_for(reader: &std::thread::JoinHandle<()>) {
    let start = now();
    while !reader.is_finished() && start.elapsed() < Duration::from_secs(2) {
        std::thread::sleep(POLL);
    }
}

impl Drop for Process {
    fn drop(&mut self) {
        if matches!(self.child.try_wait(), Ok(None)) {
            let _ = self.child.kill();
            let _ = self.child.wait();
        }
    }
}

/// A running lesson.
pub struct Suite {
    process: Process,
    /// The session's folder.
    pub session: PathBuf,
    /// Its DDS domain.
    pub domain: u32,
    _turn: Turn,
}

impl Suite {
    /// Starts a lesson in a fresh session folder named after the test.
    pub fn start(name: &str, arguments: &[&str]) -> Suite {
        let turn = Turn::take();
        let (session, domain) = (fresh_folder(name).join("session"), fresh_domain());
        let text = session.to_string_lossy().into_owned();
        let mut all = vec!["--session", &text, "--port", "0"];
        all.extend(arguments);
        let process = Process::start(apprentice(domain, &all), name);
        Suite { process, session, domain, _turn: turn }
    }

    /// The address of the operator's page, once it is announced.
    pub fn page_url(&mut self) -> String {
        let url = self.wait_for("the page's address", Duration::from_secs(60), |suite| {
            fs::read_to_string(suite.session.join("page-url")).ok().filter(|url| url.starts_with("http"))
        });
        url.trim().to_owned()
    }

    /// Every event that the journal holds, accepted in this order.
    pub fn journal(&self) -> Vec<EvidenceRecord> {
        let bytes = fs::read(self.session.join("evidence.journal")).unwrap_or_default();
        let (entries, _) = read_journal(&bytes).expect("the journal is whole");
        let record = |entry| if let Entry::Record(record) = entry { Some(*record) } else { None };
        entries.into_iter().filter_map(record).collect()
    }

    /// The bag's folder.
    pub fn bag(&self) -> PathBuf {
        self.session.join("bag")
    }

    /// What the terminal shows so far.
    pub fn shown(&self) -> String {
        let (stdout, stderr) = self.process.output();
        stdout + &stderr
    }

    /// Waits until `look` finds what is wanted.
    pub fn wait_for<T>(&mut self, what: &str, limit: Duration, mut look: impl FnMut(&Suite) -> Option<T>) -> T {
        let start = now();
        loop {
            if let Some(found) = look(self) {
                return found;
            }
            if let Some(status) = self.process.ended() {
                panic!("the lesson ended ({status}) before {what}\n{}", self.dump());
            }
            assert!(start.elapsed() < limit, "waited {limit:?} in vain for {what}\n{}", self.dump());
            std::thread::sleep(POLL);
        }
    }

    /// Waits for a lesson that ends by itself.
    pub fn wait(&mut self, limit: Duration) -> ExitStatus {
        let start = now();
        while self.process.ended().is_none() && start.elapsed() < limit {
            std::thread::sleep(POLL);
        }
        assert!(self.process.ended().is_some(), "the lesson did not end in {limit:?}\n{}", self.dump());
        self.process.wait(limit)
    }

    /// Asks the lesson to end by a signal, and waits until it has.
    pub fn stop(&mut self, signal: Signal) -> ExitStatus {
        kill_process(self.process.pid(), signal).expect("the suite runs");
        self.wait(Duration::from_secs(30))
    }

    /// The process of a node, if it runs.
    pub fn node(&self, name: &str) -> Option<Pid> {
        let is_it = |arguments: &[String]| arguments.get(1).is_some_and(|word| word == name);
        self.processes().into_iter().find(|(_, arguments)| is_it(arguments)).map(|(pid, _)| pid)
    }

    /// Kills a node the hard way.
    pub fn kill(&self, name: &str) -> Pid {
        let pid = self.node(name).unwrap_or_else(|| panic!("{name} does not run\n{}", self.dump()));
        kill_process(pid, Signal::KILL).expect("it runs");
        pid
    }

    /// Every process that was started with this session's files: the nodes.
    fn processes(&self) -> Vec<(Pid, Vec<String>)> {
        let session = self.session.to_string_lossy().into_owned();
        let mut found = Vec::new();
        for entry in fs::read_dir("/proc").expect("there is /proc").flatten() {
            let Some(pid) = entry.file_name().to_string_lossy().parse().ok().and_then(Pid::from_raw) else { continue };
            let line = fs::read(entry.path().join("cmdline")).unwrap_or_default();
            let arguments: Vec<String> =
                line.split(|b| *b == 0).map(|word| String::from_utf8_lossy(word).into_owned()).collect();
            if pid != self.process.pid() && arguments.iter().any(|word| word.starts_with(&session)) {
                found.push((pid, arguments));
            }
        }
        found
    }

    /// What the lesson showed and the ends of its logs, for failures.
    pub fn dump(&self) -> String {
        let mut text = self.process.dump();
        for entry in fs::read_dir(self.session.join("logs")).into_iter().flatten().flatten() {
            let log = fs::read_to_string(entry.path()).unwrap_or_default();
            text += &format!("--- {}\n{}", entry.file_name().to_string_lossy(), tail(&log));
        }
        text
    }
}

impl Drop for Suite {
    fn drop(&mut self) {
        if self.process.ended().is_none() {
            let _ = kill_process(self.process.pid(), Signal::TERM);
            let start = now();
            while self.process.ended().is_none() && start.elapsed() < Duration::from_secs(8) {
                std::thread::sleep(POLL);
            }
        }
        // Nothing may outlive the test, whatever it did to the suite.
        for (pid, _) in self.processes() {
            let _ = kill_process(pid, Signal::KILL);
        }
    }
}

/// The last lines of a text.
fn tail(text: &str) -> String {
    let lines: Vec<&str> = text.lines().collect();
    lines[lines.len().saturating_sub(60)..].join("\n") + "\n"
}

/// The time, for patience.
#[expect(clippy::disallowed_methods, reason = "a test's patience is real time")]
pub fn now() -> Instant {
    Instant::now()
}
