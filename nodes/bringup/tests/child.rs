//! Claims about real processes: their output, their end, and their signals.
#![expect(clippy::disallowed_methods, reason = "processes live in real time")]

use bringup::{Child, Console, Exit, Level, NodeLog};
use std::path::Path;
use std::sync::Arc;
use std::sync::mpsc::{Receiver, channel};
use std::time::{Duration, Instant};

const LONG: Duration = Duration::from_secs(10);

fn shell(script: &str, logs: &Path) -> (Child, Receiver<()>) {
    let log = Arc::new(NodeLog::new("shell", logs, Console::new(true), Level::Error));
    let (ended, end) = channel();
    let args = ["-c".to_owned(), script.to_owned()];
    let tell = move || ended.send(()).expect("the test waits");
    (Child::start(Path::new("/bin/sh"), &args, &log, tell).expect("starts"), end)
}

#[test]
fn output_is_logged_before_the_end_is_told_and_the_exit_code_comes_through() {
    let root = tempfile::tempdir().expect("a folder");
    let script = "echo '[INFO] [shell]: out'; echo '[WARN] [shell]: err' >&2; echo $APPRENTICE_PARENT_PID; exit 3";
    let (child, end) = shell(script, root.path());
    end.recv_timeout(LONG).expect("ends");
    assert_eq!(child.reap(), Exit::Code(3));
    let log = std::fs::read_to_string(root.path().join("shell.log")).expect("reads");
    for line in ["[INFO] [shell]: out", "[WARN] [shell]: err", &std::process::id().to_string()] {
        assert!(log.lines().any(|logged| logged == line), "{log}");
    }
}

#[test]
fn a_process_in_its_own_group_ends_by_the_signal_it_is_sent() {
    let root = tempfile::tempdir().expect("a folder");
    let (polite, end) = shell("trap 'exit 0' TERM; echo ready; while :; do sleep 0.05; done", root.path());
    let began = Instant::now();
    while std::fs::read_to_string(root.path().join("shell.log")).is_ok_and(|log| log.is_empty()) {
        assert!(began.elapsed() < LONG);
        std::thread::sleep(Duration::from_millis(10));
    }
    polite.terminate();
    end.recv_timeout(LONG).expect("ends");
    assert_eq!(polite.reap(), Exit::Code(0));
    let (stubborn, end) = shell("trap '' TERM; exec sleep 600", root.path());
    stubborn.kill();
    end.recv_timeout(LONG).expect("ends");
    // Signalling what has ended and is not reaped is harmless.
    stubborn.terminate();
    assert_eq!(stubborn.reap(), Exit::Signal(9));
}

#[test]
fn something_left_behind_with_the_output_open_does_not_hide_the_end() {
    let root = tempfile::tempdir().expect("a folder");
    let began = Instant::now();
    let (child, end) = shell("sleep 3 & exit 1", root.path());
    end.recv_timeout(LONG).expect("ends");
    assert!(began.elapsed() < Duration::from_millis(2500));
    assert_eq!(child.reap(), Exit::Code(1));
}

#[test]
fn what_cannot_be_started_is_an_error() {
    let root = tempfile::tempdir().expect("a folder");
    let log = Arc::new(NodeLog::new("none", root.path(), Console::new(true), Level::Error));
    assert!(Child::start(Path::new("/no/such/program"), &[], &log, || {}).is_err());
}
