//! Claims about the graph over DDS, on loopback and in a domain of this run's own.
//!
//! The environment decides about domain and range, and a process must not change its own; so this program starts
//! itself with the right one. `BUS_TEST_ROLE` says what a process is: none for the starter, `claims` for the one
//! that checks, `peer` for the other process on the graph.

use std::{
    process::{Child, Command, ExitCode, Stdio},
    time::{Duration, Instant},
};

mod actions;
mod claims;
mod common;
mod peer;
mod services;

/// Says what a process is for.
pub const ROLE: &str = "BUS_TEST_ROLE";

fn main() -> ExitCode {
    match std::env::var(ROLE).as_deref() {
        Ok("claims") => run_claims(),
        Ok("peer") => peer::run(),
        _ => start(),
    }
}

/// Starts the process that checks, with the environment that it needs.
fn start() -> ExitCode {
    let domain = 101 + std::process::id() % 100;
    let status = this_program("claims")
        .args(std::env::args().skip(1))
        .env("ROS_DOMAIN_ID", domain.to_string())
        .env("ROS_AUTOMATIC_DISCOVERY_RANGE", "LOCALHOST")
        .env_remove("RMW_IMPLEMENTATION")
        .status()
        .expect("this program starts again");
    if status.success() { ExitCode::SUCCESS } else { ExitCode::FAILURE }
}

/// This program in another role.
pub fn this_program(role: &str) -> Command {
    let mut command = Command::new(std::env::current_exe().expect("this program has a path"));
    command.env(ROLE, role);
    command
}

/// The other process; ended when dropped.
pub struct Peer(pub Child);

impl Peer {
    /// Starts it.
    pub fn start() -> Peer {
        Peer(this_program("peer").stderr(Stdio::inherit()).spawn().expect("the peer starts"))
    }
}

impl Drop for Peer {
    fn drop(&mut self) {
        let _ = self.0.kill();
        let _ = self.0.wait();
    }
}

/// Checks one claim after the other; a filter on the command line picks some.
#[expect(clippy::disallowed_methods, reason = "a test reports how long it took")]
fn run_claims() -> ExitCode {
    let filter = std::env::args().nth(1).filter(|argument| !argument.starts_with('-'));
    let claims: &[(&str, fn())] = &[
        ("a_peer_process_answers_and_late_joiners_hear_states", claims::peer_process),
        ("a_burst_arrives_whole_and_in_order", claims::burst),
        ("large_messages_arrive", claims::large),
        ("malformed_messages_are_left_out", claims::malformed),
        ("foreign_types_are_reported_and_left_out", claims::foreign_type),
        ("qos_mismatches_are_reported", claims::qos_mismatch),
        ("raw_messages_keep_their_bytes", claims::raw_bytes),
        ("discovery_tells_names_types_qos_and_nodes", claims::discovery),
        ("simulated_time_comes_from_clock", claims::sim_time),
        ("sigterm_ends_a_node_cleanly", claims::sigterm),
        ("a_node_whose_parent_is_killed_ends", claims::orphan),
        ("a_wrong_environment_is_refused_with_exit_code_2", claims::wrong_environment),
        ("parameters_over_the_enhanced_mapping", services::enhanced),
        ("parameters_over_the_cyclone_mapping", services::cyclone),
        ("actions_over_the_enhanced_mapping", actions::enhanced),
        ("actions_over_the_cyclone_mapping", actions::cyclone),
    ];
    for (name, claim) in claims {
        if filter.as_deref().is_some_and(|filter| !name.contains(filter)) {
            continue;
        }
        let start = Instant::now();
        claim();
        println!("claim {name} ... ok ({} ms)", start.elapsed().as_millis());
    }
    ExitCode::SUCCESS
}

/// How long anything may take on a busy machine.
pub const PATIENCE: Duration = Duration::from_secs(30);
