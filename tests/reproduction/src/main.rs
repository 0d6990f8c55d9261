//! Results of the dissertation beside ours, one command each: `cargo run --release -p reproduction -- NAME`.

mod all;
mod chapter4;
mod chapter6;
mod chapter7;
mod chapter8;
#[cfg(feature = "lessons")]
mod chart;
mod fig_4_2;
mod fig_4_3;
mod fig_4_4;
mod fig_4_6;
mod fig_7_3;
mod fig_7_4;
mod fig_7_5;
mod fig_8_1;
mod fig_8_2;
mod fig_8_3;
mod fig_8_4;
mod fig_8_6;
mod fig_g_1;
mod harness;
#[cfg(feature = "lessons")]
mod lesson;
mod report;
mod stopping;
#[cfg(feature = "lessons")]
mod table;
mod table_4_1;
mod table_4_2;
mod table_6_2;
mod table_6_3;
mod table_6_4;
mod table_6_5;

use clap::{Args, Command, FromArgMatches};
use harness::{Figure, Options, ReproductionError};
use std::process::ExitCode;

/// Every figure and table with a command of its own, in the order of the report. A new one is one more entry here.
const FIGURES: &[Figure] = &[
    Figure { name: "fig-4.2", about: "Accuracy and tightness of the bounds in random grid worlds", run: fig_4_2::run },
    Figure {
        name: "fig-4.3",
        about: "Demonstrations with a fifth of random actions, read with several rationalities",
        run: fig_4_3::run,
    },
    Figure {
        name: "fig-4.4",
        about: "Bounds for evaluation policies that are wrong in ever more states, after one demonstration",
        run: |options| fig_4_4::run(&fig_4_4::FIG_4_4, options),
    },
    Figure {
        name: "fig-4.5",
        about: "The same after nine demonstrations",
        run: |options| fig_4_4::run(&fig_4_4::FIG_4_5, options),
    },
    Figure {
        name: "table-4.1",
        about: "Bounds for the policy of the projection algorithm, beside the Hoeffding bound",
        run: table_4_1::run,
    },
    Figure { name: "table-4.2", about: "Policies ranked by their bounds in the driving world", run: table_4_2::run },
    Figure { name: "fig-4.6", about: "A policy improved until its value at risk is least", run: fig_4_6::run },
    Figure {
        name: "table-6.2",
        about: "Ranked random rollouts against optimal demonstrations",
        run: |options| chapter6::run(&table_6_2::TABLE, options),
    },
    Figure {
        name: "table-6.3",
        about: "Only ranked random rollouts",
        run: |options| chapter6::run(&table_6_3::TABLE, options),
    },
    Figure {
        name: "table-6.4",
        about: "Only ranked random rollouts, the best and worst of them called good and bad",
        run: |options| chapter6::run(&table_6_4::TABLE, options),
    },
    Figure {
        name: "table-6.5",
        about: "Only optimal demonstrations",
        run: |options| chapter6::run(&table_6_5::TABLE, options),
    },
    Figure {
        name: "fig-7.3",
        about: "Machine replacement: policies over λ, frontier, return distributions",
        run: fig_7_3::run,
    },
    Figure { name: "fig-7.4", about: "Policies after one ambiguous demonstration", run: fig_7_4::run },
    Figure {
        name: "fig-7.5",
        about: "Return distributions over the posterior, and the frontier of BROIL regret",
        run: fig_7_5::run,
    },
    Figure { name: "fig-8.1", about: "The first two questions by entropy and by value at risk", run: fig_8_1::run },
    Figure { name: "fig-8.2", about: "Which actions to ask for in grids with 48 features", run: fig_8_2::run },
    Figure { name: "fig-8.3", about: "Which trajectories to have criticised, and what it costs", run: fig_8_3::run },
    Figure { name: "fig-8.4", about: "What is asked on a highway after more and more driving", run: fig_8_4::run },
    Figure { name: "fig-8.6", about: "Teaching where to place flowers and a spoon", run: fig_8_6::run },
    Figure {
        name: "stopping",
        about: "Lessons that end by the stopping rule, and how often too early",
        run: stopping::run,
    },
    Figure { name: "fig-g.1", about: "Questions where rewards are sparse", run: fig_g_1::run },
];

