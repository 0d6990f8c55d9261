//! Messages of this package.
//!
//! Generated: do not edit. To write it anew: `cargo run --release -p apprentice_msgs --example generate`.

use serde::{Deserialize, Serialize};

/// A person shows what to do in states of a world. Idempotent: the same id with the same content counts once.
#[derive(Debug, Clone, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct ActionDemonstration {
    /// (`std_msgs/Header`)
    pub header: super::std_msgs::Header,
    /// unique within a session (`string`)
    pub id: std::string::String,
    /// the asker's question; empty: volunteered (`string`)
    pub query_id: std::string::String,
    /// who: a node or a person (`string`)
    pub source: std::string::String,
    /// (`string`)
    pub world_id: std::string::String,
    /// any states in any order, each as often as it was shown (`uint32[]`)
    pub states: Vec<u32>,
    /// taken in each of them (`uint32[]`)
    pub actions: Vec<u32>,
    /// (`uint8`)
    pub confidence: u8,
}

impl ActionDemonstration {
    /// The constant `CONFIDENCE_SURE`.
    pub const CONFIDENCE_SURE: u8 = 0;
    /// The constant `CONFIDENCE_FAIRLY`.
    pub const CONFIDENCE_FAIRLY: u8 = 1;
    /// The constant `CONFIDENCE_GUESS`.
    pub const CONFIDENCE_GUESS: u8 = 2;
}

impl crate::Message for ActionDemonstration {
    const TYPE: &'static str = "apprentice_msgs/msg/ActionDemonstration";
}

/// What the arm looks like to the planner: for pictures.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct ArmModel {
    /// frame: the table's (`std_msgs/Header`)
    pub header: super::std_msgs::Header,
    /// of the robot, as in PlacementPlan (`string`)
    pub robot_hash: std::string::String,
    /// poses come in this order (`string[]`)
    pub link_names: Vec<std::string::String>,
    /// (`ArmPart[]`)
    pub parts: Vec<super::msg::ArmPart>,
}

impl crate::Message for ArmModel {
    const TYPE: &'static str = "apprentice_msgs/msg/ArmModel";
}

/// How the arm would carry out a plan: for pictures.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct ArmMotion {
    /// frame: the table's (`std_msgs/Header`)
    pub header: super::std_msgs::Header,
    /// of the plan (`uint64`)
    pub revision: u64,
    /// of the robot, as in ArmModel (`string`)
    pub robot_hash: std::string::String,
    /// from the start, ascending; empty without a motion (`float64[]`)
    pub times_s: Vec<f64>,
    /// for each time the poses of ArmPose (`float32[]`)
    pub poses: Vec<f32>,
    /// of the tool: x, y, z for each point of the plan's trajectory (`float64[]`)
    pub way_m: Vec<f64>,
    /// the target is in the hand from here (`float64`)
    pub held_from_s: f64,
    /// to here (`float64`)
    pub held_until_s: f64,
    /// where the target stands before: the middle of its base; not numbers when it is in the hand (`geometry_msgs/Pose`)
    pub pick: super::geometry_msgs::Pose,
    /// where it will stand; without an extent when there is no place (`SceneObject`)
    pub target: super::msg::SceneObject,
}

impl crate::Message for ArmMotion {
    const TYPE: &'static str = "apprentice_msgs/msg/ArmMotion";
}

/// A solid of a link, as the planner checks it for collisions.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct ArmPart {
    /// in the order of ArmModel (`uint32`)
    pub link: u32,
    /// (`uint8`)
    pub shape: u8,
    /// of the solid in the link's frame (`geometry_msgs/Pose`)
    pub pose: super::geometry_msgs::Pose,
    /// box: the sides; else x the diameter, z the length, without the round ends; a mesh: unused (`geometry_msgs/Vector3`)
    pub size_m: super::geometry_msgs::Vector3,
    /// of a mesh: x, y, z of each corner (`float32[]`)
    pub points: Vec<f32>,
    /// of a mesh: three corners each, counter-clockwise from outside (`uint32[]`)
    pub triangles: Vec<u32>,
}

impl ArmPart {
    /// The constant `BOX`.
    pub const BOX: u8 = 0;
    /// along its z axis
    pub const CYLINDER: u8 = 1;
    /// The constant `SPHERE`.
    pub const SPHERE: u8 = 2;
    /// along its z axis
    pub const CAPSULE: u8 = 3;
    /// convex
    pub const MESH: u8 = 4;
}

impl crate::Message for ArmPart {
    const TYPE: &'static str = "apprentice_msgs/msg/ArmPart";
}

/// Where the links of the arm are.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct ArmPose {
    /// frame: the table's (`std_msgs/Header`)
    pub header: super::std_msgs::Header,
    /// of the robot, as in ArmModel (`string`)
    pub robot_hash: std::string::String,
    /// for each link x, y, z in metres, then a unit quaternion x, y, z, w (`float32[]`)
    pub poses: Vec<f32>,
}

impl crate::Message for ArmPose {
    const TYPE: &'static str = "apprentice_msgs/msg/ArmPose";
}

/// Hypothetical tables that active_query wants judged.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct Candidates {
    /// (`std_msgs/Header`)
    pub header: super::std_msgs::Header,
    /// of the posterior (`uint64`)
    pub revision: u64,
    /// whose reach they lie in; empty: in anybody's (`string`)
    pub robot_hash: std::string::String,
    /// (`TableScene[]`)
    pub scenes: Vec<super::msg::TableScene>,
}

impl crate::Message for Candidates {
    const TYPE: &'static str = "apprentice_msgs/msg/Candidates";
}

