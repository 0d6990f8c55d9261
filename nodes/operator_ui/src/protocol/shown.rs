//! What a page is shown: the messages of the graph in short, with `null` for what is not finite.

use super::{Confidence, Kind};
use serde::Serialize;

/// One thing of a scene.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ObjectView {
    /// Unique within its scene.
    pub id: String,
    /// What people call it.
    pub label: String,
    /// `cylinder` or `box`.
    pub shape: &'static str,
    /// Extent along its own x; a cylinder's diameter.
    pub size_x_m: f64,
    /// Extent along its own y; a cylinder's diameter.
    pub size_y_m: f64,
    /// Height.
    pub size_z_m: f64,
    /// Centre.
    pub x_m: f64,
    /// Centre.
    pub y_m: f64,
    /// Rotation about the vertical, radians.
    pub yaw_rad: f64,
    /// Whether other things may stand on it.
    pub supports: bool,
}

/// A table with what stands on it and what is to be placed.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct SceneView {
    /// Unique within a session.
    pub id: String,
    /// Frame of the coordinates.
    pub frame_id: String,
    /// Extent along x.
    pub width_m: f64,
    /// Extent along y.
    pub depth_m: f64,
    /// Things on the table.
    pub objects: Vec<ObjectView>,
    /// The thing to place; its position means nothing.
    pub target: ObjectView,
}

/// A question.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct QuestionView {
    /// Answers name it.
    pub id: String,
    /// Of the posterior it comes from.
    pub revision: u64,
    /// The table it is about.
    pub scene: SceneView,
    /// None: where the target belongs; two: in which of these places it is better.
    pub options: Vec<SpotView>,
    /// Why it is asked.
    pub reason: String,
    /// Bound in this scene.
    pub bound_m: Option<f64>,
    /// The goal.
    pub epsilon_m: Option<f64>,
    /// How many scenes it was chosen from.
    pub n_candidates: u32,
    /// Whether it waits for an answer.
    pub open: bool,
}

/// A spot on the table.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct SpotView {
    /// To the right.
    pub x_m: f64,
    /// Away from the robot.
    pub y_m: f64,
}

/// Where the robot would place the target.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct PlanView {
    /// The question it belongs to; empty for the table as it is.
    pub query_id: String,
    /// Of the posterior.
    pub revision: u64,
    /// The scene it is for.
    pub scene_id: String,
    /// `planned`, `no_free_place`, `unreachable`, `no_path`, `no_robot`, `start_in_collision`,
    /// `goal_in_collision`, `joints_unknown`, `outside_limits`, `cannot_pick` or `unknown`.
    pub outcome: &'static str,
    /// In words.
    pub reason: String,
    /// Best under the most probable weights; `null` when there is no place.
    pub map_placement: Option<SpotView>,
    /// Smallest expected worst-case distance to the person's place.
    pub robust_placement: Option<SpotView>,
    /// Its conditional value at risk.
    pub map_cvar_m: Option<f64>,
    /// Its conditional value at risk.
    pub robust_cvar_m: Option<f64>,
    /// Level of both.
    pub alpha: Option<f64>,
    /// Whether the robot may move.
    pub inside_bound: bool,
    /// Duration of the motion, seconds; 0 without one.
    pub motion_s: f64,
    /// Places that were considered, best first.
    pub candidates: Vec<CandidateView>,
    /// Cells along each side of the maps.
    pub map_side: u32,
    /// Mean reward, `map_side` squared cells, row by row from the robot's side; empty without a map.
    pub reward_map: Vec<Option<f32>>,
    /// 0 free, 1 occupied, 2 out of reach; as long as `reward_map`, or empty.
    pub cell_state: Vec<u8>,
}

/// A place that was considered.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct CandidateView {
    /// To the right.
    pub x_m: f64,
    /// Away from the robot.
    pub y_m: f64,
    /// `chosen`, `next_best`, `unreachable`, `no_path`, `blocked` or `unknown`.
    pub verdict: &'static str,
    /// The same in words.
    pub reason: String,
    /// Share of the draws whose own best place is near.
    pub probability_best: Option<f64>,
    /// Conditional value at risk of the distance to each draw's own best place.
    pub cvar_m: Option<f64>,
    /// To the nearest object or edge.
    pub clearance_m: Option<f64>,
}

/// Where the lesson stands.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct LessonView {
    /// Of the posterior.
    pub revision: u64,
    /// `asking`, `taught`, `stopped`, `gave_up`, `paused`, `finished`, `misfit` or `unknown`.
    pub state: &'static str,
    /// In words.
    pub reason: String,
    /// The open question; empty when there is none.
    pub query_id: String,
    /// Questions so far.
    pub questions_asked: u32,
    /// Demonstrations in force.
    pub demonstrations: u32,
    /// As in [`BoundsView::outcome`].
    pub bound_outcome: &'static str,
    /// The bound.
    pub bound_m: Option<f64>,
    /// The goal.
    pub epsilon_m: Option<f64>,
    /// About a world: the bound on the loss, as a share of what choosing at random loses.
    pub loss_bound: Option<f64>,
    /// About a world: the goal.
    pub epsilon_loss: Option<f64>,
    /// About a world: answers to questions that were drawn at random,
    pub held_out: u32,
    /// and how many of them were not expected.
    pub surprises: u32,
    /// Ids of what fits worst, where the state is `misfit`.
    pub misfits: Vec<String>,
}

