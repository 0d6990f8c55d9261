//! The node as a state machine: posteriors, bounds and evidence in; tables to judge, questions and the state of the lesson out.

use crate::Settings;
use crate::tables::TableLesson;
use crate::worlds::Worlds;
use apprentice_msgs::builtin_interfaces::Time;
use apprentice_msgs::msg::{
    Candidates, EvidenceLog, LessonStatus, PerformanceBounds, PlacementQuery, PolicyBounds, Posterior, RobustPolicy,
    TableReach, TabularWorld, WorldQuery,
};
use exchange::is_about_a_table;
use std::sync::Arc;

/// What reaches the node.
#[derive(Debug, Clone)]
pub enum Event {
    /// A new (or repeated) posterior.
    Posterior(Box<Posterior>),
    /// What the arm reaches of the table.
    Reach(Box<TableReach>),
    /// Bounds on the candidates.
    Bounds(Box<PerformanceBounds>),
    /// Bounds on policies: in a lesson about a world, what is known of the robot's.
    PolicyBounds(Box<PolicyBounds>),
    /// The robot's policy in a lesson about a world, or why there is none.
    Policy(Box<RobustPolicy>),
    /// A world, perhaps that of the lesson.
    World(Box<TabularWorld>),
    /// Everything accepted so far: what was asked about a world before is in it.
    Evidence(Box<EvidenceLog>),
    /// Time to choose what may follow the open question about a world, as [`Output::LookAhead`] asked for.
    LookAhead,
    /// A tenth of a second has passed.
    Tick,
    /// Time to send the newest outputs again.
    Republish,
}

/// What the node sends.
#[derive(Debug, Clone)]
pub enum Output {
    /// Tables to judge.
    Candidates(Candidates),
    /// The open question.
    Query(Box<PlacementQuery>),
    /// The open question about a world.
    WorldQuery(Box<WorldQuery>),
    /// The node wants [`Event::LookAhead`] as soon as nothing else waits: that takes a while, and the person thinks anyway.
    LookAhead,
    /// Where the lesson stands.
    Lesson(LessonStatus),
    /// Something a person should know.
    Warn(String),
}

/// See the crate.
pub struct ActiveQuery {
    settings: Settings,
    tables: TableLesson,
    worlds: Worlds,
}

impl ActiveQuery {
    /// A node that has seen nothing.
    pub fn new(settings: Settings) -> Self {
        Self { settings, tables: TableLesson::default(), worlds: Worlds::default() }
    }

    /// Takes one event. Outputs depend on the settings and the messages alone, never on `_now`.
    pub fn step(&mut self, _now: Time, event: Event) -> Vec<Output> {
        let settings = &self.settings;
        match event {
            // A lesson that is about no table asks nothing about any.
            Event::Posterior(posterior) if is_about_a_table(&posterior) => {
                if self.tables.is_at(posterior.revision) {
                    return Vec::new();
                }
                self.tables.take_posterior(settings, *posterior)
            }
            Event::Posterior(posterior) => {
                self.worlds.take_posterior(posterior);
                self.worlds.news(settings)
            }
            Event::Reach(reach) => self.tables.take_reach(settings, *reach),
            Event::Bounds(bounds) => self.tables.take_bounds(settings, bounds),
            Event::PolicyBounds(bounds) => {
                self.worlds.take_bounds(bounds);
                self.worlds.news(settings)
            }
            Event::Policy(policy) => {
                self.worlds.take_policy(&policy);
                self.worlds.news(settings)
            }
            Event::World(world) => {
                let told = self.worlds.take_world(&world);
                told.into_iter().chain(self.worlds.news(settings)).collect()
            }
            Event::Evidence(log) => {
                let log: Arc<EvidenceLog> = log.into();
                self.worlds.take_log(log.clone());
                let about_tables = self.tables.take_log(settings, log);
                about_tables.into_iter().chain(self.worlds.news(settings)).collect()
            }
            Event::LookAhead => {
                self.worlds.look_ahead(settings);
                Vec::new()
            }
            Event::Tick => self.worlds.tick(settings).into_iter().collect(),
            Event::Republish => {
                let about_tables = self.tables.republish();
                about_tables.into_iter().chain(self.worlds.republish()).collect()
            }
        }
    }
}
