//! The node as a pure state machine: questions and worlds in, answers and walks out, each repeated until its receipt comes.

use crate::teaching::Teaching;
use crate::{Answer, Comparison, Person, Piece, Settings, answer_id};
use apprentice_msgs::builtin_interfaces::Time;
use apprentice_msgs::geometry_msgs;
use apprentice_msgs::msg::{
    ActionDemonstration, EvidenceReceipt, LessonStatus, PlacementDemonstration, PlacementQuery, QueryResponse,
    SegmentCritique, TabularWorld, TrajectoryPreference, WorldQuery,
};
use apprentice_msgs::std_msgs::Header;
use exchange::MAX_ID;
use scene::Point;

/// Most answers waiting for a receipt; beyond it the oldest is dropped, which only its asker could have wanted.
pub const MAX_PENDING: usize = 64;

/// What the node takes.
#[derive(Debug, Clone, PartialEq)]
pub enum Event {
    /// A question, perhaps one seen before.
    Query(Box<PlacementQuery>),
    /// A question about a world, perhaps one seen before.
    WorldQuery(Box<WorldQuery>),
    /// What became of a piece of evidence, perhaps somebody else's.
    Receipt(EvidenceReceipt),
    /// A world to teach in.
    World(Box<TabularWorld>),
    /// Where the lesson stands.
    Lesson(Box<LessonStatus>),
    /// Time passed.
    Tick,
}

/// What the node gives.
#[derive(Debug, Clone, PartialEq)]
pub enum Output {
    /// An answer that is a placement.
    Demonstration(Box<PlacementDemonstration>),
    /// An answer that is not.
    Response(QueryResponse),
    /// What to do in a world.
    Actions(Box<ActionDemonstration>),
    /// Which of two walks or places is better.
    Preference(Box<TrajectoryPreference>),
    /// What is good and what is bad in a walk.
    Critique(Box<SegmentCritique>),
    /// Something for the log.
    Warning(String),
}

/// The simulated person on the graph.
#[derive(Debug)]
pub struct DemonstratorNode {
    person: Person,
    source: String,
    seed: u64,
    delay_ns: i128,
    period_ns: i128,
    pending: Vec<Pending>,
    /// Ids of the latest questions that were dealt with, oldest first.
    settled: Vec<String>,
    warned_features: bool,
    teaching: Teaching,
}

#[derive(Debug)]
struct Pending {
    id: String,
    query_id: String,
    message: Output,
    due_ns: i128,
    sent: bool,
}

impl DemonstratorNode {
    /// A person who has heard no question yet.
    pub fn new(settings: &Settings) -> Self {
        let nanoseconds = |seconds: f64| (seconds * 1e9) as i128;
        Self {
            person: Person::new(settings),
            source: settings.source.clone(),
            seed: bus::NodeSettings::seed(settings),
            delay_ns: nanoseconds(settings.response_delay_s),
            period_ns: nanoseconds(settings.republish_period_s),
            pending: Vec::new(),
            settled: Vec::new(),
            warned_features: false,
            teaching: Teaching::new(settings),
        }
    }

    /// Answers waiting for a receipt.
    pub fn n_pending(&self) -> usize {
        self.pending.len()
    }

    /// Takes one event; `now` stamps new answers and paces repetitions.
    pub fn step(&mut self, now: Time, event: Event) -> Vec<Output> {
        let mut outputs = Vec::new();
        match event {
            Event::Query(query) => {
                let id = query.id.clone();
                self.hear(&now, id, &mut outputs, |node, outputs| Some(node.answer(&now, &query, outputs)));
            }
            Event::WorldQuery(query) => {
                let id = query.id.clone();
                self.hear(&now, id, &mut outputs, |node, _| node.answer_in_world(&now, &query));
            }
            Event::Receipt(receipt) => {
                self.teaching.settle(now.nanoseconds(), &receipt);
                self.settle(receipt, &mut outputs);
            }
            Event::World(world) => outputs.extend(self.teaching.world(&world).map(Output::Warning)),
            Event::Lesson(lesson) => self.teaching.lesson(&lesson),
            Event::Tick => {}
        }
        self.teach(&now, &mut outputs);
        self.send_due(now.nanoseconds(), &mut outputs);
        outputs
    }

    /// Takes a question with an id, and what gives its answer: nothing while it is too early to say.
    fn hear(
        &mut self,
        now: &Time,
        query_id: String,
        outputs: &mut Vec<Output>,
        answer: impl FnOnce(&mut Self, &mut Vec<Output>) -> Option<Result<Output, String>>,
    ) {
        if query_id.is_empty() {
            return outputs.push(Output::Warning("ignored a question without an id".to_owned()));
        }
        if self.settled.contains(&query_id) || self.pending.iter().any(|pending| pending.query_id == query_id) {
            return;
        }
        match answer(self, outputs) {
            Some(Ok(message)) => {
                if self.pending.len() == MAX_PENDING {
                    let dropped = self.pending.remove(0);
                    let text = format!("gave up on a receipt for the answer to question '{}'", dropped.query_id);
                    outputs.push(Output::Warning(text));
                }
                self.pending.push(Pending {
                    id: answer_id(&self.source, &query_id, self.seed),
                    query_id,
                    message,
                    due_ns: now.nanoseconds() + self.delay_ns,
                    sent: false,
                });
            }
            Some(Err(reason)) => {
                let id: String = query_id.chars().take(MAX_ID).collect();
                outputs.push(Output::Warning(format!("cannot answer question '{id}': {reason}")));
                self.remember(query_id);
            }
            None => {}
        }
    }

