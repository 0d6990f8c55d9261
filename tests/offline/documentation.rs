//! What is documented works: every command of the crate's README and of each help, every file shown, every key named.

use crate::command::{Folder, errors, top};
use serde_json::Value;
use std::collections::BTreeSet;

const COMMANDS: [&str; 5] = ["infer", "likelihood", "bound", "evaluate", "optimize"];

fn readme() -> String {
    std::fs::read_to_string(top().join("nodes/offline/README.md")).expect("there is a README")
}

/// The command lines of a text, continued ones as one.
fn command_lines(text: &str) -> Vec<String> {
    let joined = text.replace("\\\n", " ");
    joined
        .lines()
        .map(str::trim)
        .filter_map(|line| line.strip_prefix("apprentice "))
        .filter(|line| line.contains("--"))
        .map(str::to_owned)
        .collect()
}

/// The code blocks of a Markdown text with what stands after their fences.
fn blocks(text: &str) -> Vec<(String, String)> {
    let mut found = Vec::new();
    let mut open: Option<(String, String)> = None;
    for line in text.lines() {
        match (&mut open, line.strip_prefix("```")) {
            (Some(_), Some(_)) => found.extend(open.take()),
            (None, Some(info)) => open = Some((info.to_owned(), String::new())),
            (Some((_, content)), None) => *content += &format!("{line}\n"),
            (None, None) => {}
        }
    }
    found
}

#[test]
fn every_command_of_the_readme_and_of_the_help_runs() {
    let folder = Folder::new();
    let commands: Vec<String> =
        blocks(&readme()).iter().filter(|(info, _)| info == "sh").flat_map(|(_, text)| command_lines(text)).collect();
    assert!(commands.len() >= 12, "{commands:?}");
    let helps = COMMANDS.iter().flat_map(|command| {
        let output = folder.run(&format!("{command} --help"));
        assert!(output.status.success(), "{command} --help: {}", errors(&output));
        let help = String::from_utf8(output.stdout).expect("help is UTF-8");
        let examples = command_lines(help.split("Examples:").nth(1).expect("help has examples"));
        assert!(examples.len() >= 2, "{command} --help has {examples:?}");
        examples
    });
    for line in commands.into_iter().chain(helps) {
        let output = folder.run(&line);
        assert_eq!(output.status.code(), Some(0), "{line}: {}", errors(&output));
        if line.contains("--json") {
            serde_json::from_slice::<Value>(&output.stdout).expect("one JSON object");
        } else {
            assert!(!output.stdout.is_empty(), "{line}");
        }
    }
}

#[test]
fn every_file_that_is_shown_is_shown_as_it_is() {
    let mut n = 0;
    for (info, content) in blocks(&readme()) {
        if let Some((_, name)) = info.split_once(' ') {
            let file = std::fs::read_to_string(top().join(name)).expect("the README names a file of the tree");
            assert_eq!(file, content, "{name}");
            n += 1;
        }
    }
    assert!(n >= 4, "{n} files are shown");
}

#[test]
fn every_example_file_is_explained_and_used() {
    let folder = top().join("config/examples");
    let about = std::fs::read_to_string(folder.join("README.md")).expect("there is a README");
    for entry in std::fs::read_dir(&folder).expect("there are examples").flatten() {
        let name = entry.file_name().to_string_lossy().into_owned();
        if name != "README.md" {
            assert!(about.contains(&format!("`{name}`")), "config/examples/README.md does not tell of {name}");
            assert!(
                readme().contains(&format!("config/examples/{name}")),
                "nodes/offline/README.md does not use {name}"
            );
        }
    }
}

/// Names between backquotes in the first columns of the tables of one section.
fn documented(section: &str) -> BTreeSet<String> {
    let rows = section.lines().filter(|line| line.starts_with("| `"));
    let first = rows.filter_map(|line| line.split('|').nth(1));
    first.flat_map(|cell| cell.split('`').skip(1).step_by(2).map(str::to_owned).collect::<Vec<_>>()).collect()
}

fn keys(value: &Value) -> BTreeSet<String> {
    value.as_object().expect("an object").keys().cloned().collect()
}

#[test]
fn the_keys_of_every_answer_are_those_documented() {
    let folder = Folder::new();
    let readme = readme();
    for command in COMMANDS {
        let section = readme.split(&format!("## `apprentice {command}`\n")).nth(1).expect("a section");
        let section = section.split("\n## ").next().expect("a section");
        let (of_answer, of_policy) = section.split_once("| key of a policy |").unwrap_or((section, ""));
        let line =
            command_lines(section).into_iter().find(|line| line.ends_with("--json")).expect("an example with --json");
        let answer = folder.json(line.trim_end_matches("--json"));
        let mut wanted = documented(of_answer);
        if !of_policy.is_empty() {
            let of_policy = documented(of_policy);
            assert_eq!(keys(&answer["policies"][0]), of_policy, "{command}: a policy");
            wanted.extend(of_policy);
        }
        assert_eq!(keys(&answer), wanted, "{command}");
    }
}

/// What the contract in `shared/formats.md` asks for at least.
#[test]
fn the_contract_is_kept() {
    let folder = Folder::new();
    let answer =
        folder.json("infer --features config/examples/trajectories.csv --preferences config/examples/preferences.csv");
    let infer = [
        "mean",
        "map",
        "log_likelihood_mean",
        "map_log_likelihood",
        "beta",
        "rhat_max",
        "ess_min",
        "ess_median",
        "acceptance",
        "n_draws",
        "n_chains",
        "seconds",
        "cpu_seconds",
        "outcome",
    ];
    for key in infer {
        assert!(!answer[key].is_null(), "infer: {key}");
    }
    let answer =
        folder.json("bound --losses config/examples/losses.csv --alpha 0.95 --delta 0.05 --chains 4 --tail upper");
    let bound = ["outcome", "bound", "n", "ess", "rhat", "index", "needed", "point_estimate", "cvar"];
    for key in bound {
        assert!(!answer[key].is_null(), "bound: {key}");
    }
    let files =
        "--mdp config/examples/kitchen.json --draws config/examples/draws.csv --policy config/examples/around.json";
    let answer = folder.json(&format!("evaluate {files}"));
    for key in ["expected_feature_counts", "losses", "bounds"] {
        assert!(!answer[key].is_null(), "evaluate: {key}");
    }
    let line = "likelihood --mdp config/examples/kitchen.json --demonstrations config/examples/demonstrations.csv";
    let answer = folder.json(&format!("{line} --weights config/examples/weights.csv"));
    assert_eq!(answer["log_likelihood"].as_array().map(Vec::len), Some(3));
    let answer = folder.json(
        "optimize --mdp config/examples/kitchen.json --draws config/examples/draws.csv --alpha 0.95 --lambda 0.5",
    );
    let optimize =
        ["outcome", "objective", "expected_return", "var", "cvar", "policy", "occupancy", "gap", "method", "seconds"];
    for key in optimize {
        assert!(!answer[key].is_null(), "optimize: {key}");
    }
    for command in COMMANDS {
        let help = String::from_utf8(folder.run(&format!("{command} --help")).stdout).expect("UTF-8");
        for flag in ["--json", "--seed"] {
            assert!(help.contains(flag), "{command} takes {flag}");
        }
    }
}
