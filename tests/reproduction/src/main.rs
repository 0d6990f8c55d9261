//! Results of the dissertation beside ours, one command each: `cargo run --release -p reproduction -- NAME`.

mod chapter4;
mod chapter6;
mod chart;
mod fig_4_2;
mod fig_4_3;
mod fig_4_4;
mod fig_4_6;
mod harness;
mod lesson;
mod table;
mod table_4_1;
mod table_4_2;
mod table_6_2;
mod table_6_3;
mod table_6_4;
mod table_6_5;

use clap::{Parser, Subcommand};
use harness::{Options, ReproductionError};
use std::process::ExitCode;

/// Results of the dissertation beside ours, with an SVG plot and JSON.
#[derive(Debug, Parser)]
#[command(
    name = "reproduction",
    after_help = "Examples:\n  \
        cargo run --release -p reproduction -- fig-4.2 --replicates 20 --svg fig-4.2.svg\n  \
        cargo run --release -p reproduction -- table --trials 20"
)]
struct Arguments {
    #[command(subcommand)]
    what: What,
}

#[derive(Debug, Subcommand)]
enum What {
    /// Accuracy and tightness of the bounds in random grid worlds
    #[command(name = "fig-4.2")]
    Figure42(Options),
    /// Demonstrations with a fifth of random actions, read with several rationalities
    #[command(name = "fig-4.3")]
    Figure43(Options),
    /// Bounds for evaluation policies that are wrong in ever more states, after one demonstration
    #[command(name = "fig-4.4")]
    Figure44(Options),
    /// The same after nine demonstrations
    #[command(name = "fig-4.5")]
    Figure45(Options),
    /// Bounds for the policy of the projection algorithm, beside the Hoeffding bound
    #[command(name = "table-4.1")]
    Table41(Options),
    /// Policies ranked by their bounds in the driving world
    #[command(name = "table-4.2")]
    Table42(Options),
    /// A policy improved until its value at risk is least
    #[command(name = "fig-4.6")]
    Figure46(Options),
    /// Ranked random rollouts against optimal demonstrations
    #[command(name = "table-6.2")]
    Table62(Options),
    /// Only ranked random rollouts
    #[command(name = "table-6.3")]
    Table63(Options),
    /// Only ranked random rollouts, the best and worst of them called good and bad
    #[command(name = "table-6.4")]
    Table64(Options),
    /// Only optimal demonstrations
    #[command(name = "table-6.5")]
    Table65(Options),
    /// Figure 8.6: teaching a robot to set a table, questions chosen by risk
    Table(table::Arguments),
}

fn main() -> ExitCode {
    match run(&Arguments::parse().what) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("reproduction: {error}");
            ExitCode::FAILURE
        }
    }
}

fn run(what: &What) -> Result<(), ReproductionError> {
    let (outcome, options) = match what {
        What::Figure42(options) => (fig_4_2::run(options)?, options),
        What::Figure43(options) => (fig_4_3::run(options)?, options),
        What::Figure44(options) => (fig_4_4::run(&fig_4_4::FIG_4_4, options)?, options),
        What::Figure45(options) => (fig_4_4::run(&fig_4_4::FIG_4_5, options)?, options),
        What::Table41(options) => (table_4_1::run(options)?, options),
        What::Table42(options) => (table_4_2::run(options)?, options),
        What::Figure46(options) => (fig_4_6::run(options)?, options),
        What::Table62(options) => (chapter6::run(&table_6_2::TABLE, options)?, options),
        What::Table63(options) => (chapter6::run(&table_6_3::TABLE, options)?, options),
        What::Table64(options) => (chapter6::run(&table_6_4::TABLE, options)?, options),
        What::Table65(options) => (chapter6::run(&table_6_5::TABLE, options)?, options),
        What::Table(arguments) => return Ok(table::run(arguments)?),
    };
    outcome.deliver(options)
}