/// What the arm is doing about a plan, and how that came out.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct Carrying {
    /// stamp: when it was so; frame: the table's (`std_msgs/Header`)
    pub header: super::std_msgs::Header,
    /// of the posterior that chose the place (`uint64`)
    pub revision: u64,
    /// what is being placed (`string`)
    pub object_id: std::string::String,
    /// one of the stages in the feedback of PlaceObject (`uint8`)
    pub stage: u8,
    /// in plain words; once it is over, the reason (`string`)
    pub description: std::string::String,
    /// of the whole, 0 to 1 (`float64`)
    pub progress: f64,
    /// (`bool`)
    pub over: bool,
    /// once it is over: one of the outcomes in the result of PlaceObject (`uint8`)
    pub outcome: u8,
    /// where it goes, in the table's frame (`geometry_msgs/Point`)
    pub placement: super::geometry_msgs::Point,
}

impl crate::Message for Carrying {
    const TYPE: &'static str = "apprentice_msgs/msg/Carrying";
}

/// Part of a trajectory that a person marked.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct CritiqueSegment {
    /// first step, counted from 0 (`uint32`)
    pub start: u32,
    /// the step after the last (`uint32`)
    pub end: u32,
    /// (`uint8`)
    pub verdict: u8,
}

impl CritiqueSegment {
    /// as it should be done
    pub const GOOD: u8 = 0;
    /// as it should not be done
    pub const BAD: u8 = 1;
}

impl crate::Message for CritiqueSegment {
    const TYPE: &'static str = "apprentice_msgs/msg/CritiqueSegment";
}

/// Every accepted event of the session so far; what a replay computes from.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct EvidenceLog {
    /// (`std_msgs/Header`)
    pub header: super::std_msgs::Header,
    /// the scene that named the weights before the first event; without extent when none did (`TableScene`)
    pub task: super::msg::TableScene,
    /// the world that named the weights before the first event; empty when none did (`WorldReference`)
    pub world: super::msg::WorldReference,
    /// (`EvidenceRecord[]`)
    pub records: Vec<super::msg::EvidenceRecord>,
}

impl crate::Message for EvidenceLog {
    const TYPE: &'static str = "apprentice_msgs/msg/EvidenceLog";
}

/// What reward_posterior did with evidence, a retraction or a response.
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
    /// (`ActionDemonstration[<=1]`)
    #[serde(deserialize_with = "crate::bounded::at_most::<_, _, 1>")]
    pub actions: Vec<super::msg::ActionDemonstration>,
    /// (`TrajectoryPreference[<=1]`)
    #[serde(deserialize_with = "crate::bounded::at_most::<_, _, 1>")]
    pub preference: Vec<super::msg::TrajectoryPreference>,
    /// (`SegmentCritique[<=1]`)
    #[serde(deserialize_with = "crate::bounded::at_most::<_, _, 1>")]
    pub critique: Vec<super::msg::SegmentCritique>,
    /// (`LearnerHistory[<=1]`)
    #[serde(deserialize_with = "crate::bounded::at_most::<_, _, 1>")]
    pub history: Vec<super::msg::LearnerHistory>,
    /// (`TableScene[<=1]`)
    #[serde(deserialize_with = "crate::bounded::at_most::<_, _, 1>")]
    pub scene: Vec<super::msg::TableScene>,
    /// (`WorldReference[<=1]`)
    #[serde(deserialize_with = "crate::bounded::at_most::<_, _, 1>")]
    pub world: Vec<super::msg::WorldReference>,
}

impl EvidenceRecord {
    /// The constant `DEMONSTRATION`.
    pub const DEMONSTRATION: u8 = 0;
    /// The constant `RETRACTION`.
    pub const RETRACTION: u8 = 1;
    /// The constant `RESPONSE`.
    pub const RESPONSE: u8 = 2;
    /// The constant `ACTIONS`.
    pub const ACTIONS: u8 = 3;
    /// The constant `PREFERENCE`.
    pub const PREFERENCE: u8 = 4;
    /// The constant `CRITIQUE`.
    pub const CRITIQUE: u8 = 5;
    /// The constant `HISTORY`.
    pub const HISTORY: u8 = 6;
    /// a table, when something else had named the weights before it, or things on it were moved
    pub const SCENE: u8 = 7;
    /// a world, when something else had named the weights before it
    pub const WORLD: u8 = 8;
}

impl crate::Message for EvidenceRecord {
    const TYPE: &'static str = "apprentice_msgs/msg/EvidenceRecord";
}

/// What a trajectory amounts to.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct FeatureTrajectory {
    /// unique within a session: the same id stands for the same features (`string`)
    pub id: std::string::String,
    /// one per weight: the sum over its steps, discounted as the reward is (`float64[]`)
    pub features: Vec<f64>,
}

impl crate::Message for FeatureTrajectory {
    const TYPE: &'static str = "apprentice_msgs/msg/FeatureTrajectory";
}

/// The best policy for one lambda.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub struct FrontierPoint {
    /// (`float64`)
    pub lambda: f64,
    /// as in RobustPolicy (`uint8`)
    pub outcome: u8,
    /// (`float64`)
    pub gap: f64,
    /// (`float64`)
    pub expected_return: f64,
    /// (`float64`)
    pub value_at_risk: f64,
    /// (`float64`)
    pub conditional_value_at_risk: f64,
}

impl crate::Message for FrontierPoint {
    const TYPE: &'static str = "apprentice_msgs/msg/FrontierPoint";
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

/// What somebody who was still learning did, in the order of time: a later attempt is probably the better one.
/// Idempotent: the same id with the same content counts once.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct LearnerHistory {
    /// (`std_msgs/Header`)
    pub header: super::std_msgs::Header,
    /// unique within a session (`string`)
    pub id: std::string::String,
    /// who: a node or a person (`string`)
    pub source: std::string::String,
    /// earliest first, two or more, each once; every pair is a weak preference (`FeatureTrajectory[]`)
    pub demonstrations: Vec<super::msg::FeatureTrajectory>,
    /// (`uint8`)
    pub confidence: u8,
}

impl LearnerHistory {
    /// The constant `CONFIDENCE_SURE`.
    pub const CONFIDENCE_SURE: u8 = 0;
    /// The constant `CONFIDENCE_FAIRLY`.
    pub const CONFIDENCE_FAIRLY: u8 = 1;
    /// The constant `CONFIDENCE_GUESS`.
    pub const CONFIDENCE_GUESS: u8 = 2;
}

