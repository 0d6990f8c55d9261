//! The command line of one node, as ROS users type it.

use std::path::PathBuf;

use log::LevelFilter;
use thiserror::Error;

use crate::{
    help,
    names::{NameError, NodeName, node_matches},
    parameter::NodeSettings,
    parameter_error::{ParameterError, Place},
    parameter_file::{self, Given},
    settings,
    suggest::did_you_mean,
    yaml,
};

/// The namespace of a node that is not told another one.
pub const DEFAULT_NAMESPACE: &str = "/apprentice";

/// Most arguments that are read.
const MAX_ARGUMENTS: usize = 10_000;

/// Options that take a value.
const WITH_VALUE: &[&str] = &[
    "-p",
    "--param",
    "-r",
    "--remap",
    "--params-file",
    "--log-level",
    "-e",
    "--enclave",
    "--log-config-file",
    "--log-file-name",
];

/// Options that take none.
const WITHOUT_VALUE: &[&str] = &[
    "--ros-args",
    "--",
    "--help",
    "-h",
    "--enable-rosout-logs",
    "--disable-rosout-logs",
    "--enable-stdout-logs",
    "--disable-stdout-logs",
    "--enable-external-lib-logs",
    "--disable-external-lib-logs",
];

/// A command line that cannot be taken.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum ArgumentError {
    /// No such option.
    #[error("unknown argument `{got}`{suggestion}; --help lists what there is")]
    Unknown {
        /// What was given.
        got: String,
        /// "; did you mean …?" or nothing.
        suggestion: String,
    },
    /// An option without its value.
    #[error("`{option}` needs a value: {expected}")]
    Missing {
        /// The option.
        option: String,
        /// What it takes.
        expected: &'static str,
    },
    /// An option's value in the wrong form.
    #[error("`{option} {got}`: expected {expected}")]
    Form {
        /// The option.
        option: String,
        /// Its value.
        got: String,
        /// The right form.
        expected: String,
    },
    /// A name that ROS would refuse.
    #[error(transparent)]
    Name(#[from] NameError),
    /// An absurd number of arguments.
    #[error("{0} arguments; at most 10000 are read")]
    TooMany(usize),
}

/// One renaming rule.
#[derive(Debug, Clone, PartialEq)]
struct Remap {
    /// Only for nodes of this name.
    node: Option<String>,
    /// What is renamed.
    from: String,
    /// The new name.
    to: String,
}

/// One parameter from the command line, unread.
#[derive(Debug, Clone, PartialEq)]
struct Param {
    /// Only for nodes that fit this pattern.
    node: Option<String>,
    /// The parameter and its value.
    given: Given,
}

/// The parsed command line of one node.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Arguments {
    remaps: Vec<Remap>,
    params: Vec<Param>,
    files: Vec<PathBuf>,
    levels: Vec<(Option<String>, LevelFilter)>,
    help: bool,
    rosout_disabled: bool,
    stderr_disabled: bool,
}

impl Arguments {
    /// Parses everything after `apprentice <node>`. Options are taken with or without `--ros-args` before them.
    ///
    /// # Errors
    /// On an unknown option, a missing or badly formed value, or an illegal name.
    pub fn parse(args: &[String]) -> Result<Arguments, ArgumentError> {
        if args.len() > MAX_ARGUMENTS {
            return Err(ArgumentError::TooMany(args.len()));
        }
        let mut parsed = Arguments::default();
        let mut rest = args.iter();
        while let Some(argument) = rest.next() {
            let argument = argument.as_str();
            if WITHOUT_VALUE.contains(&argument) {
                parsed.flag(argument);
            } else if WITH_VALUE.contains(&argument) {
                let value = rest.next().ok_or_else(|| ArgumentError::Missing {
                    option: argument.to_owned(),
                    expected: expected_value(argument),
                })?;
                parsed.option(argument, value)?;
            } else if let Some((option, value)) =
                argument.split_once('=').filter(|(option, _)| option.starts_with("--") && WITH_VALUE.contains(option))
            {
                parsed.option(option, value)?;
            } else {
                return Err(unknown(argument));
            }
        }
        Ok(parsed)
    }

