//! The QoS to play a topic with, from the publishers' QoS in the bag.

use bag::{Durability, OfferedQos, Reliability, Topic};
use bus::QosProfile;

/// Depth where the bag does not tell: late subscriptions to a latched topic then get what the bag has, and those that
/// ask for less get less.
const UNKNOWN_DEPTH: usize = 1_000;
/// Deepest history that is kept for late subscriptions.
const MAX_DEPTH: usize = 10_000;

/// A profile that every subscription of the recorded session would have matched: reliable or transient local as soon as
/// one publisher was, with the deepest history. Reliable and volatile where the bag says nothing.
///
/// The second value says what is wrong with the QoS in the bag, if anything is.
pub fn replay_qos(topic: &Topic) -> (QosProfile, Option<String>) {
    let (offered, problem) = match topic.offered_qos() {
        Ok(offered) => (offered, None),
        Err(error) => (Vec::new(), Some(error.to_string())),
    };
    (strongest(&offered), problem)
}

fn strongest(offered: &[OfferedQos]) -> QosProfile {
    let best_effort = |qos: &OfferedQos| qos.reliability == Reliability::BestEffort;
    let reliability = if !offered.is_empty() && offered.iter().all(best_effort) {
        bus::Reliability::BestEffort
    } else {
        bus::Reliability::Reliable
    };
    let latched = |qos: &OfferedQos| qos.durability == Durability::TransientLocal;
    let durability =
        if offered.iter().any(latched) { bus::Durability::TransientLocal } else { bus::Durability::Volatile };
    let depths = offered.iter().filter_map(|qos| usize::try_from(qos.depth).ok());
    let depth = match depths.max() {
        None | Some(0) => UNKNOWN_DEPTH,
        // A volatile burst must not be cut off by the depth of the recorded publisher, as everything comes from one.
        Some(depth) if durability == bus::Durability::Volatile => depth.clamp(UNKNOWN_DEPTH, MAX_DEPTH),
        Some(depth) => depth.min(MAX_DEPTH),
    };
    QosProfile::new(reliability, durability, depth)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn profile(reliability: Reliability, durability: Durability, depth: u64) -> OfferedQos {
        OfferedQos { reliability, durability, depth, ..OfferedQos::default() }
    }

    #[test]
    fn a_latched_topic_is_latched_again() {
        let topic = Topic::ros2("/t", "a/msg/B", "", &[profile(Reliability::Reliable, Durability::TransientLocal, 1)]);
        let expected = QosProfile::new(bus::Reliability::Reliable, bus::Durability::TransientLocal, 1);
        assert_eq!(replay_qos(&topic), (expected, None));
    }

    #[test]
    fn one_reliable_publisher_among_best_effort_ones_makes_the_replay_reliable() {
        let best_effort = profile(Reliability::BestEffort, Durability::Volatile, 5);
        let reliable = profile(Reliability::Reliable, Durability::Volatile, 5);
        assert_eq!(strongest(std::slice::from_ref(&best_effort)).reliability, bus::Reliability::BestEffort);
        assert_eq!(strongest(&[best_effort, reliable]).reliability, bus::Reliability::Reliable);
    }

    #[test]
    fn qos_that_cannot_be_read_is_told_and_played_reliable() {
        let mut topic = Topic::ros2("/t", "a/msg/B", "", &[]);
        topic.metadata.insert("offered_qos_profiles".to_owned(), "- purple".to_owned());
        let (qos, problem) = replay_qos(&topic);
        assert_eq!(qos.reliability, bus::Reliability::Reliable);
        assert!(problem.is_some_and(|problem| problem.contains("offered_qos_profiles")));
    }
}