impl crate::Message for LearnerHistory {
    const TYPE: &'static str = "apprentice_msgs/msg/LearnerHistory";
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
    /// active ones, and comparisons; about a world all pieces of evidence in force (`uint32`)
    pub demonstrations: u32,
    /// as in PlacementBound; about a world as in RiskBound (`uint8`)
    pub bound_outcome: u8,
    /// NaN without one (`float64`)
    pub bound_m: f64,
    /// (`float64`)
    pub epsilon_m: f64,
    /// about a world: bound on the normalised loss of the robot's policy; NaN without one (`float64`)
    pub loss_bound: f64,
    /// the lesson about a world ends below it; NaN when it is about a table (`float64`)
    pub epsilon_loss: f64,
    /// answers to questions that were drawn at random (`uint32`)
    pub held_out: u32,
    /// of these, how many were not expected; 1 in 10 is by chance (`uint32`)
    pub surprises: u32,
    /// answers to random questions, none of them a surprise, that the lesson still needs although its bound is good (`uint32`)
    pub to_confirm: u32,
    /// how probable answers as odd as those given are; NaN where that was not reckoned (`float64`)
    pub misfit_p: f64,
    /// when the state is MISFIT: ids of the evidence that fits worst (`string[]`)
    pub misfits: Vec<std::string::String>,
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
    /// nothing is asked until the person says start
    pub const PAUSED: u8 = 4;
    /// the person had said enough, and the bound is not below epsilon
    pub const FINISHED: u8 = 5;
    /// what was said cannot be explained with these features: more answers will not help
    pub const MISFIT: u8 = 6;
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

/// A place that was considered for the target, and what became of it.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct PlacementCandidate {
    /// metres in the table's frame (`geometry_msgs/Point`)
    pub position: super::geometry_msgs::Point,
    /// over the draws (`float64`)
    pub mean_reward: f64,
    /// share of the draws whose own best place is within 3 cm (`float64`)
    pub probability_best: f64,
    /// VaR of the distance to each draw's own best place (`float64`)
    pub var_m: f64,
    /// CVaR of it (`float64`)
    pub cvar_m: f64,
    /// from the target's outline to the nearest object, or edge of the table (`float64`)
    pub clearance_m: f64,
    /// (`uint8`)
    pub verdict: u8,
    /// the same in words (`string`)
    pub reason: std::string::String,
}

impl PlacementCandidate {
    /// The constant `CHOSEN`.
    pub const CHOSEN: u8 = 0;
    /// the arm cannot put the target there
    pub const UNREACHABLE: u8 = 1;
    /// the arm found no way there
    pub const NO_PATH: u8 = 2;
    /// it could be used, but a better one was
    pub const NEXT_BEST: u8 = 3;
    /// the arm reaches it, but would touch something
    pub const BLOCKED: u8 = 4;
}

impl crate::Message for PlacementCandidate {
    const TYPE: &'static str = "apprentice_msgs/msg/PlacementCandidate";
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

/// A place for the target that a question offers.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct PlacementOption {
    /// metres, in the question's scene (`geometry_msgs/Point`)
    pub placement: super::geometry_msgs::Point,
    /// what it amounts to there: what a TrajectoryPreference compares (`FeatureTrajectory`)
    pub trajectory: super::msg::FeatureTrajectory,
}

impl crate::Message for PlacementOption {
    const TYPE: &'static str = "apprentice_msgs/msg/PlacementOption";
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
    /// SHA-256 of the robot description (with SRDF and meshes, if any), hex; empty without one (`string`)
    pub robot_hash: std::string::String,
    /// where the arm stood; empty without a robot (`sensor_msgs/JointState`)
    pub start: super::sensor_msgs::JointState,
    /// (`uint8`)
    pub outcome: u8,
    /// (`string`)
    pub reason: std::string::String,
    /// best under the MAP weights, metres (`geometry_msgs/Point`)
    pub map_placement: super::geometry_msgs::Point,
    /// what the planner's choice prefers; where the trajectory ends (`geometry_msgs/Point`)
    pub robust_placement: super::geometry_msgs::Point,
    /// (`float64`)
    pub map_cvar_m: f64,
    /// (`float64`)
    pub robust_cvar_m: f64,
    /// (`float64`)
    pub alpha: f64,
    /// map, mean, var, cvar or most_likely: which place is taken of those in reach (`string`)
    pub choice: std::string::String,
    /// best first, those out of reach among them (`PlacementCandidate[]`)
    pub candidates: Vec<super::msg::PlacementCandidate>,
    /// the lesson is taught: the robot may move (`bool`)
    pub inside_bound: bool,
    /// the arm has to pick the target up; else it starts with the target in its hand (`bool`)
    pub picks: bool,
    /// where the target stands then: the middle of its base; not numbers where nobody knows (`geometry_msgs/Pose`)
    pub pick: super::geometry_msgs::Pose,
    /// empty-handed, from the start to the grasp; empty unless it picks (`trajectory_msgs/JointTrajectory`)
    pub approach: super::trajectory_msgs::JointTrajectory,
    /// with the target in the hand, to where it is let go (`trajectory_msgs/JointTrajectory`)
    pub trajectory: super::trajectory_msgs::JointTrajectory,
    /// empty-handed, away from it; empty without a gripper (`trajectory_msgs/JointTrajectory`)
    pub retreat: super::trajectory_msgs::JointTrajectory,
    /// where the gripper's joint is told to go to let the target in or out (`float64`)
    pub grip_open: f64,
    /// and to hold it; not numbers without a gripper (`float64`)
    pub grip: f64,
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
    /// where the arm is now, it touches something
    pub const START_IN_COLLISION: u8 = 5;
    /// in reach, but the arm would touch something at each free place
    pub const GOAL_IN_COLLISION: u8 = 6;
    /// placements stand, but nothing is heard of a joint that moves the tool
    pub const JOINTS_UNKNOWN: u8 = 7;
    /// a joint is beyond its limits
    pub const OUTSIDE_LIMITS: u8 = 8;
    /// placements stand, but the arm cannot pick the target up from where it stands
    pub const CANNOT_PICK: u8 = 9;
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

/// The open question about a table: where does the target belong in this scene, or in which of two places? Republished until it is
/// answered by a PlacementDemonstration in the scene, by a TrajectoryPreference of the two options, or by a QueryResponse.
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
    /// none: any place; two: which of these is better; the first, by lot, is called A (`PlacementOption[<=2]`)
    #[serde(deserialize_with = "crate::bounded::at_most::<_, _, 2>")]
    pub options: Vec<super::msg::PlacementOption>,
    /// nats: what the answer is expected to tell; NaN where it was not chosen by that (`float64`)
    pub gain: f64,
    /// of the person's time (`float64`)
    pub gain_per_second: f64,
    /// drawn at random, so that the answer is fair evidence against the model (`bool`)
    pub held_out: bool,
}

