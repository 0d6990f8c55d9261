//! Programs of others: Python scripts of `tests/python` with the packages that `tests/run` installs.

use crate::suite::Process;
use serde_json::Value;
use std::path::PathBuf;
use std::process::Command;
use std::time::Duration;

/// The interpreter that has the packages.
fn interpreter() -> PathBuf {
    let path = std::env::var_os("APPRENTICE_PYTHON")
        .map_or_else(|| PathBuf::from(env!("CARGO_MANIFEST_DIR")).join(".venv/bin/python"), PathBuf::from);
    assert!(path.is_file(), "{} is missing; run `tests/run` once, which installs it", path.display());
    path
}

/// A script with its arguments.
pub fn script(name: &str, arguments: &[&str]) -> Command {
    let mut command = Command::new(interpreter());
    command.arg(PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("tests/python").join(name)).args(arguments);
    command.env("PYTHONUNBUFFERED", "1").env("PYTHONDONTWRITEBYTECODE", "1");
    command
}

/// Runs a script to its end; gives the JSON that it prints last.
pub fn run(command: Command, what: &str, limit: Duration) -> Value {
    let mut process = Process::start(command, what);
    let status = process.wait(limit);
    assert!(status.success(), "{what}: {status}\n{}", process.dump());
    let (stdout, _) = process.output();
    let last = stdout.lines().last().unwrap_or_default();
    serde_json::from_str(last).unwrap_or_else(|error| panic!("{what}: {error}\n{}", process.dump()))
}
