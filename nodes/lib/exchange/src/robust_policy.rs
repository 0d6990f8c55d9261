//! Robust policies and what is said about them, checked; and the demonstrations that regret is measured against.

use crate::in_force;
use crate::text::{TextError, check_id};
use apprentice_msgs::msg::{ActionDemonstration, EvidenceLog, RiskPreference, RobustPolicy};
use thiserror::Error;

/// Id of the robust policy in the sets that `policy_optimizer` has judged.
pub const ROBUST_POLICY: &str = "robust";

/// Id of the set with the robust policy of a revision and a preference.
pub fn robust_set_id(revision: u64, preference_number: u64) -> String {
    format!("robust-{revision}-{preference_number}")
}

/// Why a preference between the mean and the worst case cannot be taken.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum PreferenceError {
    /// An id.
    #[error(transparent)]
    Text(#[from] TextError),
    /// Preferences count from 1: 0 stands for the parameter.
    #[error("its number is 0; preferences count 1, 2, …")]
    Number,
    /// λ is a share.
    #[error("its lambda is {got}; a number from 0 (only the worst case counts) to 1 (only the mean counts) is needed")]
    Lambda {
        /// Got.
        got: f64,
    },
}

/// Refuses a preference that cannot be taken.
///
/// # Errors
/// The first thing wrong with it.
pub fn check_preference_of_risk(message: &RiskPreference) -> Result<(), PreferenceError> {
    check_id("its id", &message.id)?;
    if message.number == 0 {
        return Err(PreferenceError::Number);
    }
    if !(0.0..=1.0).contains(&message.lambda) {
        return Err(PreferenceError::Lambda { got: message.lambda });
    }
    Ok(())
}

/// Why a robust policy cannot be used.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum RobustPolicyError {
    /// A table of another size.
    #[error("it has {got} probabilities and {visits} visits for {n_states} states of {n_actions} actions")]
    Size {
        /// Probabilities.
        got: usize,
        /// Visits.
        visits: usize,
        /// States.
        n_states: u32,
        /// Actions.
        n_actions: u32,
    },
    /// No probability.
    #[error("probability {index} is {got}")]
    Probability {
        /// Its place.
        index: usize,
        /// Got.
        got: f64,
    },
}

/// Refuses a robust policy whose table does not fit its own sizes; one without a table is good.
///
/// # Errors
/// The first thing wrong with it.
pub fn check_robust_policy(message: &RobustPolicy) -> Result<(), RobustPolicyError> {
    let RobustPolicy { action_probabilities: table, visits, n_states, n_actions, .. } = message;
    let (n_states, n_actions) = (*n_states, *n_actions);
    let cells = u64::from(n_states) * u64::from(n_actions);
    let fits = table.len() as u64 == cells && visits.len() as u64 == u64::from(n_states);
    let is_absent = table.is_empty() && visits.is_empty();
    if !(fits || is_absent) {
        return Err(RobustPolicyError::Size { got: table.len(), visits: visits.len(), n_states, n_actions });
    }
    match table.iter().position(|p| !(0.0..=1.0).contains(p)) {
        Some(index) => Err(RobustPolicyError::Probability { index, got: table[index] }),
        None => Ok(()),
    }
}

/// The action demonstrations about a world that are in force at a revision, in accepted order. None until the log holds all
/// that the revision takes in.
pub fn demonstrations_in_force<'a>(
    log: &'a EvidenceLog,
    revision: u64,
    world_id: &str,
) -> Option<Vec<&'a ActionDemonstration>> {
    let records = log.records.get(..usize::try_from(revision).ok()?)?;
    let shown = in_force(records).flat_map(|record| &record.actions);
    Some(shown.filter(|shown| shown.world_id == world_id).collect())
}

#[cfg(test)]
mod tests {
    use super::{check_preference_of_risk, check_robust_policy, demonstrations_in_force};
    use apprentice_msgs::msg::{
        ActionDemonstration, EvidenceLog, EvidenceRecord, Retraction, RiskPreference, RobustPolicy,
    };

    fn shown(sequence: u64, world_id: &str) -> EvidenceRecord {
        let id = format!("a{sequence}");
        let actions = ActionDemonstration { id, world_id: world_id.into(), ..ActionDemonstration::default() };
        EvidenceRecord { sequence, actions: vec![actions], ..EvidenceRecord::default() }
    }

    fn undone(sequence: u64, evidence_id: &str) -> EvidenceRecord {
        let id = format!("r{sequence}");
        let retraction = Retraction { id, evidence_id: evidence_id.into(), ..Retraction::default() };
        EvidenceRecord { sequence, retraction: vec![retraction], ..EvidenceRecord::default() }
    }

    #[test]
    fn demonstrations_are_those_in_force_at_the_revision_and_no_later() {
        let records = vec![shown(1, "w"), shown(2, "v"), shown(3, "w"), undone(4, "a1")];
        let log = EvidenceLog { records, ..EvidenceLog::default() };
        let ids = |revision: u64| -> Option<Vec<&str>> {
            let found = demonstrations_in_force(&log, revision, "w")?;
            Some(found.into_iter().map(|shown| shown.id.as_str()).collect())
        };
        assert_eq!(ids(0), Some(vec![]));
        assert_eq!(ids(3), Some(vec!["a1", "a3"]));
        assert_eq!(ids(4), Some(vec!["a3"]));
        assert_eq!(ids(5), None, "the log is older than the posterior");
    }

    #[test]
    fn preferences_and_policies_that_cannot_be_used_are_told() {
        let good = RiskPreference { id: "p".into(), number: 1, lambda: 0.25, ..RiskPreference::default() };
        assert_eq!(check_preference_of_risk(&good), Ok(()));
        let told = |message: RiskPreference| check_preference_of_risk(&message).expect_err("bad").to_string();
        assert!(told(RiskPreference { id: String::new(), ..good.clone() }).contains("its id has 0 characters"));
        assert!(told(RiskPreference { number: 0, ..good.clone() }).contains("its number is 0"));
        for lambda in [-0.1, 1.1, f64::NAN, f64::INFINITY] {
            assert!(told(RiskPreference { lambda, ..good.clone() }).contains("its lambda is"));
        }
        let none = RobustPolicy { n_states: 2, n_actions: 2, ..RobustPolicy::default() };
        assert_eq!(check_robust_policy(&none), Ok(()));
        let whole =
            RobustPolicy { action_probabilities: vec![1.0, 0.0, 0.5, 0.5], visits: vec![1.0, 2.0], ..none.clone() };
        assert_eq!(check_robust_policy(&whole), Ok(()));
        for bad in [
            RobustPolicy { visits: vec![1.0], ..whole.clone() },
            RobustPolicy { n_states: u32::MAX, ..whole.clone() },
            RobustPolicy { action_probabilities: vec![1.0, 0.0, f64::NAN, 0.5], ..whole.clone() },
            RobustPolicy { action_probabilities: vec![1.0, 0.0, 1.5, 0.5], ..whole.clone() },
        ] {
            assert!(check_robust_policy(&bad).is_err(), "{bad:?}");
        }
    }
}
