//! The QoS a publisher offered, as rosbag2 keeps it: integers up to Humble, words since Jazzy; both are read.

use serde::Deserialize;

/// Most bytes of QoS text that are parsed.
const MAX_TEXT_BYTES: usize = 1 << 20;

/// Why the text of a topic's QoS cannot be used.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum QosError {
    /// Not a YAML list of profiles.
    #[error("offered_qos_profiles is not a list of QoS profiles: {0}")]
    Malformed(String),
    /// Too long to be QoS.
    #[error("offered_qos_profiles is {got} bytes long, at most {limit} are read")]
    TooLong {
        /// Its length in bytes.
        got: usize,
        /// The longest read.
        limit: usize,
    },
}

/// How many samples a publisher keeps.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum History {
    /// Whatever the middleware does.
    #[serde(alias = "0")]
    SystemDefault = 0,
    /// The last `depth`.
    #[serde(alias = "1")]
    KeepLast = 1,
    /// All of them.
    #[serde(alias = "2")]
    KeepAll = 2,
    /// Not visible over discovery; what rosbag2 itself records.
    #[serde(alias = "3")]
    Unknown = 3,
}

/// Whether samples are sent again when lost.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Reliability {
    /// Whatever the middleware does.
    #[serde(alias = "0")]
    SystemDefault = 0,
    /// Sent again.
    #[serde(alias = "1")]
    Reliable = 1,
    /// Not sent again.
    #[serde(alias = "2")]
    BestEffort = 2,
    /// Not known.
    #[serde(alias = "3")]
    Unknown = 3,
    /// The best that matches.
    #[serde(alias = "4")]
    BestAvailable = 4,
}

/// Whether late subscribers get earlier samples.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Durability {
    /// Whatever the middleware does.
    #[serde(alias = "0")]
    SystemDefault = 0,
    /// They do.
    #[serde(alias = "1")]
    TransientLocal = 1,
    /// They do not.
    #[serde(alias = "2")]
    Volatile = 2,
    /// Not known.
    #[serde(alias = "3")]
    Unknown = 3,
    /// The best that matches.
    #[serde(alias = "4")]
    BestAvailable = 4,
}

/// How a publisher says that it is alive.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Liveliness {
    /// Whatever the middleware does.
    #[serde(alias = "0")]
    SystemDefault = 0,
    /// The middleware says it.
    #[serde(alias = "1")]
    Automatic = 1,
    /// The node said it (no longer used).
    #[serde(alias = "2")]
    ManualByNode = 2,
    /// Each publisher says it.
    #[serde(alias = "3")]
    ManualByTopic = 3,
    /// Not known.
    #[serde(alias = "4")]
    Unknown = 4,
    /// The best that matches.
    #[serde(alias = "5")]
    BestAvailable = 5,
}

/// A span of time in a QoS profile.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
pub struct QosSpan {
    /// Whole seconds.
    pub sec: u64,
    /// Nanoseconds beside them.
    pub nsec: u64,
}

impl QosSpan {
    /// No limit, as rmw writes it.
    pub const INFINITE: QosSpan = QosSpan { sec: 9_223_372_036, nsec: 854_775_807 };
}

/// One publisher's QoS.
#[derive(Debug, Clone, PartialEq, Eq, Deserialize)]
pub struct OfferedQos {
    /// How many samples are kept.
    pub history: History,
    /// Samples kept with [`History::KeepLast`].
    pub depth: u64,
    /// Whether lost samples are sent again.
    pub reliability: Reliability,
    /// Whether late subscribers get earlier samples.
    pub durability: Durability,
    /// Longest time between samples.
    pub deadline: QosSpan,
    /// Age after which a sample is dropped.
    pub lifespan: QosSpan,
    /// How the publisher says that it is alive.
    pub liveliness: Liveliness,
    /// How often it must say so.
    pub liveliness_lease_duration: QosSpan,
    /// Whether the topic's DDS name lacks ROS's `rt/`.
    #[serde(default)]
    pub avoid_ros_namespace_conventions: bool,
}

impl Default for OfferedQos {
    /// Reliable, volatile, the last 10.
    fn default() -> OfferedQos {
        OfferedQos {
            history: History::KeepLast,
            depth: 10,
            reliability: Reliability::Reliable,
            durability: Durability::Volatile,
            deadline: QosSpan::INFINITE,
            lifespan: QosSpan::INFINITE,
            liveliness: Liveliness::Automatic,
            liveliness_lease_duration: QosSpan::INFINITE,
            avoid_ros_namespace_conventions: false,
        }
    }
}

