//! What a bag holds: topics, messages, attachments and metadata records.

use std::collections::BTreeMap;
use std::sync::Arc;

use crate::{OfferedQos, QosError};

/// Channel metadata key under which rosbag2 keeps the publishers' QoS.
const QOS_KEY: &str = "offered_qos_profiles";

/// One topic of a bag, as its channel and schema describe it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Topic {
    /// Fully qualified ROS name, such as `/apprentice/posterior`.
    pub name: String,
    /// `pkg/msg/Name`; the schema's name.
    pub type_name: String,
    /// How messages are encoded; `cdr` in ROS 2 bags.
    pub message_encoding: String,
    /// How the schema is written; `ros2msg` or `ros2idl` in ROS 2 bags, empty where the bag has no schema.
    pub schema_encoding: String,
    /// The schema; for `ros2msg` the text of the type and of every type it needs.
    pub schema: Vec<u8>,
    /// The channel's metadata, QoS among them.
    pub metadata: BTreeMap<String, String>,
}

impl Topic {
    /// A topic as rosbag2 records it: CDR messages, `ros2msg` schema, QoS of each publisher.
    pub fn ros2(name: &str, type_name: &str, schema_text: &str, qos: &[OfferedQos]) -> Topic {
        Topic {
            name: name.to_owned(),
            type_name: type_name.to_owned(),
            message_encoding: "cdr".to_owned(),
            schema_encoding: "ros2msg".to_owned(),
            schema: schema_text.as_bytes().to_vec(),
            metadata: BTreeMap::from([(QOS_KEY.to_owned(), OfferedQos::list_to_yaml(qos))]),
        }
    }

    /// The QoS text as it is in the bag; empty where the bag has none.
    pub fn offered_qos_text(&self) -> &str {
        self.metadata.get(QOS_KEY).map_or("", String::as_str)
    }

    /// QoS of each publisher when the bag was recorded; empty where the bag does not say.
    ///
    /// # Errors
    /// When the text in the bag is not a list of QoS profiles.
    pub fn offered_qos(&self) -> Result<Vec<OfferedQos>, QosError> {
        OfferedQos::list_from_yaml(self.offered_qos_text())
    }
}

/// One recorded message.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Message {
    /// The topic it was on.
    pub topic: Arc<Topic>,
    /// When it was received, in ns.
    pub log_time: u64,
    /// When it was published, in ns.
    pub publish_time: u64,
    /// Number within its topic, as the writer counted.
    pub sequence: u32,
    /// CDR with its 4-byte header.
    pub data: Vec<u8>,
}

/// A named file inside a bag, such as the robot's URDF.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Attachment {
    /// When it was added, in ns.
    pub log_time: u64,
    /// When it was created, in ns; 0 where that is not known.
    pub create_time: u64,
    /// Its file name, such as `robot.urdf`. Never to be used as a path without checking it.
    pub name: String,
    /// MIME type.
    pub media_type: String,
    /// Its bytes.
    pub data: Vec<u8>,
}

/// Named strings inside a bag, such as the version that recorded it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct MetadataRecord {
    /// What it is about.
    pub name: String,
    /// Its entries.
    pub values: BTreeMap<String, String>,
}
