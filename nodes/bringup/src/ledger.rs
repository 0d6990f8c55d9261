//! The numbers of a lesson.

use crate::Topic;
use apprentice_msgs::msg::{Carrying, EvidenceReceipt, EvidenceRecord, LessonStatus, PlacementPlan, RobustPolicy};
use std::collections::BTreeMap;
use std::time::Duration;

/// Latencies kept for the percentiles.
const MAX_LATENCIES: usize = 100_000;

/// What the robot does once the lesson is over.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Placing {
    /// There is no plan to carry out, or not yet.
    NotPlanned,
    /// There is one, and the arm stands.
    NotBegun,
    /// The arm moves.
    UnderWay,
    /// Well or not.
    Over,
}

/// Counts what happens in a lesson; time is an argument.
#[derive(Debug, Default)]
pub struct Ledger {
    /// Arrival of the first question.
    pub first_question: Option<Duration>,
    /// The newest state of the lesson.
    pub lesson: Option<LessonStatus>,
    /// Answers that are evidence now: placements and other responses.
    pub answers: u64,
    /// The newest plan for the table as it is.
    pub plan: Option<PlacementPlan>,
    /// What the arm does about a plan, or did.
    pub carrying: Option<Carrying>,
    /// The newest policy of a lesson about a world.
    pub policy: Option<RobustPolicy>,
    /// From "accepted" to the next question or the lesson's end, milliseconds.
    latencies_ms: Vec<f64>,
    /// When each answer was accepted that has no next question yet, by revision.
    waiting: BTreeMap<u64, Duration>,
    /// The newest revision that was followed by a question or the end.
    followed: Option<u64>,
}

impl Ledger {
    /// Takes note of something said at a time since the start.
    pub fn note(&mut self, now: Duration, topic: &Topic) {
        match topic {
            Topic::Query(query) => {
                self.first_question.get_or_insert(now);
                self.follow(now, query.revision);
            }
            Topic::WorldQuery(query) => {
                self.first_question.get_or_insert(now);
                self.follow(now, query.revision);
            }
            Topic::Lesson(lesson) => {
                if lesson.state != LessonStatus::ASKING {
                    self.follow(now, lesson.revision);
                }
                self.lesson = Some(lesson.clone());
            }
            Topic::Receipt(receipt) if receipt.outcome == EvidenceReceipt::ACCEPTED => {
                self.wait_for(now, receipt.revision)
            }
            Topic::Evidence(log) => {
                let no_answers = [EvidenceRecord::RETRACTION, EvidenceRecord::SCENE, EvidenceRecord::WORLD];
                let answers = log.records.iter().filter(|record| !no_answers.contains(&record.kind));
                self.answers = answers.count() as u64;
            }
            Topic::Plan(plan) if plan.query_id.is_empty() => self.plan = Some(PlacementPlan::clone(plan)),
            Topic::Carrying(carrying) => self.carrying = Some(Carrying::clone(carrying)),
            Topic::Policy(policy) => self.policy = Some(RobustPolicy::clone(policy)),
            _ => {}
        }
    }

    /// Whether the lesson has ended, in whatever way.
    pub fn is_over(&self) -> bool {
        self.lesson.as_ref().is_some_and(|lesson| ![LessonStatus::ASKING, LessonStatus::PAUSED].contains(&lesson.state))
    }

    /// Whether the robot has planned with all that the lesson's end knows.
    pub fn has_final_plan(&self) -> bool {
        match (&self.plan, &self.lesson) {
            (Some(plan), Some(lesson)) => {
                let taught = lesson.state == LessonStatus::TAUGHT;
                plan.revision >= lesson.revision && (plan.inside_bound || !taught)
            }
            _ => match (&self.policy, &self.lesson) {
                (Some(policy), Some(lesson)) => policy.revision >= lesson.revision,
                _ => false,
            },
        }
    }

    /// How far the robot is with putting the target where the final plan says.
    pub fn placing(&self) -> Placing {
        let plan = self.plan.as_ref().filter(|plan| plan.inside_bound && plan.outcome == PlacementPlan::PLANNED);
        let Some(plan) = plan.filter(|_| self.has_final_plan()) else { return Placing::NotPlanned };
        match self.carrying.as_ref().filter(|carrying| carrying.revision == plan.revision) {
            None => Placing::NotBegun,
            Some(carrying) if carrying.over => Placing::Over,
            Some(_) => Placing::UnderWay,
        }
    }

    /// From "accepted" to the next question, milliseconds; sorted.
    pub fn latencies_ms(&self) -> Vec<f64> {
        let mut sorted = self.latencies_ms.clone();
        sorted.sort_by(f64::total_cmp);
        sorted
    }

    /// An answer has become this revision.
    fn wait_for(&mut self, now: Duration, revision: u64) {
        if self.followed.is_none_or(|followed| revision > followed) && self.waiting.len() < MAX_LATENCIES {
            self.waiting.entry(revision).or_insert(now);
        }
    }

    /// A question or the end with this revision has come.
    fn follow(&mut self, now: Duration, revision: u64) {
        if self.followed.is_some_and(|followed| revision <= followed) {
            return;
        }
        self.followed = Some(revision);
        let later = self.waiting.split_off(&(revision + 1));
        // Of answers that were overtaken by a newer one only the newest was waited for.
        if let Some((_, accepted)) = std::mem::replace(&mut self.waiting, later).last_key_value()
            && self.latencies_ms.len() < MAX_LATENCIES
        {
            self.latencies_ms.push(now.saturating_sub(*accepted).as_secs_f64() * 1e3);
        }
    }
}
