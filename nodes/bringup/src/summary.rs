//! What is left of a lesson when it is over: one JSON object.

use crate::{Ledger, SessionRecord};
use apprentice_msgs::action::PlaceObjectResult;
use apprentice_msgs::msg::{LessonStatus, PlacementPlan, RobustPolicy};
use serde::Serialize;
use std::collections::BTreeMap;
use std::path::Path;
use std::time::Duration;

/// The summary of a lesson (`--summary FILE`). Lengths in metres; what is not known is null.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Summary {
    /// Whether the bound is below ε.
    pub taught: bool,
    /// "asking", "taught", "stopped", "gave_up", "paused", "finished" or "misfit".
    pub state: &'static str,
    /// The reason for the state, in words.
    pub why: String,
    /// Questions asked.
    pub questions_asked: u32,
    /// Answers accepted: placements and other responses, retracted ones included.
    pub answers: u64,
    /// Demonstrations that count now.
    pub demonstrations: u32,
    /// The newest bound.
    pub last_bound_m: Option<f64>,
    /// The bound to reach.
    pub epsilon_m: Option<f64>,
    /// About a world: the newest bound on what the robot's policy loses, as a share of what choosing at random loses.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub last_bound_loss: Option<f64>,
    /// About a world: the bound to reach.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub epsilon_loss: Option<f64>,
    /// About a world: what the robot would do.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub policy: Option<PolicySummary>,
    /// Where the robot would put the target, from above: x, y.
    pub placement_m: Option<[f64; 2]>,
    /// Whether it put the target there, false also where it is taught and finds no way to; null: it did not try, is at it, or
    /// there is no robot.
    pub placed: Option<bool>,
    /// How that ended, in words.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub placed_reason: Option<String>,
    /// From the start of the command to now.
    pub wall_time_s: f64,
    /// From the start of the command to the first question.
    pub start_to_first_question_s: Option<f64>,
    /// From an answer's acceptance to the next question, or to the end of the lesson.
    pub answer_to_next_question_ms: Percentiles,
    /// The bag's folder.
    pub bag: Option<String>,
    /// The session's folder.
    pub session: String,
    /// Scenario's name or file.
    pub scenario: String,
    /// Who answered: "simulated" or "human".
    pub demonstrator: &'static str,
    /// Seed of every node.
    pub seed: i64,
    /// Version of the executable.
    pub version: &'static str,
    /// Commit that the executable was built from.
    pub commit: String,
    /// Per node.
    pub nodes: BTreeMap<&'static str, NodeCount>,
}

/// The robot's policy in a world, in short; what is not known is null.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct PolicySummary {
    /// Whether it is proved the best.
    pub optimal: bool,
    /// Weight of the mean against the worst case.
    pub lambda: f64,
    /// The worst 1 − α of the rewards are the worst case.
    pub alpha: f64,
    /// Mean return.
    pub expected_return: Option<f64>,
    /// Mean of the worst case.
    pub conditional_value_at_risk: Option<f64>,
    /// The same on draws that did not choose it.
    pub held_out_cvar: Option<f64>,
    /// In words.
    pub reason: String,
}

/// How often a node was started, and how often it died unasked.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize)]
pub struct NodeCount {
    /// Times it was started.
    pub starts: u32,
    /// Times it died.
    pub deaths: u32,
}

/// Percentiles by nearest rank.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize)]
pub struct Percentiles {
    /// Median.
    pub p50: Option<f64>,
    /// 99th percentile.
    pub p99: Option<f64>,
    /// How many there were.
    pub n: usize,
}

impl Percentiles {
    /// Of sorted numbers.
    pub fn of(sorted: &[f64]) -> Self {
        let n = sorted.len();
        let rank = |percent: usize| sorted.get((percent * n).div_ceil(100).saturating_sub(1)).copied();
        Self { p50: rank(50), p99: rank(99), n }
    }
}

/// What the summary takes from elsewhere than the ledger.
#[derive(Debug, Clone)]
pub struct Circumstances {
    /// What the session was begun with.
    pub record: SessionRecord,
    /// The session's folder.
    pub session: String,
    /// The bag's folder.
    pub bag: Option<String>,
    /// Who answers.
    pub demonstrator: &'static str,
    /// Commit that the executable was built from.
    pub commit: String,
}

