//! Bringup's own parameters; the flags of the command line set them too.

use bus::{NodeSettings, ParameterSpec, Range};
use serde::{Deserialize, Serialize};

/// Who answers the questions.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Demonstrator {
    /// The node `demonstrator`.
    #[default]
    Simulated,
    /// A person at the page.
    Human,
}

/// Parameters of bringup.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Settings {
    /// A scenario's name, or the path of a parameter file; empty: flowers, or what the session was begun with.
    pub scenario: String,
    /// Who answers.
    pub demonstrator: Demonstrator,
    /// Without the page.
    pub headless: bool,
    /// End by itself when the lesson ends.
    pub until_taught: bool,
    /// End by itself when the lesson ends and the robot has put the thing down.
    pub until_placed: bool,
    /// Where to write what happened, JSON; empty: nowhere.
    pub summary: String,
    /// Seed of every node; -1: 1, or what the session was begun with.
    pub seed: i64,
    /// The session's folder; empty: a new one under bags/.
    pub session: String,
    /// TCP port of the page.
    pub port: i64,
    /// Record everything.
    pub record: bool,
    /// With `until_taught` or `until_placed`: give up after this long, seconds; 0: never.
    pub time_limit_s: f64,
}

impl Default for Settings {
    fn default() -> Self {
        Self {
            scenario: String::new(),
            demonstrator: Demonstrator::Simulated,
            headless: false,
            until_taught: false,
            until_placed: false,
            summary: String::new(),
            seed: -1,
            session: String::new(),
            port: 8642,
            record: true,
            time_limit_s: 0.0,
        }
    }
}

impl NodeSettings for Settings {
    const NODE: &'static str = "bringup";
    const ABOUT: &'static str = "Starts, watches, restarts and stops the nodes of a lesson, and tells its story.";
    const PARAMETERS: &'static [ParameterSpec] = &[
        ParameterSpec {
            name: "scenario",
            about: "flowers, spoon, grid, driving, or the path of a parameter file; empty: flowers, or what the session was begun with",
            range: Range::Any,
        },
        ParameterSpec {
            name: "demonstrator",
            about: "who answers: a simulated person, or a human at the page",
            range: Range::Choice(&["simulated", "human"]),
        },
        ParameterSpec { name: "headless", about: "without the operator's page", range: Range::Any },
        ParameterSpec { name: "until_taught", about: "end when the lesson ends", range: Range::Any },
        ParameterSpec {
            name: "until_placed",
            about: "end when the lesson has ended and the robot, if it is to move, has put the thing down",
            range: Range::Any,
        },
        ParameterSpec { name: "summary", about: "JSON file for what happened; empty: none", range: Range::Any },
        ParameterSpec {
            name: "seed",
            about: "seed of every node; -1: 1, or what the session was begun with",
            range: Range::Integer { min: -1, max: i64::MAX },
        },
        ParameterSpec {
            name: "session",
            about: "folder of the session, continued if it exists; empty: a new one under bags/",
            range: Range::Any,
        },
        ParameterSpec {
            name: "port",
            about: "TCP port of the operator's page; 0: any free one",
            range: Range::Integer { min: 0, max: 65535 },
        },
        ParameterSpec { name: "record", about: "record every topic to a bag", range: Range::Any },
        ParameterSpec {
            name: "time_limit_s",
            about: "with until_taught or until_placed: give up after this many seconds; 0: never",
            range: Range::Float { min: 0.0, max: 1e6 },
        },
    ];

    fn check(&self) -> Result<(), String> {
        if self.headless && self.demonstrator == Demonstrator::Human {
            return Err("a human answers on the page, which `headless` leaves out; drop one of the two".to_owned());
        }
        if self.time_limit_s > 0.0 && !self.ends_by_itself() {
            return Err("time_limit_s has a meaning only with until_taught or until_placed".to_owned());
        }
        Ok(())
    }

    fn seed(&self) -> u64 {
        u64::try_from(self.seed).unwrap_or(1)
    }
}

impl Settings {
    /// Whether nobody has to end it.
    pub fn ends_by_itself(&self) -> bool {
        self.until_taught || self.until_placed
    }
}

#[cfg(test)]
mod tests {
    use super::Settings;

    #[test]
    fn the_table_of_parameters_matches_the_settings() {
        bus::testing::check_parameters::<Settings>();
    }
}
