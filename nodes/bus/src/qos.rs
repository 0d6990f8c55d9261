//! Quality of service: the profiles of this project's topics and the general form.

use std::time::Duration;

/// Whether lost samples are sent again.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Reliability {
    /// They are not.
    BestEffort,
    /// They are.
    Reliable,
}

/// Whether late joiners get earlier samples.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Durability {
    /// They get none.
    Volatile,
    /// They get the last `depth` from each publisher that lives.
    TransientLocal,
}

/// A quality-of-service profile.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub struct QosProfile {
    /// Whether lost samples are sent again.
    pub reliability: Reliability,
    /// Whether late joiners get earlier samples.
    pub durability: Durability,
    /// How many samples are kept; 0 when discovery does not tell (DDS does not announce it).
    pub depth: usize,
    /// Longest promised time between samples; `None`: no promise.
    pub deadline: Option<Duration>,
    /// How long a sample stays valid; `None`: for ever.
    pub lifespan: Option<Duration>,
    /// How long a silent publisher counts as alive; `None`: for ever.
    pub liveliness_lease: Option<Duration>,
}

impl QosProfile {
    /// A profile without deadline, lifespan and lease.
    pub const fn new(reliability: Reliability, durability: Durability, depth: usize) -> QosProfile {
        QosProfile { reliability, durability, depth, deadline: None, lifespan: None, liveliness_lease: None }
    }

    /// Whether a subscription that asks for `self` is served by a publisher that offers `offered`.
    pub fn accepts(&self, offered: &QosProfile) -> bool {
        self.incompatibility(offered).is_none()
    }

    /// Which policy of `offered` is less than `self` asks for.
    pub fn incompatibility(&self, offered: &QosProfile) -> Option<&'static str> {
        if self.reliability > offered.reliability {
            return Some("reliability");
        }
        if self.durability > offered.durability {
            return Some("durability");
        }
        match (self.deadline, offered.deadline) {
            (Some(asked), Some(offered)) if asked < offered => Some("deadline"),
            (Some(_), None) => Some("deadline"),
            _ => None,
        }
    }
}

/// The kinds of topics of this project.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Qos {
    /// A stream of samples of which only the newest matter: best effort, volatile, depth 10.
    Stream,
    /// Things that happen: reliable, volatile, depth 1000.
    Event,
    /// The latest state: reliable, transient local, depth 1. Over DDS a late joiner may get a few older samples
    /// (of the last six seconds) before the newest one.
    State,
    /// A log for late joiners: reliable, transient local, depth 1000.
    Log,
    /// Anything else.
    Custom(QosProfile),
}

impl Qos {
    /// The profile.
    pub fn profile(&self) -> QosProfile {
        use Durability::{TransientLocal, Volatile};
        use Reliability::{BestEffort, Reliable};
        match self {
            Qos::Stream => QosProfile::new(BestEffort, Volatile, 10),
            Qos::Event => QosProfile::new(Reliable, Volatile, 1000),
            Qos::State => QosProfile::new(Reliable, TransientLocal, 1),
            Qos::Log => QosProfile::new(Reliable, TransientLocal, 1000),
            Qos::Custom(profile) => profile.clone(),
        }
    }
}
