//! The main loop: processes, the clock, signals and the graph on one side, supervisor, story and ledger on the other.

use crate::words::{closing_words, told};
use crate::{
    Action, BringupError, Child, Circumstances, Console, Exit, Kind, LaunchNode, Ledger, Level, NodeCount, NodeLog,
    Placing, Settings, Story, Summary, Supervisor, Topic, Watch,
};
use bus::{Arguments, Graph};
use signal_hook::consts::{SIGHUP, SIGINT, SIGTERM};
use signal_hook::iterator::Signals;
use std::collections::BTreeMap;
use std::io::Read;
use std::path::PathBuf;
use std::sync::Arc;
use std::sync::mpsc::{Receiver, RecvTimeoutError, Sender, channel};
use std::time::{Duration, Instant};

/// After the lesson's end the robot has this long to plan.
const PLAN_GRACE: Duration = Duration::from_secs(5);
/// With `until_placed`: the arm moves within this time of the plan, or not at all.
const MOVE_GRACE: Duration = Duration::from_secs(10);
/// And is done within this one.
const MOVE_LIMIT: Duration = Duration::from_secs(300);
/// After everything has been said, the recorder has this long to hear it.
const LAST_WORDS: Duration = Duration::from_millis(500);
/// How often to look for the page's address while it is not there.
const PAGE_POLL: Duration = Duration::from_millis(100);
const IDLE: Duration = Duration::from_secs(60);

/// Everything that is decided before the first node starts.
pub struct Plan {
    /// Started with a node's name and arguments.
    pub executable: PathBuf,
    /// In the order of starting.
    pub nodes: Vec<LaunchNode>,
    /// Where the story goes.
    pub console: Console,
    /// Lines of the nodes' logs from this level on go to the terminal.
    pub shown_from: Level,
    /// For the summary.
    pub circumstances: Circumstances,
    /// Folder of the log files.
    pub logs: PathBuf,
    /// Where the page's node writes its address.
    pub url_file: Option<PathBuf>,
    /// Where the summary goes.
    pub summary: Option<PathBuf>,
    /// Bringup's own parameters.
    pub settings: Settings,
    /// Bringup's own ROS arguments.
    pub arguments: Arguments,
}

/// How it all ended.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Outcome {
    /// The lesson ended by itself, or a person ended what runs until then.
    Ended,
    /// With `until_taught` or `until_placed`: a signal came before the lesson's end.
    Interrupted(i32),
    /// A node that the lesson needs cannot run.
    NodeGivenUp,
    /// With `until_taught` or `until_placed`: the time limit passed.
    TimedOut,
}

impl Outcome {
    /// As the help text says.
    pub fn exit_code(&self) -> u8 {
        match self {
            Self::Ended => 0,
            Self::Interrupted(signal) => u8::try_from(128 + signal).unwrap_or(1),
            Self::NodeGivenUp => 2,
            Self::TimedOut => 1,
        }
    }
}

enum Event {
    Topic(Box<Topic>),
    Ended(usize),
    Signal(i32),
}

struct Suite {
    plan: Plan,
    supervisor: Supervisor,
    children: Vec<Option<Child>>,
    logs: Vec<Arc<NodeLog>>,
    story: Story,
    ledger: Ledger,
    events: Sender<Event>,
    began: Instant,
    /// The page's address, as last told.
    page: Option<String>,
    awaits_page: bool,
    over_at: Option<Duration>,
    /// How far the robot was with its plan when that was set.
    placing: Option<Placing>,
    outcome: Option<Outcome>,
    /// Why the lesson did not end by itself.
    why: Option<String>,
    all_stopped: bool,
}

/// Starts the nodes and keeps them running until the lesson, or the person, is done; then stops them in order.
///
/// # Errors
/// When the graph cannot be joined or signals cannot be caught; no node runs then.
#[expect(clippy::disallowed_methods, reason = "this is where processes meet the clock")]
pub fn run(plan: Plan, graph: Graph) -> Result<Outcome, BringupError> {
    let began = Instant::now();
    let (events, inbox) = channel();
    let signals = events.clone();
    let mut caught = Signals::new([SIGINT, SIGTERM, SIGHUP])
        .map_err(|source| BringupError::Start { what: "listening to signals", source })?;
    let signal_handle = caught.handle();
    let signal_thread = std::thread::spawn(move || {
        for signal in caught.forever() {
            if signals.send(Event::Signal(signal)).is_err() {
                break;
            }
        }
    });
    let topics = events.clone();
    let watch = Watch::start(graph, plan.arguments.clone(), plan.settings.clone(), move |topic| {
        topics.send(Event::Topic(Box::new(topic))).is_ok()
    })
    .map_err(BringupError::Bus)?;
    let stages: Vec<u8> = plan.nodes.iter().map(|node| node.stage).collect();
    let log = |node: &LaunchNode| Arc::new(NodeLog::new(node.name, &plan.logs, plan.console, plan.shown_from));
    let mut suite = Suite {
        supervisor: Supervisor::new(&stages),
        children: plan.nodes.iter().map(|_| None).collect(),
        logs: plan.nodes.iter().map(log).collect(),
        story: Story::default(),
        ledger: Ledger::default(),
        events,
        began,
        page: None,
        awaits_page: false,
        over_at: None,
        placing: None,
        outcome: None,
        why: None,
        all_stopped: false,
        plan,
    };
    suite.serve(&inbox);
    watch.stop();
    signal_handle.close();
    // A thread that only forwards signals has nothing to report.
    let _ = signal_thread.join();
    suite.conclude()
}

