//! Which nodes a lesson needs, and the command line of each.

use crate::{BringupError, Demonstrator, NodeInfo, Session, Settings, Subject, read_parameters, stop_stage};
use bus::Arguments;
use std::path::{Path, PathBuf};

/// In the order of starting: the recorder first, so that the bag holds everything; who answers last.
const ORDER: [&str; 11] = [
    "session_recorder",
    "simulated_table",
    "table_perception",
    "simulated_world",
    "reward_posterior",
    "performance_bounds",
    "active_query",
    "policy_optimizer",
    "placement_planner",
    "operator_ui",
    "demonstrator",
];

/// One node to be started.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct LaunchNode {
    /// Its name.
    pub name: &'static str,
    /// Arguments of the executable, the node's name first.
    pub args: Vec<String>,
    /// See [`stop_stage`].
    pub stage: u8,
    /// Without it the lesson cannot go on.
    pub essential: bool,
}

/// What every node gets besides its parameters.
#[derive(Debug, Clone, Default)]
pub struct Common {
    /// Parameter files of the command line.
    pub files: Vec<PathBuf>,
    /// Namespace on the graph.
    pub namespace: String,
    /// Log level.
    pub log_level: String,
}

/// The nodes of a lesson, in the order of starting; also writes the session's own parameters to its folder.
///
/// # Errors
/// When any of them would refuse its parameters, or the session's folder cannot be written.
pub fn launch(
    settings: &Settings,
    session: &Session,
    nodes: &[NodeInfo],
    common: &Common,
) -> Result<Vec<LaunchNode>, BringupError> {
    let subject = Subject::of(&read_parameters(&session.path("parameters.yaml"))?);
    let wanted = ORDER.into_iter().filter(|&name| match name {
        "simulated_table" => subject == Subject::Table,
        "table_perception" => subject == Subject::DetectedTable,
        "placement_planner" => subject != Subject::World,
        "simulated_world" | "policy_optimizer" => subject == Subject::World,
        "session_recorder" => settings.record,
        "operator_ui" => !settings.headless,
        "demonstrator" => settings.demonstrator == Demonstrator::Simulated,
        _ => true,
    });
    let chosen: Vec<&NodeInfo> = wanted.filter_map(|name| nodes.iter().find(|node| node.name == name)).collect();
    let path = session.path("session.yaml");
    let text: String = chosen.iter().map(|node| own_parameters(node, settings, session)).collect();
    crate::session::write_whole(&path, &text).map_err(|source| BringupError::Write { path, source })?;
    chosen.iter().map(|node| launch_node(node, settings, session, common)).collect()
}

fn launch_node(
    node: &NodeInfo,
    settings: &Settings,
    session: &Session,
    common: &Common,
) -> Result<LaunchNode, BringupError> {
    let mut args: Vec<String> = vec!["--ros-args".to_owned()];
    let files = [session.path("parameters.yaml"), session.path("session.yaml")];
    for file in files.iter().chain(&common.files) {
        args.extend(["--params-file".to_owned(), file.to_string_lossy().into_owned()]);
    }
    if common.namespace != bus::DEFAULT_NAMESPACE {
        args.extend(["-r".to_owned(), format!("__ns:={}", common.namespace)]);
    }
    args.extend(["--log-level".to_owned(), common.log_level.clone()]);
    (node.check)(&Arguments::parse(&args)?)?;
    args.insert(0, node.name.to_owned());
    let answers_elsewhere = node.name == "operator_ui" && settings.demonstrator == Demonstrator::Simulated;
    Ok(LaunchNode { name: node.name, args, stage: stop_stage(node.name), essential: !answers_elsewhere })
}

/// The folder that the session's own stands in, where others may stand too.
fn beside(session: &Session) -> String {
    let parent = session.dir.parent().filter(|parent| !parent.as_os_str().is_empty()).unwrap_or(Path::new("."));
    serde_json::Value::from(parent.to_string_lossy().into_owned()).to_string()
}

/// The section of session.yaml for one node: what depends on the session.
fn own_parameters(node: &NodeInfo, settings: &Settings, session: &Session) -> String {
    let path = |name: &str| serde_json::Value::from(session.path(name).to_string_lossy().into_owned()).to_string();
    let mut lines = String::new();
    for (parameter, value) in [
        ("seed", session.record.seed.to_string()),
        ("journal", path("evidence.journal")),
        ("output", path("bag")),
        ("port", settings.port.to_string()),
        ("url_file", path("page-url")),
        ("token_file", path("page-token")),
        ("recordings", beside(session)),
    ] {
        if node.has(parameter) {
            lines += &format!("    {parameter}: {value}\n");
        }
    }
    // A simulated person does not mind waiting, and a lesson of theirs is the same however fast the machine is.
    if settings.demonstrator == Demonstrator::Simulated && node.has("next_within_s") {
        lines += "    next_within_s: 0.0\n";
    }
    if lines.is_empty() { lines } else { format!("/**/{}:\n  ros__parameters:\n{lines}", node.name) }
}

