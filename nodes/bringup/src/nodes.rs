//! What bringup knows of the nodes it starts.

use bus::{Arguments, ParameterError, ParameterSpec};

/// One node that the executable holds.
#[derive(Clone, Copy)]
pub struct NodeInfo {
    /// Its name, as in `apprentice <name>`.
    pub name: &'static str,
    /// One sentence.
    pub about: &'static str,
    /// Its parameters.
    pub parameters: &'static [ParameterSpec],
    /// Reads its settings and drops them: the errors are what is wanted.
    pub check: fn(&Arguments) -> Result<(), ParameterError>,
}

impl NodeInfo {
    /// Whether the node has a parameter.
    pub fn has(&self, parameter: &str) -> bool {
        self.parameters.iter().any(|spec| spec.name == parameter)
    }
}

/// Stage in which a node is stopped: first those that give evidence, then those that compute, at last the recorder, so
/// that the bag holds everything.
pub fn stop_stage(name: &str) -> u8 {
    match name {
        "demonstrator" | "operator_ui" => 0,
        "session_recorder" => 2,
        _ => 1,
    }
}