fn main() -> ExitCode {
    match run() {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("reproduction: {error}");
            ExitCode::FAILURE
        }
    }
}

fn run() -> Result<(), ReproductionError> {
    let matches = command().get_matches();
    let (name, matches) = matches.subcommand().expect("clap asks for a command");
    match name {
        "all" => all::run(FIGURES, &read(matches)),
        "report" => report::run(FIGURES, &read(matches)),
        #[cfg(feature = "lessons")]
        "table" => Ok(table::run(&read(matches))?),
        _ => {
            let figure = FIGURES.iter().find(|figure| figure.name == name).expect("clap knows no other command");
            let options: Options = read(matches);
            figure.make(&options)?.deliver(&options)
        }
    }
}

fn command() -> Command {
    let mut command = Command::new("reproduction")
        .about("Results of the dissertation beside ours, with an SVG plot and JSON")
        .after_help(
            "Examples:\n  \
            cargo run --release -p reproduction -- fig-4.2 --replicates 20 --svg fig-4.2.svg\n  \
            cargo run --release -p reproduction -- all\n  \
            cargo run --release -p reproduction -- table --trials 20",
        )
        .subcommand_required(true)
        .arg_required_else_help(true);
    for figure in FIGURES {
        command = command.subcommand(Options::augment_args(Command::new(figure.name)).about(figure.about));
    }
    #[cfg(feature = "lessons")]
    {
        let table = table::Arguments::augment_args(Command::new("table"));
        command =
            command.subcommand(table.about("Figure 8.6: teaching a robot to set a table, questions chosen by risk"));
    }
    command
        .subcommand(
            all::Arguments::augment_args(Command::new("all"))
                .about("Every figure and table that is not there yet, then the report"),
        )
        .subcommand(
            report::Arguments::augment_args(Command::new("report")).about("Writes the report of what `all` has made"),
        )
}

/// The arguments of a command, which clap has checked.
fn read<T: FromArgMatches>(matches: &clap::ArgMatches) -> T {
    T::from_arg_matches(matches).unwrap_or_else(|error| error.exit())
}

#[cfg(test)]
mod tests {
    use super::{FIGURES, command, read};
    use crate::harness::{Options, Summary};

    #[test]
    fn the_commands_fit_together() {
        command().debug_assert();
    }

    /// Every figure, by its own command line, with as few replicates as there may be.
    #[test]
    fn every_figure_can_be_made_and_read_again() {
        let folder = tempfile::tempdir().expect("a folder");
        for figure in FIGURES {
            let (json, svg) = (folder.path().join("figure.json"), folder.path().join("figure.svg"));
            let arguments = ["reproduction", figure.name, "--replicates", "2", "--seed", "5", "--json"];
            let mut arguments: Vec<String> = arguments.map(String::from).to_vec();
            arguments.extend([json.display().to_string(), "--svg".into(), svg.display().to_string()]);
            let matches = command().try_get_matches_from(arguments).expect("a good command line");
            let (name, matches) = matches.subcommand().expect("a command");
            assert_eq!(name, figure.name);
            let options: Options = read(matches);
            let made = figure.make(&options).unwrap_or_else(|error| panic!("{name}: {error}"));
            made.deliver(&options).unwrap_or_else(|error| panic!("{name}: {error}"));

            let summary = Summary::read(&json).expect("a good file").expect("the file is there");
            assert_eq!(summary, made.summary);
            assert_eq!((summary.name.as_str(), summary.replicates, summary.seed, summary.full), (name, 2, 5, false));
            assert!(!summary.tables.is_empty() && !summary.claims.is_empty(), "{name} shows nothing");
            let whole: serde_json::Value =
                serde_json::from_slice(&std::fs::read(&json).expect("the file is there")).expect("JSON");
            let data = &whole["data"];
            assert!(data.as_array().is_some_and(|rows| !rows.is_empty()) || data.is_object(), "{name}: no numbers");
            let drawn = std::fs::read_to_string(&svg).expect("the picture is there");
            assert!(drawn.starts_with("<svg") && drawn.trim_end().ends_with("</svg>"), "{name}: no picture");
        }
    }
}
