//! Tells the executable which commit it was built from; works without git and outside a repository.

use std::path::Path;
use std::process::Command;

fn main() {
    println!("cargo::rerun-if-env-changed=APPRENTICE_COMMIT");
    // Both change with every commit and checkout; where they are missing, nothing needs watching.
    for file in [".git/HEAD", ".git/logs/HEAD"] {
        if Path::new(file).exists() {
            println!("cargo::rerun-if-changed={file}");
        }
    }
    println!("cargo::rerun-if-changed=build.rs");
    let given = std::env::var("APPRENTICE_COMMIT").ok().filter(|commit| !commit.is_empty() && commit != "unknown");
    let commit = given.or_else(head).unwrap_or_else(|| "unknown".to_owned());
    println!("cargo::rustc-env=APPRENTICE_COMMIT={commit}");
}

/// The commit that is checked out.
fn head() -> Option<String> {
    if !Path::new(".git").exists() {
        return None;
    }
    let output = Command::new("git").args(["rev-parse", "HEAD"]).output().ok()?;
    let commit = String::from_utf8(output.stdout).ok()?.trim().to_owned();
    let good = output.status.success() && commit.len() >= 40 && commit.bytes().all(|byte| byte.is_ascii_hexdigit());
    good.then_some(commit)
}
