//! Policies to judge, checked, each in the form in which it came.

use crate::evidence::{EvidenceError, check_features, usable};
use crate::text::{TextError, check_id, shown};
use crate::{MAX_FEATURE, World};
use apprentice_msgs::msg::{PolicySet, PolicyToJudge};
use mdp::{MdpError, Policy};
use std::collections::HashSet;
use thiserror::Error;

/// More policies in one set are refused.
pub const MAX_POLICIES: usize = 1000;
/// More rollouts of one policy are refused.
const MAX_ROLLOUTS: usize = 100_000;

/// A policy that can be judged.
#[derive(Debug, Clone, PartialEq)]
pub struct Checked {
    /// Unique within its set.
    pub id: String,
    /// What is known of it.
    pub form: Form,
}

/// What is known of a policy.
#[derive(Debug, Clone, PartialEq)]
pub enum Form {
    /// Φ(π).
    FeatureCounts(Vec<f64>),
    /// A policy of the world.
    Tabular(Policy),
    /// Φ of each rollout, all of one length (dissertation appendix E.6).
    Rollouts(Vec<Vec<f64>>),
}

/// Why policies cannot be judged.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum PolicyError {
    /// An id.
    #[error(transparent)]
    Text(#[from] TextError),
    /// Sets count from 1.
    #[error("its number is 0; the sets of a session count 1, 2, …")]
    Number,
    /// No policies, or too many.
    #[error("it holds {got} policies; 1 to {MAX_POLICIES} are supported")]
    Count {
        /// Got.
        got: usize,
    },
    /// The same id for two policies.
    #[error("it holds the policy '{id}' twice")]
    Repeated {
        /// Of the policy.
        id: String,
    },
    /// Only the numbered forms are known.
    #[error("policy '{id}' is of form {got}; 0 (feature counts), 1 (tabular) and 2 (rollouts) are known")]
    UnknownForm {
        /// Of the policy.
        id: String,
        /// Got.
        got: u8,
    },
    /// One count for each weight.
    #[error("policy '{id}' has {got} feature counts, but this lesson has {expected} weights")]
    FeatureCounts {
        /// Of the policy.
        id: String,
        /// Got.
        got: usize,
        /// Weights.
        expected: usize,
    },
    /// A count that cannot be computed with.
    #[error("feature count {index} of policy '{id}' is {got}; finite numbers of at most {MAX_FEATURE:e} are needed")]
    FeatureCount {
        /// Of the policy.
        id: String,
        /// Counted from 0.
        index: usize,
        /// Got.
        got: f64,
    },
    /// Tables are about a world.
    #[error("policy '{id}' is a table of the world '{world}', which has not been received")]
    NoWorld {
        /// Of the policy.
        id: String,
        /// The world that the set names.
        world: String,
    },
    /// The set is about another world.
    #[error("it is about the world '{got}', but this lesson is about '{expected}'")]
    OtherWorld {
        /// Got.
        got: String,
        /// The lesson's.
        expected: String,
    },
    /// Deterministic or stochastic.
    #[error("policy '{id}' has {actions} actions and {probabilities} probabilities; one of the two is needed")]
    Table {
        /// Of the policy.
        id: String,
        /// Got.
        actions: usize,
        /// Got.
        probabilities: usize,
    },
    /// It is no policy of the world.
    #[error("policy '{id}': {source}")]
    Policy {
        /// Of the policy.
        id: String,
        /// What is wrong.
        source: MdpError,
    },
    /// No rollouts, or too many.
    #[error("policy '{id}' has {got} rollouts; 1 to {MAX_ROLLOUTS} are supported")]
    Rollouts {
        /// Of the policy.
        id: String,
        /// Got.
        got: usize,
    },
    /// A rollout that cannot be used.
    #[error("policy '{id}': {source}")]
    Rollout {
        /// Of the policy.
        id: String,
        /// What is wrong.
        source: EvidenceError,
    },
}

/// The policies of a set for a lesson of `n_features` weights, about `world` if it has come.
///
/// # Errors
/// The first thing wrong with the set: all its policies are judged together, or none.
pub fn check_policies(
    message: &PolicySet,
    n_features: usize,
    world: Option<&World>,
) -> Result<Vec<Checked>, PolicyError> {
    check_id("its id", &message.id)?;
    if message.number == 0 {
        return Err(PolicyError::Number);
    }
    if message.policies.is_empty() || message.policies.len() > MAX_POLICIES {
        return Err(PolicyError::Count { got: message.policies.len() });
    }
    if let Some(world) = world
        && !message.world_id.is_empty()
        && message.world_id != world.id
    {
        return Err(PolicyError::OtherWorld { got: shown(&message.world_id), expected: world.id.clone() });
    }
    let mut ids = HashSet::new();
    let checked = message.policies.iter().map(|policy| {
        check_id("the id of a policy", &policy.id)?;
        if !ids.insert(policy.id.as_str()) {
            return Err(PolicyError::Repeated { id: policy.id.clone() });
        }
        let form = match policy.form {
            PolicyToJudge::FEATURE_COUNTS => feature_counts(policy, n_features)?,
            PolicyToJudge::TABULAR => tabular(policy, &message.world_id, world)?,
            PolicyToJudge::ROLLOUTS => rollouts(policy, n_features)?,
            got => return Err(PolicyError::UnknownForm { id: policy.id.clone(), got }),
        };
        Ok(Checked { id: policy.id.clone(), form })
    });
    checked.collect()
}

fn feature_counts(policy: &PolicyToJudge, expected: usize) -> Result<Form, PolicyError> {
    let (id, counts) = (policy.id.clone(), &policy.feature_counts);
    if counts.len() != expected {
        return Err(PolicyError::FeatureCounts { id, got: counts.len(), expected });
    }
    match counts.iter().position(|x| !usable(*x)) {
        Some(index) => Err(PolicyError::FeatureCount { id, index, got: counts[index] }),
        None => Ok(Form::FeatureCounts(counts.clone())),
    }
}

fn tabular(policy: &PolicyToJudge, world_id: &str, world: Option<&World>) -> Result<Form, PolicyError> {
    let id = policy.id.clone();
    let Some(world) = world else { return Err(PolicyError::NoWorld { id, world: shown(world_id) }) };
    let (actions, probabilities) = (policy.actions.len(), policy.action_probabilities.len());
    if (actions == 0) == (probabilities == 0) {
        return Err(PolicyError::Table { id, actions, probabilities });
    }
    let table = if probabilities == 0 {
        Policy::Deterministic(policy.actions.iter().map(|&action| action as usize).collect())
    } else {
        Policy::Stochastic(policy.action_probabilities.clone())
    };
    table.check(&world.mdp).map_err(|source| PolicyError::Policy { id, source })?;
    Ok(Form::Tabular(table))
}

fn rollouts(policy: &PolicyToJudge, n_features: usize) -> Result<Form, PolicyError> {
    let id = || policy.id.clone();
    let got = policy.rollouts.len();
    if got == 0 || got > MAX_ROLLOUTS {
        return Err(PolicyError::Rollouts { id: id(), got });
    }
    for rollout in &policy.rollouts {
        check_features(rollout, n_features).map_err(|source| PolicyError::Rollout { id: id(), source })?;
    }
    Ok(Form::Rollouts(policy.rollouts.iter().map(|rollout| rollout.features.clone()).collect()))
}
