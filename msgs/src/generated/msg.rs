//! Messages of this package.
//!
//! Generated: do not edit. To write it anew: `cargo run --release -p apprentice_msgs --example generate`.

use serde::{Deserialize, Serialize};

/// Hypothetical tables that active_query wants judged.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct Candidates {
    /// (`std_msgs/Header`)
    pub header: super::std_msgs::Header,
    /// of the posterior (`uint64`)
    pub revision: u64,
    /// (`TableScene[]`)
    pub scenes: Vec<super::msg::TableScene>,
}

impl crate::Message for Candidates {
    const TYPE: &'static str = "apprentice_msgs/msg/Candidates";
}

/// Every accepted event of the session so far; what a replay computes from.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct EvidenceLog {
    /// (`std_msgs/Header`)
    pub header: super::std_msgs::Header,
    /// the first scene the session saw; names the weights (`TableScene`)
    pub task: super::msg::TableScene,
    /// (`EvidenceRecord[]`)
    pub records: Vec<super::msg::EvidenceRecord>,
}

impl crate::Message for EvidenceLog {
    const TYPE: &'static str = "apprentice_msgs/msg/EvidenceLog";
}

/// What reward_posterior did with a demonstration, a retraction or a response.
#[derive(Debug, Clone, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct EvidenceReceipt {
    /// (`std_msgs/Header`)
    pub header: super::std_msgs::Header,
    /// of the evidence (`string`)
    pub id: std::string::String,
    /// (`uint8`)
    pub outcome: u8,
    /// one sentence; empty when accepted (`string`)
    pub reason: std::string::String,
    /// of the posterior that holds it; 0 when refused (`uint64`)
    pub revision: u64,
}

impl EvidenceReceipt {
    /// The constant `ACCEPTED`.
    pub const ACCEPTED: u8 = 0;
    /// had been accepted before; nothing changed
    pub const DUPLICATE: u8 = 1;
    /// The constant `REFUSED`.
    pub const REFUSED: u8 = 2;
}

impl crate::Message for EvidenceReceipt {
    const TYPE: &'static str = "apprentice_msgs/msg/EvidenceReceipt";
}

/// One accepted event, in the order in which reward_posterior accepted it.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct EvidenceRecord {
    /// 1, 2, …; the revision of the posterior that takes it in (`uint64`)
    pub sequence: u64,
    /// (`uint8`)
    pub kind: u8,
    /// (`PlacementDemonstration[<=1]`)
    #[serde(deserialize_with = "crate::bounded::at_most::<_, _, 1>")]
    pub demonstration: Vec<super::msg::PlacementDemonstration>,
    /// (`Retraction[<=1]`)
    #[serde(deserialize_with = "crate::bounded::at_most::<_, _, 1>")]
    pub retraction: Vec<super::msg::Retraction>,
    /// (`QueryResponse[<=1]`)
    #[serde(deserialize_with = "crate::bounded::at_most::<_, _, 1>")]
    pub response: Vec<super::msg::QueryResponse>,
}

impl EvidenceRecord {
    /// The constant `DEMONSTRATION`.
    pub const DEMONSTRATION: u8 = 0;
    /// The constant `RETRACTION`.
    pub const RETRACTION: u8 = 1;
    /// The constant `RESPONSE`.
    pub const RESPONSE: u8 = 2;
}

impl crate::Message for EvidenceRecord {
    const TYPE: &'static str = "apprentice_msgs/msg/EvidenceRecord";
}

/// A node is alive. Twice a second.
#[derive(Debug, Clone, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Heartbeat {
    /// (`builtin_interfaces/Time`)
    pub stamp: super::builtin_interfaces::Time,
    /// (`string`)
    pub node: std::string::String,
    /// new at every start (`string`)
    pub instance: std::string::String,
    /// (`uint64`)
    pub count: u64,
}

impl crate::Message for Heartbeat {
    const TYPE: &'static str = "apprentice_msgs/msg/Heartbeat";
}