impl crate::Message for PlacementQuery {
    const TYPE: &'static str = "apprentice_msgs/msg/PlacementQuery";
}

/// How good and how wrong one policy may be.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct PolicyBound {
    /// (`string`)
    pub id: std::string::String,
    /// as in PolicyToJudge (`uint8`)
    pub form: u8,
    /// judged: given, computed from the policy, or the mean of the rollouts (`float64[]`)
    pub feature_counts: Vec<f64>,
    /// behind them; 0 when they are exact (`uint64`)
    pub n_rollouts: u64,
    /// of the mean return over the rollouts under the mean weights; NaN when it is exact or unknown (`float64`)
    pub rollout_standard_error: f64,
    /// lower bound on the (1 - alpha)-quantile of the return w.Phi (`RiskBound`)
    pub return_bound: super::msg::RiskBound,
    /// upper bound on the alpha-quantile of the loss V\* - w.Phi, V\* the best return in the world (`RiskBound`)
    pub loss_bound: super::msg::RiskBound,
    /// upper bound on the mean of the worst 1 - alpha of the losses (`RiskBound`)
    pub loss_cvar: super::msg::RiskBound,
    /// upper bound on the alpha-quantile of the loss over that of choosing actions at random (`RiskBound`)
    pub normalised_loss: super::msg::RiskBound,
    /// share of the rewards under which no other policy of the set has a higher return (`float64`)
    pub probability_best: f64,
    /// 1: the highest bound on the return (`uint32`)
    pub rank: u32,
    /// 1: the highest mean return (`uint32`)
    pub rank_by_mean: u32,
    /// a high mean and a low bound, in words; empty when there is nothing to warn of (`string`)
    pub warning: std::string::String,
}

impl crate::Message for PolicyBound {
    const TYPE: &'static str = "apprentice_msgs/msg/PolicyBound";
}

/// High-confidence bounds on the policies of a set, with their receipt.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct PolicyBounds {
    /// stamp of the posterior (`std_msgs/Header`)
    pub header: super::std_msgs::Header,
    /// of the posterior (`uint64`)
    pub revision: u64,
    /// (`string`)
    pub set_id: std::string::String,
    /// (`uint64`)
    pub set_number: u64,
    /// in which losses are measured; empty without one (`WorldReference`)
    pub world: super::msg::WorldReference,
    /// as in RiskBound: a bound only if every policy has one on its return (`uint8`)
    pub outcome: u8,
    /// in words: the claim, or "no bound, because …" and what it would take (`string`)
    pub reason: std::string::String,
    /// in the order of the set (`PolicyBound[]`)
    pub policies: Vec<super::msg::PolicyBound>,
    /// (`float64`)
    pub alpha: f64,
    /// (`float64`)
    pub delta: f64,
    /// how many posteriors the session has looked at, this one counted: revision + 1 (`uint64`)
    pub look: u64,
    /// on each bound of this look (`float64`)
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
    /// (`Rationality[]`)
    pub rationalities: Vec<super::msg::Rationality>,
    /// (`string`)
    pub prior: std::string::String,
    /// (`float64`)
    pub prior_scale: f64,
    /// (`string`)
    pub evidence_hash: std::string::String,
    /// (`uint64`)
    pub seed: u64,
    /// (`string`)
    pub version: std::string::String,
}

impl crate::Message for PolicyBounds {
    const TYPE: &'static str = "apprentice_msgs/msg/PolicyBounds";
}

/// What every lambda buys: expected return against the worst case (dissertation figure 7.3), of one posterior.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct PolicyFrontier {
    /// stamp of the posterior (`std_msgs/Header`)
    pub header: super::std_msgs::Header,
    /// of the posterior (`uint64`)
    pub revision: u64,
    /// (`string`)
    pub evidence_hash: std::string::String,
    /// (`WorldReference`)
    pub world: super::msg::WorldReference,
    /// as in RobustPolicy: the worst of the points' (`uint8`)
    pub outcome: u8,
    /// (`string`)
    pub reason: std::string::String,
    /// as in RobustPolicy (`uint8`)
    pub objective: u8,
    /// (`float64`)
    pub alpha: f64,
    /// (`uint64`)
    pub n_draws: u64,
    /// as in RobustPolicy (`uint32`)
    pub draws_used: u32,
    /// lambda ascending; empty without any (`FrontierPoint[]`)
    pub points: Vec<super::msg::FrontierPoint>,
    /// (`uint32`)
    pub n_states: u32,
    /// (`uint32`)
    pub n_actions: u32,
    /// points x n_states x n_actions, row-major; empty when that is more than 10,000 numbers (`float32[]`)
    pub policies: Vec<f32>,
    /// (`uint64`)
    pub seed: u64,
    /// (`string`)
    pub version: std::string::String,
}

impl crate::Message for PolicyFrontier {
    const TYPE: &'static str = "apprentice_msgs/msg/PolicyFrontier";
}

