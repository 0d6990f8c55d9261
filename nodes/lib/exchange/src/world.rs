//! Worlds: a decision process without a reward, as a message and as the core computes with it.

use crate::evidence::usable;
use crate::text::{TextError, check_id, shown};
use crate::{MAX_FEATURE, MAX_WEIGHTS};
use apprentice_msgs::msg::{TabularWorld, WorldReference};
use apprentice_msgs::std_msgs::Header;
use apprentice_msgs::to_cdr;
use mdp::{Features, Mdp, MdpError, MdpParts};
use sha2::{Digest, Sha256};
use thiserror::Error;

/// More pairs of a state and an action than this are refused: tables of them are made before any transition is seen.
const MAX_STATE_ACTIONS: usize = 5_000_000;

/// A checked world.
#[derive(Debug, Clone, PartialEq)]
pub struct World {
    /// Unique within a session.
    pub id: String,
    /// See [`world_hash`].
    pub hash: String,
    /// What each weight is about.
    pub feature_names: Vec<String>,
    /// The process.
    pub mdp: Mdp,
    /// How to picture its states.
    pub picture: Picture,
}

/// How to picture the states of a world.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Picture {
    /// Not at all.
    None,
    /// As the cells of a grid, row by row.
    Cells {
        /// Rows.
        rows: usize,
        /// Columns.
        columns: usize,
    },
    /// As a car on a road with other traffic: see TabularWorld.
    Road {
        /// Lanes, the outer two off the road.
        lanes: usize,
        /// Places of the traffic.
        places: usize,
    },
}

/// Why a world cannot be used.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum WorldError {
    /// An id or a name.
    #[error(transparent)]
    Text(#[from] TextError),
    /// No weights, or too many.
    #[error("it names {got} features; 1 to {MAX_WEIGHTS} are supported")]
    Features {
        /// Got.
        got: usize,
    },
    /// The same name for two weights.
    #[error("it names the feature '{name}' twice")]
    RepeatedFeature {
        /// The name.
        name: String,
    },
    /// Transitions are four arrays of equal length.
    #[error(
        "its transitions are {from} states, {actions} actions, {to} targets and {probabilities} probabilities; \
         as many of each are needed"
    )]
    Ragged {
        /// Length of `from_state`.
        from: usize,
        /// Length of `action`.
        actions: usize,
        /// Length of `to_state`.
        to: usize,
        /// Length of `probability`.
        probabilities: usize,
    },
    /// More pairs of a state and an action than fit.
    #[error("it has {n_states} states of {n_actions} actions; at most {MAX_STATE_ACTIONS} pairs are supported")]
    TooLarge {
        /// Got.
        n_states: u32,
        /// Got.
        n_actions: u32,
    },
    /// Only the numbered kinds of features are known.
    #[error("its features are of kind {got}; 0 (of states) and 1 (of states and actions) are known")]
    FeatureKind {
        /// Got.
        got: u8,
    },
    /// A feature so large that returns could overflow.
    #[error("features[{index}] is {got}; finite numbers of at most {MAX_FEATURE:e} are needed")]
    Feature {
        /// In the array of the message.
        index: usize,
        /// Got.
        got: f64,
    },
    /// Rows and columns, or neither.
    #[error("its shape has {got} numbers; rows and columns are needed, or none")]
    Shape {
        /// Got.
        got: usize,
    },
    /// Only the numbered kinds of shapes are known.
    #[error("its shape is of kind {got}; 0 (rows and columns) and 1 (lanes and places of traffic) are known")]
    ShapeKind {
        /// Got.
        got: u8,
    },
    /// A road with another number of states.
    #[error(
        "a road of {lanes} lanes and {places} places of traffic has lanes (lanes - 2) places states, at least 3 lanes and 1 \
         place; it has {got} states"
    )]
    Road {
        /// Got.
        lanes: u32,
        /// Got.
        places: u32,
        /// States.
        got: u32,
    },
    /// It is no decision process.
    #[error(transparent)]
    Process(#[from] MdpError),
}

impl World {
    /// How other messages name it.
    pub fn reference(&self) -> WorldReference {
        WorldReference { id: self.id.clone(), hash: self.hash.clone() }
    }
}

/// SHA-256 of a world's message without its header, hex.
pub fn world_hash(message: &TabularWorld) -> String {
    let bare = TabularWorld { header: Header::default(), ..message.clone() };
    Sha256::digest(to_cdr(&bare)).iter().map(|byte| format!("{byte:02x}")).collect()
}

