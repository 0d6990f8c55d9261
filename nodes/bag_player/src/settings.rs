//! The player's parameters.

use bus::{NodeSettings, ParameterSpec, Range};
use regex::Regex;
use serde::{Deserialize, Serialize};

/// Parameters of the player.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Settings {
    /// The bag: a folder, its `metadata.yaml`, or an `.mcap` file.
    pub bag: String,
    /// Seconds of the bag per second of real time.
    pub rate: f64,
    /// Seconds from the bag's start that are left out.
    pub start_offset_s: f64,
    /// Regular expressions of whole topic names; empty: every topic.
    pub topics: Vec<String>,
    /// Regular expressions of whole topic names that are not played.
    pub exclude: Vec<String>,
    /// Start over at the end.
    pub r#loop: bool,
    /// Wait for `~/set_paused` before the first message.
    pub paused: bool,
    /// Seconds before the first message, so that subscriptions can match.
    pub delay_s: f64,
    /// How often `/clock` is published, per second of real time; 0: never.
    pub clock_hz: f64,
}

impl Default for Settings {
    fn default() -> Settings {
        Settings {
            bag: String::new(),
            rate: 1.0,
            start_offset_s: 0.0,
            topics: Vec::new(),
            exclude: Vec::new(),
            r#loop: false,
            paused: false,
            delay_s: 1.0,
            clock_hz: 0.0,
        }
    }
}

impl NodeSettings for Settings {
    const NODE: &'static str = "bag_player";
    const ABOUT: &'static str = "Plays a bag back onto the graph, byte for byte and with the recorded QoS.";
    const PARAMETERS: &'static [ParameterSpec] = &[
        ParameterSpec {
            name: "bag",
            about: "the bag: a folder, its metadata.yaml, or an .mcap file",
            range: Range::Any,
        },
        ParameterSpec {
            name: "rate",
            about: "seconds of the bag per second of real time",
            range: Range::Float { min: 0.001, max: 1000.0 },
        },
        ParameterSpec {
            name: "start_offset_s",
            about: "seconds from the bag's start that are left out",
            range: Range::Float { min: 0.0, max: 1e9 },
        },
        ParameterSpec {
            name: "topics",
            about: "regular expressions of whole topic names to play; empty: every topic",
            range: Range::Any,
        },
        ParameterSpec {
            name: "exclude",
            about: "regular expressions of whole topic names not to play",
            range: Range::Any,
        },
        ParameterSpec { name: "loop", about: "start over at the end", range: Range::Any },
        ParameterSpec { name: "paused", about: "wait for ~/set_paused before the first message", range: Range::Any },
        ParameterSpec {
            name: "delay_s",
            about: "seconds before the first message, so that subscriptions can match",
            range: Range::Float { min: 0.0, max: 3600.0 },
        },
        ParameterSpec {
            name: "clock_hz",
            about: "how often /clock is published, per second of real time; 0: never",
            range: Range::Float { min: 0.0, max: 10_000.0 },
        },
    ];

    fn check(&self) -> Result<(), String> {
        Filter::new(self).map(drop).map_err(|error| error.to_string())
    }
}

/// Why settings cannot be used.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum SettingsError {
    /// Not a regular expression.
    #[error("`{name}`: '{got}' is no regular expression: {why}")]
    Regex {
        /// The parameter.
        name: &'static str,
        /// The text.
        got: String,
        /// What is wrong with it.
        why: String,
    },
}

/// Which topics are played.
#[derive(Debug, Clone)]
pub(crate) struct Filter {
    topics: Vec<Regex>,
    exclude: Vec<Regex>,
    /// `/clock` of the bag stays out when the player makes its own.
    own_clock: bool,
}

impl Filter {
    pub(crate) fn new(settings: &Settings) -> Result<Filter, SettingsError> {
        Ok(Filter {
            topics: compile("topics", &settings.topics)?,
            exclude: compile("exclude", &settings.exclude)?,
            own_clock: settings.clock_hz > 0.0,
        })
    }

    pub(crate) fn takes(&self, topic: &str) -> bool {
        let any = |patterns: &[Regex]| patterns.iter().any(|pattern| pattern.is_match(topic));
        let clock_is_ours = self.own_clock && topic == "/clock";
        (self.topics.is_empty() || any(&self.topics)) && !any(&self.exclude) && !clock_is_ours
    }
}

fn compile(name: &'static str, patterns: &[String]) -> Result<Vec<Regex>, SettingsError> {
    let compile_one = |text: &String| {
        Regex::new(&format!("^(?:{text})$")).map_err(|error| SettingsError::Regex {
            name,
            got: text.clone(),
            why: error.to_string().lines().last().unwrap_or_default().trim().to_owned(),
        })
    };
    patterns.iter().map(compile_one).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_table_and_the_settings_agree() {
        bus::testing::check_parameters::<Settings>();
    }

    #[test]
    fn the_bags_clock_is_left_out_only_when_the_player_makes_its_own() {
        let takes = |clock_hz| Filter::new(&Settings { clock_hz, ..Settings::default() }).map(|f| f.takes("/clock"));
        assert_eq!((takes(0.0), takes(10.0)), (Ok(true), Ok(false)));
    }
}