/// Policies to judge against each other under every posterior from now on, until the next set.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct PolicySet {
    /// (`std_msgs/Header`)
    pub header: super::std_msgs::Header,
    /// unique within a session (`string`)
    pub id: std::string::String,
    /// 1, 2, … within a session: bounds on the sets of a session share delta by it (`uint64`)
    pub number: u64,
    /// of tabular policies; may be empty when there are none (`string`)
    pub world_id: std::string::String,
    /// the policies were chosen by so many first draws of each chain: bounds are of the later ones alone (`uint32`)
    pub draws_used: u32,
    /// (`PolicyToJudge[]`)
    pub policies: Vec<super::msg::PolicyToJudge>,
}

impl crate::Message for PolicySet {
    const TYPE: &'static str = "apprentice_msgs/msg/PolicySet";
}

/// A policy, in one of three forms.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct PolicyToJudge {
    /// unique within a set (`string`)
    pub id: std::string::String,
    /// (`uint8`)
    pub form: u8,
    /// FEATURE_COUNTS: one per weight, discounted, over the initial states (`float64[]`)
    pub feature_counts: Vec<f64>,
    /// TABULAR and deterministic: one per state (`uint32[]`)
    pub actions: Vec<u32>,
    /// TABULAR and stochastic: n_states x n_actions, row-major (`float64[]`)
    pub action_probabilities: Vec<f64>,
    /// ROLLOUTS: their mean is judged (`FeatureTrajectory[]`)
    pub rollouts: Vec<super::msg::FeatureTrajectory>,
}

impl PolicyToJudge {
    /// what it is expected to collect
    pub const FEATURE_COUNTS: u8 = 0;
    /// what it does in each state of the world
    pub const TABULAR: u8 = 1;
    /// what it collected when it was run
    pub const ROLLOUTS: u8 = 2;
}

impl crate::Message for PolicyToJudge {
    const TYPE: &'static str = "apprentice_msgs/msg/PolicyToJudge";
}

/// Draws of the reward weights given the evidence.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct Posterior {
    /// stamp of the newest accepted evidence (`std_msgs/Header`)
    pub header: super::std_msgs::Header,
    /// number of accepted events (`uint64`)
    pub revision: u64,
    /// SHA-256 over the evidence in force, hex (`string`)
    pub evidence_hash: std::string::String,
    /// placements in force (`uint64`)
    pub n_demonstrations: u64,
    /// questions of this lesson answered or skipped so far, taken back or not (`uint64`)
    pub n_answers: u64,
    /// about the lesson itself, of what has not been taken back: stop before finish before the newest of the others (`uint8`)
    pub wish: u8,
    /// the table that the lesson is about, as it stands now; without objects and extent when it is about none (`TableScene`)
    pub task: super::msg::TableScene,
    /// of the newest placement in force, else the task (`TableScene`)
    pub scene: super::msg::TableScene,
    /// the world that the lesson is about; empty when it is about none (`WorldReference`)
    pub world: super::msg::WorldReference,
    /// (`uint8`)
    pub outcome: u8,
    /// (`string`)
    pub reason: std::string::String,
    /// one per weight; for a table object ids, then the fixed centres (`string[]`)
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
    /// rank-normalised split R-hat, worst over weights, learned betas and log-likelihood (`float64`)
    pub rhat_max: f64,
    /// (`float64`)
    pub ess_bulk_min: f64,
    /// (`float64`)
    pub ess_tail_min: f64,
    /// (`float64`)
    pub acceptance: f64,
    /// of placements (`float64`)
    pub beta: f64,
    /// every kind (`Rationality[]`)
    pub rationalities: Vec<super::msg::Rationality>,
    /// those whose beta is drawn, in the order of rationalities (`string[]`)
    pub learned_kinds: Vec<std::string::String>,
    /// n_draws x learned_kinds, row-major (`float32[]`)
    pub learned_betas: Vec<f32>,
    /// among the preferences in force (`PreferenceCycle[]`)
    pub cycles: Vec<super::msg::PreferenceCycle>,
    /// (`string`)
    pub prior: std::string::String,
    /// 0 for a prior on a sphere (`float64`)
    pub prior_scale: f64,
    /// (`uint64`)
    pub seed: u64,
    /// (`string`)
    pub version: std::string::String,
}

impl Posterior {
    /// The constant `NO_WISH`.
    pub const NO_WISH: u8 = 0;
    /// nothing is acceptable
    pub const STOP: u8 = 1;
    /// The constant `PAUSE`.
    pub const PAUSE: u8 = 2;
    /// The constant `START`.
    pub const START: u8 = 3;
    /// The constant `FINISH`.
    pub const FINISH: u8 = 4;
    /// The constant `READY`.
    pub const READY: u8 = 0;
    /// the chains disagree: see reason
    pub const NOT_MIXED: u8 = 1;
}

impl crate::Message for Posterior {
    const TYPE: &'static str = "apprentice_msgs/msg/Posterior";
}

/// An earlier posterior re-weighted by what was said since, while the next one is being computed. Nothing is computed
/// from it, and it does not change what the next one will be.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct PosteriorPreview {
    /// stamp of the newest accepted evidence (`std_msgs/Header`)
    pub header: super::std_msgs::Header,
    /// of the posterior that is being computed (`uint64`)
    pub revision: u64,
    /// of the posterior whose draws are re-weighted (`uint64`)
    pub base_revision: u64,
    /// as the next posterior will carry it (`string`)
    pub evidence_hash: std::string::String,
    /// (`uint8`)
    pub outcome: u8,
    /// (`string`)
    pub reason: std::string::String,
    /// weighted mean over the draws (`float64[]`)
    pub mean_weights: Vec<f64>,
    /// of all evidence in force, weighted mean over the draws (`float64`)
    pub expected_log_likelihood: f64,
    /// shape of the tail of the weights (Pareto); above 0.7 they are not to be relied on (`float64`)
    pub khat: f64,
    /// of the weights: squared sum over sum of squares (`float64`)
    pub effective_size: f64,
    /// draws that were re-weighted, evenly spread over the posterior's (`uint32`)
    pub n_draws: u32,
    /// (`uint64`)
    pub seed: u64,
    /// (`string`)
    pub version: std::string::String,
}

