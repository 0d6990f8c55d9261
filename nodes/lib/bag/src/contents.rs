//! What is in a bag: topics, counts and times.

use std::sync::Arc;

use crate::Topic;

/// How much of one topic is in a bag.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct TopicContents {
    /// The topic.
    pub topic: Arc<Topic>,
    /// Its messages.
    pub message_count: u64,
}

/// What is in one file.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Contents {
    /// Profile of the file; `ros2` for ROS 2 bags.
    pub profile: String,
    /// What wrote the file.
    pub library: String,
    /// Topics with their counts, by name. Channels that share a topic are joined.
    pub topics: Vec<TopicContents>,
    /// All messages.
    pub message_count: u64,
    /// Log time of the first message in ns; `None` without messages.
    pub start: Option<u64>,
    /// Log time of the last message in ns; `None` without messages.
    pub end: Option<u64>,
    /// Number of attachments.
    pub attachment_count: u64,
}

impl Contents {
    /// From first to last message, in ns; 0 without messages.
    pub fn duration(&self) -> u64 {
        match (self.start, self.end) {
            (Some(start), Some(end)) => end.saturating_sub(start),
            _ => 0,
        }
    }

    /// Adds a channel's count, joining channels of the same topic, and keeps the topics sorted by name.
    pub(crate) fn add_topic(&mut self, topic: &Arc<Topic>, message_count: u64) {
        match self.topics.binary_search_by(|known| known.topic.name.cmp(&topic.name)) {
            Ok(at) => self.topics[at].message_count = self.topics[at].message_count.saturating_add(message_count),
            Err(at) => self.topics.insert(at, TopicContents { topic: Arc::clone(topic), message_count }),
        }
    }
}
