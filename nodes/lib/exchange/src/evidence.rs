//! Evidence other than placements: actions, marked segments and trajectories, checked and as plain values.

use crate::World;
use crate::text::{TextError, check_id, shown};
use apprentice_msgs::msg::{
    ActionDemonstration, CritiqueSegment, FeatureTrajectory, LearnerHistory, PlacementDemonstration, SegmentCritique,
    TrajectoryPreference,
};
use std::collections::HashSet;
use thiserror::Error;

/// More steps in one demonstration or critique are refused.
pub const MAX_STEPS: usize = 100_000;
/// More trajectories in one preference or history are refused: all their pairs count.
pub const MAX_TRAJECTORIES: usize = 100;
/// Features larger than this are refused, so that no return overflows.
pub const MAX_FEATURE: f64 = 1e12;

/// How sure a person was.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Confidence {
    /// That is it.
    Sure,
    /// About so.
    Fairly,
    /// A guess.
    Guess,
}

/// A step that a person marked.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Mark {
    /// State of the world.
    pub state: usize,
    /// Action taken in it.
    pub action: usize,
    /// Whether that is how it should be done.
    pub good: bool,
}

/// Why a message is no evidence.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum EvidenceError {
    /// An id.
    #[error(transparent)]
    Text(#[from] TextError),
    /// Only the numbered degrees are known.
    #[error("its confidence is {got}; 0 (sure), 1 (fairly) and 2 (a guess) are known")]
    Confidence {
        /// Got.
        got: u8,
    },
    /// Only the numbered answers are known.
    #[error("its answer is {got}; 0 (ranked), 1 (equal) and 2 (can't tell) are known")]
    Answer {
        /// Got.
        got: u8,
    },
    /// It speaks of another world.
    #[error("it is about the world '{got}', but this lesson is about '{expected}'")]
    OtherWorld {
        /// Got.
        got: String,
        /// The lesson's.
        expected: String,
    },
    /// One action for each state.
    #[error("it has {states} states and {actions} actions; one action for each state is needed")]
    Ragged {
        /// States.
        states: usize,
        /// Actions.
        actions: usize,
    },
    /// No steps, or too many.
    #[error("it has {got} steps; 1 to {MAX_STEPS} are supported")]
    Steps {
        /// Got.
        got: usize,
    },
    /// A step that the world does not have.
    #[error("step {step}: {what} {got} is out of range; the world has {n} of them, counted from 0")]
    OutOfRange {
        /// Counted from 0.
        step: usize,
        /// `state` or `action`.
        what: &'static str,
        /// Got.
        got: u32,
        /// How many there are.
        n: usize,
    },
    /// Nothing is marked, or more segments than steps.
    #[error("it marks {got} segments of {steps} steps; one or more are needed, none of them empty")]
    Segments {
        /// Got.
        got: usize,
        /// Steps of the trajectory.
        steps: usize,
    },
    /// A segment that the trajectory does not have.
    #[error("segment {index} goes from step {start} to {end}; 0 <= start < end <= {steps} is needed")]
    Segment {
        /// Counted from 0.
        index: usize,
        /// Got.
        start: u32,
        /// Got.
        end: u32,
        /// Steps of the trajectory.
        steps: usize,
    },
    /// Only the numbered verdicts are known.
    #[error("the verdict of segment {index} is {got}; 0 (good) and 1 (bad) are known")]
    Verdict {
        /// Counted from 0.
        index: usize,
        /// Got.
        got: u8,
    },
    /// Where there is one thing to do, it is not bad.
    #[error("segment {index} is bad, but the world '{world}' has no other action to take")]
    NoAlternative {
        /// Counted from 0.
        index: usize,
        /// The world.
        world: String,
    },
    /// A step that is marked twice.
    #[error("step {step} lies in two segments; a step is marked once")]
    Overlap {
        /// Counted from 0.
        step: usize,
    },
    /// Nothing to compare, or too much.
    #[error("it compares {got} trajectories; 2 to {MAX_TRAJECTORIES} are supported")]
    Trajectories {
        /// Got.
        got: usize,
    },
    /// A trajectory is not better than itself.
    #[error("it holds the trajectory '{id}' twice")]
    Repeated {
        /// Of the trajectory.
        id: String,
    },
    /// One feature for each weight.
    #[error("trajectory '{id}' has {got} features, but this lesson has {expected} weights")]
    Features {
        /// Of the trajectory.
        id: String,
        /// Got.
        got: usize,
        /// Weights.
        expected: usize,
    },
    /// A feature that cannot be computed with.
    #[error("feature {index} of trajectory '{id}' is {got}; finite numbers of at most {MAX_FEATURE:e} are needed")]
    Feature {
        /// Of the trajectory.
        id: String,
        /// Counted from 0.
        index: usize,
        /// Got.
        got: f64,
    },
}

/// The degree of confidence that messages of every kind of evidence number alike.
///
/// # Errors
/// An unknown number.
pub fn confidence_from_message(confidence: u8) -> Result<Confidence, EvidenceError> {
    match confidence {
        PlacementDemonstration::CONFIDENCE_SURE => Ok(Confidence::Sure),
        PlacementDemonstration::CONFIDENCE_FAIRLY => Ok(Confidence::Fairly),
        PlacementDemonstration::CONFIDENCE_GUESS => Ok(Confidence::Guess),
        got => Err(EvidenceError::Confidence { got }),
    }
}