impl PosteriorPreview {
    /// The constant `READY`.
    pub const READY: u8 = 0;
    /// the new evidence moves the posterior too far for the old draws: see reason
    pub const UNRELIABLE: u8 = 1;
}

impl crate::Message for PosteriorPreview {
    const TYPE: &'static str = "apprentice_msgs/msg/PosteriorPreview";
}

/// Trajectories that were said to be better than each other all around: answers that cannot all be right.
#[derive(Debug, Clone, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct PreferenceCycle {
    /// ids; each was called worse than the next one, and the last worse than the first (`string[]`)
    pub trajectories: Vec<std::string::String>,
}

impl crate::Message for PreferenceCycle {
    const TYPE: &'static str = "apprentice_msgs/msg/PreferenceCycle";
}

/// An answer to a question that shows nothing, or a word about the lesson itself, which needs no question.
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
    /// ask nothing until START comes, or this is taken back
    pub const PAUSE: u8 = 3;
    /// begin to ask, or go on
    pub const START: u8 = 4;
    /// the person has said enough: the lesson ends with what is known
    pub const FINISH: u8 = 5;
    /// what was said before counts no more, unless this is taken back
    pub const NEW_LESSON: u8 = 6;
}

impl crate::Message for QueryResponse {
    const TYPE: &'static str = "apprentice_msgs/msg/QueryResponse";
}

/// How rational one kind of evidence is taken to be: answers follow returns times beta.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct Rationality {
    /// placements, actions, preferences, critiques or progress (`string`)
    pub kind: std::string::String,
    /// pieces of evidence of this kind in force (`uint64`)
    pub n: u64,
    /// of beta; its value when it is fixed (`float64`)
    pub prior_median: f64,
    /// standard deviation of log beta before any evidence; 0: beta is fixed (`float64`)
    pub prior_log_sd: f64,
    /// of the draws; the median of the prior when it is fixed (`float64`)
    pub mean: f64,
    /// (`float64`)
    pub quantile_05: f64,
    /// (`float64`)
    pub quantile_95: f64,
    /// share of answers taken to be given at random (`float64`)
    pub wrong_rate: f64,
}

impl crate::Message for Rationality {
    const TYPE: &'static str = "apprentice_msgs/msg/Rationality";
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

/// A confidence bound on a measure of risk over the rewards that fit the evidence, and the figures it rests on.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct RiskBound {
    /// (`uint8`)
    pub outcome: u8,
    /// "no bound, because …"; empty with one (`string`)
    pub reason: std::string::String,
    /// NaN without one (`float64`)
    pub bound: f64,
    /// the measure of the draws (`float64`)
    pub point_estimate: f64,
    /// of the draws (`float64`)
    pub mean: f64,
    /// draws (`uint64`)
    pub n: u64,
    /// effective draws in the tail (`float64`)
    pub ess: f64,
    /// (`float64`)
    pub rhat: f64,
    /// effective draws that a bound takes (`uint64`)
    pub needed: u64,
    /// by how much probability the bound looks further into the tail than the estimate does (`float64`)
    pub shift: f64,
}

impl RiskBound {
    /// The constant `BOUND`.
    pub const BOUND: u8 = 0;
    /// The constant `NOT_ENOUGH_SAMPLES`.
    pub const NOT_ENOUGH_SAMPLES: u8 = 1;
    /// the chains disagree
    pub const NOT_MIXED: u8 = 2;
    /// for want of something other than draws
    pub const NOT_JUDGED: u8 = 3;
    /// what may be arbitrarily bad has no bound on the mean of its tail
    pub const UNBOUNDED: u8 = 4;
}

impl crate::Message for RiskBound {
    const TYPE: &'static str = "apprentice_msgs/msg/RiskBound";
}

/// How cautious the robot is to be. Of all that were said the one with the largest number counts, of equal numbers the larger id.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct RiskPreference {
    /// (`std_msgs/Header`)
    pub header: super::std_msgs::Header,
    /// unique within a session (`string`)
    pub id: std::string::String,
    /// who: a node or a person (`string`)
    pub source: std::string::String,
    /// one more than the number of the newest RobustPolicy, or of one's own last preference (`uint64`)
    pub number: u64,
    /// from 0, only the worst case counts, to 1, only the mean counts (`float64`)
    pub lambda: f64,
}

impl crate::Message for RiskPreference {
    const TYPE: &'static str = "apprentice_msgs/msg/RiskPreference";
}

/// The policy to follow while the reward is uncertain: it makes (1 - lambda) CVaR_alpha(psi) + lambda E(return) largest, where
/// CVaR is the mean of the worst 1 - alpha of the rewards that fit the evidence. Published again when the posterior or lambda changes.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct RobustPolicy {
    /// stamp of the posterior (`std_msgs/Header`)
    pub header: super::std_msgs::Header,
    /// of the posterior (`uint64`)
    pub revision: u64,
    /// (`string`)
    pub evidence_hash: std::string::String,
    /// (`WorldReference`)
    pub world: super::msg::WorldReference,
    /// (`uint8`)
    pub outcome: u8,
    /// in words: what the policy promises, or why there is none and what it would take (`string`)
    pub reason: std::string::String,
    /// (`uint8`)
    pub objective: u8,
    /// (`float64`)
    pub alpha: f64,
    /// 0: only the worst case counts; 1: only the mean (`float64`)
    pub lambda: f64,
    /// of the RiskPreference that chose lambda; 0: the parameter (`uint64`)
    pub preference_number: u64,
    /// of it; empty: the parameter (`string`)
    pub preference_id: std::string::String,
    /// (`uint8`)
    pub method: u8,
    /// what the solver said last (`string`)
    pub status: std::string::String,
    /// (`uint64`)
    pub rounds: u64,
    /// of the policy (`float64`)
    pub objective_value: f64,
    /// no policy's objective is larger by more than this; NaN without a policy, as are the next three (`float64`)
    pub gap: f64,
    /// (`float64`)
    pub expected_return: f64,
    /// alpha of the draws have a larger psi (`float64`)
    pub value_at_risk: f64,
    /// (`float64`)
    pub conditional_value_at_risk: f64,
    /// that it was chosen by (`uint64`)
    pub n_draws: u64,
    /// of each chain, the first; the later ones judge it. 0: all, and none judge it (`uint32`)
    pub draws_used: u32,
    /// these later draws, of all chains (`uint64`)
    pub held_out: u64,
    /// of psi over these; NaN without them, as are the next four (`float64`)
    pub held_out_mean: f64,
    /// of psi over these (`float64`)
    pub held_out_cvar: f64,
    /// confidence interval of it (`float64`)
    pub held_out_cvar_low: f64,
    /// (`float64`)
    pub held_out_cvar_high: f64,
    /// of the interval (`float64`)
    pub confidence: f64,
    /// (`uint32`)
    pub n_states: u32,
    /// (`uint32`)
    pub n_actions: u32,
    /// n_states x n_actions, row-major; empty without a policy (`float64[]`)
    pub action_probabilities: Vec<f64>,
    /// discounted visits of each state: times a row above, the occupancy; 0 where it never comes (`float32[]`)
    pub visits: Vec<f32>,
    /// expected, discounted: one per weight (`float64[]`)
    pub feature_counts: Vec<f64>,
    /// (`uint64`)
    pub seed: u64,
    /// (`string`)
    pub version: std::string::String,
}

