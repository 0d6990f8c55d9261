//! Questions about a world, checked before anybody answers or shows them.

use crate::evidence::usable;
use crate::text::{TextError, check_id, shown};
use crate::{MAX_FEATURE, World};
use apprentice_msgs::msg::{FeatureTrajectory, WorldQuery, WorldTrajectory};
use thiserror::Error;

/// Trajectories longer than this are not shown to a person.
pub const MAX_SHOWN_STEPS: usize = 1000;

/// Why a question about a world cannot be answered.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum WorldQueryError {
    /// An id.
    #[error(transparent)]
    Text(#[from] TextError),
    /// It speaks of another world.
    #[error("it is about the world '{got}', but this lesson is about '{expected}'")]
    OtherWorld {
        /// Got.
        got: String,
        /// The lesson's.
        expected: String,
    },
    /// Only the numbered kinds are known.
    #[error("its kind is {got}; 0 (action), 1 (critique) and 2 (comparison) are known")]
    Kind {
        /// Got.
        got: u8,
    },
    /// The number of trajectories follows from the kind.
    #[error("it shows {got} trajectories; its kind shows {expected}")]
    Trajectories {
        /// Got.
        got: usize,
        /// By kind.
        expected: usize,
    },
    /// No steps, too many, or not an action for each state.
    #[error(
        "trajectory '{id}' has {states} states and {actions} actions; 1 to {MAX_SHOWN_STEPS} states and an action for each \
         are needed"
    )]
    Steps {
        /// Of the trajectory.
        id: String,
        /// Got.
        states: usize,
        /// Got.
        actions: usize,
    },
    /// Something that the world does not have.
    #[error("its {what} {got} is out of range; the world has {n} of them, counted from 0")]
    OutOfRange {
        /// `state` or `action`.
        what: &'static str,
        /// Got.
        got: u32,
        /// How many there are.
        n: usize,
    },
    /// Two trajectories under one name.
    #[error("it shows the trajectory '{id}' twice")]
    Repeated {
        /// Of the trajectory.
        id: String,
    },
    /// One usable feature for each weight.
    #[error("the features of trajectory '{id}' are not {expected} finite numbers of at most {MAX_FEATURE:e}")]
    Features {
        /// Of the trajectory.
        id: String,
        /// Weights of the world.
        expected: usize,
    },
}

/// Refuses a question that is not about `world`, or not of a kind that is known.
///
/// # Errors
/// The first thing wrong with it.
pub fn check_world_query(query: &WorldQuery, world: &World) -> Result<(), WorldQueryError> {
    check_id("its id", &query.id)?;
    if query.world != world.reference() {
        return Err(WorldQueryError::OtherWorld { got: shown(&query.world.id), expected: world.id.clone() });
    }
    let expected = match query.kind {
        WorldQuery::ACTION => 0,
        WorldQuery::CRITIQUE => 1,
        WorldQuery::COMPARISON => 2,
        got => return Err(WorldQueryError::Kind { got }),
    };
    if query.trajectories.len() != expected {
        return Err(WorldQueryError::Trajectories { got: query.trajectories.len(), expected });
    }
    in_range("state", query.state, world.mdp.n_states())?;
    query.trajectories.iter().try_for_each(|trajectory| check_trajectory(trajectory, world))?;
    match query.trajectories.as_slice() {
        [a, b] if a.id == b.id => Err(WorldQueryError::Repeated { id: a.id.clone() }),
        _ => Ok(()),
    }
}

/// What stands for a shown trajectory in an answer.
pub fn feature_trajectory(shown: &WorldTrajectory) -> FeatureTrajectory {
    FeatureTrajectory { id: shown.id.clone(), features: shown.features.clone() }
}

