//! Who may depend on what, and what a file looks like.

use crate::files::{self, File};

/// The crates of the nodes.
const NODES: [&str; 14] = [
    "active_query",
    "bag_player",
    "bringup",
    "demonstrator",
    "operator_ui",
    "performance_bounds",
    "placement_planner",
    "policy_optimizer",
    "reward_posterior",
    "session_recorder",
    "simulated_table",
    "simulated_world",
    "table_perception",
    "replay",
];

/// Most lines of a file that is still one idea.
const MAX_LINES: usize = 500;

/// Every package's folder (empty for the root) and what it depends on.
fn packages() -> Vec<(String, Vec<String>)> {
    let is_manifest = |file: &File| file.path == "Cargo.toml" || file.path.ends_with("/Cargo.toml");
    let folder = |file: &File| file.path.trim_end_matches("Cargo.toml").trim_end_matches('/').to_owned();
    let manifests = files::all().into_iter().filter(is_manifest);
    manifests.map(|file| (folder(&file), files::dependencies(&file.text))).collect()
}

/// Fails with every broken rule at once.
fn none(problems: Vec<String>, rule: &str) {
    assert!(problems.is_empty(), "{rule}:\n{}", problems.join("\n"));
}

#[test]
fn each_middleware_and_geometry_library_is_named_by_one_crate() {
    let owners = [
        ("ros2-client", "nodes/bus"),
        ("rustdds", "nodes/bus"),
        ("parry3d-f64", "nodes/lib/arm"),
        ("clarabel", "nodes/lib/robust"),
        ("mcap", "nodes/lib/bag"),
    ];
    let mut problems = Vec::new();
    for (library, owner) in owners {
        for (folder, dependencies) in packages() {
            if folder != owner && dependencies.iter().any(|name| name == library) {
                problems.push(format!("{folder}/Cargo.toml names {library}"));
            }
        }
    }
    none(problems, "only its owner names a library that others are to be kept from");
}

#[test]
fn no_node_depends_on_a_node() {
    let mut problems = Vec::new();
    for (folder, dependencies) in packages() {
        // The executable and the tests hold every node, and a replay runs those that compute.
        let may = !folder.starts_with("nodes/") || folder == "nodes/replay";
        problems.extend(
            dependencies
                .iter()
                .filter(|name| !may && NODES.contains(&name.as_str()))
                .map(|name| format!("{folder} depends on {name}")),
        );
    }
    none(problems, "nodes talk over topics alone");
}

#[test]
fn pure_crates_depend_on_no_node_and_not_on_the_bus() {
    let mut problems = Vec::new();
    for (folder, dependencies) in packages().into_iter().filter(|(folder, _)| folder.starts_with("nodes/lib/")) {
        problems.extend(dependencies.iter().filter(|name| *name == "bus").map(|_| format!("{folder} depends on bus")));
    }
    none(problems, "dependencies point one way");
}

#[test]
fn pure_crates_touch_no_clock_file_environment_or_global_generator() {
    let impure = [
        "Instant::now",
        "SystemTime::now",
        "std::fs",
        "std::env",
        "std::net",
        "std::process",
        "rand::rng(",
        "thread_rng",
    ];
    let mut problems = Vec::new();
    for file in files::rust() {
        let pure = file.path.starts_with("nodes/lib/") && file.path.contains("/src/");
        for (number, line) in file.text.lines().enumerate().filter(|_| pure) {
            let code = line.split("//").next().unwrap_or("");
            problems.extend(
                impure
                    .iter()
                    .filter(|word| code.contains(*word))
                    .map(|word| format!("{}:{}: {word}", file.path, number + 1)),
            );
        }
    }
    none(problems, "time, files and randomness are arguments of the pure crates");
}

#[test]
fn every_package_takes_the_lints_of_the_workspace() {
    let manifests = files::all().into_iter().filter(|file| file.path.ends_with("Cargo.toml"));
    let without = manifests.filter(|file| !file.text.contains("[lints]\nworkspace = true"));
    none(without.map(|file| file.path).collect(), "[lints] workspace = true");
}

#[test]
fn every_file_says_what_it_is_for_and_stays_short() {
    let mut problems = Vec::new();
    for file in files::rust() {
        if !file.text.starts_with("//!") {
            problems.push(format!("{} does not begin with a //! sentence", file.path));
        }
    }
    let written = [".rs", ".py", ".js", ".css", ".html", ".sh", "/run"];
    for file in files::all().iter().filter(|file| !file.path.contains("/generated/")) {
        let lines = file.text.lines().count();
        if lines > MAX_LINES && written.iter().any(|end| file.path.ends_with(end)) {
            problems.push(format!("{} has {lines} lines, at most {MAX_LINES} are wanted", file.path));
        }
    }
    none(problems, "one idea a file");
}

#[test]
fn nothing_is_left_open() {
    // Put together from parts, so that this file does not hold them.
    let open = [["todo", "!("], ["unimplemented", "!("], ["#[ign", "ore"], ["FIX", "ME"], ["dbg", "!("]]
        .map(|parts| parts.concat());
    let mut problems = Vec::new();
    for file in files::rust() {
        problems
            .extend(open.iter().filter(|word| file.text.contains(*word)).map(|word| format!("{}: {word}", file.path)));
    }
    none(problems, "no stubs and no tests that are left out");
}

#[test]
fn no_file_names_a_machine() {
    let folders =
        [["/ro", "ot/"], ["/ho", "me/"], ["/wo", "rk/"], ["/Use", "rs/"], ["/fa", "rm/"]].map(|parts| parts.concat());
    let hosts =
        [["index.crat", "es.io"], ["pypi.o", "rg"], ["arti", "factory"], ["file", ":///"]].map(|parts| parts.concat());
    let begins = |text: &str, at: usize| {
        text[..at].chars().next_back().is_none_or(|c| !(c.is_alphanumeric() || "._-}".contains(c)))
    };
    let mut problems = Vec::new();
    for file in files::all() {
        for (number, line) in file.text.lines().enumerate() {
            let folder =
                folders.iter().any(|folder| line.match_indices(folder.as_str()).any(|(at, _)| begins(line, at)));
            if folder || hosts.iter().any(|host| line.contains(host.as_str())) {
                problems.push(format!("{}:{}: {}", file.path, number + 1, line.chars().take(100).collect::<String>()));
            }
        }
    }
    none(problems, "no path of one machine, no registry");
}