impl RobustPolicy {
    /// proved: no policy is better by more than gap
    pub const OPTIMAL: u8 = 0;
    /// the solver came no closer than gap
    pub const INACCURATE: u8 = 1;
    /// the steps allowed did not suffice: see gap
    pub const ITERATION_LIMIT: u8 = 2;
    /// The constant `TIMED_OUT`.
    pub const TIMED_OUT: u8 = 3;
    /// The constant `INFEASIBLE`.
    pub const INFEASIBLE: u8 = 4;
    /// The constant `UNBOUNDED`.
    pub const UNBOUNDED: u8 = 5;
    /// what the solver gave is no policy
    pub const CONSTRAINTS_VIOLATED: u8 = 6;
    /// something is missing or wrong: see reason
    pub const NOT_COMPUTED: u8 = 7;
    /// psi = return
    pub const ROBUST: u8 = 0;
    /// psi = return less what the demonstrations in force return
    pub const REGRET: u8 = 1;
    /// psi = return less the best return of each reward
    pub const EVD: u8 = 2;
    /// one linear program
    pub const DIRECT: u8 = 0;
    /// The constant `COLUMN_GENERATION`.
    pub const COLUMN_GENERATION: u8 = 1;
}

impl crate::Message for RobustPolicy {
    const TYPE: &'static str = "apprentice_msgs/msg/RobustPolicy";
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

/// A person marks what is good and what is bad in a trajectory of a world; what is not marked says nothing.
/// Idempotent: the same id with the same content counts once.
#[derive(Debug, Clone, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct SegmentCritique {
    /// (`std_msgs/Header`)
    pub header: super::std_msgs::Header,
    /// unique within a session (`string`)
    pub id: std::string::String,
    /// the asker's question; empty: volunteered (`string`)
    pub query_id: std::string::String,
    /// who: a node or a person (`string`)
    pub source: std::string::String,
    /// (`string`)
    pub world_id: std::string::String,
    /// the trajectory (`uint32[]`)
    pub states: Vec<u32>,
    /// taken in each of its states (`uint32[]`)
    pub actions: Vec<u32>,
    /// one or more, none overlapping another (`CritiqueSegment[]`)
    pub segments: Vec<super::msg::CritiqueSegment>,
    /// (`uint8`)
    pub confidence: u8,
}

impl SegmentCritique {
    /// The constant `CONFIDENCE_SURE`.
    pub const CONFIDENCE_SURE: u8 = 0;
    /// The constant `CONFIDENCE_FAIRLY`.
    pub const CONFIDENCE_FAIRLY: u8 = 1;
    /// The constant `CONFIDENCE_GUESS`.
    pub const CONFIDENCE_GUESS: u8 = 2;
}

impl crate::Message for SegmentCritique {
    const TYPE: &'static str = "apprentice_msgs/msg/SegmentCritique";
}

/// Where the arm can put the target on the bare table.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct TableReach {
    /// the frame of the table; no stamp (`std_msgs/Header`)
    pub header: super::std_msgs::Header,
    /// which arm, as in PlacementPlan (`string`)
    pub robot_hash: std::string::String,
    /// (`string`)
    pub target_id: std::string::String,
    /// of the table (`float64`)
    pub width_m: f64,
    /// (`float64`)
    pub depth_m: f64,
    /// cells per axis; 0: not known, see reason (`uint32`)
    pub side: u32,
    /// side x side, row-major, the first row nearest to the robot (`bool[]`)
    pub reachable: Vec<bool>,
    /// (`string`)
    pub reason: std::string::String,
}

impl crate::Message for TableReach {
    const TYPE: &'static str = "apprentice_msgs/msg/TableReach";
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

/// A Markov decision process without a reward: what demonstrated actions and policies are about. Return = sum of
/// gamma^t w.phi over t = 0, 1, …; a state without transitions is terminal, and its features count once.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct TabularWorld {
    /// (`std_msgs/Header`)
    pub header: super::std_msgs::Header,
    /// unique within a session (`string`)
    pub id: std::string::String,
    /// discount, 0 or more and below 1 (`float64`)
    pub gamma: f64,
    /// (`uint32`)
    pub n_states: u32,
    /// (`uint32`)
    pub n_actions: u32,
    /// one per weight (`string[]`)
    pub feature_names: Vec<std::string::String>,
    /// one per action; empty: numbers (`string[]`)
    pub action_names: Vec<std::string::String>,
    /// probability of starting in each state (`float64[]`)
    pub initial: Vec<f64>,
    /// transitions, in four arrays of equal length (`uint32[]`)
    pub from_state: Vec<u32>,
    /// (`uint32[]`)
    pub action: Vec<u32>,
    /// (`uint32[]`)
    pub to_state: Vec<u32>,
    /// of each state and action that has any, they sum to 1 (`float64[]`)
    pub probability: Vec<f64>,
    /// (`uint8`)
    pub features_of: u8,
    /// (`float64[]`)
    pub features: Vec<f64>,
    /// two numbers for pictures; empty: none (`uint32[<=2]`)
    #[serde(deserialize_with = "crate::bounded::at_most::<_, _, 2>")]
    pub shape: Vec<u32>,
    /// what they count (`uint8`)
    pub shape_of: u8,
}