impl Suite {
    fn now(&self) -> Duration {
        self.began.elapsed()
    }

    fn serve(&mut self, inbox: &Receiver<Event>) {
        while !self.all_stopped {
            let now = self.now();
            let due = self.supervisor.tick(now);
            self.apply(due);
            self.look_for_page();
            self.look_at_lesson();
            if self.all_stopped {
                break;
            }
            let wait = self.deadline().map_or(IDLE, |deadline| deadline.saturating_sub(self.now()));
            match inbox.recv_timeout(wait) {
                Ok(Event::Topic(topic)) => self.hear(&topic),
                Ok(Event::Ended(node)) => self.bury(node),
                Ok(Event::Signal(signal)) => self.interrupt(signal),
                Err(RecvTimeoutError::Timeout | RecvTimeoutError::Disconnected) => {}
            }
        }
    }

    /// When something is to be done without any event.
    fn deadline(&self) -> Option<Duration> {
        let limit = self.time_limit().filter(|_| self.outcome.is_none());
        let page = self.awaits_page.then(|| self.now() + PAGE_POLL);
        let over = self.over_at.filter(|_| self.outcome.is_none());
        [self.supervisor.deadline(), limit, page, over].into_iter().flatten().min()
    }

    fn time_limit(&self) -> Option<Duration> {
        let limit_s = self.plan.settings.time_limit_s;
        (limit_s > 0.0).then(|| Duration::from_secs_f64(limit_s))
    }

    fn apply(&mut self, actions: Vec<Action>) {
        let mut queue = std::collections::VecDeque::from(actions);
        while let Some(action) = queue.pop_front() {
            match action {
                Action::Start(node) => {
                    if let Err(error) = self.start(node) {
                        let now = self.now();
                        queue.extend(self.supervisor.exited(now, node, Exit::NotStarted(error.to_string())));
                    }
                }
                Action::Terminate(node) => self.children[node].iter().for_each(Child::terminate),
                Action::Kill(node) => {
                    self.say(Kind::Node, &format!("    {} does not stop; it is killed", self.name(node)));
                    self.children[node].iter().for_each(Child::kill);
                }
                Action::Died { node, exit, wait } => {
                    let wait = wait.as_secs_f64();
                    let text =
                        format!("    {} died ({}); it starts again in {wait:.1} s", self.name(node), told(&exit));
                    self.say(Kind::Node, &text);
                }
                Action::Back(node) => {
                    if let Some(child) = &self.children[node] {
                        self.say(Kind::Node, &format!("    {} is back (process {})", self.name(node), child.id()));
                    }
                }
                Action::GivenUp { node, exit } => self.give_up(node, &exit),
                Action::AllStopped => self.all_stopped = true,
            }
        }
    }

    fn start(&mut self, node: usize) -> std::io::Result<()> {
        let launch = &self.plan.nodes[node];
        if launch.name == "operator_ui"
            && let Some(path) = &self.plan.url_file
        {
            // Gone already is what is wanted.
            let _ = std::fs::remove_file(path);
            self.awaits_page = true;
        }
        let events = self.events.clone();
        let ended = move || {
            // Nobody listens only when everything has ended.
            let _ = events.send(Event::Ended(node));
        };
        self.children[node] = Some(Child::start(&self.plan.executable, &launch.args, &self.logs[node], ended)?);
        Ok(())
    }

    fn bury(&mut self, node: usize) {
        let Some(child) = self.children[node].take() else { return };
        let exit = child.reap();
        let now = self.now();
        let actions = self.supervisor.exited(now, node, exit);
        self.apply(actions);
    }

    fn give_up(&mut self, node: usize, exit: &Exit) {
        let log = self.plan.logs.join(format!("{}.log", self.name(node)));
        let text =
            format!("{} cannot start ({}): its reason is above, and in {}", self.name(node), told(exit), log.display());
        self.say(Kind::Node, &format!("    {text}"));
        if self.name(node) == "operator_ui" {
            self.awaits_page = false;
        }
        if self.plan.nodes[node].essential {
            self.end(Outcome::NodeGivenUp, Some(text));
        }
    }

