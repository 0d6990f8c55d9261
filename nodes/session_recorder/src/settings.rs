//! The recorder's parameters.

use bag::TopicFilter;
use bus::{NodeSettings, ParameterSpec, Range};
use serde::{Deserialize, Serialize};

/// How the chunks of the bag are compressed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Compression {
    /// Not at all.
    #[default]
    None,
    /// LZ4.
    Lz4,
}

/// Parameters of the recorder.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Settings {
    /// The bag's folder; empty: a new one under `bags/` named after the time in UTC.
    pub output: String,
    /// Regular expressions of whole topic names; empty: every topic.
    pub topics: Vec<String>,
    /// Regular expressions of whole topic names that are not recorded.
    pub exclude: Vec<String>,
    /// Compression of the bag.
    pub compression: Compression,
    /// Seconds after which a received message is on disk at the latest.
    pub flush_period_s: f64,
    /// A new file is started when one has grown past this many bytes; 0: never.
    pub max_bytes_per_file: i64,
    /// Seconds between two looks for new topics.
    pub discovery_period_s: f64,
    /// Folders with message definitions (`FOLDER/PACKAGE/msg/NAME.msg`), searched before AMENT_PREFIX_PATH.
    pub message_definition_path: Vec<String>,
    /// Megabytes of messages that may wait for the disk before any is dropped.
    pub queue_mb: i64,
}

impl Default for Settings {
    fn default() -> Settings {
        Settings {
            output: String::new(),
            topics: Vec::new(),
            exclude: Vec::new(),
            compression: Compression::None,
            flush_period_s: 0.5,
            max_bytes_per_file: 0,
            discovery_period_s: 0.15,
            message_definition_path: Vec::new(),
            queue_mb: 256,
        }
    }
}

impl NodeSettings for Settings {
    const NODE: &'static str = "session_recorder";
    const ABOUT: &'static str = "Records any topic of the graph into a bag that ros2 bag and Foxglove open.";
    const PARAMETERS: &'static [ParameterSpec] = &[
        ParameterSpec {
            name: "output",
            about: "folder of the bag; empty: a new one under bags/ named after the time in UTC",
            range: Range::Any,
        },
        ParameterSpec {
            name: "topics",
            about: "regular expressions of whole topic names to record; empty: every topic",
            range: Range::Any,
        },
        ParameterSpec {
            name: "exclude",
            about: "regular expressions of whole topic names not to record",
            range: Range::Any,
        },
        ParameterSpec { name: "compression", about: "compression of the bag", range: Range::Choice(&["none", "lz4"]) },
        ParameterSpec {
            name: "flush_period_s",
            about: "seconds after which a received message is on disk at the latest",
            range: Range::Float { min: 0.01, max: 60.0 },
        },
        ParameterSpec {
            name: "max_bytes_per_file",
            about: "bytes after which a new file is started; 0: never",
            range: Range::Integer { min: 0, max: i64::MAX },
        },
        ParameterSpec {
            name: "discovery_period_s",
            about: "seconds between two looks for new topics",
            range: Range::Float { min: 0.02, max: 10.0 },
        },
        ParameterSpec {
            name: "message_definition_path",
            about: "folders with message definitions (FOLDER/PACKAGE/msg/NAME.msg), searched before AMENT_PREFIX_PATH",
            range: Range::Any,
        },
        ParameterSpec {
            name: "queue_mb",
            about: "megabytes of messages that may wait for the disk before any is dropped",
            range: Range::Integer { min: 1, max: 65_536 },
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
