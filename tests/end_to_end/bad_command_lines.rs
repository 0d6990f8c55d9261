//! Bad input on the command line and on disk: one clear line, exit code 2, and no panic.

use crate::recorded::Recorded;
use crate::suite::{Turn, apprentice, fresh_domain, fresh_folder, run};
use crate::taught::flowers;
use std::path::{Path, PathBuf};
use std::process::Output;

fn stderr(output: &Output) -> String {
    String::from_utf8_lossy(&output.stderr).into_owned()
}

/// The command must end with exit code 2 and one line on standard error that holds every part.
fn refused(arguments: &[&str], parts: &[&str]) {
    let output = run(arguments);
    let told = stderr(&output);
    assert_eq!(output.status.code(), Some(2), "{arguments:?}: {told}");
    let lines: Vec<&str> = told.lines().filter(|line| !line.trim().is_empty()).collect();
    assert_eq!(lines.len(), 1, "{arguments:?}: one line was expected:\n{told}");
    for part in parts {
        assert!(lines[0].contains(part), "{arguments:?}: expected {part:?} in: {}", lines[0]);
    }
    assert!(!told.contains("panicked"), "{told}");
}

#[test]
fn an_unknown_scenario_is_refused() {
    refused(&["--scenario", "flower", "--headless"], &["'flower'", "flowers", "spoon"]);
    refused(&["--scenario", "missing/file.yaml", "--headless"], &["missing/file.yaml"]);
}

#[test]
fn an_unknown_parameter_is_refused() {
    refused(&["performance_bounds", "--ros-args", "-p", "alhpa:=0.9"], &["alhpa", "alpha"]);
    let folder = tempfile::tempdir().expect("a folder");
    let file = folder.path().join("typo.yaml");
    std::fs::write(&file, "/**:\n  active_query:\n    ros__parameters:\n      epsilon: 0.1\n").expect("writes");
    let file = file.to_string_lossy().into_owned();
    refused(&["active_query", "--ros-args", "--params-file", &file], &["typo.yaml", "epsilon", "epsilon_m"]);
    let session = fresh_folder("typo").join("session").to_string_lossy().into_owned();
    let suite = ["--headless", "--session", session.as_str(), "--params-file", file.as_str()];
    refused(&suite, &["typo.yaml", "epsilon", "epsilon_m"]);
}

#[test]
fn an_unknown_node_is_refused() {
    refused(&["reward_posteriors"], &["reward_posteriors", "reward_posterior"]);
}

#[test]
fn a_parameter_of_the_wrong_type_is_refused() {
    refused(&["reward_posterior", "--ros-args", "-p", "beta:=high"], &["beta", "high"]);
    refused(&["reward_posterior", "--ros-args", "-p", "seed:=1.5"], &["seed", "1.5"]);
    refused(&["demonstrator", "--ros-args", "-p", "reward_weights:=[a, b]"], &["reward_weights"]);
    refused(&["reward_posterior", "--ros-args", "-p", "prior:=flat"], &["prior", "flat", "l1_sphere"]);
}

#[test]
fn alpha_delta_epsilon_and_beta_out_of_range_are_refused() {
    for (node, name, values) in [
        ("performance_bounds", "alpha", ["1.5", "0.0", "-0.95", ".nan"]),
        ("performance_bounds", "delta", ["0.0", "1.0", "-0.05", ".nan"]),
        ("active_query", "epsilon_m", ["0.0", "-0.1", "1e9", ".inf"]),
        ("reward_posterior", "beta", ["0.0", "-100.0", "1e300", ".nan"]),
    ] {
        for value in values {
            refused(&[node, "--ros-args", "-p", &format!("{name}:={value}")], &[name]);
        }
    }
}

#[test]
fn a_port_in_use_is_refused() {
    let taken = std::net::TcpListener::bind("127.0.0.1:0").expect("some port is free");
    let port = taken.local_addr().expect("it is bound").port().to_string();
    let _turn = Turn::take();
    let output = run(&["operator_ui", "--ros-args", "-p", &format!("port:={port}")]);
    let told = stderr(&output);
    assert_eq!(output.status.code(), Some(2), "{told}");
    let lines: Vec<&str> = told.lines().filter(|line| line.contains(&port)).collect();
    assert_eq!(lines.len(), 1, "{told}");
    assert!(lines[0].contains("in use") && !told.contains("panicked"), "{told}");

    // A whole lesson that needs the page ends too, and finishes what it has recorded.
    let session = fresh_folder("port-in-use").join("session");
    let output = run(&["--demonstrator", "human", "--session", &text(&session), "--port", &port]);
    assert_eq!(output.status.code(), Some(2), "{}", stderr(&output));
    let shown = format!("{}{}", String::from_utf8_lossy(&output.stdout), stderr(&output));
    assert_eq!(shown.lines().filter(|line| line.contains("in use")).count(), 1, "{shown}");
    assert!(Recorded::read(&session.join("bag")).expect("the bag opens").whole);
}

#[test]
fn a_wrong_environment_is_refused() {
    let _turn = Turn::take();
    let mut command = apprentice(fresh_domain(), &["active_query"]);
    let output = command.env("ROS_DOMAIN_ID", "many").output().expect("it starts");
    let told = stderr(&output);
    assert_eq!(output.status.code(), Some(2), "{told}");
    assert!(told.contains("ROS_DOMAIN_ID") && told.contains("many"), "{told}");
}

/// A copy of the lesson's bag file, cut to a share of its bytes.
fn truncated(name: &str, share: f64) -> PathBuf {
    let bag = flowers().bag;
    let first = bag_files::list_files(&bag).expect("a bag").into_iter().next().expect("a file");
    let bytes = std::fs::read(first).expect("it can be read");
    let path = fresh_folder(name).join("cut_0.mcap");
    let kept = (bytes.len() as f64 * share) as usize;
    std::fs::write(&path, &bytes[..kept]).expect("writes");
    path
}

fn text(path: &Path) -> String {
    path.to_string_lossy().into_owned()
}

#[test]
fn an_unreadable_bag_is_refused() {
    let folder = fresh_folder("unreadable");
    let noise = folder.join("noise_0.mcap");
    std::fs::write(&noise, b"this is no bag, but long enough to be looked at twice").expect("writes");
    let empty = folder.join("empty");
    std::fs::create_dir(&empty).expect("makes a folder");
    for path in [noise, empty, folder.join("missing")] {
        let path = text(&path);
        let name = path.rsplit('/').next().expect("a name");
        refused(&["replay", "--verify", &path], &[name]);
        refused(&["bag", "info", &path], &[name]);
        refused(&["bag_player", "--ros-args", "-p", &format!("bag:={path}")], &[name]);
    }
}

#[test]
fn a_truncated_bag_says_so_gives_what_it_has_and_can_be_recovered() {
    let path = truncated("truncated", 0.6);
    let info = run(&["bag", "info", &text(&path)]);
    let told = format!("{}{}", String::from_utf8_lossy(&info.stdout), stderr(&info));
    assert!(told.to_lowercase().contains("recover"), "what to do is told: {told}");
    assert!(!told.contains("panicked"), "{told}");

    let recovered = run(&["bag", "recover", &text(&path)]);
    assert!(recovered.status.success(), "{}", stderr(&recovered));
    let whole = bag_files::open_bag(&path).expect("it opens");
    assert_eq!(whole.damage().count(), 0, "a recovered bag is whole");
    assert!(whole.metadata.message_count > 0, "what was flushed is kept");

    let verified = run(&["replay", "--verify", &text(&path)]);
    assert!(verified.status.success(), "what is left agrees with itself: {}", stderr(&verified));
}
