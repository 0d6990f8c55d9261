//! What a node costs while nothing happens.

use crate::suite::Suite;
use rustix::process::Pid;
use serde_json::{Value, json};
use std::time::Duration;

/// How long is looked.
const SPAN: Duration = Duration::from_secs(30);

/// What Linux counts CPU time in, whatever its kernel's own clock.
const TICKS_PER_S: f64 = 100.0;

/// CPU share of one core in percent, and resident memory in megabytes, for each node of a lesson that waits.
pub fn measure(suite: &Suite) -> Value {
    let nodes = [
        "session_recorder",
        "simulated_table",
        "reward_posterior",
        "performance_bounds",
        "active_query",
        "placement_planner",
        "operator_ui",
    ];
    let running: Vec<(&str, Pid)> = nodes.iter().filter_map(|name| Some((*name, suite.node(name)?))).collect();
    let before: Vec<f64> = running.iter().map(|(_, pid)| cpu_s(*pid)).collect();
    std::thread::sleep(SPAN);
    let mut costs = serde_json::Map::new();
    for ((name, pid), before) in running.iter().zip(before) {
        let share = 100.0 * (cpu_s(*pid) - before) / SPAN.as_secs_f64();
        costs.insert((*name).to_owned(), json!({ "cpu, %": share, "memory, MB": resident_mb(*pid) }));
    }
    Value::Object(costs)
}

/// CPU time of a process so far, seconds.
fn cpu_s(pid: Pid) -> f64 {
    let stat = std::fs::read_to_string(format!("/proc/{}/stat", pid.as_raw_nonzero())).unwrap_or_default();
    // The name in brackets may hold spaces; user and system time are the 12th and 13th words after it.
    let words: Vec<&str> = stat.rsplit(')').next().unwrap_or_default().split_whitespace().collect();
    let ticks = |i: usize| words.get(i).and_then(|word| word.parse::<f64>().ok()).unwrap_or(f64::NAN);
    (ticks(11) + ticks(12)) / TICKS_PER_S
}

/// Resident memory of a process, megabytes.
fn resident_mb(pid: Pid) -> f64 {
    let status = std::fs::read_to_string(format!("/proc/{}/status", pid.as_raw_nonzero())).unwrap_or_default();
    let line = status.lines().find_map(|line| line.strip_prefix("VmRSS:")).unwrap_or_default();
    line.split_whitespace().next().and_then(|kb| kb.parse::<f64>().ok()).unwrap_or(f64::NAN) / 1000.0
}
