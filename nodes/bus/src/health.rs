//! How a node does: counters, the status it reports, and the `/diagnostics` message made of both.

use std::sync::{
    Mutex, PoisonError,
    atomic::{AtomicU64, Ordering},
};

use apprentice_msgs::{
    builtin_interfaces::Time,
    diagnostic_msgs::{DiagnosticArray, DiagnosticStatus, KeyValue},
};

/// What the bus counts for a node.
#[derive(Debug, Default)]
pub(crate) struct Counters {
    /// Messages handed to the node.
    pub(crate) received: AtomicU64,
    /// Messages that could not be decoded.
    pub(crate) malformed: AtomicU64,
    /// Messages published by the node.
    pub(crate) published: AtomicU64,
    /// Stream messages lost because the node was too slow.
    pub(crate) lost: AtomicU64,
}

/// How well a node does.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Default)]
pub enum Level {
    /// Well.
    #[default]
    Ok,
    /// Something is odd.
    Warn,
    /// It cannot do its work.
    Error,
    /// It has not heard anything for too long.
    Stale,
}

impl Level {
    /// The number in a `DiagnosticStatus`.
    fn number(self) -> u8 {
        match self {
            Level::Ok => DiagnosticStatus::OK,
            Level::Warn => DiagnosticStatus::WARN,
            Level::Error => DiagnosticStatus::ERROR,
            Level::Stale => DiagnosticStatus::STALE,
        }
    }
}

/// What a node last said of itself.
#[derive(Debug, Clone, Default)]
struct Status {
    level: Level,
    message: String,
    values: Vec<(String, String)>,
}

/// A node's counters and status.
#[derive(Debug, Default)]
pub(crate) struct Health {
    status: Mutex<Status>,
}

impl Health {
    /// Replaces the status.
    pub(crate) fn set(&self, level: Level, message: String, values: &[(&str, String)]) {
        let values = values.iter().map(|(key, value)| ((*key).to_owned(), value.clone())).collect();
        *self.status.lock().unwrap_or_else(PoisonError::into_inner) = Status { level, message, values };
    }

    /// The message for `/diagnostics`.
    pub(crate) fn message(
        &self,
        stamp: Time,
        node: &str,
        instance: &str,
        counters: &Counters,
        waiting: usize,
    ) -> DiagnosticArray {
        let status = self.status.lock().unwrap_or_else(PoisonError::into_inner).clone();
        let count = |counter: &AtomicU64| counter.load(Ordering::Relaxed).to_string();
        let mut values: Vec<KeyValue> = status.values.into_iter().map(|(key, value)| KeyValue { key, value }).collect();
        for (key, value) in [
            ("received", count(&counters.received)),
            ("malformed", count(&counters.malformed)),
            ("published", count(&counters.published)),
            ("lost", count(&counters.lost)),
            ("queue_length", waiting.to_string()),
        ] {
            values.push(KeyValue { key: key.to_owned(), value });
        }
        let mut array = DiagnosticArray::default();
        array.header.stamp = stamp;
        array.status.push(DiagnosticStatus {
            level: status.level.number(),
            name: node.trim_start_matches('/').to_owned(),
            message: if status.message.is_empty() { "running".to_owned() } else { status.message },
            hardware_id: instance.to_owned(),
            values,
        });
        array
    }
}