/// Where the lesson stands.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct LessonStatus {
    /// (`std_msgs/Header`)
    pub header: super::std_msgs::Header,
    /// (`uint64`)
    pub revision: u64,
    /// (`uint8`)
    pub state: u8,
    /// (`string`)
    pub reason: std::string::String,
    /// the open question; empty when there is none (`string`)
    pub query_id: std::string::String,
    /// (`uint32`)
    pub questions_asked: u32,
    /// active ones (`uint32`)
    pub demonstrations: u32,
    /// as in PlacementBound (`uint8`)
    pub bound_outcome: u8,
    /// NaN without one (`float64`)
    pub bound_m: f64,
    /// (`float64`)
    pub epsilon_m: f64,
}

impl LessonStatus {
    /// The constant `ASKING`.
    pub const ASKING: u8 = 0;
    /// the bound is below epsilon
    pub const TAUGHT: u8 = 1;
    /// the person said that nothing is acceptable
    pub const STOPPED: u8 = 2;
    /// max_questions asked and still not taught
    pub const GAVE_UP: u8 = 3;
}

impl crate::Message for LessonStatus {
    const TYPE: &'static str = "apprentice_msgs/msg/LessonStatus";
}

/// What a node was started with; a replay starts it the same way.
#[derive(Debug, Clone, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct NodeSettings {
    /// executable's name of the node (`string`)
    pub node: std::string::String,
    /// fully qualified name on the graph (`string`)
    pub name: std::string::String,
    /// (`uint64`)
    pub seed: u64,
    /// (`string`)
    pub version: std::string::String,
    /// (`string`)
    pub commit: std::string::String,
    /// YAML, as a ROS parameter file (`string`)
    pub parameters: std::string::String,
}

impl crate::Message for NodeSettings {
    const TYPE: &'static str = "apprentice_msgs/msg/NodeSettings";
}

/// High-confidence bounds on the placement loss, with their receipt.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct PerformanceBounds {
    /// stamp of the posterior (`std_msgs/Header`)
    pub header: super::std_msgs::Header,
    /// of the posterior (`uint64`)
    pub revision: u64,
    /// as in PlacementBound; a bound only if every scene has one (`uint8`)
    pub outcome: u8,
    /// in words: the claim, or "no bound, because …" and what it would take (`string`)
    pub reason: std::string::String,
    /// the largest over the scenes; NaN without one (`float64`)
    pub bound_m: f64,
    /// index of that scene (`uint32`)
    pub worst: u32,
    /// one per scene, in the order of the candidates (`PlacementBound[]`)
    pub bounds: Vec<super::msg::PlacementBound>,
    /// (`float64`)
    pub alpha: f64,
    /// (`float64`)
    pub delta: f64,
    /// how many bounds the session has looked at, this one counted: revision + 1 (`uint64`)
    pub look: u64,
    /// on each scene of this look (`float64`)
    pub delta_spent: f64,
    /// (`uint64`)
    pub n: u64,
    /// (`uint32`)
    pub n_chains: u32,
    /// (`float64`)
    pub ess_min: f64,
    /// (`float64`)
    pub rhat_max: f64,
    /// (`float64`)
    pub acceptance: f64,
    /// (`float64`)
    pub beta: f64,
    /// (`string`)
    pub prior: std::string::String,
    /// (`string`)
    pub evidence_hash: std::string::String,
    /// (`uint64`)
    pub seed: u64,
    /// (`string`)
    pub version: std::string::String,
}

impl crate::Message for PerformanceBounds {
    const TYPE: &'static str = "apprentice_msgs/msg/PerformanceBounds";
}

