//! The message in which a participant says which nodes it holds and which endpoints are theirs.
//!
//! `rmw_dds_common/msg/ParticipantEntitiesInfo`, with the 16-byte identities of ROS 2 Iron and later.

use serde::{Deserialize, Serialize};

use crate::dds::discovery::Gid;

/// The topic on DDS.
pub(crate) const TOPIC: &str = "ros_discovery_info";

/// The type on DDS.
pub(crate) const TYPE: &str = "rmw_dds_common::msg::dds_::ParticipantEntitiesInfo_";

/// One participant.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub(crate) struct ParticipantInfo {
    /// The participant's identity.
    pub(crate) gid: Gid,
    /// The nodes that it holds.
    pub(crate) nodes: Vec<NodeInfo>,
}

/// One node.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub(crate) struct NodeInfo {
    /// Absolute namespace.
    pub(crate) namespace: String,
    /// Base name.
    pub(crate) name: String,
    /// Its readers.
    pub(crate) readers: Vec<Gid>,
    /// Its writers.
    pub(crate) writers: Vec<Gid>,
}

impl NodeInfo {
    /// The fully qualified name.
    pub(crate) fn full_name(&self) -> String {
        format!("{}/{}", self.namespace.trim_end_matches('/'), self.name)
    }

    /// Whether an endpoint is this node's.
    pub(crate) fn owns(&self, gid: Gid) -> bool {
        self.readers.contains(&gid) || self.writers.contains(&gid)
    }
}
