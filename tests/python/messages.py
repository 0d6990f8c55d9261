"""Some of the messages as a DDS program that knows nothing of ROS declares them: names and members by ROS's mapping."""

from dataclasses import dataclass, field

from cyclonedds.idl import IdlStruct
from cyclonedds.idl.annotations import final
from cyclonedds.idl.types import (
    float32,
    float64,
    int32,
    sequence,
    uint8,
    uint32,
    uint64,
)


@dataclass
@final
class Time(IdlStruct, typename="builtin_interfaces::msg::dds_::Time_"):
    sec: int32 = 0
    nanosec: uint32 = 0


@dataclass
@final
class Header(IdlStruct, typename="std_msgs::msg::dds_::Header_"):
    stamp: Time = field(default_factory=Time)
    frame_id: str = ""


@dataclass
@final
class Point(IdlStruct, typename="geometry_msgs::msg::dds_::Point_"):
    x: float64 = 0.0
    y: float64 = 0.0
    z: float64 = 0.0


@dataclass
@final
class Vector3(IdlStruct, typename="geometry_msgs::msg::dds_::Vector3_"):
    x: float64 = 0.0
    y: float64 = 0.0
    z: float64 = 0.0


@dataclass
@final
class Quaternion(IdlStruct, typename="geometry_msgs::msg::dds_::Quaternion_"):
    x: float64 = 0.0
    y: float64 = 0.0
    z: float64 = 0.0
    w: float64 = 1.0


@dataclass
@final
class Pose(IdlStruct, typename="geometry_msgs::msg::dds_::Pose_"):
    position: Point = field(default_factory=Point)
    orientation: Quaternion = field(default_factory=Quaternion)


@dataclass
@final
class SceneObject(IdlStruct, typename="apprentice_msgs::msg::dds_::SceneObject_"):
    id: str = ""
    label: str = ""
    shape: uint8 = 0
    size_m: Vector3 = field(default_factory=Vector3)
    pose: Pose = field(default_factory=Pose)
    supports: bool = False


@dataclass
@final
class TableScene(IdlStruct, typename="apprentice_msgs::msg::dds_::TableScene_"):
    header: Header = field(default_factory=Header)
    id: str = ""
    width_m: float64 = 0.0
    depth_m: float64 = 0.0
    objects: sequence[SceneObject] = field(default_factory=list)
    target: SceneObject = field(default_factory=SceneObject)


@dataclass
@final
class PlacementDemonstration(IdlStruct, typename="apprentice_msgs::msg::dds_::PlacementDemonstration_"):
    header: Header = field(default_factory=Header)
    id: str = ""
    query_id: str = ""
    source: str = ""
    scene: TableScene = field(default_factory=TableScene)
    placement: Point = field(default_factory=Point)
    confidence: uint8 = 0


@dataclass
@final
class FeatureTrajectory(IdlStruct, typename="apprentice_msgs::msg::dds_::FeatureTrajectory_"):
    id: str = ""
    features: sequence[float64] = field(default_factory=list)


@dataclass
@final
class PlacementOption(IdlStruct, typename="apprentice_msgs::msg::dds_::PlacementOption_"):
    placement: Point = field(default_factory=Point)
    trajectory: FeatureTrajectory = field(default_factory=FeatureTrajectory)


@dataclass
@final
class PlacementQuery(IdlStruct, typename="apprentice_msgs::msg::dds_::PlacementQuery_"):
    header: Header = field(default_factory=Header)
    id: str = ""
    revision: uint64 = 0
    scene: TableScene = field(default_factory=TableScene)
    reason: str = ""
    bound_m: float64 = 0.0
    epsilon_m: float64 = 0.0
    n_candidates: uint32 = 0
    options: sequence[PlacementOption, 2] = field(default_factory=list)
    gain: float64 = 0.0
    gain_per_second: float64 = 0.0
    held_out: bool = False


@dataclass
@final
class EvidenceReceipt(IdlStruct, typename="apprentice_msgs::msg::dds_::EvidenceReceipt_"):
    header: Header = field(default_factory=Header)
    id: str = ""
    outcome: uint8 = 0
    reason: str = ""
    revision: uint64 = 0


@dataclass
@final
class Retraction(IdlStruct, typename="apprentice_msgs::msg::dds_::Retraction_"):
    header: Header = field(default_factory=Header)
    id: str = ""
    evidence_id: str = ""
    source: str = ""
    reason: str = ""


