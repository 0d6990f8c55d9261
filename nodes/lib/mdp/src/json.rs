//! Processes as JSON text (formats.md, "MDP JSON").
//!
//! `{"gamma", "n_states", "n_actions", "initial": [S], "transitions": [[s, a, s2, p], …], "features": [[k] × S]}` or
//! `"state_action_features": [[k] × S·A]` with row s·A + a; optional `"actions"`: [A names] and `"shape"`: [rows, columns].

use serde::{Deserialize, Serialize};

use crate::error::{MdpError, check_sizes, check_transitions};
use crate::model::Mdp;
use crate::parts::{Features, MdpParts};

#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Text {
    gamma: f64,
    n_states: usize,
    n_actions: usize,
    initial: Vec<f64>,
    transitions: Vec<(usize, usize, usize, f64)>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    features: Option<Vec<Vec<f64>>>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    state_action_features: Option<Vec<Vec<f64>>>,
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    actions: Vec<String>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    shape: Option<[usize; 2]>,
}

impl Mdp {
    /// Reads and checks a process.
    ///
    /// # Errors
    /// Text that is no such JSON; everything that [`Mdp::new`] refuses.
    pub fn from_json(bytes: &[u8]) -> Result<Self, MdpError> {
        let text: Text = serde_json::from_slice(bytes)
            .map_err(|error| MdpError::Json { what: "a decision process", message: error.to_string() })?;
        let (table, wrap): (_, fn(Vec<f64>) -> Features) = match (text.features, text.state_action_features) {
            (Some(table), None) => (table, Features::State),
            (None, Some(table)) => (table, Features::StateAction),
            (Some(_), Some(_)) => return Err(MdpError::FeatureKeys { got: "both are" }),
            (None, None) => return Err(MdpError::FeatureKeys { got: "neither is" }),
        };
        let n_features = table.first().map_or(0, Vec::len);
        check_sizes(text.n_states, text.n_actions, n_features)?;
        check_transitions(text.transitions.len())?;
        let features = wrap(flatten("features", table, n_features)?);
        Self::new(MdpParts {
            gamma: text.gamma,
            n_states: text.n_states,
            n_actions: text.n_actions,
            n_features,
            initial: text.initial,
            transitions: text.transitions,
            features,
            actions: text.actions,
            shape: text.shape,
        })
    }

    /// The process as JSON; every number reads back as the same bits.
    pub fn to_json(&self) -> String {
        let parts = self.parts();
        let nested = |values: Vec<f64>| values.chunks(parts.n_features).map(<[f64]>::to_vec).collect();
        let (features, state_action_features) = match parts.features {
            Features::State(values) => (Some(nested(values)), None),
            Features::StateAction(values) => (None, Some(nested(values))),
        };
        let text = Text {
            gamma: parts.gamma,
            n_states: parts.n_states,
            n_actions: parts.n_actions,
            initial: parts.initial,
            transitions: parts.transitions,
            features,
            state_action_features,
            actions: parts.actions,
            shape: parts.shape,
        };
        serde_json::to_string(&text).expect("numbers and strings always serialise")
    }
}

/// Rows one after another, all of `width`.
pub(crate) fn flatten(name: &'static str, table: Vec<Vec<f64>>, width: usize) -> Result<Vec<f64>, MdpError> {
    if let Some(row) = table.iter().position(|row| row.len() != width) {
        return Err(MdpError::Row { name, row, got: table[row].len(), expected: width });
    }
    Ok(table.concat())
}
