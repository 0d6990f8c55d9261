//! The command line: short flags for people, turned into ROS parameters of bringup.

use crate::{BringupError, Settings};
use bus::Arguments;
use clap::{Parser, ValueEnum};
use std::path::PathBuf;

const EXAMPLES: &str = "\
Examples:
  apprentice                                    a lesson with a simulated person; the page opens on 127.0.0.1
  apprentice --demonstrator human               you answer, in the browser
  apprentice --scenario spoon --seed 7          another task, another draw
  apprentice --scenario grid                    a world to act in: what caution costs, and what may go wrong
  apprentice --headless --until-taught --summary lesson.json
  apprentice --session bags/mine                begin or continue the session in that folder

Other commands:
  apprentice <node> --ros-args ...              one node, as `ros2 run` would start it
  apprentice replay --verify BAG                compute a recorded session again and compare every bit
  apprentice bag info|recover BAG               what is in a bag; make a broken one whole
  apprentice check FILE...                      are these parameter files good?
  apprentice help                               all commands and nodes

Exit codes:
  0  the lesson ended (taught, stopped or given up: see the summary), or it was stopped by Ctrl-C or SIGTERM
  1  something failed, or --time-limit passed
  2  the command line or a parameter is wrong
  130, 143  with --until-taught or --until-placed: interrupted by Ctrl-C or SIGTERM before the lesson ended";

/// Who answers the questions.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Who {
    /// A simulated person with a hidden reward.
    Simulated,
    /// You, at the page.
    Human,
}

/// Teach a robot to set a table: brings up every node of a lesson and tells its story.
#[derive(Debug, Clone, PartialEq, Parser)]
#[command(name = "apprentice", version, after_help = EXAMPLES, disable_help_subcommand = true, max_term_width = 110)]
pub struct Flags {
    /// The task: flowers, spoon, grid, driving, or the path of a parameter file [default: flowers]
    #[arg(long, value_name = "NAME|FILE")]
    pub scenario: Option<String>,
    /// Who answers the questions [default: simulated]
    #[arg(long, value_enum, hide_possible_values = false)]
    pub demonstrator: Option<Who>,
    /// No operator's page
    #[arg(long)]
    pub headless: bool,
    /// End by itself when the lesson ends
    #[arg(long)]
    pub until_taught: bool,
    /// End by itself when the lesson has ended and the robot has put the thing down
    #[arg(long)]
    pub until_placed: bool,
    /// Write what happened to this file, as JSON
    #[arg(long, value_name = "FILE")]
    pub summary: Option<PathBuf>,
    /// Seed of every node [default: 1]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(i64).range(0..))]
    pub seed: Option<i64>,
    /// Folder of the session; one that exists is continued [default: bags/session-UTCTIME]
    #[arg(long, value_name = "DIR")]
    pub session: Option<PathBuf>,
    /// TCP port of the operator's page; 0 takes any free one [default: 8642]
    #[arg(long, value_name = "PORT")]
    pub port: Option<u16>,
    /// ROS domain [default: ROS_DOMAIN_ID, else 0]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u8).range(0..=232))]
    pub domain_id: Option<u8>,
    /// Record no bag
    #[arg(long)]
    pub no_record: bool,
    /// More parameters, for any of the nodes; later files win (may be repeated)
    #[arg(long, value_name = "FILE")]
    pub params_file: Vec<PathBuf>,
    /// Show the nodes' log from this level on: debug, info, warn, error [default: warnings; the files hold all from info on]
    #[arg(long, value_name = "LEVEL", value_parser = ["debug", "info", "warn", "error"])]
    pub log_level: Option<String>,
    /// With --until-taught or --until-placed: give up after this many seconds
    #[arg(long, value_name = "SECONDS", value_parser = seconds)]
    pub time_limit: Option<f64>,
    /// Plain text, no colours (NO_COLOR=1 does the same)
    #[arg(long)]
    pub no_color: bool,
}

fn seconds(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(value) if value > 0.0 && value <= 1e6 => Ok(value),
        _ => Err("expected a number of seconds above 0".to_owned()),
    }
}

/// The command line of bringup, taken apart.
#[derive(Debug, Clone)]
pub struct CommandLine {
    /// The flags.
    pub flags: Flags,
    /// ROS arguments of bringup itself, flags included as parameters.
    pub arguments: Arguments,
    /// Parameter files for every node, later ones win.
    pub parameter_files: Vec<PathBuf>,
}

/// Why a command line cannot be taken.
#[derive(Debug)]
pub enum CommandLineError {
    /// The flags; this is also how help and version come back.
    Flags(clap::Error),
    /// Everything after `--ros-args`.
    Ros(BringupError),
}

impl CommandLine {
    /// Parses everything after `apprentice [bringup]`.
    ///
    /// # Errors
    /// On unknown flags or values; help and version come back as errors that print to standard output.
    pub fn parse(args: &[String]) -> Result<Self, CommandLineError> {
        let split = args.iter().position(|arg| arg == "--ros-args").unwrap_or(args.len());
        let (own, ros) = args.split_at(split);
        let name = ["apprentice".to_owned()];
        let flags = Flags::try_parse_from(name.iter().chain(own)).map_err(CommandLineError::Flags)?;
        let ros_error = |error| CommandLineError::Ros(BringupError::Arguments(error));
        let mut all = ros.to_vec();
        let mut parameter_files = ros_parameter_files(ros);
        for file in &flags.params_file {
            all.extend(["--params-file".to_owned(), file.to_string_lossy().into_owned()]);
            parameter_files.push(file.clone());
        }
        let mut arguments = Arguments::parse(&all).map_err(ros_error)?;
        for (name, value) in parameters(&flags) {
            arguments = arguments.with_parameter(name, &value).map_err(ros_error)?;
        }
        Ok(Self { flags, arguments, parameter_files })
    }