    fn hear(&mut self, topic: &Topic) {
        let now = self.now();
        self.ledger.note(now, topic);
        for (kind, text) in self.story.tell(topic) {
            self.say(kind, &text);
        }
    }

    fn interrupt(&mut self, signal: i32) {
        if self.outcome.is_some() {
            self.say(Kind::Info("stop"), "still stopping; the bag is being finished");
            let now = self.now();
            let actions = self.supervisor.hurry(now);
            return self.apply(actions);
        }
        let name = signal_hook::low_level::signal_name(signal).unwrap_or("a signal");
        self.say(Kind::Info("stop"), &format!("{name}: stopping the nodes, the recorder last"));
        let early = self.plan.settings.ends_by_itself() && !self.ledger.is_over();
        let outcome = if early { Outcome::Interrupted(signal) } else { Outcome::Ended };
        self.end(outcome, Some(format!("interrupted by {name}")));
    }

    /// Ends a lesson that is done, and one that takes too long.
    fn look_at_lesson(&mut self) {
        if self.outcome.is_some() {
            return;
        }
        let now = self.now();
        if self.ledger.is_over() {
            if self.over_at.is_none() {
                self.write_summary();
                self.over_at = Some(now + PLAN_GRACE);
            }
            if self.ledger.has_final_plan() {
                // Without `until_placed` nobody waits for the arm.
                let placing = if self.plan.settings.until_placed { self.ledger.placing() } else { Placing::Over };
                let wait = match placing {
                    Placing::NotBegun => MOVE_GRACE,
                    Placing::UnderWay => MOVE_LIMIT,
                    Placing::NotPlanned | Placing::Over => LAST_WORDS,
                };
                // What is waited for changes; the time for it runs from then on.
                if self.placing.replace(placing) != Some(placing) {
                    self.over_at = Some(now + wait);
                }
            }
        } else {
            // An undo took the end back.
            (self.over_at, self.placing) = (None, None);
        }
        if !self.plan.settings.ends_by_itself() {
            self.over_at = self.over_at.map(|_| Duration::MAX);
            return;
        }
        if self.over_at.is_some_and(|at| now >= at) {
            self.end(Outcome::Ended, None);
        } else if self.over_at.is_none() && self.time_limit().is_some_and(|limit| now >= limit) {
            let why = format!("the time limit of {} s passed before the lesson ended", self.plan.settings.time_limit_s);
            self.say(Kind::Lesson, &format!("    {why}"));
            self.end(Outcome::TimedOut, Some(why));
        }
    }

    fn end(&mut self, outcome: Outcome, why: Option<String>) {
        if self.outcome.is_none() {
            (self.outcome, self.why) = (Some(outcome), why);
            let now = self.now();
            let actions = self.supervisor.stop(now);
            self.apply(actions);
        }
    }

    fn look_for_page(&mut self) {
        if !self.awaits_page || self.outcome.is_some() {
            self.awaits_page = false;
            return;
        }
        let Some(path) = &self.plan.url_file else { return };
        let mut text = String::new();
        let read = std::fs::File::open(path).and_then(|file| file.take(4096).read_to_string(&mut text));
        let url = text.trim();
        if read.is_ok() && !url.is_empty() {
            self.awaits_page = false;
            if self.page.as_deref() != Some(url) {
                self.plan.console.say(Kind::Info("page"), &crate::log_line::harmless(url));
                self.page = Some(url.to_owned());
            }
        }
    }

    fn summary(&self) -> Summary {
        let counts = self.plan.nodes.iter().enumerate().map(|(i, node)| {
            let (starts, deaths) = self.supervisor.starts_and_deaths(i);
            (node.name, NodeCount { starts, deaths })
        });
        let counts: BTreeMap<_, _> = counts.collect();
        let why = self.why.as_deref().or(self.outcome.is_none().then_some("the lesson goes on"));
        Summary::new(&self.plan.circumstances, &self.ledger, counts, self.now(), why)
    }

    /// Once when the lesson ends, so that it is there while the page is still served, and once at the very end.
    fn write_summary(&self) {
        if let Some(path) = &self.plan.summary
            && let Err(error) = self.summary().write(path)
        {
            self.say(Kind::Node, &format!("    cannot write the summary {}: {error}", path.display()));
        }
    }

    fn conclude(self) -> Result<Outcome, BringupError> {
        let summary = self.summary();
        for text in closing_words(&summary) {
            self.say(Kind::Info("summary"), &text);
        }
        if let Some(path) = &self.plan.summary {
            let path = path.clone();
            summary.write(&path).map_err(|source| BringupError::Summary { path, source })?;
        }
        Ok(self.outcome.unwrap_or(Outcome::Ended))
    }

    fn name(&self, node: usize) -> &'static str {
        self.plan.nodes[node].name
    }

    fn say(&self, kind: Kind, text: &str) {
        self.plan.console.say(kind, text);
    }
}
