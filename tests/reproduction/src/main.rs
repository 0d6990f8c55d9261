//! Results of the dissertation beside ours, one command each: `cargo run --release -p reproduction -- NAME`.

mod chart;
mod lesson;
mod table;

use clap::{Parser, Subcommand};
use std::process::ExitCode;

/// Results of the dissertation beside ours, with an SVG plot and JSON.
#[derive(Debug, Parser)]
#[command(name = "reproduction", after_help = "Example:\n  cargo run --release -p reproduction -- table --trials 20")]
struct Arguments {
    #[command(subcommand)]
    what: What,
}

#[derive(Debug, Subcommand)]
enum What {
    /// Figure 8.6: teaching a robot to set a table, questions chosen by risk
    Table(table::Arguments),
}

fn main() -> ExitCode {
    let Arguments { what: What::Table(arguments) } = Arguments::parse();
    match table::run(&arguments) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("reproduction: {error}");
            ExitCode::FAILURE
        }
    }
}