@dataclass
@final
class TabularWorld(IdlStruct, typename="apprentice_msgs::msg::dds_::TabularWorld_"):
    header: Header = field(default_factory=Header)
    id: str = ""
    gamma: float64 = 0.0
    n_states: uint32 = 0
    n_actions: uint32 = 0
    feature_names: sequence[str] = field(default_factory=list)
    action_names: sequence[str] = field(default_factory=list)
    initial: sequence[float64] = field(default_factory=list)
    from_state: sequence[uint32] = field(default_factory=list)
    action: sequence[uint32] = field(default_factory=list)
    to_state: sequence[uint32] = field(default_factory=list)
    probability: sequence[float64] = field(default_factory=list)
    features_of: uint8 = 0
    features: sequence[float64] = field(default_factory=list)
    shape: sequence[uint32, 2] = field(default_factory=list)
    shape_of: uint8 = 0


@dataclass
@final
class WorldReference(IdlStruct, typename="apprentice_msgs::msg::dds_::WorldReference_"):
    id: str = ""
    hash: str = ""


@dataclass
@final
class ActionDemonstration(IdlStruct, typename="apprentice_msgs::msg::dds_::ActionDemonstration_"):
    header: Header = field(default_factory=Header)
    id: str = ""
    query_id: str = ""
    source: str = ""
    world_id: str = ""
    states: sequence[uint32] = field(default_factory=list)
    actions: sequence[uint32] = field(default_factory=list)
    confidence: uint8 = 0


@dataclass
@final
class TrajectoryPreference(IdlStruct, typename="apprentice_msgs::msg::dds_::TrajectoryPreference_"):
    header: Header = field(default_factory=Header)
    id: str = ""
    query_id: str = ""
    source: str = ""
    trajectories: sequence[FeatureTrajectory] = field(default_factory=list)
    answer: uint8 = 0
    confidence: uint8 = 0


@dataclass
@final
class CritiqueSegment(IdlStruct, typename="apprentice_msgs::msg::dds_::CritiqueSegment_"):
    start: uint32 = 0
    end: uint32 = 0
    verdict: uint8 = 0


@dataclass
@final
class SegmentCritique(IdlStruct, typename="apprentice_msgs::msg::dds_::SegmentCritique_"):
    header: Header = field(default_factory=Header)
    id: str = ""
    query_id: str = ""
    source: str = ""
    world_id: str = ""
    states: sequence[uint32] = field(default_factory=list)
    actions: sequence[uint32] = field(default_factory=list)
    segments: sequence[CritiqueSegment] = field(default_factory=list)
    confidence: uint8 = 0


@dataclass
@final
class LearnerHistory(IdlStruct, typename="apprentice_msgs::msg::dds_::LearnerHistory_"):
    header: Header = field(default_factory=Header)
    id: str = ""
    source: str = ""
    demonstrations: sequence[FeatureTrajectory] = field(default_factory=list)
    confidence: uint8 = 0


@dataclass
@final
class PolicyToJudge(IdlStruct, typename="apprentice_msgs::msg::dds_::PolicyToJudge_"):
    id: str = ""
    form: uint8 = 0
    feature_counts: sequence[float64] = field(default_factory=list)
    actions: sequence[uint32] = field(default_factory=list)
    action_probabilities: sequence[float64] = field(default_factory=list)
    rollouts: sequence[FeatureTrajectory] = field(default_factory=list)


@dataclass
@final
class PolicySet(IdlStruct, typename="apprentice_msgs::msg::dds_::PolicySet_"):
    header: Header = field(default_factory=Header)
    id: str = ""
    number: uint64 = 0
    world_id: str = ""
    draws_used: uint32 = 0
    policies: sequence[PolicyToJudge] = field(default_factory=list)


@dataclass
@final
class Rationality(IdlStruct, typename="apprentice_msgs::msg::dds_::Rationality_"):
    kind: str = ""
    n: uint64 = 0
    prior_median: float64 = 0.0
    prior_log_sd: float64 = 0.0
    mean: float64 = 0.0
    quantile_05: float64 = 0.0
    quantile_95: float64 = 0.0
    wrong_rate: float64 = 0.0


@dataclass
@final
class PreferenceCycle(IdlStruct, typename="apprentice_msgs::msg::dds_::PreferenceCycle_"):
    trajectories: sequence[str] = field(default_factory=list)


