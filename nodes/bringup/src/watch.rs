//! Bringup's own ears on the graph.

use crate::Settings;
use apprentice_msgs::msg::{
    Carrying, EvidenceLog, EvidenceReceipt, LessonStatus, PerformanceBounds, PlacementPlan, PlacementQuery,
    RobustPolicy, TableScene, TabularWorld, WorldQuery,
};
use bus::{Arguments, Bus, Graph, NodeError, Qos, Stopper};
use std::sync::mpsc::{Sender, channel};
use std::thread::JoinHandle;

/// What is said on the topics of a lesson.
#[derive(Debug, Clone, PartialEq)]
pub enum Topic {
    /// The table.
    Scene(TableScene),
    /// The open question.
    Query(PlacementQuery),
    /// What became of an answer.
    Receipt(EvidenceReceipt),
    /// All answers.
    Evidence(EvidenceLog),
    /// The bounds.
    Bounds(PerformanceBounds),
    /// The lesson's state.
    Lesson(LessonStatus),
    /// The robot's plan.
    Plan(Box<PlacementPlan>),
    /// What the arm is doing about it.
    Carrying(Box<Carrying>),
    /// The world.
    World(Box<TabularWorld>),
    /// The open question about it.
    WorldQuery(Box<WorldQuery>),
    /// What the robot would do in it.
    Policy(Box<RobustPolicy>),
}

/// A thread that listens.
pub struct Watch {
    stopper: Stopper,
    thread: JoinHandle<()>,
}

impl Watch {
    /// Joins the graph and hands everything to `take` from then on; `take` returns false to end it.
    ///
    /// # Errors
    /// When the graph cannot be joined.
    pub fn start(
        graph: Graph,
        arguments: Arguments,
        settings: Settings,
        mut take: impl FnMut(Topic) -> bool + Send + 'static,
    ) -> Result<Self, String> {
        let (ready, joined) = channel();
        let work = move || {
            let mut bus = match open(&graph, &arguments, &settings) {
                Ok(bus) => bus,
                Err(error) => return report(&ready, Err(error.to_string())),
            };
            report(&ready, Ok(bus.stopper()));
            while let Some((_, topic)) = bus.next() {
                if !take(topic) {
                    break;
                }
            }
        };
        let thread = std::thread::Builder::new()
            .name("watch".to_owned())
            .spawn(work)
            .map_err(|error| format!("no thread to listen: {error}"))?;
        let stopper = joined.recv().map_err(|_| "the listening thread ended".to_owned())??;
        Ok(Self { stopper, thread })
    }

    /// Leaves the graph.
    pub fn stop(self) {
        self.stopper.stop();
        // A listener that panicked has said so, and there is nothing left to do with it.
        let _ = self.thread.join();
    }
}

fn report(ready: &Sender<Result<Stopper, String>>, result: Result<Stopper, String>) {
    // The receiver waits for exactly this.
    let _ = ready.send(result);
}

fn open(graph: &Graph, arguments: &Arguments, settings: &Settings) -> Result<Bus<Topic>, NodeError> {
    let mut bus = Bus::open(graph, arguments, settings)?;
    bus.subscribe("scene", Qos::State, Topic::Scene)?;
    bus.subscribe("query", Qos::State, Topic::Query)?;
    bus.subscribe("receipt", Qos::Event, Topic::Receipt)?;
    bus.subscribe("evidence", Qos::State, Topic::Evidence)?;
    bus.subscribe("bounds", Qos::State, Topic::Bounds)?;
    bus.subscribe("lesson", Qos::State, Topic::Lesson)?;
    bus.subscribe("plan", Qos::State, |plan| Topic::Plan(Box::new(plan)))?;
    bus.subscribe("carrying", Qos::State, |carrying| Topic::Carrying(Box::new(carrying)))?;
    bus.subscribe("world", Qos::State, |world| Topic::World(Box::new(world)))?;
    bus.subscribe("world_query", Qos::State, |query| Topic::WorldQuery(Box::new(query)))?;
    bus.subscribe("robust_policy", Qos::State, |policy| Topic::Policy(Box::new(policy)))?;
    Ok(bus)
}