/// The bound and everything it rests on.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct BoundsView {
    /// Of the posterior.
    pub revision: u64,
    /// `bound`, `not_enough_samples`, `not_mixed`, `no_placement` or `unknown`.
    pub outcome: &'static str,
    /// The claim, or why there is none.
    pub reason: String,
    /// The largest over the scenes.
    pub bound_m: Option<f64>,
    /// Share of the rewards covered.
    pub alpha: Option<f64>,
    /// Chance that the bound is wrong.
    pub delta: Option<f64>,
    /// How many bounds were looked at so far.
    pub look: u64,
    /// Share of delta spent on each scene of this look.
    pub delta_spent: Option<f64>,
    /// Draws.
    pub n: u64,
    /// Chains.
    pub n_chains: u32,
    /// Least effective sample size.
    pub ess_min: Option<f64>,
    /// Worst split R-hat.
    pub rhat_max: Option<f64>,
    /// Acceptance of the sampler.
    pub acceptance: Option<f64>,
    /// Rationality.
    pub beta: Option<f64>,
    /// Prior.
    pub prior: String,
    /// SHA-256 over the evidence, hex.
    pub evidence_hash: String,
    /// Decimal; a JSON number would lose digits.
    pub seed: String,
    /// Of the program.
    pub version: String,
}

/// The posterior in short.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct PosteriorView {
    /// Number of accepted events.
    pub revision: u64,
    /// `ready`, `not_mixed` or `unknown`.
    pub outcome: &'static str,
    /// In words.
    pub reason: String,
    /// Demonstrations in force.
    pub n_demonstrations: u64,
    /// SHA-256 over the evidence, hex.
    pub evidence_hash: String,
}

/// The bound after one revision.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct TrendPoint {
    /// Of the posterior.
    pub revision: u64,
    /// As in [`BoundsView::outcome`].
    pub outcome: &'static str,
    /// The bound.
    pub bound_m: Option<f64>,
    /// The goal.
    pub epsilon_m: Option<f64>,
    /// The claim, or why there is none.
    pub reason: String,
}

/// What became of an answer.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Fate {
    /// Waits for another event before it is sent.
    Held,
    /// Sent again and again until it is acknowledged.
    Pending,
    /// Part of the evidence.
    Accepted,
    /// Not part of the evidence.
    Refused,
    /// Was part of the evidence and has been taken back.
    Undone,
    /// Was part of the evidence of an earlier lesson.
    Past,
}

/// One answer.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct AnswerView {
    /// Of the evidence.
    pub id: String,
    /// What it is.
    pub kind: Kind,
    /// The question; empty when volunteered.
    pub query_id: String,
    /// Who answered.
    pub source: String,
    /// Whether that was the person at this node's pages.
    pub mine: bool,
    /// The table of a placement.
    pub scene: Option<SceneView>,
    /// Of a placement.
    pub x_m: Option<f64>,
    /// Of a placement.
    pub y_m: Option<f64>,
    /// How sure the person was.
    pub confidence: Option<Confidence>,
    /// Steps shown, trajectories compared, segments marked or attempts told.
    pub n: Option<u32>,
    /// State and action, where one step was shown.
    pub step: Option<[u32; 2]>,
    /// Of a comparison: `ranked`, `equal` or `cant_tell`.
    pub said: Option<&'static str>,
    /// Steps marked good and steps marked bad.
    pub marked: Option<[u32; 2]>,
    /// What became of it.
    pub state: Fate,
    /// Of the posterior that took it in.
    pub revision: Option<u64>,
    /// Why it was refused.
    pub reason: String,
    /// How it is being taken back.
    pub undo: Option<UndoView>,
}

/// A retraction.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct UndoView {
    /// Of the retraction.
    pub id: String,
    /// What became of it; never [`Fate::Undone`].
    pub state: Fate,
    /// Of the posterior that took it in.
    pub revision: Option<u64>,
    /// Why it was refused.
    pub reason: String,
}

/// A node and whether it is there.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct NodeView {
    /// Its name, without the namespace.
    pub name: String,
    /// `alive`, `late` or `gone`.
    pub state: &'static str,
    /// How often it was started anew while this node watched.
    pub restarts: u32,
}

/// A session that was recorded before.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct RecordingView {
    /// Of its file or folder.
    pub name: String,
    /// Of the first message, seconds since 1970; `null` when there is none.
    pub began_s: Option<f64>,
    /// From the first to the last message.
    pub duration_s: f64,
    /// On disk.
    pub bytes: u64,
}