fn check_trajectory(trajectory: &WorldTrajectory, world: &World) -> Result<(), WorldQueryError> {
    check_id("the id of a trajectory", &trajectory.id)?;
    let (states, actions) = (trajectory.states.len(), trajectory.actions.len());
    if states != actions || !(1..=MAX_SHOWN_STEPS).contains(&states) {
        return Err(WorldQueryError::Steps { id: trajectory.id.clone(), states, actions });
    }
    trajectory.states.iter().try_for_each(|state| in_range("state", *state, world.mdp.n_states()))?;
    trajectory.actions.iter().try_for_each(|action| in_range("action", *action, world.mdp.n_actions()))?;
    let expected = world.feature_names.len();
    if trajectory.features.len() != expected || !trajectory.features.iter().all(|x| usable(*x)) {
        return Err(WorldQueryError::Features { id: trajectory.id.clone(), expected });
    }
    Ok(())
}

fn in_range(what: &'static str, got: u32, n: usize) -> Result<(), WorldQueryError> {
    if (got as usize) < n { Ok(()) } else { Err(WorldQueryError::OutOfRange { what, got, n }) }
}

#[cfg(test)]
mod tests {
    use super::check_world_query;
    use crate::{World, world_from_message};
    use apprentice_msgs::msg::{TabularWorld, WorldQuery, WorldReference, WorldTrajectory};

    /// Two states, the second of them the end.
    fn world() -> World {
        let message = TabularWorld {
            id: "w".into(),
            gamma: 0.9,
            n_states: 2,
            n_actions: 2,
            feature_names: vec!["a".into()],
            initial: vec![1.0, 0.0],
            from_state: vec![0, 0],
            action: vec![0, 1],
            to_state: vec![0, 1],
            probability: vec![1.0, 1.0],
            features: vec![0.0, 1.0],
            ..TabularWorld::default()
        };
        world_from_message(&message).expect("a good world")
    }

    #[test]
    fn only_questions_that_can_be_shown_and_answered_are_taken() {
        let world = world();
        let walk =
            |id: &str| WorldTrajectory { id: id.into(), states: vec![0, 1], actions: vec![1, 0], features: vec![0.9] };
        let of = |kind, trajectories| WorldQuery {
            id: "q".into(),
            world: world.reference(),
            kind,
            trajectories,
            ..WorldQuery::default()
        };
        let two = || of(WorldQuery::COMPARISON, vec![walk("a"), walk("b")]);
        for good in [of(WorldQuery::ACTION, vec![]), of(WorldQuery::CRITIQUE, vec![walk("a")]), two()] {
            assert_eq!(check_world_query(&good, &world), Ok(()));
        }
        let with = |change: fn(&mut WorldQuery)| {
            let mut query = two();
            change(&mut query);
            check_world_query(&query, &world).expect_err("it is bad").to_string()
        };
        for (told, expected) in [
            (with(|q| q.id = String::new()), "its id has 0 characters"),
            (with(|q| q.world = WorldReference::default()), "but this lesson is about 'w'"),
            (with(|q| q.world.hash = "other".into()), "but this lesson is about 'w'"),
            (with(|q| q.kind = 3), "its kind is 3"),
            (with(|q| q.kind = WorldQuery::ACTION), "it shows 2 trajectories; its kind shows 0"),
            (with(|q| q.state = 2), "its state 2 is out of range"),
            (with(|q| q.trajectories[1].states[1] = 2), "its state 2 is out of range"),
            (with(|q| q.trajectories[1].actions[0] = 9), "its action 9 is out of range"),
            (with(|q| q.trajectories[0].actions.clear()), "has 2 states and 0 actions"),
            (with(|q| q.trajectories[0] = WorldTrajectory { id: "a".into(), ..Default::default() }), "has 0 states"),
            (with(|q| q.trajectories[1].id = "a".into()), "the trajectory 'a' twice"),
            (with(|q| q.trajectories[0].features[0] = f64::NAN), "are not 1 finite numbers"),
            (with(|q| q.trajectories[0].features.push(0.0)), "are not 1 finite numbers"),
        ] {
            assert!(told.contains(expected), "{told}");
        }
    }
}
