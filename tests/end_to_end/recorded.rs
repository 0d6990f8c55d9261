//! What a bag holds, decoded.

use apprentice_msgs::msg::{EvidenceLog, PlacementDemonstration, TrajectoryPreference};
use apprentice_msgs::{Message, from_cdr, to_cdr};
use std::path::Path;

/// Every message of a bag, in the order of recording.
pub struct Recorded {
    pub messages: Vec<bag::Message>,
    /// Whether every file was finished and is whole.
    pub whole: bool,
}

impl Recorded {
    /// Reads a bag, which may still be growing.
    pub fn read(path: &Path) -> Result<Recorded, bag_files::BagFilesError> {
        let bag = bag_files::open_bag(path)?;
        let whole = bag.damage().next().is_none();
        Ok(Recorded { messages: bag.messages().collect::<Result<Vec<_>, _>>()?, whole })
    }

    /// The messages of one topic of the lesson, such as `posterior`, with their log times in ns.
    pub fn timed<M: Message>(&self, topic: &str) -> Vec<(u64, M)> {
        let name = format!("/apprentice/{topic}");
        let of_topic = self.messages.iter().filter(|message| message.topic.name == name);
        of_topic
            .map(|message| (message.log_time, from_cdr(&message.data).expect("what was recorded is whole")))
            .collect()
    }

    /// The same without times, and each content once: nodes say things again.
    pub fn distinct<M: Message>(&self, topic: &str) -> Vec<M> {
        let mut seen = std::collections::HashSet::new();
        let all = self.timed::<M>(topic).into_iter().map(|(_, message)| message);
        all.filter(|message| seen.insert(to_cdr(message))).collect()
    }

    /// Ids of everything accepted, by the newest log of evidence.
    pub fn accepted(&self) -> Vec<String> {
        self.timed::<EvidenceLog>("evidence").last().map(|(_, log)| ids(log)).unwrap_or_default()
    }

    /// Ids of all placements and comparisons that were sent, sorted.
    pub fn answers(&self) -> Vec<String> {
        let places = self.distinct::<PlacementDemonstration>("demonstration").into_iter().map(|d| d.id);
        let choices = self.distinct::<TrajectoryPreference>("preference").into_iter().map(|p| p.id);
        let mut all: Vec<String> = places.chain(choices).collect();
        all.sort();
        all
    }
}

/// The ids of a log's events, in order.
pub fn ids(log: &EvidenceLog) -> Vec<String> {
    log.records.iter().map(|record| exchange::record_id(record).to_owned()).collect()
}
