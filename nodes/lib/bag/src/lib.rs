//! Bags as rosbag2 writes them: MCAP files and `metadata.yaml`, over `Read` and `Write`, without files or clocks.
//!
//! Times are nanoseconds since the Unix epoch (or since the start of simulated time). Message bytes are CDR with the
//! 4-byte encapsulation header, exactly as they travelled.

mod bytes;
mod chunk;
mod compression;
mod contents;
mod damage;
mod error;
mod filter;
mod limits;
mod messages;
mod metadata;
mod metadata_yaml;
mod qos;
mod reader;
mod record;
mod recover;
mod scan;
mod summary;
mod table;
mod topic;
mod writer;

pub use compression::Compression;
pub use contents::{Contents, TopicContents};
pub use damage::Damage;
pub use error::BagError;
pub use filter::{FilterError, TopicFilter};
pub use limits::Limits;
pub use messages::Messages;
pub use metadata::{BagMetadata, FileMetadata, MetadataError, TopicMetadata};
pub use qos::{Durability, History, Liveliness, OfferedQos, QosError, QosSpan, Reliability};
pub use reader::BagReader;
pub use recover::{RecoverReport, recover};
pub use topic::{Attachment, Message, MetadataRecord, Topic};
pub use writer::{BagWriter, TopicId, WriterOptions};
