//! Why a session cannot be replayed.

use thiserror::Error;

/// Why a session cannot be replayed.
#[derive(Debug, Error)]
pub enum ReplayError {
    /// The bag cannot be opened or read.
    #[error(transparent)]
    Bag(#[from] bag_files::BagFilesError),
    /// The bag is of something else, or the evidence was not recorded.
    #[error("the bag holds no accepted evidence (type {0}); was `evidence` recorded?")]
    NoEvidence(&'static str),
    /// Two suites at once.
    #[error("the bag holds several sessions, in the namespaces {0:?}; choose one with --namespace")]
    SeveralSessions(Vec<String>),
    /// A message on a topic of ours that does not decode.
    #[error("message {index} of topic '{topic}' cannot be read as {type_name}: {source}")]
    Malformed {
        /// Topic.
        topic: String,
        /// Its type.
        type_name: &'static str,
        /// Number of the message within the bag.
        index: usize,
        /// What the decoder says.
        source: apprentice_msgs::CdrError,
    },
    /// Two recorded logs of evidence contradict each other.
    #[error("the recorded logs of evidence contradict each other at record {sequence}")]
    TwoHistories {
        /// First record in which they differ; 0: the task.
        sequence: u64,
    },
    /// A record is missing.
    #[error("the log of evidence jumps from record {before} to {after}")]
    Gap {
        /// Last record before the gap.
        before: u64,
        /// First after it.
        after: u64,
    },
    /// The world that evidence is about was not recorded.
    #[error("the world '{id}' of the evidence is not in the bag; was `lesson_world` recorded?")]
    NoWorld {
        /// Its id.
        id: String,
    },
    /// What a policy was chosen by was not recorded.
    #[error("the preference '{id}' that a policy names is not in the bag; was `risk_preference` recorded?")]
    NoPreference {
        /// Its id.
        id: String,
    },
    /// The node's parameters were not recorded.
    #[error("the settings of {0} are not in the bag; was `settings` recorded?")]
    NoSettings(&'static str),
    /// A node was restarted with other parameters within the session.
    #[error("{node} ran with different settings within the session; such a session cannot be replayed")]
    TwoSettings {
        /// The node.
        node: String,
    },
    /// The recorded parameters do not fit this version.
    #[error("the recorded settings of {node} (version {version}) do not fit this version: {reason}")]
    Settings {
        /// The node.
        node: &'static str,
        /// Version that recorded.
        version: String,
        /// What does not fit.
        reason: String,
    },
    /// A node could not compute.
    #[error("revision {revision} cannot be computed: {reason}")]
    Compute {
        /// Which revision.
        revision: u64,
        /// What the node says.
        reason: String,
    },
}