/// The shown pairs of a state and an action.
///
/// # Errors
/// The first thing wrong with the message.
pub fn steps_from_message(message: &ActionDemonstration, world: &World) -> Result<Vec<(usize, usize)>, EvidenceError> {
    confidence_from_message(message.confidence)?;
    steps(&message.world_id, &message.states, &message.actions, world)
}

/// The marked steps of a trajectory, in its order.
///
/// # Errors
/// The first thing wrong with the message.
pub fn marks_from_message(message: &SegmentCritique, world: &World) -> Result<Vec<Mark>, EvidenceError> {
    confidence_from_message(message.confidence)?;
    let steps = steps(&message.world_id, &message.states, &message.actions, world)?;
    // Empty segments are refused, so more segments than steps overlap for sure.
    if message.segments.is_empty() || message.segments.len() > steps.len() {
        return Err(EvidenceError::Segments { got: message.segments.len(), steps: steps.len() });
    }
    let mut good: Vec<Option<bool>> = vec![None; steps.len()];
    for (index, segment) in message.segments.iter().enumerate() {
        let verdict = match segment.verdict {
            CritiqueSegment::GOOD => true,
            CritiqueSegment::BAD if world.mdp.n_actions() == 1 => {
                return Err(EvidenceError::NoAlternative { index, world: world.id.clone() });
            }
            CritiqueSegment::BAD => false,
            got => return Err(EvidenceError::Verdict { index, got }),
        };
        let (start, end) = (segment.start as usize, segment.end as usize);
        if start >= end || end > steps.len() {
            return Err(EvidenceError::Segment { index, start: segment.start, end: segment.end, steps: steps.len() });
        }
        for (step, mark) in good.iter_mut().enumerate().take(end).skip(start) {
            if mark.replace(verdict).is_some() {
                return Err(EvidenceError::Overlap { step });
            }
        }
    }
    let marked =
        steps.iter().zip(good).filter_map(|(&(state, action), good)| Some(Mark { state, action, good: good? }));
    Ok(marked.collect())
}

fn steps(world_id: &str, states: &[u32], actions: &[u32], world: &World) -> Result<Vec<(usize, usize)>, EvidenceError> {
    if world_id != world.id {
        return Err(EvidenceError::OtherWorld { got: shown(world_id), expected: world.id.clone() });
    }
    if states.len() != actions.len() {
        return Err(EvidenceError::Ragged { states: states.len(), actions: actions.len() });
    }
    if states.is_empty() || states.len() > MAX_STEPS {
        return Err(EvidenceError::Steps { got: states.len() });
    }
    let (n_states, n_actions) = (world.mdp.n_states(), world.mdp.n_actions());
    let checked = states.iter().zip(actions).enumerate().map(|(step, (&state, &action))| {
        for (what, got, n) in [("state", state, n_states), ("action", action, n_actions)] {
            if got as usize >= n {
                return Err(EvidenceError::OutOfRange { step, what, got, n });
            }
        }
        Ok((state as usize, action as usize))
    });
    checked.collect()
}

/// Checks a preference over trajectories of `n_features` features each.
///
/// # Errors
/// The first thing wrong with the message.
pub fn check_preference(message: &TrajectoryPreference, n_features: usize) -> Result<(), EvidenceError> {
    confidence_from_message(message.confidence)?;
    if message.answer > TrajectoryPreference::CANT_TELL {
        return Err(EvidenceError::Answer { got: message.answer });
    }
    check_trajectories(&message.trajectories, n_features)
}

/// Checks the history of a learner, of `n_features` features each.
///
/// # Errors
/// The first thing wrong with the message.
pub fn check_history(message: &LearnerHistory, n_features: usize) -> Result<(), EvidenceError> {
    confidence_from_message(message.confidence)?;
    check_trajectories(&message.demonstrations, n_features)
}

fn check_trajectories(trajectories: &[FeatureTrajectory], n_features: usize) -> Result<(), EvidenceError> {
    if !(2..=MAX_TRAJECTORIES).contains(&trajectories.len()) {
        return Err(EvidenceError::Trajectories { got: trajectories.len() });
    }
    let mut ids = HashSet::new();
    for trajectory in trajectories {
        check_id("the id of a trajectory", &trajectory.id)?;
        if !ids.insert(trajectory.id.as_str()) {
            return Err(EvidenceError::Repeated { id: trajectory.id.clone() });
        }
        check_features(trajectory, n_features)?;
    }
    Ok(())
}

/// Checks that a trajectory has one usable feature for each of `expected` weights.
pub(crate) fn check_features(trajectory: &FeatureTrajectory, expected: usize) -> Result<(), EvidenceError> {
    let id = || shown(&trajectory.id);
    let got = trajectory.features.len();
    if got != expected {
        return Err(EvidenceError::Features { id: id(), got, expected });
    }
    match trajectory.features.iter().position(|x| !usable(*x)) {
        Some(index) => Err(EvidenceError::Feature { id: id(), index, got: trajectory.features[index] }),
        None => Ok(()),
    }
}

/// Whether a feature is finite and not so large that returns could overflow.
pub(crate) fn usable(feature: f64) -> bool {
    feature.abs() <= MAX_FEATURE
}