/// How far the robot's placement in one scene may be from the person's.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct PlacementBound {
    /// (`string`)
    pub scene_id: std::string::String,
    /// (`uint8`)
    pub outcome: u8,
    /// judged: best under the MAP weights, metres (`geometry_msgs/Point`)
    pub placement: super::geometry_msgs::Point,
    /// upper confidence bound on the alpha-VaR of the loss; NaN without one (`float64`)
    pub bound_m: f64,
    /// empirical alpha-quantile (`float64`)
    pub point_estimate_m: f64,
    /// empirical mean of the losses at or above it (`float64`)
    pub cvar_m: f64,
    /// (`float64`)
    pub mean_m: f64,
    /// draws (`uint64`)
    pub n: u64,
    /// of the tail indicator (`float64`)
    pub ess: f64,
    /// (`float64`)
    pub rhat: f64,
    /// 1-based order statistic used; 0 without a bound (`uint64`)
    pub index: u64,
    /// effective samples a bound would take (`uint64`)
    pub needed: u64,
}

impl PlacementBound {
    /// The constant `BOUND`.
    pub const BOUND: u8 = 0;
    /// The constant `NOT_ENOUGH_SAMPLES`.
    pub const NOT_ENOUGH_SAMPLES: u8 = 1;
    /// The constant `NOT_MIXED`.
    pub const NOT_MIXED: u8 = 2;
    /// there is no free spot for the target in this scene
    pub const NO_PLACEMENT: u8 = 3;
}

impl crate::Message for PlacementBound {
    const TYPE: &'static str = "apprentice_msgs/msg/PlacementBound";
}

/// A person shows where the target belongs in a scene. Idempotent: the same id with the same content counts once.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct PlacementDemonstration {
    /// (`std_msgs/Header`)
    pub header: super::std_msgs::Header,
    /// unique within a session (`string`)
    pub id: std::string::String,
    /// the question this answers; empty: volunteered (`string`)
    pub query_id: std::string::String,
    /// who: a node or a person (`string`)
    pub source: std::string::String,
    /// (`TableScene`)
    pub scene: super::msg::TableScene,
    /// metres, in the scene's frame (`geometry_msgs/Point`)
    pub placement: super::geometry_msgs::Point,
    /// (`uint8`)
    pub confidence: u8,
}

impl PlacementDemonstration {
    /// The constant `CONFIDENCE_SURE`.
    pub const CONFIDENCE_SURE: u8 = 0;
    /// The constant `CONFIDENCE_FAIRLY`.
    pub const CONFIDENCE_FAIRLY: u8 = 1;
    /// The constant `CONFIDENCE_GUESS`.
    pub const CONFIDENCE_GUESS: u8 = 2;
}

impl crate::Message for PlacementDemonstration {
    const TYPE: &'static str = "apprentice_msgs/msg/PlacementDemonstration";
}

/// Where the robot would put the target, and how it would get there.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct PlacementPlan {
    /// stamp of the posterior (`std_msgs/Header`)
    pub header: super::std_msgs::Header,
    /// of the posterior (`uint64`)
    pub revision: u64,
    /// the question this is the robot's guess for; empty: a plan for the table as it is (`string`)
    pub query_id: std::string::String,
    /// what was planned for (`TableScene`)
    pub scene: super::msg::TableScene,
    /// SHA-256 of the robot description, hex; empty without one (`string`)
    pub robot_hash: std::string::String,
    /// where the arm stood; empty without a robot (`sensor_msgs/JointState`)
    pub start: super::sensor_msgs::JointState,
    /// (`uint8`)
    pub outcome: u8,
    /// (`string`)
    pub reason: std::string::String,
    /// best under the MAP weights, metres (`geometry_msgs/Point`)
    pub map_placement: super::geometry_msgs::Point,
    /// smallest CVaR of the distance to the person's placement (`geometry_msgs/Point`)
    pub robust_placement: super::geometry_msgs::Point,
    /// (`float64`)
    pub map_cvar_m: f64,
    /// (`float64`)
    pub robust_cvar_m: f64,
    /// (`float64`)
    pub alpha: f64,
    /// the lesson is taught: the robot may move (`bool`)
    pub inside_bound: bool,
    /// (`trajectory_msgs/JointTrajectory`)
    pub trajectory: super::trajectory_msgs::JointTrajectory,
    /// the two maps are map_side x map_side cells, row-major, first row at y = 0 (`uint32`)
    pub map_side: u32,
    /// mean reward over the draws (`float32[]`)
    pub reward_map: Vec<f32>,
    /// (`uint8[]`)
    #[serde(with = "serde_bytes")]
    pub cell_state: Vec<u8>,
}

