//! `apprentice`: alone it brings a lesson up; `apprentice <node>` is one node; a few commands work without ROS.

mod bag;
mod check;
mod registry;

use bus::{Arguments, Graph};
use clap::Parser;
use std::process::ExitCode;

/// The commit that this was built from.
const COMMIT: &str = env!("APPRENTICE_COMMIT");

/// Commands that are no nodes: name and purpose.
const COMMANDS: [(&str, &str); 12] = [
    ("bringup", "Starts, watches, restarts and stops the nodes of a lesson; what `apprentice` alone does"),
    ("setting", "A whole table to set: lessons one after another, each thing in the way of the next"),
    ("replay", "Computes a recorded session again, and compares every bit with --verify"),
    ("bag", "What is in a bag (info), and making a broken one whole (recover)"),
    ("check", "Reads parameter files as every node would"),
    ("infer", "The posterior of reward weights given evidence in files: preferences, demonstrations, critiques"),
    ("likelihood", "How probable evidence in files is under given weights"),
    ("bound", "A high-confidence bound on a risk measure of losses in a file"),
    ("evaluate", "Policies judged under posterior draws in a file: losses, bounds, ranking"),
    ("optimize", "The policy that is robust to what posterior draws do not agree on, and what its caution costs"),
    ("robot", "Checks a robot description (URDF) with its meshes: tree, limits, poses, collisions"),
    ("help", "This text; `apprentice --help` has the flags of a lesson"),
];

fn main() -> ExitCode {
    let args: Result<Vec<String>, _> = std::env::args_os().skip(1).map(std::ffi::OsString::into_string).collect();
    let args = match args {
        Ok(args) => args,
        Err(arg) => {
            eprintln!("error: the argument {arg:?} is not UTF-8");
            return ExitCode::from(2);
        }
    };
    match args.split_first() {
        None => lesson(&args),
        Some((first, _)) if first.starts_with('-') => lesson(&args),
        Some((command, rest)) => dispatch(command, rest),
    }
}

fn dispatch(command: &str, rest: &[String]) -> ExitCode {
    match command {
        "bringup" => lesson(rest),
        "setting" => parsed("apprentice setting", rest, bringup::setting::run),
        "replay" => parsed("apprentice replay", rest, replay::run),
        "bag" => parsed("apprentice bag", rest, bag::run),
        "check" => parsed("apprentice check", rest, check::run),
        "infer" => parsed("apprentice infer", rest, offline::infer::run),
        "likelihood" => parsed("apprentice likelihood", rest, offline::likelihood::run),
        "bound" => parsed("apprentice bound", rest, offline::bound::run),
        "evaluate" => parsed("apprentice evaluate", rest, offline::evaluate::run),
        "optimize" => parsed("apprentice optimize", rest, offline::optimize::run),
        "robot" => parsed("apprentice robot", rest, robot_check::run),
        "help" => {
            print!("{}", overview());
            ExitCode::SUCCESS
        }
        name => match registry::nodes().into_iter().find(|node| node.info.name == name) {
            Some(node) => one_node(&node, rest),
            None => unknown(name),
        },
    }
}

fn lesson(args: &[String]) -> ExitCode {
    let nodes: Vec<_> = registry::nodes().into_iter().map(|node| node.info).collect();
    bringup::main(args, &nodes, COMMIT)
}

fn one_node(node: &registry::Node, args: &[String]) -> ExitCode {
    // The nodes read the commit from their environment, whoever starts them.
    if std::env::var_os("APPRENTICE_COMMIT").is_none_or(|held| held != COMMIT)
        && let Err(error) = bringup::take_on(&[("APPRENTICE_COMMIT", COMMIT.to_owned())])
    {
        eprintln!("error: {}: cannot start with its environment: {error}", node.info.name);
        return ExitCode::FAILURE;
    }
    let result = Arguments::parse(args).map_err(Into::into).and_then(|arguments| (node.run)(&Graph::Dds, &arguments));
    match result {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => ExitCode::from(u8::try_from(error.report(node.info.name)).unwrap_or(1)),
    }
}

/// Parses the rest of the command line for a command without ROS, and runs it.
fn parsed<T: Parser>(name: &str, rest: &[String], run: impl FnOnce(&T) -> ExitCode) -> ExitCode {
    match T::try_parse_from(std::iter::once(name).chain(rest.iter().map(String::as_str))) {
        Ok(arguments) => run(&arguments),
        Err(error) => {
            // Help is an error to clap; a closed standard output is not worth a panic.
            let _ = error.print();
            ExitCode::from(u8::try_from(error.exit_code()).unwrap_or(2))
        }
    }
}

fn overview() -> String {
    let nodes = registry::nodes();
    let line = |name: &str, about: &str| format!("  {name:<20} {about}\n");
    let commands: String = COMMANDS.iter().map(|(name, about)| line(name, about)).collect();
    let nodes: String = nodes.iter().map(|node| line(node.info.name, node.info.about)).collect();
    format!(
        "apprentice {} ({COMMIT}): teach a robot to set a table\n\n\
         Usage: apprentice [FLAGS]              a lesson; `apprentice --help` lists the flags\n       \
         apprentice <command> ...        `apprentice <command> --help` says more\n       \
         apprentice <node> [--ros-args ...]\n\nCommands:\n{commands}\nNodes:\n{nodes}",
        env!("CARGO_PKG_VERSION")
    )
}

fn unknown(name: &str) -> ExitCode {
    let nodes = registry::nodes();
    let known = COMMANDS.iter().map(|(name, _)| *name).chain(nodes.iter().map(|node| node.info.name));
    let nearest = known.map(|known| (strsim::damerau_levenshtein(known, name), known)).min();
    let hint = match nearest {
        Some((distance, known)) if distance <= 3 => format!(" (did you mean '{known}'?)"),
        _ => String::new(),
    };
    let name: String = name.chars().take(80).collect();
    eprintln!("error: there is no command or node '{name}'{hint}; `apprentice help` lists them all");
    ExitCode::from(2)
}