@dataclass
@final
class Posterior(IdlStruct, typename="apprentice_msgs::msg::dds_::Posterior_"):
    header: Header = field(default_factory=Header)
    revision: uint64 = 0
    evidence_hash: str = ""
    n_demonstrations: uint64 = 0
    n_answers: uint64 = 0
    wish: uint8 = 0
    task: TableScene = field(default_factory=TableScene)
    scene: TableScene = field(default_factory=TableScene)
    world: WorldReference = field(default_factory=WorldReference)
    outcome: uint8 = 0
    reason: str = ""
    feature_names: sequence[str] = field(default_factory=list)
    n_chains: uint32 = 0
    n_draws: uint32 = 0
    draws: sequence[float32] = field(default_factory=list)
    map_weights: sequence[float64] = field(default_factory=list)
    map_log_likelihood: float64 = 0.0
    log_likelihood_mean: float64 = 0.0
    rhat_max: float64 = 0.0
    ess_bulk_min: float64 = 0.0
    ess_tail_min: float64 = 0.0
    acceptance: float64 = 0.0
    beta: float64 = 0.0
    rationalities: sequence[Rationality] = field(default_factory=list)
    learned_kinds: sequence[str] = field(default_factory=list)
    learned_betas: sequence[float32] = field(default_factory=list)
    cycles: sequence[PreferenceCycle] = field(default_factory=list)
    prior: str = ""
    prior_scale: float64 = 0.0
    seed: uint64 = 0
    version: str = ""


@dataclass
@final
class RiskBound(IdlStruct, typename="apprentice_msgs::msg::dds_::RiskBound_"):
    outcome: uint8 = 0
    reason: str = ""
    bound: float64 = 0.0
    point_estimate: float64 = 0.0
    mean: float64 = 0.0
    n: uint64 = 0
    ess: float64 = 0.0
    rhat: float64 = 0.0
    needed: uint64 = 0
    shift: float64 = 0.0


@dataclass
@final
class PolicyBound(IdlStruct, typename="apprentice_msgs::msg::dds_::PolicyBound_"):
    id: str = ""
    form: uint8 = 0
    feature_counts: sequence[float64] = field(default_factory=list)
    n_rollouts: uint64 = 0
    rollout_standard_error: float64 = 0.0
    return_bound: RiskBound = field(default_factory=RiskBound)
    loss_bound: RiskBound = field(default_factory=RiskBound)
    loss_cvar: RiskBound = field(default_factory=RiskBound)
    normalised_loss: RiskBound = field(default_factory=RiskBound)
    probability_best: float64 = 0.0
    rank: uint32 = 0
    rank_by_mean: uint32 = 0
    warning: str = ""


@dataclass
@final
class PolicyBounds(IdlStruct, typename="apprentice_msgs::msg::dds_::PolicyBounds_"):
    header: Header = field(default_factory=Header)
    revision: uint64 = 0
    set_id: str = ""
    set_number: uint64 = 0
    world: WorldReference = field(default_factory=WorldReference)
    outcome: uint8 = 0
    reason: str = ""
    policies: sequence[PolicyBound] = field(default_factory=list)
    alpha: float64 = 0.0
    delta: float64 = 0.0
    look: uint64 = 0
    delta_spent: float64 = 0.0
    n: uint64 = 0
    n_chains: uint32 = 0
    ess_min: float64 = 0.0
    rhat_max: float64 = 0.0
    acceptance: float64 = 0.0
    rationalities: sequence[Rationality] = field(default_factory=list)
    prior: str = ""
    prior_scale: float64 = 0.0
    evidence_hash: str = ""
    seed: uint64 = 0
    version: str = ""


@dataclass
@final
class PlacementBound(IdlStruct, typename="apprentice_msgs::msg::dds_::PlacementBound_"):
    scene_id: str = ""
    outcome: uint8 = 0
    placement: Point = field(default_factory=Point)
    bound_m: float64 = 0.0
    point_estimate_m: float64 = 0.0
    cvar_m: float64 = 0.0
    mean_m: float64 = 0.0
    n: uint64 = 0
    ess: float64 = 0.0
    rhat: float64 = 0.0
    index: uint64 = 0
    needed: uint64 = 0


@dataclass
@final
class PerformanceBounds(IdlStruct, typename="apprentice_msgs::msg::dds_::PerformanceBounds_"):
    header: Header = field(default_factory=Header)
    revision: uint64 = 0
    outcome: uint8 = 0
    reason: str = ""
    bound_m: float64 = 0.0
    worst: uint32 = 0
    bounds: sequence[PlacementBound] = field(default_factory=list)
    alpha: float64 = 0.0
    delta: float64 = 0.0
    look: uint64 = 0
    delta_spent: float64 = 0.0
    n: uint64 = 0
    n_chains: uint32 = 0
    ess_min: float64 = 0.0
    rhat_max: float64 = 0.0
    acceptance: float64 = 0.0
    beta: float64 = 0.0
    prior: str = ""
    evidence_hash: str = ""
    seed: uint64 = 0
    version: str = ""
