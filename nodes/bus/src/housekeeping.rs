//! What every node publishes about itself: heartbeat, diagnostics and log lines, on a thread of its own.

use std::{
    sync::{
        Arc,
        mpsc::{Receiver, RecvTimeoutError},
    },
    time::{Duration, Instant},
};

use apprentice_msgs::{diagnostic_msgs::DiagnosticArray, msg::Heartbeat, rcl_interfaces::Log as RosLog};
use log::Level;

use crate::{
    clock::{self, Clock},
    health::{Counters, Health},
    logging::{self, LogLine},
    publisher::Publisher,
};

/// Between two heartbeats.
const HEARTBEAT: Duration = Duration::from_millis(500);

/// What the thread works with.
pub(crate) struct Housekeeping {
    /// Fully qualified name of the node.
    pub(crate) node: String,
    /// The logger's name, such as `apprentice.planner`.
    pub(crate) logger: String,
    /// New at every start.
    pub(crate) instance: String,
    pub(crate) clock: Clock,
    pub(crate) counters: Arc<Counters>,
    pub(crate) health: Arc<Health>,
    pub(crate) waiting: Box<dyn Fn() -> usize + Send>,
    pub(crate) heartbeat: Publisher<Heartbeat>,
    pub(crate) diagnostics: Publisher<DiagnosticArray>,
    pub(crate) rosout: Option<Publisher<RosLog>>,
    pub(crate) lines: Receiver<LogLine>,
    pub(crate) log_id: u64,
}

impl Housekeeping {
    /// Works until every sender of log lines is gone, which is when the bus is dropped.
    #[expect(clippy::disallowed_methods, reason = "heartbeats follow real time, whatever the simulation does")]
    pub(crate) fn run(self) {
        logging::enter(self.log_id);
        let mut count = 0;
        let mut next = Instant::now();
        loop {
            let now = Instant::now();
            if now >= next {
                next = now + HEARTBEAT;
                count += 1;
                self.beat(count);
            }
            match self.lines.recv_timeout(next.saturating_duration_since(now)) {
                Ok(line) => self.publish_line(line),
                Err(RecvTimeoutError::Timeout) => {}
                Err(RecvTimeoutError::Disconnected) => return,
            }
        }
    }

    /// Publishes the heartbeat, and each second time the diagnostics.
    fn beat(&self, count: u64) {
        let stamp = clock::to_time(clock::system_ns());
        let heartbeat = Heartbeat { stamp, node: self.node.clone(), instance: self.instance.clone(), count };
        // A lost heartbeat is followed by the next; a lost graph shows in what the node itself publishes.
        let _ = self.heartbeat.publish(&heartbeat);
        if count % 2 == 1 {
            let array =
                self.health.message(self.clock.now(), &self.node, &self.instance, &self.counters, (self.waiting)());
            let _ = self.diagnostics.publish(&array);
        }
    }

    /// Publishes one log line.
    fn publish_line(&self, line: LogLine) {
        let Some(rosout) = &self.rosout else { return };
        let _ = rosout.publish(&RosLog {
            stamp: self.clock.now(),
            level: match line.level {
                Level::Error => RosLog::ERROR,
                Level::Warn => RosLog::WARN,
                Level::Info => RosLog::INFO,
                Level::Debug | Level::Trace => RosLog::DEBUG,
            },
            name: self.logger.clone(),
            msg: line.text,
            file: line.file,
            function: line.function,
            line: line.line,
        });
    }
}
