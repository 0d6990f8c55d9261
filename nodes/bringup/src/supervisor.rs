//! Which node to start, signal or give up on, as a pure state machine; time is an argument.

use crate::Backoff;
use std::time::Duration;

/// A node that is asked to stop has this long.
pub const GRACE: Duration = Duration::from_secs(5);
/// Exit code of a node that cannot start with what it was given.
const BAD_INPUT: i32 = 2;
/// A node that ends with [`BAD_INPUT`] this often in a row is given up although it had run before.
const BAD_INPUT_LIMIT: u32 = 5;

/// How a process ended.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Exit {
    /// By itself.
    Code(i32),
    /// By a signal.
    Signal(i32),
    /// It never began.
    NotStarted(String),
}

/// What is to be done next.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Action {
    /// Start a node's process.
    Start(usize),
    /// Ask a node's process to end (SIGTERM).
    Terminate(usize),
    /// End a node's process (SIGKILL).
    Kill(usize),
    /// A node died and will be started again after the wait.
    Died {
        /// Which.
        node: usize,
        /// How.
        exit: Exit,
        /// Until the next start.
        wait: Duration,
    },
    /// A node died and stays dead.
    GivenUp {
        /// Which.
        node: usize,
        /// How.
        exit: Exit,
    },
    /// A node that had died runs again.
    Back(usize),
    /// Every node has ended after [`Supervisor::stop`].
    AllStopped,
}

#[derive(Debug, Clone, PartialEq, Eq)]
enum State {
    Waiting { until: Duration },
    Running { since: Duration },
    Ended,
    GivenUp,
}

#[derive(Debug, Clone)]
struct Node {
    /// Nodes of a lower stage are stopped, and have ended, before those of a higher one are asked to.
    stage: u8,
    state: State,
    backoff: Backoff,
    bad_inputs: u32,
    starts: u32,
    deaths: u32,
}

#[derive(Debug, Clone, PartialEq, Eq)]
struct Stopping {
    stage: u8,
    kill_at: Duration,
    killed: bool,
}

/// Keeps nodes running until it is told to stop them.
#[derive(Debug, Clone)]
pub struct Supervisor {
    nodes: Vec<Node>,
    stopping: Option<Stopping>,
}

impl Supervisor {
    /// Nodes by the stage in which they are stopped, lowest first.
    pub fn new(stages: &[u8]) -> Self {
        let node = |&stage| Node {
            stage,
            state: State::Waiting { until: Duration::ZERO },
            backoff: Backoff::default(),
            bad_inputs: 0,
            starts: 0,
            deaths: 0,
        };
        Self { nodes: stages.iter().map(node).collect(), stopping: None }
    }

    /// Starts what is due, and kills what did not stop in time.
    pub fn tick(&mut self, now: Duration) -> Vec<Action> {
        let mut actions = Vec::new();
        if let Some(stopping) = &mut self.stopping {
            if now >= stopping.kill_at && !stopping.killed {
                stopping.killed = true;
                let stage = stopping.stage;
                actions.extend(self.running(stage).map(Action::Kill));
            }
            return actions;
        }
        for (i, node) in self.nodes.iter_mut().enumerate() {
            if matches!(node.state, State::Waiting { until } if now >= until) {
                node.state = State::Running { since: now };
                node.starts += 1;
                actions.push(Action::Start(i));
                if node.starts > 1 {
                    actions.push(Action::Back(i));
                }
            }
        }
        actions
    }

    /// A node's process has ended, or could not be started.
    pub fn exited(&mut self, now: Duration, i: usize, exit: Exit) -> Vec<Action> {
        let Some(node) = self.nodes.get_mut(i) else { return Vec::new() };
        let State::Running { since } = node.state else { return Vec::new() };
        if self.stopping.is_some() {
            node.state = State::Ended;
            return self.next_stage(now);
        }
        node.deaths += 1;
        let bad_input = exit == Exit::Code(BAD_INPUT);
        node.bad_inputs = if bad_input { node.bad_inputs + 1 } else { 0 };
        if bad_input && (node.starts == 1 || node.bad_inputs >= BAD_INPUT_LIMIT) {
            node.state = State::GivenUp;
            return vec![Action::GivenUp { node: i, exit }];
        }
        let wait = node.backoff.after(now.saturating_sub(since));
        node.state = State::Waiting { until: now + wait };
        vec![Action::Died { node: i, exit, wait }]
    }

    /// Stops all nodes, stage by stage. Asking again changes nothing.
    pub fn stop(&mut self, now: Duration) -> Vec<Action> {
        if self.stopping.is_some() {
            return Vec::new();
        }
        for node in &mut self.nodes {
            if !matches!(node.state, State::Running { .. }) {
                node.state = State::Ended;
            }
        }
        self.stopping = Some(Stopping { stage: 0, kill_at: now + GRACE, killed: false });
        let mut actions: Vec<Action> = self.running(0).map(Action::Terminate).collect();
        if actions.is_empty() {
            actions = self.next_stage(now);
        }
        actions
    }

    /// Kills what is being stopped now, except the last stage, which keeps its grace.
    pub fn hurry(&mut self, now: Duration) -> Vec<Action> {
        let last = self.nodes.iter().map(|node| node.stage).max().unwrap_or(0);
        match &mut self.stopping {
            Some(stopping) if stopping.stage < last => {
                stopping.kill_at = now;
                self.tick(now)
            }
            _ => Vec::new(),
        }
    }

    /// When [`Supervisor::tick`] has something to do next.
    pub fn deadline(&self) -> Option<Duration> {
        match &self.stopping {
            Some(stopping) if stopping.killed => None,
            Some(stopping) => Some(stopping.kill_at),
            None => self
                .nodes
                .iter()
                .filter_map(|node| if let State::Waiting { until } = node.state { Some(until) } else { None })
                .min(),
        }
    }

    /// How often a node was started, and how often it died unasked.
    pub fn starts_and_deaths(&self, i: usize) -> (u32, u32) {
        self.nodes.get(i).map_or((0, 0), |node| (node.starts, node.deaths))
    }

    /// Whether a node stays dead.
    pub fn is_given_up(&self, i: usize) -> bool {
        self.nodes.get(i).is_some_and(|node| node.state == State::GivenUp)
    }

    /// Moves on to the next stage that has a running node, once the present one has none.
    fn next_stage(&mut self, now: Duration) -> Vec<Action> {
        let Some(Stopping { stage, .. }) = self.stopping else { return Vec::new() };
        if self.running(stage).next().is_some() {
            return Vec::new();
        }
        let next = self
            .nodes
            .iter()
            .filter(|node| matches!(node.state, State::Running { .. }) && node.stage > stage)
            .map(|node| node.stage)
            .min();
        match next {
            Some(stage) => {
                self.stopping = Some(Stopping { stage, kill_at: now + GRACE, killed: false });
                self.running(stage).map(Action::Terminate).collect()
            }
            None => vec![Action::AllStopped],
        }
    }

    fn running(&self, stage: u8) -> impl Iterator<Item = usize> {
        let runs = move |node: &Node| node.stage == stage && matches!(node.state, State::Running { .. });
        self.nodes.iter().enumerate().filter(move |(_, node)| runs(node)).map(|(i, _)| i)
    }
}