    /// Takes an option without a value.
    fn flag(&mut self, option: &str) {
        match option {
            "--help" | "-h" => self.help = true,
            "--disable-rosout-logs" => self.rosout_disabled = true,
            "--enable-rosout-logs" => self.rosout_disabled = false,
            "--disable-stdout-logs" => self.stderr_disabled = true,
            "--enable-stdout-logs" => self.stderr_disabled = false,
            _ => {}
        }
    }

    /// Takes an option with its value.
    fn option(&mut self, option: &str, value: &str) -> Result<(), ArgumentError> {
        match option {
            "-p" | "--param" => self.params.push(parse_param(option, value)?),
            "-r" | "--remap" => self.remaps.push(parse_remap(option, value)?),
            "--params-file" => self.files.push(PathBuf::from(value)),
            "--log-level" => self.levels.push(parse_level(option, value)?),
            // Enclaves and log files are for the C++ client library; taken so that launch files work.
            _ => {}
        }
        Ok(())
    }

    /// The node's settings: defaults, then parameter files in order, then `-p`.
    ///
    /// # Errors
    /// On an unreadable file, an unknown parameter, a wrong type or range; [`ParameterError::Help`] when
    /// `--help` was given.
    pub fn settings<S: NodeSettings>(&self) -> Result<S, ParameterError> {
        if self.help {
            return Err(ParameterError::Help(help::help::<S>()));
        }
        settings::build(&self.given(S::NODE)?)
    }

    /// The same arguments with one more parameter, as `-p name:=value` at the end would give.
    ///
    /// # Errors
    /// When the value is no YAML scalar or list.
    pub fn with_parameter(mut self, name: &str, value: &str) -> Result<Arguments, ArgumentError> {
        self.option("-p", &format!("{name}:={value}"))?;
        Ok(self)
    }

    /// The node's name on the graph.
    ///
    /// # Errors
    /// When a given name or namespace is not allowed.
    pub fn node_name(&self, default: &str) -> Result<NodeName, NameError> {
        let rule = |key: &str| {
            self.remaps
                .iter()
                .find(|remap| remap.from == key && remap.node.as_deref().is_none_or(|node| node == default))
                .map(|remap| remap.to.as_str())
        };
        NodeName::new(rule("__node").or(rule("__name")).unwrap_or(default), rule("__ns").unwrap_or(DEFAULT_NAMESPACE))
    }

    /// The absolute name of a topic or service after expansion and renaming; the first rule that fits counts.
    ///
    /// # Errors
    /// When a name is not allowed.
    pub fn resolve(&self, node: &NodeName, kind: &'static str, name: &str) -> Result<String, NameError> {
        let expanded = node.expand(kind, name)?;
        for remap in &self.remaps {
            if remap.from.starts_with("__") || remap.node.as_deref().is_some_and(|wanted| wanted != node.name) {
                continue;
            }
            if node.expand(kind, &remap.from)? == expanded {
                return node.expand(kind, &remap.to);
            }
        }
        Ok(expanded)
    }

    /// Every parameter given for this node, files first, in order of rising precedence.
    pub(crate) fn given(&self, default_node: &str) -> Result<Vec<Given>, ParameterError> {
        let node = self.node_name(default_node)?;
        let mut given = Vec::new();
        for path in &self.files {
            for section in parameter_file::read(path)? {
                if node_matches(&section.pattern, &node) {
                    given.extend(section.parameters);
                }
            }
        }
        for param in &self.params {
            if param.node.as_deref().is_none_or(|pattern| node_matches(pattern, &node)) {
                given.push(param.given.clone());
            }
        }
        Ok(given)
    }

    /// The log level asked for, if any: the last one that is for every logger or for this one.
    pub(crate) fn level(&self, node: &NodeName) -> Option<LevelFilter> {
        let logger = node.logger();
        self.levels
            .iter()
            .rev()
            .find(|(wanted, _)| wanted.as_deref().is_none_or(|wanted| wanted == logger || wanted == node.name))
            .map(|(_, level)| *level)
    }

    /// Whether log lines go to `/rosout`.
    pub(crate) fn rosout(&self) -> bool {
        !self.rosout_disabled
    }

    /// Whether log lines go to standard error.
    pub(crate) fn stderr(&self) -> bool {
        !self.stderr_disabled
    }
}