impl PlacementPlan {
    /// The constant `PLANNED`.
    pub const PLANNED: u8 = 0;
    /// The constant `NO_FREE_PLACE`.
    pub const NO_FREE_PLACE: u8 = 1;
    /// The constant `UNREACHABLE`.
    pub const UNREACHABLE: u8 = 2;
    /// The constant `NO_PATH`.
    pub const NO_PATH: u8 = 3;
    /// placements stand, but no robot model has been received
    pub const NO_ROBOT: u8 = 4;
    /// The constant `CELL_FREE`.
    pub const CELL_FREE: u8 = 0;
    /// The constant `CELL_OCCUPIED`.
    pub const CELL_OCCUPIED: u8 = 1;
    /// The constant `CELL_UNREACHABLE`.
    pub const CELL_UNREACHABLE: u8 = 2;
}

impl crate::Message for PlacementPlan {
    const TYPE: &'static str = "apprentice_msgs/msg/PlacementPlan";
}

/// The open question: where does the target belong in this scene? Republished until it is answered.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct PlacementQuery {
    /// stamp of the posterior (`std_msgs/Header`)
    pub header: super::std_msgs::Header,
    /// (`string`)
    pub id: std::string::String,
    /// of the posterior it comes from (`uint64`)
    pub revision: u64,
    /// (`TableScene`)
    pub scene: super::msg::TableScene,
    /// why this is asked, in words (`string`)
    pub reason: std::string::String,
    /// in this scene; NaN without one (`float64`)
    pub bound_m: f64,
    /// (`float64`)
    pub epsilon_m: f64,
    /// how many scenes it was chosen from (`uint32`)
    pub n_candidates: u32,
}

impl crate::Message for PlacementQuery {
    const TYPE: &'static str = "apprentice_msgs/msg/PlacementQuery";
}

/// Draws of the reward weights given the evidence.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct Posterior {
    /// stamp of the newest accepted evidence (`std_msgs/Header`)
    pub header: super::std_msgs::Header,
    /// number of accepted events (`uint64`)
    pub revision: u64,
    /// SHA-256 over the active demonstrations, hex (`string`)
    pub evidence_hash: std::string::String,
    /// active ones (`uint64`)
    pub n_demonstrations: u64,
    /// questions answered or skipped so far, taken back or not (`uint64`)
    pub n_answers: u64,
    /// the person said that nothing is acceptable, and has not taken it back (`bool`)
    pub stopped: bool,
    /// the table that the lesson is about; names the weights (`TableScene`)
    pub task: super::msg::TableScene,
    /// of the newest active demonstration, else the task (`TableScene`)
    pub scene: super::msg::TableScene,
    /// (`uint8`)
    pub outcome: u8,
    /// (`string`)
    pub reason: std::string::String,
    /// one per weight: object ids, then the fixed centres (`string[]`)
    pub feature_names: Vec<std::string::String>,
    /// (`uint32`)
    pub n_chains: u32,
    /// over all chains (`uint32`)
    pub n_draws: u32,
    /// n_draws x features, row-major, chains one after another; consumers use these very numbers (`float32[]`)
    pub draws: Vec<f32>,
    /// (`float64[]`)
    pub map_weights: Vec<f64>,
    /// (`float64`)
    pub map_log_likelihood: f64,
    /// (`float64`)
    pub log_likelihood_mean: f64,
    /// rank-normalised split R-hat, worst over weights and log-likelihood (`float64`)
    pub rhat_max: f64,
    /// (`float64`)
    pub ess_bulk_min: f64,
    /// (`float64`)
    pub ess_tail_min: f64,
    /// (`float64`)
    pub acceptance: f64,
    /// (`float64`)
    pub beta: f64,
    /// (`string`)
    pub prior: std::string::String,
    /// (`uint64`)
    pub seed: u64,
    /// (`string`)
    pub version: std::string::String,
}