impl Summary {
    /// The summary as of `now`; `why` overrules the lesson's own reason when the lesson did not end by itself.
    pub fn new(
        circumstances: &Circumstances,
        ledger: &Ledger,
        nodes: BTreeMap<&'static str, NodeCount>,
        now: Duration,
        why: Option<&str>,
    ) -> Self {
        let lesson = ledger.lesson.as_ref();
        let finite = |value: f64| value.is_finite().then_some(value);
        let carried = ledger.carrying.as_ref().filter(|carrying| carrying.over);
        let carried =
            carried.map(|carrying| (carrying.outcome == PlaceObjectResult::DONE, carrying.description.clone()));
        let hopeless = |plan: &&PlacementPlan| {
            plan.inside_bound && ![PlacementPlan::PLANNED, PlacementPlan::NO_ROBOT].contains(&plan.outcome)
        };
        let hopeless = || ledger.plan.as_ref().filter(hopeless).map(|plan| (false, plan.reason.clone()));
        let (placed, placed_reason) = carried.or_else(hopeless).unzip();
        let about_world = ledger.policy.is_some();
        let state = lesson.map_or(LessonStatus::ASKING, |lesson| lesson.state);
        let own_reason = lesson.map_or("no question was asked", |lesson| lesson.reason.as_str());
        Self {
            taught: state == LessonStatus::TAUGHT,
            state: match state {
                LessonStatus::TAUGHT => "taught",
                LessonStatus::STOPPED => "stopped",
                LessonStatus::GAVE_UP => "gave_up",
                LessonStatus::PAUSED => "paused",
                LessonStatus::FINISHED => "finished",
                LessonStatus::MISFIT => "misfit",
                _ => "asking",
            },
            why: why.filter(|_| state == LessonStatus::ASKING).unwrap_or(own_reason).to_owned(),
            questions_asked: lesson.map_or(0, |lesson| lesson.questions_asked),
            answers: ledger.answers,
            demonstrations: lesson.map_or(0, |lesson| lesson.demonstrations),
            last_bound_m: lesson.and_then(|lesson| finite(lesson.bound_m)),
            epsilon_m: lesson.and_then(|lesson| finite(lesson.epsilon_m)),
            last_bound_loss: lesson.and_then(|lesson| finite(lesson.loss_bound)).filter(|_| about_world),
            epsilon_loss: lesson.and_then(|lesson| finite(lesson.epsilon_loss)).filter(|_| about_world),
            policy: ledger.policy.as_ref().map(|policy| PolicySummary {
                optimal: policy.outcome == RobustPolicy::OPTIMAL,
                lambda: policy.lambda,
                alpha: policy.alpha,
                expected_return: finite(policy.expected_return),
                conditional_value_at_risk: finite(policy.conditional_value_at_risk),
                held_out_cvar: finite(policy.held_out_cvar),
                reason: policy.reason.clone(),
            }),
            placement_m: ledger.plan.as_ref().map(|plan| [plan.robust_placement.x, plan.robust_placement.y]),
            placed,
            placed_reason,
            wall_time_s: now.as_secs_f64(),
            start_to_first_question_s: ledger.first_question.map(|at| at.as_secs_f64()),
            answer_to_next_question_ms: Percentiles::of(&ledger.latencies_ms()),
            bag: circumstances.bag.clone(),
            session: circumstances.session.clone(),
            scenario: circumstances.record.scenario.clone(),
            demonstrator: circumstances.demonstrator,
            seed: circumstances.record.seed,
            version: env!("CARGO_PKG_VERSION"),
            commit: circumstances.commit.clone(),
            nodes,
        }
    }

    /// Writes the summary so that a reader sees all of it or nothing.
    ///
    /// # Errors
    /// When the file cannot be written.
    pub fn write(&self, path: &Path) -> std::io::Result<()> {
        let text = serde_json::to_string_pretty(self)? + "\n";
        crate::session::write_whole(path, &text)
    }
}
