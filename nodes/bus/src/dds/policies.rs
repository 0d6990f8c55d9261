//! Quality of service in RustDDS's words.

use ros2_client::dds::rustdds::{
    Duration as DdsDuration, QosPolicies, QosPolicyBuilder, Timestamp,
    policy::{Deadline, Durability as DdsDurability, History, Lifespan, Liveliness, Reliability as DdsReliability},
};

use apprentice_msgs::builtin_interfaces::Time;

use crate::{
    clock,
    qos::{Durability, QosProfile, Reliability},
};

/// How long a reliable write waits for readers that lag, before the sample is given up.
const MAX_BLOCKING: DdsDuration = DdsDuration::from_millis(2000);

/// Samples that a reader keeps when the profile does not say how many.
const UNKNOWN_DEPTH: usize = 1000;

/// What a writer offers.
pub(crate) fn for_writer(profile: &QosProfile) -> QosPolicies {
    build(profile, profile.depth.max(1))
}

/// What a reader asks for. Never `KeepAll`: RustDDS then keeps 64 samples only, and loses the rest of a burst.
pub(crate) fn for_reader(profile: &QosProfile) -> QosPolicies {
    match profile.depth {
        0 => build(profile, UNKNOWN_DEPTH),
        depth => build(profile, depth),
    }
}

/// The policies with a depth.
fn build(profile: &QosProfile, depth: usize) -> QosPolicies {
    let mut policies = QosPolicyBuilder::new()
        .durability(match profile.durability {
            Durability::Volatile => DdsDurability::Volatile,
            Durability::TransientLocal => DdsDurability::TransientLocal,
        })
        .reliability(match profile.reliability {
            Reliability::BestEffort => DdsReliability::BestEffort,
            Reliability::Reliable => DdsReliability::Reliable { max_blocking_time: MAX_BLOCKING },
        })
        .history(History::KeepLast { depth: i32::try_from(depth).unwrap_or(i32::MAX) });
    if let Some(deadline) = profile.deadline {
        policies = policies.deadline(Deadline(DdsDuration::from_std(deadline)));
    }
    if let Some(lifespan) = profile.lifespan {
        policies = policies.lifespan(Lifespan { duration: DdsDuration::from_std(lifespan) });
    }
    if let Some(lease) = profile.liveliness_lease {
        policies = policies.liveliness(Liveliness::Automatic { lease_duration: DdsDuration::from_std(lease) });
    }
    policies.build()
}

/// A profile from what discovery tells; `depth` is 0 because discovery does not tell it.
pub(crate) fn to_profile(policies: &QosPolicies) -> QosProfile {
    let finite = |duration: DdsDuration| {
        (duration != DdsDuration::INFINITE && duration != DdsDuration::ZERO).then(|| duration.to_std())
    };
    QosProfile {
        reliability: match policies.reliability() {
            Some(DdsReliability::Reliable { .. }) => Reliability::Reliable,
            _ => Reliability::BestEffort,
        },
        durability: match policies.durability() {
            None | Some(DdsDurability::Volatile) => Durability::Volatile,
            Some(_) => Durability::TransientLocal,
        },
        depth: match policies.history() {
            Some(History::KeepLast { depth }) => usize::try_from(depth).unwrap_or(0),
            _ => 0,
        },
        deadline: policies.deadline().and_then(|deadline| finite(deadline.0)),
        lifespan: policies.lifespan().and_then(|lifespan| finite(lifespan.duration)),
        liveliness_lease: policies.liveliness().and_then(|liveliness| finite(liveliness.duration())),
    }
}

/// A message's time from DDS's; `None` for DDS's marks of "no time".
pub(crate) fn to_time(timestamp: Timestamp) -> Option<Time> {
    if timestamp == Timestamp::INVALID || timestamp == Timestamp::INFINITE {
        return None;
    }
    let ticks = timestamp.to_ticks();
    let seconds = i64::try_from(ticks >> 32).ok()?;
    // Ticks are 2^-32 s; rounded to the nearest nanosecond.
    let nanoseconds = ((ticks & 0xffff_ffff) * 1_000_000_000 + (1 << 31)) >> 32;
    Some(clock::to_time(seconds * 1_000_000_000 + i64::try_from(nanoseconds).ok()?))
}

#[cfg(test)]
mod tests {
    use crate::qos::Qos;

    use super::*;

    #[test]
    fn profiles_survive_the_way_through_dds() {
        for qos in [Qos::Stream, Qos::Event, Qos::State, Qos::Log] {
            let profile = qos.profile();
            assert_eq!(to_profile(&for_writer(&profile)), profile);
        }
    }

    #[test]
    fn readers_never_keep_all() {
        for qos in [Qos::Stream, Qos::Event, Qos::State, Qos::Log] {
            assert!(matches!(
                for_reader(&qos.profile()).history(),
                Some(History::KeepLast { depth }) if depth >= 1
            ));
        }
        let unknown = QosProfile::new(Reliability::Reliable, Durability::Volatile, 0);
        assert_eq!(to_profile(&for_reader(&unknown)).depth, UNKNOWN_DEPTH);
    }

    #[test]
    fn times_to_the_nanosecond() {
        let half = Timestamp::from_ticks((5 << 32) | (1 << 31));
        assert_eq!(to_time(half), Some(Time { sec: 5, nanosec: 500_000_000 }));
        assert_eq!(to_time(Timestamp::INVALID), None);
    }
}