#[cfg(test)]
mod tests {
    use super::{Common, launch};
    use crate::{Demonstrator, NodeInfo, Session, Settings};
    use bus::{Arguments, NodeSettings, ParameterSpec, Range};
    use serde::{Deserialize, Serialize};

    #[derive(Clone, Default, Serialize, Deserialize)]
    struct Posterior {
        seed: i64,
        journal: String,
    }

    impl NodeSettings for Posterior {
        const NODE: &'static str = "reward_posterior";
        const ABOUT: &'static str = "A stand-in.";
        const PARAMETERS: &'static [ParameterSpec] = &[
            ParameterSpec { name: "seed", about: "s", range: Range::Integer { min: 0, max: 100 } },
            ParameterSpec { name: "journal", about: "j", range: Range::Any },
        ];
    }

    fn node(name: &'static str) -> NodeInfo {
        NodeInfo {
            name,
            about: "",
            parameters: if name == "reward_posterior" { Posterior::PARAMETERS } else { &[] },
            check: |arguments: &Arguments| arguments.settings::<Posterior>().map(drop),
        }
    }

    fn names(settings: &Settings) -> Vec<&'static str> {
        let root = tempfile::tempdir().expect("a folder");
        let settings = Settings { session: root.path().join("s").to_string_lossy().into_owned(), ..settings.clone() };
        let session = Session::open(&settings, "").expect("opens");
        std::fs::write(session.path("parameters.yaml"), "").expect("writes");
        let nodes = ["demonstrator", "operator_ui", "session_recorder", "reward_posterior"].map(node);
        let common = Common { log_level: "info".to_owned(), ..Common::default() };
        let launched = launch(&settings, &session, &nodes, &common).expect("good parameters");
        launched.iter().map(|node| node.name).collect()
    }

    #[test]
    fn the_recorder_starts_first_and_the_flags_choose_the_nodes() {
        let all = ["session_recorder", "reward_posterior", "operator_ui", "demonstrator"];
        assert_eq!(names(&Settings::default()), all);
        assert_eq!(names(&Settings { headless: true, record: false, ..Settings::default() }), [all[1], all[3]]);
        assert_eq!(names(&Settings { demonstrator: Demonstrator::Human, ..Settings::default() }), all[..3]);
    }

    #[test]
    fn a_lesson_about_a_world_has_no_table_and_a_table_no_world() {
        let of = |text: &str| {
            let root = tempfile::tempdir().expect("a folder");
            let settings =
                Settings { session: root.path().join("s").to_string_lossy().into_owned(), ..Settings::default() };
            let session = Session::open(&settings, "").expect("opens");
            std::fs::write(session.path("parameters.yaml"), text).expect("writes");
            let nodes = [
                "simulated_table",
                "table_perception",
                "simulated_world",
                "policy_optimizer",
                "placement_planner",
                "active_query",
            ];
            let common = Common { log_level: "info".to_owned(), ..Common::default() };
            let launched = launch(&settings, &session, &nodes.map(node), &common).expect("good parameters");
            launched.iter().map(|node| node.name).collect::<Vec<_>>()
        };
        assert_eq!(of(""), ["simulated_table", "active_query", "placement_planner"]);
        let detected = "/**/table_perception:\n  ros__parameters: {}\n";
        assert_eq!(of(detected), ["table_perception", "active_query", "placement_planner"]);
        let world = "/**/simulated_world:\n  ros__parameters: {}\n";
        assert_eq!(of(world), ["simulated_world", "active_query", "policy_optimizer"]);
    }

    #[test]
    fn a_node_reads_its_session_parameters_and_bad_files_are_caught_before_the_start() {
        let root = tempfile::tempdir().expect("a folder");
        let dir = root.path().join("it's a \"session\"");
        let settings = Settings { session: dir.to_string_lossy().into_owned(), seed: 42, ..Settings::default() };
        let session = Session::open(&settings, "").expect("opens");
        std::fs::write(session.path("parameters.yaml"), "").expect("writes");
        let mut common = Common { log_level: "info".to_owned(), namespace: "/robot".to_owned(), ..Common::default() };
        let launched = launch(&settings, &session, &[node("reward_posterior")], &common).expect("good parameters");
        let arguments = Arguments::parse(&launched[0].args[1..]).expect("good arguments");
        let read: Posterior = arguments.settings().expect("good parameters");
        assert_eq!(read.seed, 42);
        assert_eq!(read.journal, session.path("evidence.journal").to_string_lossy());
        assert_eq!(arguments.node_name("reward_posterior").expect("a name").full(), "/robot/reward_posterior");
        let extra = root.path().join("extra.yaml");
        std::fs::write(&extra, "/**/reward_posterior:\n  ros__parameters:\n    sede: 3\n").expect("writes");
        common.files.push(extra);
        let error = launch(&settings, &session, &[node("reward_posterior")], &common).expect_err("bad").to_string();
        assert!(error.contains("extra.yaml") && error.contains("sede") && error.contains("seed"), "{error}");
    }
}
