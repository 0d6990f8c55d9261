//! The player's parameters.

use bag::TopicFilter;
use bus::{NodeSettings, ParameterSpec, Range};
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
        TopicFilter::new(&self.topics, &self.exclude).map(drop).map_err(|error| error.to_string())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_table_and_the_settings_agree() {
        bus::testing::check_parameters::<Settings>();
    }
}
