//! What is shipped works: every parameter file, and every command of the README.

use crate::files;
use std::process::{Command, Output};

fn apprentice(arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_apprentice"))
        .args(arguments)
        .output()
        .expect("the executable was built for this test")
}

fn words(output: &Output) -> String {
    format!("{}{}", String::from_utf8_lossy(&output.stdout), String::from_utf8_lossy(&output.stderr))
}

#[test]
fn every_shipped_parameter_file_is_good_for_every_node() {
    let files: Vec<String> = files::all()
        .into_iter()
        .filter(|file| file.path.starts_with("config/") && file.text.contains("ros__parameters"))
        .map(|file| files::top().join(file.path).to_string_lossy().into_owned())
        .collect();
    assert!(files.len() >= 2, "flowers and spoon, at least: {files:?}");
    let mut arguments = vec!["check"];
    arguments.extend(files.iter().map(String::as_str));
    let output = apprentice(&arguments);
    assert!(output.status.success(), "{}", words(&output));
}

#[test]
fn every_node_tells_its_parameters() {
    let help = words(&apprentice(&["help"]));
    let nodes = ["demonstrator", "simulated_table", "reward_posterior", "performance_bounds", "active_query"];
    for node in nodes.into_iter().chain([
        "simulated_world",
        "table_perception",
        "policy_optimizer",
        "placement_planner",
        "session_recorder",
        "bag_player",
        "operator_ui",
    ]) {
        assert!(help.contains(node), "`apprentice help` does not tell of {node}:\n{help}");
        let output = apprentice(&[node, "--help"]);
        assert!(output.status.success(), "{node} --help: {}", words(&output));
        assert!(words(&output).contains("--ros-args"), "{node} --help: {}", words(&output));
    }
}

#[test]
fn every_command_of_the_readme_is_there() {
    let readme = std::fs::read_to_string(files::top().join("README.md")).expect("there is a README");
    let help = words(&apprentice(&["help"])) + &words(&apprentice(&["--help"]));
    let mut n_commands = 0;
    for line in code_lines(&readme).into_iter().chain(code_words(&readme)) {
        let words: Vec<&str> =
            line.split_whitespace().skip_while(|word| word.contains('=') && !word.starts_with('-')).collect();
        let Some((first, rest)) = words.split_first() else { continue };
        let own: Vec<&str> = match *first {
            "cargo" => match rest.iter().position(|word| *word == "-p") {
                Some(at) => {
                    assert!(is_package(rest.get(at + 1).unwrap_or(&"")), "README: `{line}`: there is no such package");
                    Vec::new()
                }
                None => rest.iter().copied().skip_while(|word| *word != "--").skip(1).collect(),
            },
            "apprentice" => rest.to_vec(),
            script if script.starts_with("tests/") || script.starts_with(".ci/") => {
                assert!(files::top().join(script).exists(), "the README names {script}");
                Vec::new()
            }
            _ => continue,
        };
        n_commands += 1;
        check_words(&line, &own, &help);
    }
    assert!(n_commands >= 5, "{n_commands} commands were found in the README; run it and test it, at least");
}

/// Every flag, and the command if there is one, must be in the help.
fn check_words(line: &str, own: &[&str], help: &str) {
    for word in own.iter().take_while(|word| **word != "--ros-args").filter(|word| word.starts_with("--")) {
        let option = word.split('=').next().unwrap_or(word);
        let of_replay = own.first() == Some(&"replay") && option == "--verify";
        assert!(of_replay || help.contains(option), "README: `{line}`: {option} is not in the help:\n{help}");
    }
    if let Some(command) = own.first().filter(|word| !word.starts_with(['-', '<', '…'])) {
        assert!(help.contains(*command), "README: `{line}`: {command} is not in the help:\n{help}");
    }
}

fn is_package(name: &str) -> bool {
    let line = format!("name = \"{name}\"");
    files::all().iter().any(|file| file.path.ends_with("Cargo.toml") && file.text.lines().any(|l| l == line))
}

/// The commands that stand in the text of a Markdown file, between backquotes.
fn code_words(text: &str) -> Vec<String> {
    let spans = text.lines().flat_map(|line| line.split('`').skip(1).step_by(2));
    let is_command =
        |span: &&str| ["apprentice ", "cargo ", "tests/", ".ci/"].iter().any(|start| span.starts_with(start));
    spans.filter(is_command).map(str::to_owned).collect()
}

/// The lines of the shell code in a Markdown text, without comments.
fn code_lines(text: &str) -> Vec<String> {
    let mut inside = None;
    let mut lines = Vec::new();
    for line in text.lines() {
        if let Some(language) = line.trim_start().strip_prefix("```") {
            inside = if inside.is_some() {
                None
            } else {
                Some(["", "sh", "bash", "console", "text"].contains(&language.trim()))
            };
        } else if inside == Some(true) {
            let code = line.split(" #").next().unwrap_or("").trim().trim_start_matches("$ ");
            lines.push(code.to_owned());
        }
    }
    lines
}