impl TabularWorld {
    /// n_states x features, row-major
    pub const STATE_FEATURES: u8 = 0;
    /// (n_states n_actions) x features, row state n_actions + action
    pub const STATE_ACTION_FEATURES: u8 = 1;
    /// shape: rows and columns of a grid of states, row by row
    pub const CELLS: u8 = 0;
    /// shape: lanes, the outer two off the road, and places of traffic, the farthest ahead first;
    pub const ROAD: u8 = 1;
}

impl crate::Message for TabularWorld {
    const TYPE: &'static str = "apprentice_msgs/msg/TabularWorld";
}

/// Which of several trajectories is better. Idempotent: the same id with the same content counts once.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct TrajectoryPreference {
    /// (`std_msgs/Header`)
    pub header: super::std_msgs::Header,
    /// unique within a session (`string`)
    pub id: std::string::String,
    /// the asker's question; empty: volunteered (`string`)
    pub query_id: std::string::String,
    /// who: a node or a person (`string`)
    pub source: std::string::String,
    /// two or more, each once (`FeatureTrajectory[]`)
    pub trajectories: Vec<super::msg::FeatureTrajectory>,
    /// (`uint8`)
    pub answer: u8,
    /// (`uint8`)
    pub confidence: u8,
}

impl TrajectoryPreference {
    /// worst first; with more than two, every pair counts
    pub const RANKED: u8 = 0;
    /// about equally good; with more than two, every pair is
    pub const EQUAL: u8 = 1;
    /// no opinion, which says something about how rational the answers are
    pub const CANT_TELL: u8 = 2;
    /// The constant `CONFIDENCE_SURE`.
    pub const CONFIDENCE_SURE: u8 = 0;
    /// The constant `CONFIDENCE_FAIRLY`.
    pub const CONFIDENCE_FAIRLY: u8 = 1;
    /// The constant `CONFIDENCE_GUESS`.
    pub const CONFIDENCE_GUESS: u8 = 2;
}

impl crate::Message for TrajectoryPreference {
    const TYPE: &'static str = "apprentice_msgs/msg/TrajectoryPreference";
}

/// The open question about a world. Republished until evidence with its id answers it, or a QueryResponse.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct WorldQuery {
    /// stamp of the posterior (`std_msgs/Header`)
    pub header: super::std_msgs::Header,
    /// (`string`)
    pub id: std::string::String,
    /// of the evidence that it asks to add to (`uint64`)
    pub revision: u64,
    /// 0: chosen by the posterior of its revision; n: by that of n revisions before, whose answers were not learned from (`uint32`)
    pub ahead: u32,
    /// (`WorldReference`)
    pub world: super::msg::WorldReference,
    /// (`uint8`)
    pub kind: u8,
    /// that it is about; where the trajectories begin (`uint32`)
    pub state: u32,
    /// none, one or two by kind; the first of two, by lot, is shown on the left (`WorldTrajectory[<=2]`)
    #[serde(deserialize_with = "crate::bounded::at_most::<_, _, 2>")]
    pub trajectories: Vec<super::msg::WorldTrajectory>,
    /// what is asked, and why, in words (`string`)
    pub reason: std::string::String,
    /// from the state on the MAP policy loses no more than this under alpha of the rewards that fit (`float64`)
    pub value_at_risk: f64,
    /// (`float64`)
    pub alpha: f64,
    /// nats: what the answer is expected to tell; NaN where it was not chosen by that (`float64`)
    pub gain: f64,
    /// of the person's time (`float64`)
    pub gain_per_second: f64,
    /// drawn at random, so that the answer is fair evidence against the model (`bool`)
    pub held_out: bool,
    /// how many questions it was chosen from (`uint32`)
    pub n_candidates: u32,
    /// on the normalised loss of the robot's policy; NaN without one (`float64`)
    pub loss_bound: f64,
    /// the lesson ends below it (`float64`)
    pub epsilon_loss: f64,
}

impl WorldQuery {
    /// what to do in the state; answered by an ActionDemonstration of that state
    pub const ACTION: u8 = 0;
    /// what is good and what is bad in the trajectory; answered by a SegmentCritique of it
    pub const CRITIQUE: u8 = 1;
    /// which of the two trajectories is better; answered by a TrajectoryPreference of the two
    pub const COMPARISON: u8 = 2;
}

impl crate::Message for WorldQuery {
    const TYPE: &'static str = "apprentice_msgs/msg/WorldQuery";
}

/// Which TabularWorld; the world itself is on the topics \`world\` and \`lesson_world\`.
#[derive(Debug, Clone, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct WorldReference {
    /// (`string`)
    pub id: std::string::String,
    /// SHA-256 of the message without its header, hex (`string`)
    pub hash: std::string::String,
}

impl crate::Message for WorldReference {
    const TYPE: &'static str = "apprentice_msgs/msg/WorldReference";
}

/// A trajectory of a world that a question shows.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct WorldTrajectory {
    /// unique within a session; of the FeatureTrajectory that stands for it in an answer (`string`)
    pub id: std::string::String,
    /// (`uint32[]`)
    pub states: Vec<u32>,
    /// taken in each of the states (`uint32[]`)
    pub actions: Vec<u32>,
    /// one per weight, as in FeatureTrajectory (`float64[]`)
    pub features: Vec<f64>,
}

impl crate::Message for WorldTrajectory {
    const TYPE: &'static str = "apprentice_msgs/msg/WorldTrajectory";
}