impl Posterior {
    /// The constant `READY`.
    pub const READY: u8 = 0;
    /// the chains disagree: see reason
    pub const NOT_MIXED: u8 = 1;
}

impl crate::Message for Posterior {
    const TYPE: &'static str = "apprentice_msgs/msg/Posterior";
}

/// An answer to a question that is not a placement.
#[derive(Debug, Clone, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct QueryResponse {
    /// (`std_msgs/Header`)
    pub header: super::std_msgs::Header,
    /// unique within a session (`string`)
    pub id: std::string::String,
    /// (`string`)
    pub query_id: std::string::String,
    /// (`string`)
    pub source: std::string::String,
    /// (`uint8`)
    pub kind: u8,
    /// may be empty (`string`)
    pub reason: std::string::String,
}

impl QueryResponse {
    /// no data: ask something else
    pub const SKIP: u8 = 0;
    /// the person has no opinion here: ask something else
    pub const CANT_TELL: u8 = 1;
    /// nothing is acceptable: stop the lesson
    pub const STOP: u8 = 2;
}

impl crate::Message for QueryResponse {
    const TYPE: &'static str = "apprentice_msgs/msg/QueryResponse";
}

/// Takes evidence back. Nothing is deleted: the posterior after it equals the posterior without that evidence.
#[derive(Debug, Clone, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Retraction {
    /// (`std_msgs/Header`)
    pub header: super::std_msgs::Header,
    /// unique within a session (`string`)
    pub id: std::string::String,
    /// what is taken back (`string`)
    pub evidence_id: std::string::String,
    /// (`string`)
    pub source: std::string::String,
    /// may be empty (`string`)
    pub reason: std::string::String,
}

impl crate::Message for Retraction {
    const TYPE: &'static str = "apprentice_msgs/msg/Retraction";
}

/// One thing on the table. Metres, in the frame of the scene's header: x to the right, y away from the robot, z up;
/// the origin is the table's near left corner on its surface.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct SceneObject {
    /// unique within a scene (`string`)
    pub id: std::string::String,
    /// what people call it (`string`)
    pub label: std::string::String,
    /// (`uint8`)
    pub shape: u8,
    /// bounding box; a cylinder has size_m.x == size_m.y == its diameter (`geometry_msgs/Vector3`)
    pub size_m: super::geometry_msgs::Vector3,
    /// centre of the base; rotation about z only (`geometry_msgs/Pose`)
    pub pose: super::geometry_msgs::Pose,
    /// true: other things may be placed on it (a bowl for a spoon) (`bool`)
    pub supports: bool,
}

impl SceneObject {
    /// The constant `SHAPE_CYLINDER`.
    pub const SHAPE_CYLINDER: u8 = 0;
    /// The constant `SHAPE_BOX`.
    pub const SHAPE_BOX: u8 = 1;
}

impl crate::Message for SceneObject {
    const TYPE: &'static str = "apprentice_msgs/msg/SceneObject";
}

/// What stands on the table, and what is to be placed.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct TableScene {
    /// frame_id: the table's frame (`std_msgs/Header`)
    pub header: super::std_msgs::Header,
    /// unique within a session (`string`)
    pub id: std::string::String,
    /// extent along x (`float64`)
    pub width_m: f64,
    /// extent along y (`float64`)
    pub depth_m: f64,
    /// (`SceneObject[]`)
    pub objects: Vec<super::msg::SceneObject>,
    /// the thing to place; its pose is ignored (`SceneObject`)
    pub target: super::msg::SceneObject,
}

impl crate::Message for TableScene {
    const TYPE: &'static str = "apprentice_msgs/msg/TableScene";
}
