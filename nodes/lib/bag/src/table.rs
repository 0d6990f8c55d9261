//! The channels and schemas of one file, by number.

use std::collections::BTreeMap;
use std::sync::Arc;

use crate::Topic;
use crate::record::{Channel, Schema};

/// Channels joined to their schemas. The first description of a number wins, as MCAP forbids a second that differs.
#[derive(Debug, Default)]
pub(crate) struct Table {
    schemas: BTreeMap<u16, Schema>,
    topics: BTreeMap<u16, Arc<Topic>>,
}

impl Table {
    pub(crate) fn add_schema(&mut self, schema: Schema) {
        self.schemas.entry(schema.id).or_insert(schema);
    }

    /// Adds a channel; without a described schema its type is empty.
    pub(crate) fn add_channel(&mut self, channel: Channel) {
        let schema = self.schemas.get(&channel.schema);
        self.topics.entry(channel.id).or_insert_with(|| {
            Arc::new(Topic {
                name: channel.topic,
                type_name: schema.map(|s| s.name.clone()).unwrap_or_default(),
                message_encoding: channel.message_encoding,
                schema_encoding: schema.map(|s| s.encoding.clone()).unwrap_or_default(),
                schema: schema.map(|s| s.data.clone()).unwrap_or_default(),
                metadata: channel.metadata,
            })
        });
    }

    pub(crate) fn topic(&self, channel: u16) -> Option<&Arc<Topic>> {
        self.topics.get(&channel)
    }

    /// Channel numbers and topics in the order of the numbers.
    pub(crate) fn topics(&self) -> impl Iterator<Item = (u16, &Arc<Topic>)> {
        self.topics.iter().map(|(id, topic)| (*id, topic))
    }
}