/// The checked world of a message.
///
/// # Errors
/// The first thing wrong with it; sizes are compared before anything of that size is allocated.
pub fn world_from_message(message: &TabularWorld) -> Result<World, WorldError> {
    check_id("its id", &message.id)?;
    check_names(message)?;
    let [from, actions, to] = [&message.from_state, &message.action, &message.to_state].map(Vec::len);
    let probabilities = message.probability.len();
    if [from, actions, to].iter().any(|&n| n != probabilities) {
        return Err(WorldError::Ragged { from, actions, to, probabilities });
    }
    let (n_states, n_actions) = (message.n_states as usize, message.n_actions as usize);
    if n_states.saturating_mul(n_actions) > MAX_STATE_ACTIONS {
        return Err(WorldError::TooLarge { n_states: message.n_states, n_actions: message.n_actions });
    }
    if let Some(index) = message.features.iter().position(|x| !usable(*x)) {
        return Err(WorldError::Feature { index, got: message.features[index] });
    }
    let features = match message.features_of {
        TabularWorld::STATE_FEATURES => Features::State(message.features.clone()),
        TabularWorld::STATE_ACTION_FEATURES => Features::StateAction(message.features.clone()),
        got => return Err(WorldError::FeatureKind { got }),
    };
    let picture = picture(message)?;
    let shape = match picture {
        Picture::Cells { rows, columns } => Some([rows, columns]),
        Picture::None | Picture::Road { .. } => None,
    };
    let transitions = message.from_state.iter().zip(&message.action).zip(&message.to_state).zip(&message.probability);
    let mdp = Mdp::new(MdpParts {
        gamma: message.gamma,
        n_states,
        n_actions,
        n_features: message.feature_names.len(),
        initial: message.initial.clone(),
        transitions: transitions.map(|(((&s, &a), &to), &p)| (s as usize, a as usize, to as usize, p)).collect(),
        features,
        actions: message.action_names.clone(),
        shape,
    })?;
    let hash = world_hash(message);
    Ok(World { id: message.id.clone(), hash, feature_names: message.feature_names.clone(), mdp, picture })
}

/// How its states are to be pictured. Rows and columns are compared with the states where the process is checked.
fn picture(message: &TabularWorld) -> Result<Picture, WorldError> {
    match (message.shape.as_slice(), message.shape_of) {
        ([], _) => Ok(Picture::None),
        ([rows, columns], TabularWorld::CELLS) => {
            Ok(Picture::Cells { rows: *rows as usize, columns: *columns as usize })
        }
        (&[lanes, places], TabularWorld::ROAD) => {
            let got = message.n_states;
            let n_states = lanes.checked_mul(lanes.saturating_sub(2)).and_then(|n| n.checked_mul(places));
            if n_states == Some(got) && got > 0 {
                Ok(Picture::Road { lanes: lanes as usize, places: places as usize })
            } else {
                Err(WorldError::Road { lanes, places, got })
            }
        }
        ([_, _], got) => Err(WorldError::ShapeKind { got }),
        (other, _) => Err(WorldError::Shape { got: other.len() }),
    }
}

/// The message of a process.
pub fn world_to_message(id: &str, feature_names: &[String], mdp: &Mdp, picture: Picture) -> TabularWorld {
    let parts = mdp.parts();
    let column =
        |pick: fn(&(usize, usize, usize, f64)) -> usize| parts.transitions.iter().map(pick).map(number).collect();
    let (features_of, features) = match parts.features {
        Features::State(features) => (TabularWorld::STATE_FEATURES, features),
        Features::StateAction(features) => (TabularWorld::STATE_ACTION_FEATURES, features),
    };
    let (shape, shape_of) = match picture {
        Picture::None => (Vec::new(), TabularWorld::CELLS),
        Picture::Cells { rows, columns } => (vec![number(rows), number(columns)], TabularWorld::CELLS),
        Picture::Road { lanes, places } => (vec![number(lanes), number(places)], TabularWorld::ROAD),
    };
    TabularWorld {
        header: Header::default(),
        id: id.to_owned(),
        gamma: parts.gamma,
        n_states: number(parts.n_states),
        n_actions: number(parts.n_actions),
        feature_names: feature_names.to_vec(),
        action_names: parts.actions,
        initial: parts.initial,
        from_state: column(|t| t.0),
        action: column(|t| t.1),
        to_state: column(|t| t.2),
        probability: parts.transitions.iter().map(|t| t.3).collect(),
        features_of,
        features,
        shape,
        shape_of,
    }
}

/// A process is checked to be small, so that its numbers fit.
fn number(n: usize) -> u32 {
    u32::try_from(n).unwrap_or(u32::MAX)
}

fn check_names(message: &TabularWorld) -> Result<(), WorldError> {
    let names = &message.feature_names;
    if names.is_empty() || names.len() > MAX_WEIGHTS {
        return Err(WorldError::Features { got: names.len() });
    }
    for (i, name) in names.iter().enumerate() {
        check_id("a name of a feature", name)?;
        if names[..i].contains(name) {
            return Err(WorldError::RepeatedFeature { name: shown(name) });
        }
    }
    message.action_names.iter().try_for_each(|name| check_id("a name of an action", name))?;
    Ok(())
}
