//! The operator page with a canned lesson behind it: a question after each answer, taught after a few.
//!
//! `cargo run --release -p operator_ui --example canned -- -p port:=9000`; the address is printed. No other node is
//! needed, so the page can be worked on and looked at alone. With `dds` as the first argument the two talk over DDS.

#[path = "../tests/world/mod.rs"]
mod world;

use apprentice_msgs::msg::{
    EvidenceLog, EvidenceReceipt, EvidenceRecord, LessonStatus, PerformanceBounds, PlacementDemonstration,
    PlacementPlan, PlacementQuery, Posterior, QueryResponse, Retraction, TableScene, TrajectoryPreference,
};
use bus::{Arguments, Bus, EventSender, Graph, MemoryGraph, NodeError, NodeSettings, ParameterSpec, Publisher, Qos};
use serde::{Deserialize, Serialize};
use std::time::Duration;

/// The canned lesson has no parameters.
#[derive(Debug, Clone, Default, Serialize, Deserialize)]
struct NoSettings {}

impl NodeSettings for NoSettings {
    const NODE: &'static str = "reward_posterior";
    const ABOUT: &'static str = "A canned lesson";
    const PARAMETERS: &'static [ParameterSpec] = &[];
}

enum Event {
    Demonstration(Box<PlacementDemonstration>),
    Preference(Box<TrajectoryPreference>),
    Retraction(Box<Retraction>),
    Response(Box<QueryResponse>),
    Revised,
}

struct Lesson {
    records: Vec<EvidenceRecord>,
    later: EventSender<Event>,
    receipt: Publisher<EvidenceReceipt>,
    evidence: Publisher<EvidenceLog>,
    scene: Publisher<TableScene>,
    posterior: Publisher<Posterior>,
    bounds: Publisher<PerformanceBounds>,
    guess: Publisher<PlacementPlan>,
    plan: Publisher<PlacementPlan>,
    query: Publisher<PlacementQuery>,
    lesson: Publisher<LessonStatus>,
}

impl Lesson {
    fn revise(&self) -> Result<(), NodeError> {
        let revision = self.records.len() as u64;
        // Every third question is which of two places is better.
        let question = if revision % 3 == 2 { world::pair(revision) } else { world::query(revision) };
        let task = world::scene("task", 0.0);
        self.posterior.publish(&world::posterior(revision))?;
        self.bounds.publish(&world::bounds(revision))?;
        self.guess.publish(&world::plan(&question.scene, &question.id, revision))?;
        self.plan.publish(&world::plan(&task, "", revision))?;
        self.scene.publish(&task)?;
        if world::lesson(revision).state == LessonStatus::ASKING {
            self.query.publish(&question)?;
        }
        self.lesson.publish(&world::lesson(revision))?;
        Ok(())
    }

    fn accept(&mut self, id: &str, record: EvidenceRecord) -> Result<(), NodeError> {
        let known = |r: &EvidenceRecord| {
            r.demonstration.iter().any(|m| m.id == id)
                || r.retraction.iter().any(|m| m.id == id)
                || r.response.iter().any(|m| m.id == id)
                || r.preference.iter().any(|m| m.id == id)
        };
        if !self.records.iter().any(known) {
            self.records.push(EvidenceRecord { sequence: self.records.len() as u64 + 1, ..record });
            let later = self.later.clone();
            std::thread::spawn(move || {
                std::thread::sleep(Duration::from_millis(400));
                later.send(Event::Revised);
            });
        }
        self.receipt.publish(&world::receipt(id, EvidenceReceipt::ACCEPTED, self.records.len() as u64))?;
        self.evidence.publish(&world::log(self.records.clone()))?;
        Ok(())
    }
}

fn teach(graph: &Graph) -> Result<(), NodeError> {
    let none = Arguments::parse(&[])?;
    let mut bus: Bus<Event> = Bus::open(graph, &none, &NoSettings {})?;
    bus.subscribe("demonstration", Qos::Event, |m| Event::Demonstration(Box::new(m)))?;
    bus.subscribe("preference", Qos::Event, |m| Event::Preference(Box::new(m)))?;
    bus.subscribe("retraction", Qos::Event, |m| Event::Retraction(Box::new(m)))?;
    bus.subscribe("response", Qos::Event, |m| Event::Response(Box::new(m)))?;
    let mut lesson = Lesson {
        records: Vec::new(),
        later: bus.sender(),
        receipt: bus.publisher("receipt", Qos::Event)?,
        evidence: bus.publisher("evidence", Qos::State)?,
        scene: bus.publisher("scene", Qos::State)?,
        posterior: bus.publisher("posterior", Qos::State)?,
        bounds: bus.publisher("bounds", Qos::State)?,
        guess: bus.publisher("guess", Qos::State)?,
        plan: bus.publisher("plan", Qos::State)?,
        query: bus.publisher("query", Qos::State)?,
        lesson: bus.publisher("lesson", Qos::State)?,
    };
    lesson.revise()?;
    while let Some((_, event)) = bus.next() {
        match event {
            Event::Revised => lesson.revise()?,
            Event::Demonstration(message) => {
                let record = world::record(0, &message);
                lesson.accept(&message.id, record)?;
            }
            Event::Preference(message) => {
                let id = message.id.clone();
                let kind = EvidenceRecord::PREFERENCE;
                lesson.accept(&id, EvidenceRecord { kind, preference: vec![*message], ..EvidenceRecord::default() })?;
            }
            Event::Retraction(message) => {
                let record = world::retraction_record(0, &message);
                lesson.accept(&message.id, record)?;
            }
            Event::Response(message) => {
                let id = message.id.clone();
                let kind = EvidenceRecord::RESPONSE;
                lesson.accept(&id, EvidenceRecord { kind, response: vec![*message], ..EvidenceRecord::default() })?;
            }
        }
    }
    Ok(())
}

fn main() -> Result<(), NodeError> {
    let mut given: Vec<String> = std::env::args().skip(1).collect();
    let over_dds = given.first().is_some_and(|first| first == "dds");
    given.drain(..usize::from(over_dds));
    given.insert(0, "--ros-args".to_owned());
    let arguments = Arguments::parse(&given)?;
    let graph = if over_dds { Graph::Dds } else { Graph::Memory(MemoryGraph::new()) };
    let beside = graph.clone();
    let lesson = std::thread::spawn(move || teach(&beside));
    operator_ui::run(&graph, &arguments)?;
    lesson.join().unwrap_or_else(|_| Err(NodeError::Failed("the canned lesson broke off".into())))
}
