//! `apprentice check`: reads parameter files as every node would.

use crate::registry::nodes;
use bus::{Arguments, NodeSettings};
use clap::Parser;
use std::path::PathBuf;
use std::process::ExitCode;

/// Reads ROS parameter files as every node would, and names what any of them would refuse.
///
/// Exit code 0: all good; 2: the first thing wrong is named.
#[derive(Debug, Parser)]
#[command(name = "apprentice check", after_help = "Example:\n  apprentice check config/flowers.yaml my-table.yaml")]
pub struct Check {
    /// Parameter files, each checked by itself
    #[arg(required = true)]
    files: Vec<PathBuf>,
}

/// Runs the command.
pub fn run(check: &Check) -> ExitCode {
    let bringup = |arguments: &Arguments| arguments.settings::<bringup::Settings>().map(drop);
    let mut checks: Vec<_> = nodes().into_iter().map(|node| (node.info.name, node.info.check)).collect();
    checks.push((bringup::Settings::NODE, bringup));
    let setting = |arguments: &Arguments| arguments.settings::<bringup::setting::Settings>().map(drop);
    checks.push((bringup::setting::Settings::NODE, setting));
    for file in &check.files {
        let args = ["--params-file".to_owned(), file.to_string_lossy().into_owned()];
        for (name, check) in &checks {
            let result = match Arguments::parse(&args) {
                Ok(arguments) => check(&arguments).map_err(|error| error.to_string()),
                Err(error) => Err(error.to_string()),
            };
            if let Err(error) = result {
                eprintln!("error: {name}: {error}");
                return ExitCode::from(2);
            }
        }
        println!("{}: good for all {} nodes", file.display(), checks.len());
    }
    ExitCode::SUCCESS
}