impl OfferedQos {
    /// The YAML text rosbag2 up to Humble writes, which every later version reads too.
    pub fn list_to_yaml(profiles: &[OfferedQos]) -> String {
        let span = |name: &str, span: QosSpan| format!("  {name}:\n    sec: {}\n    nsec: {}\n", span.sec, span.nsec);
        let mut text = String::new();
        for qos in profiles {
            text += &format!("- history: {}\n  depth: {}\n", qos.history as u8, qos.depth);
            text += &format!("  reliability: {}\n", qos.reliability as u8);
            text += &format!("  durability: {}\n", qos.durability as u8);
            text += &span("deadline", qos.deadline);
            text += &span("lifespan", qos.lifespan);
            text += &format!("  liveliness: {}\n", qos.liveliness as u8);
            text += &span("liveliness_lease_duration", qos.liveliness_lease_duration);
            let avoid = qos.avoid_ros_namespace_conventions;
            text += &format!("  avoid_ros_namespace_conventions: {avoid}\n");
        }
        text.trim_end().to_owned()
    }

    /// Reads the text of any rosbag2; an empty text is an empty list.
    ///
    /// # Errors
    /// When it is not a YAML list of profiles, or longer than 1 MiB.
    pub fn list_from_yaml(text: &str) -> Result<Vec<OfferedQos>, QosError> {
        if text.len() > MAX_TEXT_BYTES {
            return Err(QosError::TooLong { got: text.len(), limit: MAX_TEXT_BYTES });
        }
        if text.trim().is_empty() {
            return Ok(Vec::new());
        }
        serde_saphyr::from_str(text).map_err(|error| QosError::Malformed(first_line(&error.to_string())))
    }
}

/// The first line of a longer message, so that errors stay one line.
pub(crate) fn first_line(text: &str) -> String {
    text.lines().next().unwrap_or_default().to_owned()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_written_is_read_back() {
        let latched = OfferedQos { durability: Durability::TransientLocal, depth: 1, ..OfferedQos::default() };
        let best_effort = OfferedQos { reliability: Reliability::BestEffort, ..OfferedQos::default() };
        let both = vec![latched, best_effort];
        assert_eq!(OfferedQos::list_from_yaml(&OfferedQos::list_to_yaml(&both)), Ok(both));
    }

    #[test]
    fn the_text_has_the_integers_that_humble_reads() {
        let text = OfferedQos::list_to_yaml(&[OfferedQos::default()]);
        assert!(
            text.starts_with("- history: 1\n  depth: 10\n  reliability: 1\n  durability: 2\n  deadline:\n    sec: ")
        );
        assert!(text.contains("sec: 9223372036\n    nsec: 854775807"));
    }

    #[test]
    fn the_words_of_jazzy_mean_the_same_as_the_integers_of_humble() {
        let words = "- history: unknown\n  depth: 0\n  reliability: best_effort\n  durability: transient_local\n  deadline:\n    \
                     sec: 1\n    nsec: 2\n  lifespan:\n    sec: 2147483647\n    nsec: 4294967295\n  liveliness: automatic\n  \
                     liveliness_lease_duration:\n    sec: 0\n    nsec: 0\n  avoid_ros_namespace_conventions: false";
        let integers = words
            .replace("unknown", "3")
            .replace("best_effort", "2")
            .replace("transient_local", "1")
            .replace("automatic", "1");
        let parsed = OfferedQos::list_from_yaml(words);
        assert_eq!(parsed, OfferedQos::list_from_yaml(&integers));
        let profile = &parsed.expect("both are valid")[0];
        assert_eq!(profile.reliability, Reliability::BestEffort);
        assert_eq!(profile.durability, Durability::TransientLocal);
        assert_eq!(profile.deadline, QosSpan { sec: 1, nsec: 2 });
    }

    #[test]
    fn nonsense_is_one_line_of_error() {
        let error = OfferedQos::list_from_yaml("- history: purple").expect_err("no such history").to_string();
        assert_eq!(error.lines().count(), 1);
        assert_eq!(OfferedQos::list_from_yaml(""), Ok(Vec::new()));
    }
}