    /// Bringup's settings: files, then `-p`, then flags.
    ///
    /// # Errors
    /// On bad parameters.
    pub fn settings(&self) -> Result<Settings, BringupError> {
        Ok(self.arguments.settings()?)
    }
}

/// The files that follow `--params-file`.
fn ros_parameter_files(ros: &[String]) -> Vec<PathBuf> {
    let mut files = Vec::new();
    let mut rest = ros.iter();
    while let Some(arg) = rest.next() {
        if arg == "--params-file" {
            files.extend(rest.next().map(PathBuf::from));
        } else if let Some(file) = arg.strip_prefix("--params-file=") {
            files.push(PathBuf::from(file));
        }
    }
    files
}

/// The flags given, as parameters with YAML values.
fn parameters(flags: &Flags) -> Vec<(&'static str, String)> {
    // A JSON string is a YAML string.
    let quoted = |text: &str| serde_json::Value::from(text).to_string();
    let path = |path: &PathBuf| quoted(&path.to_string_lossy());
    let mut given = Vec::new();
    let mut give = |name, value: Option<String>| given.extend(value.map(|value| (name, value)));
    give("scenario", flags.scenario.as_deref().map(quoted));
    give(
        "demonstrator",
        flags.demonstrator.map(|who| match who {
            Who::Simulated => "simulated".to_owned(),
            Who::Human => "human".to_owned(),
        }),
    );
    give("headless", flags.headless.then(|| "true".to_owned()));
    give("until_taught", flags.until_taught.then(|| "true".to_owned()));
    give("until_placed", flags.until_placed.then(|| "true".to_owned()));
    give("summary", flags.summary.as_ref().map(path));
    give("seed", flags.seed.map(|seed| seed.to_string()));
    give("session", flags.session.as_ref().map(path));
    give("port", flags.port.map(|port| port.to_string()));
    give("record", flags.no_record.then(|| "false".to_owned()));
    give("time_limit_s", flags.time_limit.map(|seconds| format!("{seconds:?}")));
    given
}

#[cfg(test)]
mod tests {
    use super::{CommandLine, CommandLineError, Flags};
    use crate::{Demonstrator, Settings};
    use clap::CommandFactory;

    fn parse(line: &str) -> Result<CommandLine, CommandLineError> {
        CommandLine::parse(&line.split_whitespace().map(String::from).collect::<Vec<_>>())
    }

    #[test]
    fn the_flags_are_consistent() {
        Flags::command().debug_assert();
    }

    #[test]
    fn flags_become_parameters_and_win_over_ros_arguments() {
        let line = "--scenario spoon --seed 7 --headless --until-taught --time-limit 90 --no-record --session a/b \
                    --ros-args -p seed:=3 -p port:=9000";
        let settings = parse(line).expect("a good line").settings().expect("good settings");
        let wanted = Settings {
            scenario: "spoon".to_owned(),
            seed: 7,
            headless: true,
            until_taught: true,
            until_placed: false,
            time_limit_s: 90.0,
            record: false,
            session: "a/b".to_owned(),
            port: 9000,
            ..Settings::default()
        };
        assert_eq!(settings, wanted);
        let nothing = parse("").expect("a good line").settings().expect("good settings");
        assert_eq!(nothing, Settings::default());
        let human = parse("--demonstrator human").expect("a good line").settings().expect("good settings");
        assert_eq!(human.demonstrator, Demonstrator::Human);
    }

    #[test]
    fn parameter_files_of_both_kinds_reach_the_nodes_in_order() {
        let line =
            parse("--params-file c.yaml --ros-args --params-file a.yaml --params-file=b.yaml").expect("a good line");
        let names: Vec<_> = line.parameter_files.iter().map(|path| path.to_string_lossy().into_owned()).collect();
        assert_eq!(names, ["a.yaml", "b.yaml", "c.yaml"]);
    }

    #[test]
    fn bad_flags_are_refused_with_what_would_do() {
        for (line, wanted) in [
            ("--scenari spoon", "--scenario"),
            ("--demonstrator robot", "simulated, human"),
            ("--seed -1", "-1"),
            ("--seed many", "many"),
            ("--domain-id 233", "233"),
            ("--port 70000", "70000"),
            ("--time-limit 0", "seconds above 0"),
            ("--log-level loud", "debug, info, warn, error"),
        ] {
            match parse(line) {
                Err(CommandLineError::Flags(error)) => {
                    assert!(error.to_string().contains(wanted), "{line}: {error}");
                    assert_eq!(error.exit_code(), 2);
                }
                other => panic!("{line}: expected an error, got {other:?}"),
            }
        }
    }

    #[test]
    fn settings_that_contradict_each_other_are_refused() {
        for (line, wanted) in [("--headless --demonstrator human", "headless"), ("--time-limit 5", "until_taught")] {
            let error = parse(line).expect("a good line").settings().expect_err("a contradiction").to_string();
            assert!(error.contains(wanted), "{error}");
        }
        assert!(parse("--ros-args -p seeed:=1").expect("a good line").settings().is_err());
    }
}
