//! From the command line to a running lesson.

use crate::{
    BringupError, Circumstances, CommandLine, CommandLineError, Common, Console, Demonstrator, DomainLock, Kind, Level,
    NodeInfo, Plan, Session, Settings, Subject, environment, launch, read_parameters, suite,
};
use bus::Graph;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

/// Runs a lesson; `args` is everything after `apprentice [bringup]`, `nodes` what the executable holds.
pub fn main(args: &[String], nodes: &[NodeInfo], commit: &str) -> ExitCode {
    let line = match CommandLine::parse(args) {
        Ok(line) => line,
        Err(CommandLineError::Flags(error)) => {
            // Help and version are errors to clap; a closed standard output is not worth a panic.
            let _ = error.print();
            return ExitCode::from(u8::try_from(error.exit_code()).unwrap_or(2));
        }
        Err(CommandLineError::Ros(error)) => return refuse(&error),
    };
    match begin(&line, nodes, commit) {
        Ok(code) => ExitCode::from(code),
        Err(error) => refuse(&error),
    }
}

fn refuse(error: &BringupError) -> ExitCode {
    match error {
        BringupError::Parameters(bus::ParameterError::Help(text)) => print!("{text}"),
        error => eprintln!("error: {error}"),
    }
    ExitCode::from(error.exit_code())
}

fn begin(line: &CommandLine, nodes: &[NodeInfo], commit: &str) -> Result<u8, BringupError> {
    let settings = line.settings()?;
    let variables = environment::wanted(|name| std::env::var_os(name), line.flags.domain_id, commit);
    environment::take_on(&variables)
        .map_err(|source| BringupError::Start { what: "apprentice with its environment", source })?;
    let summary = checked_summary(&settings)?;
    let namespace = line.arguments.node_name("bringup")?.namespace;
    let _alone = DomainLock::take(&std::env::temp_dir(), &domain_id(), &namespace)?;
    let session = Session::open(&settings, &utc_stamp())?;
    let common = Common {
        files: line.parameter_files.clone(),
        namespace,
        log_level: line.flags.log_level.clone().unwrap_or_else(|| "info".to_owned()),
    };
    let launched = match launch(&settings, &session, nodes, &common) {
        Ok(launched) => launched,
        Err(error) => {
            session.abandon();
            return Err(error);
        }
    };
    let console = Console::new(line.flags.no_color);
    let bag = settings.record.then(|| session.path("bag").to_string_lossy().into_owned());
    introduce(&console, &session, &settings, bag.as_deref(), &common.namespace, commit);
    let shown_from = line.flags.log_level.as_deref().and_then(Level::from_name).unwrap_or(Level::Warn);
    let plan = Plan {
        executable: std::env::current_exe()
            .map_err(|source| BringupError::Start { what: "the executable again", source })?,
        nodes: launched,
        console,
        shown_from,
        circumstances: Circumstances {
            record: session.record.clone(),
            session: session.dir.to_string_lossy().into_owned(),
            bag,
            demonstrator: match settings.demonstrator {
                Demonstrator::Simulated => "simulated",
                Demonstrator::Human => "human",
            },
            commit: commit.to_owned(),
        },
        logs: session.path("logs"),
        url_file: (!settings.headless).then(|| session.path("page-url")),
        summary,
        settings,
        arguments: line.arguments.clone(),
    };
    Ok(suite::run(plan, Graph::Dds)?.exit_code())
}

/// The summary's path, once it is known that a file can be written there: an hour's lesson must not end with an error.
fn checked_summary(settings: &Settings) -> Result<Option<PathBuf>, BringupError> {
    if settings.summary.is_empty() {
        return Ok(None);
    }
    let path = PathBuf::from(&settings.summary);
    let unwritable = |source| BringupError::Summary { path: path.clone(), source };
    let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
    std::fs::create_dir_all(folder).map_err(unwritable)?;
    if path.is_dir() {
        return Err(unwritable(std::io::ErrorKind::IsADirectory.into()));
    }
    // A summary of an earlier lesson would be mistaken for this one's.
    match std::fs::remove_file(&path) {
        Err(error) if error.kind() != std::io::ErrorKind::NotFound => Err(unwritable(error)),
        _ => Ok(Some(path)),
    }
}

#[expect(clippy::disallowed_methods, reason = "a new session is named by the time of day")]
fn utc_stamp() -> String {
    chrono::DateTime::<chrono::Utc>::from(std::time::SystemTime::now()).format("%Y%m%d-%H%M%S").to_string()
}

fn introduce(
    console: &Console,
    session: &Session,
    settings: &Settings,
    bag: Option<&str>,
    namespace: &str,
    commit: &str,
) {
    let say = |word, text: &str| console.say(Kind::Info(word), text);
    let commit = commit.get(..10).unwrap_or(commit);
    // What cannot be read by now is for the nodes to complain of.
    let subject = read_parameters(&session.path("parameters.yaml")).map_or(Subject::Table, |text| Subject::of(&text));
    let who = match (settings.demonstrator, subject) {
        (Demonstrator::Simulated, Subject::Table | Subject::DetectedTable) => "a simulated person answers",
        (Demonstrator::Simulated, Subject::World) => "a simulated person teaches",
        (Demonstrator::Human, Subject::Table | Subject::DetectedTable) => "you answer, on the page",
        (Demonstrator::Human, Subject::World) => {
            "you teach, with any ROS client; the page shows what the robot would do"
        }
    };
    let record = &session.record;
    let version = env!("CARGO_PKG_VERSION");
    say("apprentice", &format!("{version} ({commit}): {}, seed {}; {who}", record.scenario, record.seed));
    let again = if session.resumed { " (continued)" } else { "" };
    say("session", &format!("{}{again}", session.dir.display()));
    say("bag", bag.unwrap_or("none is recorded"));
    let domain = domain_id();
    let (name, range) = match variable("ROS_AUTOMATIC_DISCOVERY_RANGE") {
        Some(range) => ("ROS_AUTOMATIC_DISCOVERY_RANGE", range),
        None => ("ROS_LOCALHOST_ONLY", variable("ROS_LOCALHOST_ONLY").unwrap_or_default()),
    };
    let environment = format!("ROS_DOMAIN_ID={domain} {name}={range}");
    say("graph", &format!("domain {domain}, {name}={range}"));
    say("watch", &format!("{environment} ros2 topic echo {namespace}/lesson"));
    if !settings.ends_by_itself() {
        say("stop", "Ctrl-C");
    }
}

fn variable(name: &str) -> Option<String> {
    std::env::var(name).ok().filter(|value| !value.is_empty())
}

fn domain_id() -> String {
    variable("ROS_DOMAIN_ID").unwrap_or_else(|| "0".to_owned())
}
