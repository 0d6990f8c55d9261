//! The state machine with a page in front of it.

use super::{bounds, lesson, plan, posterior, query, receipt, scene};
use apprentice_msgs::msg::{
    ActionDemonstration, LearnerHistory, PlacementDemonstration, QueryResponse, Retraction, RiskPreference,
    SegmentCritique, TrajectoryPreference,
};
use apprentice_msgs::visualization_msgs::{InteractiveMarker, Marker};
use operator_ui::{Event, OperatorUi, Output, Settings};
use serde_json::{Value, json};

/// The node with a clock of its own, and everything it has told the pages put together.
pub struct Table {
    pub node: OperatorUi,
    pub now_s: f64,
    pub shown: Value,
    pub refused: Vec<(Value, String)>,
    pub notices: Vec<String>,
    /// Interactive markers, as a client has them that takes every update.
    pub handles: Vec<InteractiveMarker>,
    /// The number of the last update.
    pub sequence: u64,
    /// Markers, the newest.
    pub drawn: Vec<Marker>,
}

#[derive(Default)]
pub struct Sent {
    pub demonstrations: Vec<PlacementDemonstration>,
    pub actions: Vec<ActionDemonstration>,
    pub critiques: Vec<SegmentCritique>,
    pub comparisons: Vec<TrajectoryPreference>,
    pub retractions: Vec<Retraction>,
    pub responses: Vec<QueryResponse>,
    pub preferences: Vec<RiskPreference>,
    pub histories: Vec<LearnerHistory>,
    pub reads: Vec<(String, String)>,
    pub lookups: usize,
    pub markers: usize,
}

impl Table {
    pub fn new() -> Self {
        let node = OperatorUi::new(Settings::default());
        Self {
            node,
            now_s: 100.0,
            shown: json!({}),
            refused: Vec::new(),
            notices: Vec::new(),
            handles: Vec::new(),
            sequence: 0,
            drawn: Vec::new(),
        }
    }

    /// A node that has heard everything of a revision.
    pub fn asking(revision: u64) -> Self {
        let mut table = Self::new();
        table.hear(Event::Scene(Box::new(scene("task", 0.0))));
        table.revise(revision);
        table
    }

    pub fn revise(&mut self, revision: u64) {
        let question = query(revision);
        self.hear(Event::Posterior(Box::new(posterior(revision))));
        self.hear(Event::Bounds(Box::new(bounds(revision))));
        self.hear(Event::Guess(Box::new(plan(&question.scene, &question.id, revision))));
        self.hear(Event::Query(Box::new(question)));
        self.hear(Event::Lesson(Box::new(lesson(revision))));
    }

    pub fn hear(&mut self, event: Event) -> Sent {
        let mut sent = Sent::default();
        let now = bus::Time::from_nanoseconds((self.now_s * 1e9) as i128);
        for output in self.node.step(now, event) {
            match output {
                Output::Demonstration(message) => sent.demonstrations.push(*message),
                Output::Actions(message) => sent.actions.push(*message),
                Output::Critique(message) => sent.critiques.push(*message),
                Output::Comparison(message) => sent.comparisons.push(*message),
                Output::Retraction(message) => sent.retractions.push(*message),
                Output::Response(message) => sent.responses.push(*message),
                Output::Preference(message) => sent.preferences.push(*message),
                Output::History(message) => sent.histories.push(*message),
                Output::Read { id, name } => sent.reads.push((id, name)),
                Output::LookUp => sent.lookups += 1,
                Output::Markers(message) => {
                    self.drawn = message.markers;
                    sent.markers += 1;
                }
                Output::Handles { update, all } => {
                    assert_eq!(update.seq_num, self.sequence + 1, "a client would begin anew");
                    assert!(!update.server_id.is_empty());
                    self.sequence = update.seq_num;
                    self.handles.retain(|marker| !update.erases.contains(&marker.name));
                    for marker in update.markers {
                        match self.handles.iter_mut().find(|known| known.name == marker.name) {
                            Some(known) => *known = marker,
                            None => self.handles.push(marker),
                        }
                    }
                    assert_eq!(self.handles.len(), all.len(), "who comes late has what the others have");
                    assert!(all.iter().all(|marker| self.handles.contains(marker)));
                }
                Output::Warn(_) => {}
                Output::Told(told) => {
                    let value: Value = serde_json::from_str(&told.text).expect("pages get JSON");
                    match value["type"].as_str().expect("every text has a type") {
                        "state" => {
                            for (name, section) in value["sections"].as_object().expect("sections are an object") {
                                self.shown[name] = section.clone();
                            }
                        }
                        "refused" => {
                            self.refused
                                .push((value["id"].clone(), value["reason"].as_str().unwrap_or_default().into()));
                        }
                        "notice" => self.notices.push(value["text"].as_str().unwrap_or_default().into()),
                        "tick" => {}
                        other => panic!("pages know no '{other}'"),
                    }
                }
            }
        }
        sent
    }

    pub fn say(&mut self, command: &Value) -> Sent {
        self.hear(Event::Said(0, command.to_string()))
    }

    pub fn wait(&mut self, seconds: f64) -> Sent {
        self.now_s += seconds;
        self.hear(Event::Tick)
    }

    pub fn receive(&mut self, id: &str, outcome: u8, revision: u64) -> Sent {
        self.hear(Event::Receipt(Box::new(receipt(id, outcome, revision))))
    }

    pub fn answer(&self, id: &str) -> &Value {
        let answers = self.shown["answers"].as_array().expect("answers were shown");
        answers.iter().find(|answer| answer["id"] == id).expect("the answer is shown")
    }

    pub fn is_open(&self) -> bool {
        self.shown["question"]["open"] == true
    }
}