    /// What the person says about a world: nothing before it is known, or while there is still something to show unasked.
    fn answer_in_world(&mut self, now: &Time, query: &WorldQuery) -> Option<Result<Output, String>> {
        let teacher = self.teaching.teacher().filter(|_| !self.teaching.is_showing())?;
        let header = Header { stamp: *now, frame_id: String::new() };
        Some(teacher.answer(query, header).map_err(|error| error.to_string()))
    }

    /// Gives the next piece of evidence about a world, when its time has come.
    fn teach(&mut self, now: &Time, outputs: &mut Vec<Output>) {
        match self.teaching.next(now) {
            Some(Ok(piece)) => {
                let id = piece.id().to_owned();
                let message = match piece {
                    Piece::Show(message) => Output::Actions(message),
                    Piece::Compare(message) => Output::Preference(message),
                };
                let due_ns = now.nanoseconds() + self.delay_ns;
                self.pending.push(Pending { query_id: id.clone(), id, message, due_ns, sent: false });
            }
            Some(Err(text)) => outputs.push(Output::Warning(text)),
            None => {}
        }
    }

    fn answer(&mut self, now: &Time, query: &PlacementQuery, outputs: &mut Vec<Output>) -> Result<Output, String> {
        let scene = exchange::scene_from_message(&query.scene).map_err(|error| error.to_string())?;
        let unknown = self.person.unknown_features(&scene);
        if !self.warned_features && !unknown.is_empty() {
            let text = format!("the person's reward names features that are not on this table: {}", unknown.join(", "));
            outputs.push(Output::Warning(text));
            self.warned_features = true;
        }
        let id = answer_id(&self.source, &query.id, self.seed);
        let header = Header { stamp: *now, frame_id: query.scene.header.frame_id.clone() };
        let response = |header, id, kind, reason: &str| {
            Output::Response(QueryResponse {
                header,
                id,
                query_id: query.id.clone(),
                source: self.source.clone(),
                kind,
                reason: reason.to_owned(),
            })
        };
        if let [first, second] = query.options.as_slice() {
            let places_m = [first, second].map(|option| Point::new(option.placement.x, option.placement.y));
            let said = self.person.compare(&query.id, &scene, places_m).map_err(|error| error.to_string())?;
            let Comparison::Said { answer, second_is_better } = said else {
                return Ok(response(header, id, QueryResponse::SKIP, ""));
            };
            // Worst first.
            let [worse, better] = if second_is_better { [first, second] } else { [second, first] };
            return Ok(Output::Preference(Box::new(TrajectoryPreference {
                header,
                id,
                query_id: query.id.clone(),
                source: self.source.clone(),
                trajectories: vec![worse.trajectory.clone(), better.trajectory.clone()],
                answer,
                confidence: TrajectoryPreference::CONFIDENCE_SURE,
            })));
        }
        let answer = self.person.answer(&query.id, &scene).map_err(|error| error.to_string())?;
        Ok(match answer {
            Answer::Place(at_m) => Output::Demonstration(Box::new(PlacementDemonstration {
                header,
                id,
                query_id: query.id.clone(),
                source: self.source.clone(),
                scene: query.scene.clone(),
                placement: geometry_msgs::Point { x: at_m.x, y: at_m.y, z: 0.0 },
                confidence: PlacementDemonstration::CONFIDENCE_SURE,
            })),
            Answer::Skip => response(header, id, QueryResponse::SKIP, ""),
            Answer::CantTell { reason } => response(header, id, QueryResponse::CANT_TELL, reason),
        })
    }

    fn settle(&mut self, receipt: EvidenceReceipt, outputs: &mut Vec<Output>) {
        let Some(at) = self.pending.iter().position(|pending| pending.id == receipt.id) else { return };
        let answered = self.pending.remove(at);
        if receipt.outcome == EvidenceReceipt::REFUSED {
            let text = format!("the answer to question '{}' was refused: {}", answered.query_id, receipt.reason);
            outputs.push(Output::Warning(text));
        }
        self.remember(answered.query_id);
    }

    fn remember(&mut self, query_id: String) {
        if self.settled.len() == MAX_PENDING {
            self.settled.remove(0);
        }
        self.settled.push(query_id);
    }

    fn send_due(&mut self, now_ns: i128, outputs: &mut Vec<Output>) {
        for pending in &mut self.pending {
            // A clock that jumped back (a looped replay) must not silence an answer for longer than its period.
            let longest = if pending.sent { self.period_ns } else { self.delay_ns };
            if now_ns >= pending.due_ns || pending.due_ns - now_ns > longest {
                pending.due_ns = now_ns + self.period_ns;
                pending.sent = true;
                outputs.push(pending.message.clone());
            }
        }
    }
}
