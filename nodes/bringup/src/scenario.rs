//! The scenarios that come with the executable, and those in files.

use crate::BringupError;
use std::io::Read;
use std::path::{Path, PathBuf};

/// Name and parameter file of every scenario built in.
pub const BUILT_IN: [(&str, &str); 4] = [
    ("flowers", include_str!("../../../config/flowers.yaml")),
    ("spoon", include_str!("../../../config/spoon.yaml")),
    ("grid", include_str!("../../../config/grid.yaml")),
    ("driving", include_str!("../../../config/driving.yaml")),
];
const MAX_BYTES: u64 = 1 << 20;

/// A parameter file for all nodes of a lesson.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Scenario {
    /// What to call it.
    pub name: String,
    /// ROS parameters, YAML.
    pub text: String,
}

impl Scenario {
    /// A scenario by its name, or by the path of a parameter file (which ends in .yaml or .yml, or has a slash).
    ///
    /// # Errors
    /// When there is no such scenario, or the file cannot be read.
    pub fn find(name: &str) -> Result<Self, BringupError> {
        if let Some((name, text)) = BUILT_IN.iter().find(|(known, _)| *known == name) {
            return Ok(Self { name: (*name).to_owned(), text: (*text).to_owned() });
        }
        if name.contains('/') || name.ends_with(".yaml") || name.ends_with(".yml") {
            return Ok(Self { name: name.to_owned(), text: read_parameters(Path::new(name))? });
        }
        let nearest = BUILT_IN
            .iter()
            .map(|(known, _)| (strsim::damerau_levenshtein(known, &name.to_lowercase()), *known))
            .min()
            .filter(|(distance, _)| *distance <= 2);
        Err(BringupError::UnknownScenario {
            got: name.chars().take(80).collect(),
            hint: nearest.map_or(String::new(), |(_, known)| format!(" (did you mean '{known}'?)")),
        })
    }
}

/// What a lesson is about, which decides what nodes it needs.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Subject {
    /// A simulated table to set.
    Table,
    /// A real one, seen by detectors: its parameters name `table_perception`.
    DetectedTable,
    /// A world to act in: its parameters name `simulated_world`.
    World,
}

impl Subject {
    /// Of a scenario's parameters. What is wrong with them is for the nodes to say.
    pub fn of(text: &str) -> Self {
        let sections = bus::sections_of(text).unwrap_or_default();
        let names = |node: &str| sections.iter().any(|pattern| pattern.rsplit('/').next() == Some(node));
        if names("simulated_world") {
            Self::World
        } else if names("table_perception") {
            Self::DetectedTable
        } else {
            Self::Table
        }
    }
}

/// The text of a parameter file.
///
/// # Errors
/// When it cannot be read, is longer than 1 MiB, or is not UTF-8.
pub fn read_parameters(path: &Path) -> Result<String, BringupError> {
    let unreadable = |source| BringupError::Read { path: PathBuf::from(path), source };
    let file = std::fs::File::open(path).map_err(unreadable)?;
    let mut text = String::new();
    file.take(MAX_BYTES + 1).read_to_string(&mut text).map_err(unreadable)?;
    if text.len() as u64 > MAX_BYTES {
        return Err(BringupError::ParametersTooLong { path: PathBuf::from(path), max: MAX_BYTES });
    }
    Ok(text)
}

#[cfg(test)]
mod tests {
    use super::{BUILT_IN, Scenario, Subject};

    #[test]
    fn a_scenario_that_names_a_simulated_world_is_about_a_world() {
        let subjects = BUILT_IN.map(|(_, text)| Subject::of(text));
        assert_eq!(subjects, [Subject::Table, Subject::Table, Subject::World, Subject::World]);
        assert_eq!(Subject::of("/**/simulated_world_2:\n  ros__parameters: {}"), Subject::Table);
        assert_eq!(Subject::of("/**/table_perception:\n  ros__parameters: {}"), Subject::DetectedTable);
        assert_eq!(Subject::of("not: [a, parameter file"), Subject::Table);
    }

    #[test]
    fn an_unknown_scenario_names_the_known_ones_and_the_nearest() {
        let error = Scenario::find("Flower").expect_err("unknown").to_string();
        for wanted in ["'Flower'", "flowers", "spoon", "did you mean 'flowers'"] {
            assert!(error.contains(wanted), "{error}");
        }
        assert!(!Scenario::find("kitchen").expect_err("unknown").to_string().contains("did you mean"));
        assert_eq!(Scenario::find("spoon").expect("known").name, "spoon");
    }

    #[test]
    fn a_missing_file_is_named() {
        let error = Scenario::find("no/such.yaml").expect_err("missing").to_string();
        assert!(error.contains("no/such.yaml"), "{error}");
    }
}