/// The error for an argument that is no option.
fn unknown(argument: &str) -> ArgumentError {
    let suggestion = if argument.contains(":=") {
        format!("; did you mean `-p {}`?", yaml::shorten(argument))
    } else {
        did_you_mean(argument, WITH_VALUE.iter().chain(WITHOUT_VALUE).copied())
    };
    ArgumentError::Unknown { got: yaml::shorten(argument), suggestion }
}

/// What an option takes, in words.
fn expected_value(option: &str) -> &'static str {
    match option {
        "-p" | "--param" => "name:=value",
        "-r" | "--remap" => "from:=to",
        "--params-file" => "a YAML file",
        "--log-level" => "a level, or logger:=level",
        "-e" | "--enclave" => "an enclave's name",
        _ => "a file",
    }
}

/// The error for a value in the wrong form.
fn form(option: &str, got: &str, expected: impl Into<String>) -> ArgumentError {
    ArgumentError::Form { option: option.to_owned(), got: yaml::shorten(got), expected: expected.into() }
}

/// Splits a `node:` prefix off, if there is one.
fn split_node(text: &str) -> (Option<String>, &str) {
    match text.split_once(':') {
        Some((node, rest)) if !node.is_empty() => (Some(node.to_owned()), rest),
        _ => (None, text),
    }
}

/// Parses `[node:]name:=value`.
fn parse_param(option: &str, text: &str) -> Result<Param, ArgumentError> {
    let (left, value_text) = text.split_once(":=").ok_or_else(|| form(option, text, "name:=value"))?;
    let (node, name) = split_node(left);
    if name.is_empty() || name.contains(char::is_whitespace) {
        return Err(form(option, text, "name:=value"));
    }
    let value = if value_text.is_empty() {
        crate::ParameterValue::String(String::new())
    } else {
        let tree =
            yaml::parse(value_text).map_err(|(_, reason)| form(option, text, format!("a YAML value ({reason})")))?;
        parameter_file::to_value(tree).map_err(|got| {
            form(option, text, format!("a bool, a number, a string, or a list of one of these, not {got}"))
        })?
    };
    Ok(Param {
        node,
        given: Given {
            name: name.to_owned(),
            value,
            place: Place::CommandLine(yaml::shorten(&format!("{option} {text}"))),
        },
    })
}

/// Parses `[node:]from:=to` and checks both names.
fn parse_remap(option: &str, text: &str) -> Result<Remap, ArgumentError> {
    let (left, to) = text.split_once(":=").ok_or_else(|| form(option, text, "from:=to"))?;
    let left = left.trim_start_matches("rostopic://").trim_start_matches("rosservice://");
    let (node, from) = split_node(left);
    let any = NodeName { name: "node".to_owned(), namespace: "/".to_owned() };
    match from {
        "__node" | "__name" => {
            NodeName::new(to, "/")?;
        }
        "__ns" => {
            NodeName::new("node", to)?;
        }
        _ if from.starts_with("__") => {
            return Err(form(option, text, "__node, __ns, or a topic or service name"));
        }
        _ => {
            any.expand("topic", from)?;
            any.expand("topic", to)?;
        }
    }
    Ok(Remap { node, from: from.to_owned(), to: to.to_owned() })
}

/// Parses `level` or `logger:=level`.
fn parse_level(option: &str, text: &str) -> Result<(Option<String>, LevelFilter), ArgumentError> {
    let (logger, level) = match text.split_once(":=") {
        Some((logger, level)) => (Some(logger.trim_start_matches('/').replace('/', ".")), level),
        None => (None, text),
    };
    let level = match level.to_ascii_lowercase().as_str() {
        "debug" => LevelFilter::Debug,
        "info" | "unset" => LevelFilter::Info,
        "warn" | "warning" => LevelFilter::Warn,
        "error" | "fatal" => LevelFilter::Error,
        "trace" => LevelFilter::Trace,
        "none" | "off" => LevelFilter::Off,
        other => {
            let levels = ["debug", "info", "warn", "error", "fatal"];
            return Err(form(option, text, format!("one of {}{}", levels.join(", "), did_you_mean(other, levels))));
        }
    };
    Ok((logger, level))
}

#[cfg(test)]
mod tests;
