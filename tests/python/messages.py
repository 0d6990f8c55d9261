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
class PlacementQuery(IdlStruct, typename="apprentice_msgs::msg::dds_::PlacementQuery_"):
    header: Header = field(default_factory=Header)
    id: str = ""
    revision: uint64 = 0
    scene: TableScene = field(default_factory=TableScene)
    reason: str = ""
    bound_m: float64 = 0.0
    epsilon_m: float64 = 0.0
    n_candidates: uint32 = 0


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
class Posterior(IdlStruct, typename="apprentice_msgs::msg::dds_::Posterior_"):
    header: Header = field(default_factory=Header)
    revision: uint64 = 0
    evidence_hash: str = ""
    n_demonstrations: uint64 = 0
    n_answers: uint64 = 0
    stopped: bool = False
    task: TableScene = field(default_factory=TableScene)
    scene: TableScene = field(default_factory=TableScene)
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
    prior: str = ""
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
