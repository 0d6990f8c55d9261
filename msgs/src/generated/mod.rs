//! All interfaces, and the texts they were generated from.
//!
//! Generated: do not edit. To write it anew: `cargo run --release -p apprentice_msgs --example generate`.

pub mod action;
pub mod action_msgs;
pub mod builtin_interfaces;
pub mod control_msgs;
pub mod diagnostic_msgs;
pub mod geometry_msgs;
pub mod moveit_msgs;
pub mod msg;
pub mod object_recognition_msgs;
pub mod octomap_msgs;
pub mod rcl_interfaces;
pub mod rosgraph_msgs;
pub mod sensor_msgs;
pub mod shape_msgs;
pub mod srv;
pub mod std_msgs;
pub mod std_srvs;
pub mod tf2_msgs;
pub mod trajectory_msgs;
pub mod unique_identifier_msgs;
pub mod vision_msgs;
pub mod visualization_msgs;

/// Names of all messages, sorted.
pub(crate) const MESSAGES: &[&str] = &[
    "action_msgs/msg/GoalInfo",
    "action_msgs/msg/GoalStatus",
    "action_msgs/msg/GoalStatusArray",
    "apprentice_msgs/msg/ActionDemonstration",
    "apprentice_msgs/msg/ArmModel",
    "apprentice_msgs/msg/ArmMotion",
    "apprentice_msgs/msg/ArmPart",
    "apprentice_msgs/msg/ArmPose",
    "apprentice_msgs/msg/Candidates",
    "apprentice_msgs/msg/Carrying",
    "apprentice_msgs/msg/CritiqueSegment",
    "apprentice_msgs/msg/EvidenceLog",
    "apprentice_msgs/msg/EvidenceReceipt",
    "apprentice_msgs/msg/EvidenceRecord",
    "apprentice_msgs/msg/FeatureTrajectory",
    "apprentice_msgs/msg/FrontierPoint",
    "apprentice_msgs/msg/Heartbeat",
    "apprentice_msgs/msg/LearnerHistory",
    "apprentice_msgs/msg/LessonStatus",
    "apprentice_msgs/msg/NodeSettings",
    "apprentice_msgs/msg/PerformanceBounds",
    "apprentice_msgs/msg/PlacementBound",
    "apprentice_msgs/msg/PlacementCandidate",
    "apprentice_msgs/msg/PlacementDemonstration",
    "apprentice_msgs/msg/PlacementOption",
    "apprentice_msgs/msg/PlacementPlan",
    "apprentice_msgs/msg/PlacementQuery",
    "apprentice_msgs/msg/PolicyBound",
    "apprentice_msgs/msg/PolicyBounds",
    "apprentice_msgs/msg/PolicyFrontier",
    "apprentice_msgs/msg/PolicySet",
    "apprentice_msgs/msg/PolicyToJudge",
    "apprentice_msgs/msg/Posterior",
    "apprentice_msgs/msg/PosteriorPreview",
    "apprentice_msgs/msg/PreferenceCycle",
    "apprentice_msgs/msg/QueryResponse",
    "apprentice_msgs/msg/Rationality",
    "apprentice_msgs/msg/Retraction",
    "apprentice_msgs/msg/RiskBound",
    "apprentice_msgs/msg/RiskPreference",
    "apprentice_msgs/msg/RobustPolicy",
    "apprentice_msgs/msg/SceneObject",
    "apprentice_msgs/msg/SegmentCritique",
    "apprentice_msgs/msg/TableReach",
    "apprentice_msgs/msg/TableScene",
    "apprentice_msgs/msg/TabularWorld",
    "apprentice_msgs/msg/TrajectoryPreference",
    "apprentice_msgs/msg/WorldQuery",
    "apprentice_msgs/msg/WorldReference",
    "apprentice_msgs/msg/WorldTrajectory",
    "builtin_interfaces/msg/Duration",
    "builtin_interfaces/msg/Time",
    "control_msgs/msg/GripperCommand",
    "control_msgs/msg/JointComponentTolerance",
    "control_msgs/msg/JointTolerance",
    "diagnostic_msgs/msg/DiagnosticArray",
    "diagnostic_msgs/msg/DiagnosticStatus",
    "diagnostic_msgs/msg/KeyValue",
    "geometry_msgs/msg/Accel",
    "geometry_msgs/msg/Point",
    "geometry_msgs/msg/Point32",
    "geometry_msgs/msg/PointStamped",
    "geometry_msgs/msg/Polygon",
    "geometry_msgs/msg/Pose",
    "geometry_msgs/msg/PoseArray",
    "geometry_msgs/msg/PoseStamped",
    "geometry_msgs/msg/PoseWithCovariance",
    "geometry_msgs/msg/PoseWithCovarianceStamped",
    "geometry_msgs/msg/Quaternion",
    "geometry_msgs/msg/QuaternionStamped",
    "geometry_msgs/msg/Transform",
    "geometry_msgs/msg/TransformStamped",
    "geometry_msgs/msg/Twist",
    "geometry_msgs/msg/TwistStamped",
    "geometry_msgs/msg/Vector3",
    "geometry_msgs/msg/Vector3Stamped",
    "geometry_msgs/msg/Wrench",
    "geometry_msgs/msg/WrenchStamped",
    "moveit_msgs/msg/AllowedCollisionEntry",
    "moveit_msgs/msg/AllowedCollisionMatrix",
    "moveit_msgs/msg/AttachedCollisionObject",
    "moveit_msgs/msg/CollisionObject",
    "moveit_msgs/msg/LinkPadding",
    "moveit_msgs/msg/LinkScale",
    "moveit_msgs/msg/ObjectColor",
    "moveit_msgs/msg/PlanningScene",
    "moveit_msgs/msg/PlanningSceneWorld",
    "moveit_msgs/msg/RobotState",
    "object_recognition_msgs/msg/ObjectType",
    "octomap_msgs/msg/Octomap",
    "octomap_msgs/msg/OctomapWithPose",
    "rcl_interfaces/msg/FloatingPointRange",
    "rcl_interfaces/msg/IntegerRange",
    "rcl_interfaces/msg/ListParametersResult",
    "rcl_interfaces/msg/Log",
    "rcl_interfaces/msg/Parameter",
    "rcl_interfaces/msg/ParameterDescriptor",
    "rcl_interfaces/msg/ParameterEvent",
    "rcl_interfaces/msg/ParameterEventDescriptors",
    "rcl_interfaces/msg/ParameterType",
    "rcl_interfaces/msg/ParameterValue",
    "rcl_interfaces/msg/SetParametersResult",
    "rosgraph_msgs/msg/Clock",
    "sensor_msgs/msg/CompressedImage",
    "sensor_msgs/msg/JointState",
    "sensor_msgs/msg/MultiDOFJointState",
    "shape_msgs/msg/Mesh",
    "shape_msgs/msg/MeshTriangle",
    "shape_msgs/msg/Plane",
    "shape_msgs/msg/SolidPrimitive",
    "std_msgs/msg/Bool",
    "std_msgs/msg/Byte",
    "std_msgs/msg/Char",
    "std_msgs/msg/ColorRGBA",
    "std_msgs/msg/Empty",
    "std_msgs/msg/Float32",
    "std_msgs/msg/Float32MultiArray",
    "std_msgs/msg/Float64",
    "std_msgs/msg/Float64MultiArray",
    "std_msgs/msg/Header",
    "std_msgs/msg/Int16",
    "std_msgs/msg/Int32",
    "std_msgs/msg/Int64",
    "std_msgs/msg/Int8",
    "std_msgs/msg/MultiArrayDimension",
    "std_msgs/msg/MultiArrayLayout",
    "std_msgs/msg/String",
    "std_msgs/msg/UInt16",
    "std_msgs/msg/UInt32",
    "std_msgs/msg/UInt64",
    "std_msgs/msg/UInt8",
    "tf2_msgs/msg/TFMessage",
    "trajectory_msgs/msg/JointTrajectory",
    "trajectory_msgs/msg/JointTrajectoryPoint",
    "trajectory_msgs/msg/MultiDOFJointTrajectory",
    "trajectory_msgs/msg/MultiDOFJointTrajectoryPoint",
    "unique_identifier_msgs/msg/UUID",
    "vision_msgs/msg/BoundingBox3D",
    "vision_msgs/msg/Detection3D",
    "vision_msgs/msg/Detection3DArray",
    "vision_msgs/msg/ObjectHypothesis",
    "vision_msgs/msg/ObjectHypothesisWithPose",
    "visualization_msgs/msg/InteractiveMarker",
    "visualization_msgs/msg/InteractiveMarkerControl",
    "visualization_msgs/msg/InteractiveMarkerFeedback",
    "visualization_msgs/msg/InteractiveMarkerInit",
    "visualization_msgs/msg/InteractiveMarkerPose",
    "visualization_msgs/msg/InteractiveMarkerUpdate",
    "visualization_msgs/msg/Marker",
    "visualization_msgs/msg/MarkerArray",
    "visualization_msgs/msg/MenuEntry",
    "visualization_msgs/msg/MeshFile",
    "visualization_msgs/msg/UVCoordinate",
];

/// Names of all services, sorted.
pub(crate) const SERVICES: &[&str] = &[
    "action_msgs/srv/CancelGoal",
    "apprentice_msgs/srv/SetPaused",
    "rcl_interfaces/srv/DescribeParameters",
    "rcl_interfaces/srv/GetParameterTypes",
    "rcl_interfaces/srv/GetParameters",
    "rcl_interfaces/srv/ListParameters",
    "rcl_interfaces/srv/SetParameters",
    "rcl_interfaces/srv/SetParametersAtomically",
    "std_srvs/srv/Empty",
    "std_srvs/srv/SetBool",
    "std_srvs/srv/Trigger",
    "visualization_msgs/srv/GetInteractiveMarkers",
];

/// Names of all actions, sorted.
pub(crate) const ACTIONS: &[&str] = &[
    "apprentice_msgs/action/PlaceObject",
    "control_msgs/action/FollowJointTrajectory",
    "control_msgs/action/GripperCommand",
];

/// Names and texts of all definitions, sorted by name.
pub(crate) const DEFINITIONS: &[(&str, &str)] = &[
    ("action_msgs/msg/GoalInfo", r#"unique_identifier_msgs/UUID goal_id
builtin_interfaces/Time stamp
"#),
    ("action_msgs/msg/GoalStatus", r#"int8 STATUS_UNKNOWN=0
int8 STATUS_ACCEPTED=1
int8 STATUS_EXECUTING=2
int8 STATUS_CANCELING=3
int8 STATUS_SUCCEEDED=4
int8 STATUS_CANCELED=5
int8 STATUS_ABORTED=6

GoalInfo goal_info
int8 status
"#),
    ("action_msgs/msg/GoalStatusArray", r#"GoalStatus[] status_list
"#),
    ("action_msgs/srv/CancelGoal", r#"GoalInfo goal_info
---
int8 ERROR_NONE=0
int8 ERROR_REJECTED=1
int8 ERROR_UNKNOWN_GOAL_ID=2
int8 ERROR_GOAL_TERMINATED=3

int8 return_code
GoalInfo[] goals_canceling
"#),
    ("apprentice_msgs/action/PlaceObject", r#"# Put an object where the person wants it: choose a place, pick it up, put it down. Any client may ask; nothing moves unless
# the lesson is taught, the path is free and the arm is known to be where it starts.
string object_id                 # what to place; empty: the target of the scene
bool plan_only                   # stop before anything moves
---
# How it came out.
uint8 DONE=0
uint8 PLANNED=1                  # planned, and no more was asked for
uint8 NOT_TAUGHT=2               # the bound on the placement loss exceeds epsilon
uint8 NO_FREE_PLACE=3
uint8 UNREACHABLE=4
uint8 NO_PATH=5
uint8 NO_ROBOT=6
uint8 STALE_JOINTS=7             # the joint state is older than the set age, or is not that of the robot
uint8 SCENE_CHANGED=8            # what stands on the table changed on the way
uint8 CONTROLLER_FAILED=9        # the controller refused, aborted, timed out or is gone
uint8 CANCELED=10
uint8 BUSY=11                    # another object is being placed
uint8 UNKNOWN_OBJECT=12
uint8 START_IN_COLLISION=13      # where the arm is now, it touches something
uint8 GOAL_IN_COLLISION=14       # in reach, but the arm would touch something at each free place
uint8 OUTSIDE_LIMITS=15          # a joint is beyond its limits
uint8 CANNOT_PICK=16             # the arm cannot pick the object up from where it stands, or nobody knows where that is
uint8 GRASP_FAILED=17            # the gripper closed and there was nothing in it, or it did not move

uint8 outcome
string reason                    # the same in one sentence
uint64 revision                  # of the posterior that chose the place
geometry_msgs/Point placement    # where it went or would go, in the table's frame; not numbers without a place
---
# How far it is.
uint8 CHOOSING=0
uint8 PLANNING=1
uint8 APPROACHING=2              # the empty hand goes to the object
uint8 GRASPING=3
uint8 MOVING=4                   # the object is on its way
uint8 RELEASING=5
uint8 RETREATING=6

uint8 stage
string description               # in plain words
float64 progress                 # of the whole, 0 to 1
"#),
    ("apprentice_msgs/msg/ActionDemonstration", r#"# A person shows what to do in states of a world. Idempotent: the same id with the same content counts once.
uint8 CONFIDENCE_SURE=0
uint8 CONFIDENCE_FAIRLY=1
uint8 CONFIDENCE_GUESS=2

std_msgs/Header header
string id                        # unique within a session
string query_id                  # the asker's question; empty: volunteered
string source                    # who: a node or a person
string world_id
uint32[] states                  # any states in any order, each as often as it was shown
uint32[] actions                 # taken in each of them
uint8 confidence
"#),
    ("apprentice_msgs/msg/ArmModel", r#"# What the arm looks like to the planner: for pictures.
std_msgs/Header header           # frame: the table's
string robot_hash                # of the robot, as in PlacementPlan
string[] link_names              # poses come in this order
ArmPart[] parts
"#),
    ("apprentice_msgs/msg/ArmMotion", r#"# How the arm would carry out a plan: for pictures.
std_msgs/Header header           # frame: the table's
uint64 revision                  # of the plan
string robot_hash                # of the robot, as in ArmModel
float64[] times_s                # from the start, ascending; empty without a motion
float32[] poses                  # for each time the poses of ArmPose
float64[] way_m                  # of the tool: x, y, z for each point of the plan's trajectory
float64 held_from_s              # the target is in the hand from here
float64 held_until_s             # to here
geometry_msgs/Pose pick          # where the target stands before: the middle of its base; not numbers when it is in the hand
SceneObject target               # where it will stand; without an extent when there is no place
"#),
    ("apprentice_msgs/msg/ArmPart", r#"# A solid of a link, as the planner checks it for collisions.
uint8 BOX=0
uint8 CYLINDER=1                 # along its z axis
uint8 SPHERE=2
uint8 CAPSULE=3                  # along its z axis
uint8 MESH=4                     # convex

uint32 link                      # in the order of ArmModel
uint8 shape
geometry_msgs/Pose pose          # of the solid in the link's frame
geometry_msgs/Vector3 size_m     # box: the sides; else x the diameter, z the length, without the round ends; a mesh: unused
float32[] points                 # of a mesh: x, y, z of each corner
uint32[] triangles               # of a mesh: three corners each, counter-clockwise from outside
"#),
    ("apprentice_msgs/msg/ArmPose", r#"# Where the links of the arm are.
std_msgs/Header header           # frame: the table's
string robot_hash                # of the robot, as in ArmModel
float32[] poses                  # for each link x, y, z in metres, then a unit quaternion x, y, z, w
"#),
    ("apprentice_msgs/msg/Candidates", r#"# Hypothetical tables that active_query wants judged.
std_msgs/Header header
uint64 revision                  # of the posterior
string robot_hash                # whose reach they lie in; empty: in anybody's
TableScene[] scenes
"#),
    ("apprentice_msgs/msg/Carrying", r#"# What the arm is doing about a plan, and how that came out.
std_msgs/Header header           # stamp: when it was so; frame: the table's
uint64 revision                  # of the posterior that chose the place
string object_id                 # what is being placed
uint8 stage                      # one of the stages in the feedback of PlaceObject
string description               # in plain words; once it is over, the reason
float64 progress                 # of the whole, 0 to 1
bool over
uint8 outcome                    # once it is over: one of the outcomes in the result of PlaceObject
geometry_msgs/Point placement    # where it goes, in the table's frame
"#),
    ("apprentice_msgs/msg/CritiqueSegment", r#"# Part of a trajectory that a person marked.
uint8 GOOD=0                     # as it should be done
uint8 BAD=1                      # as it should not be done

uint32 start                     # first step, counted from 0
uint32 end                       # the step after the last
uint8 verdict
"#),
    ("apprentice_msgs/msg/EvidenceLog", r#"# Every accepted event of the session so far; what a replay computes from.
std_msgs/Header header
TableScene task                  # the scene that named the weights before the first event; without extent when none did
WorldReference world             # the world that named the weights before the first event; empty when none did
EvidenceRecord[] records
"#),
    ("apprentice_msgs/msg/EvidenceReceipt", r#"# What reward_posterior did with evidence, a retraction or a response.
uint8 ACCEPTED=0
uint8 DUPLICATE=1                # had been accepted before; nothing changed
uint8 REFUSED=2

std_msgs/Header header
string id                        # of the evidence
uint8 outcome
string reason                    # one sentence; empty when accepted
uint64 revision                  # of the posterior that holds it; 0 when refused
"#),
    ("apprentice_msgs/msg/EvidenceRecord", r#"# One accepted event, in the order in which reward_posterior accepted it.
uint8 DEMONSTRATION=0
uint8 RETRACTION=1
uint8 RESPONSE=2
uint8 ACTIONS=3
uint8 PREFERENCE=4
uint8 CRITIQUE=5
uint8 HISTORY=6
uint8 SCENE=7                    # a table, when something else had named the weights before it, or things on it were moved
uint8 WORLD=8                    # a world, when something else had named the weights before it

uint64 sequence                  # 1, 2, …; the revision of the posterior that takes it in
uint8 kind
PlacementDemonstration[<=1] demonstration
Retraction[<=1] retraction
QueryResponse[<=1] response
ActionDemonstration[<=1] actions
TrajectoryPreference[<=1] preference
SegmentCritique[<=1] critique
LearnerHistory[<=1] history
TableScene[<=1] scene
WorldReference[<=1] world
"#),
    ("apprentice_msgs/msg/FeatureTrajectory", r#"# What a trajectory amounts to.
string id                        # unique within a session: the same id stands for the same features
float64[] features               # one per weight: the sum over its steps, discounted as the reward is
"#),
    ("apprentice_msgs/msg/FrontierPoint", r#"# The best policy for one lambda.
float64 lambda
uint8 outcome                    # as in RobustPolicy
float64 gap
float64 expected_return
float64 value_at_risk
float64 conditional_value_at_risk
"#),
    ("apprentice_msgs/msg/Heartbeat", r#"# A node is alive. Twice a second.
builtin_interfaces/Time stamp
string node
string instance                  # new at every start
uint64 count
"#),
    ("apprentice_msgs/msg/LearnerHistory", r#"# What somebody who was still learning did, in the order of time: a later attempt is probably the better one.
# Idempotent: the same id with the same content counts once.
uint8 CONFIDENCE_SURE=0
uint8 CONFIDENCE_FAIRLY=1
uint8 CONFIDENCE_GUESS=2

std_msgs/Header header
string id                        # unique within a session
string source                    # who: a node or a person
FeatureTrajectory[] demonstrations  # earliest first, two or more, each once; every pair is a weak preference
uint8 confidence
"#),
    ("apprentice_msgs/msg/LessonStatus", r#"# Where the lesson stands.
uint8 ASKING=0
uint8 TAUGHT=1                   # the bound is below epsilon
uint8 STOPPED=2                  # the person said that nothing is acceptable
uint8 GAVE_UP=3                  # max_questions asked and still not taught
uint8 PAUSED=4                   # nothing is asked until the person says start
uint8 FINISHED=5                 # the person had said enough, and the bound is not below epsilon
uint8 MISFIT=6                   # what was said cannot be explained with these features: more answers will not help

std_msgs/Header header
uint64 revision
uint8 state
string reason
string query_id                  # the open question; empty when there is none
uint32 questions_asked
uint32 demonstrations            # active ones, and comparisons; about a world all pieces of evidence in force
uint8 bound_outcome              # as in PlacementBound; about a world as in RiskBound
float64 bound_m                  # NaN without one
float64 epsilon_m
float64 loss_bound               # about a world: bound on the normalised loss of the robot's policy; NaN without one
float64 epsilon_loss             # the lesson about a world ends below it; NaN when it is about a table
uint32 held_out                  # answers to questions that were drawn at random
uint32 surprises                 # of these, how many were not expected; 1 in 10 is by chance
uint32 to_confirm                # answers to random questions, none of them a surprise, that the lesson still needs although its bound is good
float64 misfit_p                 # how probable answers as odd as those given are; NaN where that was not reckoned
string[] misfits                 # when the state is MISFIT: ids of the evidence that fits worst
"#),
    ("apprentice_msgs/msg/NodeSettings", r#"# What a node was started with; a replay starts it the same way.
string node                      # executable's name of the node
string name                      # fully qualified name on the graph
uint64 seed
string version
string commit
string parameters                # YAML, as a ROS parameter file
"#),
    ("apprentice_msgs/msg/PerformanceBounds", r#"# High-confidence bounds on the placement loss, with their receipt.
std_msgs/Header header           # stamp of the posterior
uint64 revision                  # of the posterior
uint8 outcome                    # as in PlacementBound; a bound only if every scene has one
string reason                    # in words: the claim, or "no bound, because …" and what it would take
float64 bound_m                  # the largest over the scenes; NaN without one
uint32 worst                     # index of that scene
PlacementBound[] bounds          # one per scene, in the order of the candidates
float64 alpha
float64 delta
uint64 look                      # how many bounds the session has looked at, this one counted: revision + 1
float64 delta_spent              # on each scene of this look
uint64 n
uint32 n_chains
float64 ess_min
float64 rhat_max
float64 acceptance
float64 beta
string prior
string evidence_hash
uint64 seed
string version
"#),
    ("apprentice_msgs/msg/PlacementBound", r#"# How far the robot's placement in one scene may be from the person's.
uint8 BOUND=0
uint8 NOT_ENOUGH_SAMPLES=1
uint8 NOT_MIXED=2
uint8 NO_PLACEMENT=3             # there is no free spot for the target in this scene

string scene_id
uint8 outcome
geometry_msgs/Point placement    # judged: best under the MAP weights, metres
float64 bound_m                  # upper confidence bound on the alpha-VaR of the loss; NaN without one
float64 point_estimate_m         # empirical alpha-quantile
float64 cvar_m                   # empirical mean of the losses at or above it
float64 mean_m
uint64 n                         # draws
float64 ess                      # of the tail indicator
float64 rhat
uint64 index                     # 1-based order statistic used; 0 without a bound
uint64 needed                    # effective samples a bound would take
"#),
    ("apprentice_msgs/msg/PlacementCandidate", r#"# A place that was considered for the target, and what became of it.
uint8 CHOSEN=0
uint8 UNREACHABLE=1              # the arm cannot put the target there
uint8 NO_PATH=2                  # the arm found no way there
uint8 NEXT_BEST=3                # it could be used, but a better one was
uint8 BLOCKED=4                  # the arm reaches it, but would touch something

geometry_msgs/Point position     # metres in the table's frame
float64 mean_reward              # over the draws
float64 probability_best         # share of the draws whose own best place is within 3 cm
float64 var_m                    # VaR of the distance to each draw's own best place
float64 cvar_m                   # CVaR of it
float64 clearance_m              # from the target's outline to the nearest object, or edge of the table
uint8 verdict
string reason                    # the same in words
"#),
    ("apprentice_msgs/msg/PlacementDemonstration", r#"# A person shows where the target belongs in a scene. Idempotent: the same id with the same content counts once.
uint8 CONFIDENCE_SURE=0
uint8 CONFIDENCE_FAIRLY=1
uint8 CONFIDENCE_GUESS=2

std_msgs/Header header
string id                        # unique within a session
string query_id                  # the question this answers; empty: volunteered
string source                    # who: a node or a person
TableScene scene
geometry_msgs/Point placement    # metres, in the scene's frame
uint8 confidence
"#),
    ("apprentice_msgs/msg/PlacementOption", r#"# A place for the target that a question offers.
geometry_msgs/Point placement    # metres, in the question's scene
FeatureTrajectory trajectory     # what it amounts to there: what a TrajectoryPreference compares
"#),
    ("apprentice_msgs/msg/PlacementPlan", r#"# Where the robot would put the target, and how it would get there.
uint8 PLANNED=0
uint8 NO_FREE_PLACE=1
uint8 UNREACHABLE=2
uint8 NO_PATH=3
uint8 NO_ROBOT=4                 # placements stand, but no robot model has been received
uint8 START_IN_COLLISION=5       # where the arm is now, it touches something
uint8 GOAL_IN_COLLISION=6        # in reach, but the arm would touch something at each free place
uint8 JOINTS_UNKNOWN=7           # placements stand, but nothing is heard of a joint that moves the tool
uint8 OUTSIDE_LIMITS=8           # a joint is beyond its limits
uint8 CANNOT_PICK=9              # placements stand, but the arm cannot pick the target up from where it stands

uint8 CELL_FREE=0
uint8 CELL_OCCUPIED=1
uint8 CELL_UNREACHABLE=2

std_msgs/Header header           # stamp of the posterior
uint64 revision                  # of the posterior
string query_id                  # the question this is the robot's guess for; empty: a plan for the table as it is
TableScene scene                 # what was planned for
string robot_hash                # SHA-256 of the robot description (with SRDF and meshes, if any), hex; empty without one
sensor_msgs/JointState start     # where the arm stood; empty without a robot
uint8 outcome
string reason
geometry_msgs/Point map_placement      # best under the MAP weights, metres
geometry_msgs/Point robust_placement   # what the planner's choice prefers; where the trajectory ends
float64 map_cvar_m
float64 robust_cvar_m
float64 alpha
string choice                    # map, mean, var, cvar or most_likely: which place is taken of those in reach
PlacementCandidate[] candidates  # best first, those out of reach among them
bool inside_bound                # the lesson is taught: the robot may move
bool picks                       # the arm has to pick the target up; else it starts with the target in its hand
geometry_msgs/Pose pick          # where the target stands then: the middle of its base; not numbers where nobody knows
trajectory_msgs/JointTrajectory approach    # empty-handed, from the start to the grasp; empty unless it picks
trajectory_msgs/JointTrajectory trajectory  # with the target in the hand, to where it is let go
trajectory_msgs/JointTrajectory retreat     # empty-handed, away from it; empty without a gripper
float64 grip_open                # where the gripper's joint is told to go to let the target in or out
float64 grip                     # and to hold it; not numbers without a gripper
uint32 map_side                  # the two maps are map_side x map_side cells, row-major, first row at y = 0
float32[] reward_map             # mean reward over the draws
uint8[] cell_state
"#),
    ("apprentice_msgs/msg/PlacementQuery", r#"# The open question about a table: where does the target belong in this scene, or in which of two places? Republished until it is
# answered by a PlacementDemonstration in the scene, by a TrajectoryPreference of the two options, or by a QueryResponse.
std_msgs/Header header           # stamp of the posterior
string id
uint64 revision                  # of the posterior it comes from
TableScene scene
string reason                    # why this is asked, in words
float64 bound_m                  # in this scene; NaN without one
float64 epsilon_m
uint32 n_candidates              # how many scenes it was chosen from
PlacementOption[<=2] options     # none: any place; two: which of these is better; the first, by lot, is called A
float64 gain                     # nats: what the answer is expected to tell; NaN where it was not chosen by that
float64 gain_per_second          # of the person's time
bool held_out                    # drawn at random, so that the answer is fair evidence against the model
"#),
    ("apprentice_msgs/msg/PolicyBound", r#"# How good and how wrong one policy may be.
string id
uint8 form                       # as in PolicyToJudge
float64[] feature_counts         # judged: given, computed from the policy, or the mean of the rollouts
uint64 n_rollouts                # behind them; 0 when they are exact
float64 rollout_standard_error   # of the mean return over the rollouts under the mean weights; NaN when it is exact or unknown
RiskBound return_bound           # lower bound on the (1 - alpha)-quantile of the return w.Phi
RiskBound loss_bound             # upper bound on the alpha-quantile of the loss V* - w.Phi, V* the best return in the world
RiskBound loss_cvar              # upper bound on the mean of the worst 1 - alpha of the losses
RiskBound normalised_loss        # upper bound on the alpha-quantile of the loss over that of choosing actions at random
float64 probability_best         # share of the rewards under which no other policy of the set has a higher return
uint32 rank                      # 1: the highest bound on the return
uint32 rank_by_mean              # 1: the highest mean return
string warning                   # a high mean and a low bound, in words; empty when there is nothing to warn of
"#),
    ("apprentice_msgs/msg/PolicyBounds", r#"# High-confidence bounds on the policies of a set, with their receipt.
std_msgs/Header header           # stamp of the posterior
uint64 revision                  # of the posterior
string set_id
uint64 set_number
WorldReference world             # in which losses are measured; empty without one
uint8 outcome                    # as in RiskBound: a bound only if every policy has one on its return
string reason                    # in words: the claim, or "no bound, because …" and what it would take
PolicyBound[] policies           # in the order of the set
float64 alpha
float64 delta
uint64 look                      # how many posteriors the session has looked at, this one counted: revision + 1
float64 delta_spent              # on each bound of this look
uint64 n
uint32 n_chains
float64 ess_min
float64 rhat_max
float64 acceptance
Rationality[] rationalities
string prior
float64 prior_scale
string evidence_hash
uint64 seed
string version
"#),
    ("apprentice_msgs/msg/PolicyFrontier", r#"# What every lambda buys: expected return against the worst case (dissertation figure 7.3), of one posterior.
std_msgs/Header header           # stamp of the posterior
uint64 revision                  # of the posterior
string evidence_hash
WorldReference world
uint8 outcome                    # as in RobustPolicy: the worst of the points'
string reason
uint8 objective                  # as in RobustPolicy
float64 alpha
uint64 n_draws
uint32 draws_used                # as in RobustPolicy
FrontierPoint[] points           # lambda ascending; empty without any
uint32 n_states
uint32 n_actions
float32[] policies               # points x n_states x n_actions, row-major; empty when that is more than 10,000 numbers
uint64 seed
string version
"#),
    ("apprentice_msgs/msg/PolicySet", r#"# Policies to judge against each other under every posterior from now on, until the next set.
std_msgs/Header header
string id                        # unique within a session
uint64 number                    # 1, 2, … within a session: bounds on the sets of a session share delta by it
string world_id                  # of tabular policies; may be empty when there are none
uint32 draws_used                # the policies were chosen by so many first draws of each chain: bounds are of the later ones alone
PolicyToJudge[] policies
"#),
    ("apprentice_msgs/msg/PolicyToJudge", r#"# A policy, in one of three forms.
uint8 FEATURE_COUNTS=0           # what it is expected to collect
uint8 TABULAR=1                  # what it does in each state of the world
uint8 ROLLOUTS=2                 # what it collected when it was run

string id                        # unique within a set
uint8 form
float64[] feature_counts         # FEATURE_COUNTS: one per weight, discounted, over the initial states
uint32[] actions                 # TABULAR and deterministic: one per state
float64[] action_probabilities   # TABULAR and stochastic: n_states x n_actions, row-major
FeatureTrajectory[] rollouts     # ROLLOUTS: their mean is judged
"#),
    ("apprentice_msgs/msg/Posterior", r#"# Draws of the reward weights given the evidence.
uint8 NO_WISH=0
uint8 STOP=1                     # nothing is acceptable
uint8 PAUSE=2
uint8 START=3
uint8 FINISH=4

uint8 READY=0
uint8 NOT_MIXED=1                # the chains disagree: see reason

std_msgs/Header header           # stamp of the newest accepted evidence
uint64 revision                  # number of accepted events
string evidence_hash             # SHA-256 over the evidence in force, hex
uint64 n_demonstrations          # placements in force
uint64 n_answers                 # questions of this lesson answered or skipped so far, taken back or not
uint8 wish                       # about the lesson itself, of what has not been taken back: stop before finish before the newest of the others
TableScene task                  # the table that the lesson is about, as it stands now; without objects and extent when it is about none
TableScene scene                 # of the newest placement in force, else the task
WorldReference world             # the world that the lesson is about; empty when it is about none
uint8 outcome
string reason
string[] feature_names           # one per weight; for a table object ids, then the fixed centres
uint32 n_chains
uint32 n_draws                   # over all chains
float32[] draws                  # n_draws x features, row-major, chains one after another; consumers use these very numbers
float64[] map_weights
float64 map_log_likelihood
float64 log_likelihood_mean
float64 rhat_max                 # rank-normalised split R-hat, worst over weights, learned betas and log-likelihood
float64 ess_bulk_min
float64 ess_tail_min
float64 acceptance
float64 beta                     # of placements
Rationality[] rationalities      # every kind
string[] learned_kinds           # those whose beta is drawn, in the order of rationalities
float32[] learned_betas          # n_draws x learned_kinds, row-major
PreferenceCycle[] cycles         # among the preferences in force
string prior
float64 prior_scale              # 0 for a prior on a sphere
uint64 seed
string version
"#),
    ("apprentice_msgs/msg/PosteriorPreview", r#"# An earlier posterior re-weighted by what was said since, while the next one is being computed. Nothing is computed
# from it, and it does not change what the next one will be.
uint8 READY=0
uint8 UNRELIABLE=1               # the new evidence moves the posterior too far for the old draws: see reason

std_msgs/Header header           # stamp of the newest accepted evidence
uint64 revision                  # of the posterior that is being computed
uint64 base_revision             # of the posterior whose draws are re-weighted
string evidence_hash             # as the next posterior will carry it
uint8 outcome
string reason
float64[] mean_weights           # weighted mean over the draws
float64 expected_log_likelihood  # of all evidence in force, weighted mean over the draws
float64 khat                     # shape of the tail of the weights (Pareto); above 0.7 they are not to be relied on
float64 effective_size           # of the weights: squared sum over sum of squares
uint32 n_draws                   # draws that were re-weighted, evenly spread over the posterior's
uint64 seed
string version
"#),
    ("apprentice_msgs/msg/PreferenceCycle", r#"# Trajectories that were said to be better than each other all around: answers that cannot all be right.
string[] trajectories            # ids; each was called worse than the next one, and the last worse than the first
"#),
    ("apprentice_msgs/msg/QueryResponse", r#"# An answer to a question that shows nothing, or a word about the lesson itself, which needs no question.
uint8 SKIP=0                     # no data: ask something else
uint8 CANT_TELL=1                # the person has no opinion here: ask something else
uint8 STOP=2                     # nothing is acceptable: stop the lesson
uint8 PAUSE=3                    # ask nothing until START comes, or this is taken back
uint8 START=4                    # begin to ask, or go on
uint8 FINISH=5                   # the person has said enough: the lesson ends with what is known
uint8 NEW_LESSON=6               # what was said before counts no more, unless this is taken back

std_msgs/Header header
string id                        # unique within a session
string query_id
string source
uint8 kind
string reason                    # may be empty
"#),
    ("apprentice_msgs/msg/Rationality", r#"# How rational one kind of evidence is taken to be: answers follow returns times beta.
string kind                      # placements, actions, preferences, critiques or progress
uint64 n                         # pieces of evidence of this kind in force
float64 prior_median             # of beta; its value when it is fixed
float64 prior_log_sd             # standard deviation of log beta before any evidence; 0: beta is fixed
float64 mean                     # of the draws; the median of the prior when it is fixed
float64 quantile_05
float64 quantile_95
float64 wrong_rate               # share of answers taken to be given at random
"#),
    ("apprentice_msgs/msg/Retraction", r#"# Takes evidence back. Nothing is deleted: the posterior after it equals the posterior without that evidence.
std_msgs/Header header
string id                        # unique within a session
string evidence_id               # what is taken back
string source
string reason                    # may be empty
"#),
    ("apprentice_msgs/msg/RiskBound", r#"# A confidence bound on a measure of risk over the rewards that fit the evidence, and the figures it rests on.
uint8 BOUND=0
uint8 NOT_ENOUGH_SAMPLES=1
uint8 NOT_MIXED=2                # the chains disagree
uint8 NOT_JUDGED=3               # for want of something other than draws
uint8 UNBOUNDED=4                # what may be arbitrarily bad has no bound on the mean of its tail

uint8 outcome
string reason                    # "no bound, because …"; empty with one
float64 bound                    # NaN without one
float64 point_estimate           # the measure of the draws
float64 mean                     # of the draws
uint64 n                         # draws
float64 ess                      # effective draws in the tail
float64 rhat
uint64 needed                    # effective draws that a bound takes
float64 shift                    # by how much probability the bound looks further into the tail than the estimate does
"#),
    ("apprentice_msgs/msg/RiskPreference", r#"# How cautious the robot is to be. Of all that were said the one with the largest number counts, of equal numbers the larger id.
std_msgs/Header header
string id                        # unique within a session
string source                    # who: a node or a person
uint64 number                    # one more than the number of the newest RobustPolicy, or of one's own last preference
float64 lambda                   # from 0, only the worst case counts, to 1, only the mean counts
"#),
    ("apprentice_msgs/msg/RobustPolicy", r#"# The policy to follow while the reward is uncertain: it makes (1 - lambda) CVaR_alpha(psi) + lambda E(return) largest, where
# CVaR is the mean of the worst 1 - alpha of the rewards that fit the evidence. Published again when the posterior or lambda changes.
uint8 OPTIMAL=0                  # proved: no policy is better by more than gap
uint8 INACCURATE=1               # the solver came no closer than gap
uint8 ITERATION_LIMIT=2          # the steps allowed did not suffice: see gap
uint8 TIMED_OUT=3
uint8 INFEASIBLE=4
uint8 UNBOUNDED=5
uint8 CONSTRAINTS_VIOLATED=6     # what the solver gave is no policy
uint8 NOT_COMPUTED=7             # something is missing or wrong: see reason

uint8 ROBUST=0                   # psi = return
uint8 REGRET=1                   # psi = return less what the demonstrations in force return
uint8 EVD=2                      # psi = return less the best return of each reward

uint8 DIRECT=0                   # one linear program
uint8 COLUMN_GENERATION=1

std_msgs/Header header           # stamp of the posterior
uint64 revision                  # of the posterior
string evidence_hash
WorldReference world
uint8 outcome
string reason                    # in words: what the policy promises, or why there is none and what it would take
uint8 objective
float64 alpha
float64 lambda                   # 0: only the worst case counts; 1: only the mean
uint64 preference_number         # of the RiskPreference that chose lambda; 0: the parameter
string preference_id             # of it; empty: the parameter
uint8 method
string status                    # what the solver said last
uint64 rounds
float64 objective_value          # of the policy
float64 gap                      # no policy's objective is larger by more than this; NaN without a policy, as are the next three
float64 expected_return
float64 value_at_risk            # alpha of the draws have a larger psi
float64 conditional_value_at_risk
uint64 n_draws                   # that it was chosen by
uint32 draws_used                # of each chain, the first; the later ones judge it. 0: all, and none judge it
uint64 held_out                  # these later draws, of all chains
float64 held_out_mean            # of psi over these; NaN without them, as are the next four
float64 held_out_cvar            # of psi over these
float64 held_out_cvar_low        # confidence interval of it
float64 held_out_cvar_high
float64 confidence               # of the interval
uint32 n_states
uint32 n_actions
float64[] action_probabilities   # n_states x n_actions, row-major; empty without a policy
float32[] visits                 # discounted visits of each state: times a row above, the occupancy; 0 where it never comes
float64[] feature_counts         # expected, discounted: one per weight
uint64 seed
string version
"#),
    ("apprentice_msgs/msg/SceneObject", r#"# One thing on the table. Metres, in the frame of the scene's header: x to the right, y away from the robot, z up;
# the origin is the table's near left corner on its surface.
uint8 SHAPE_CYLINDER=0
uint8 SHAPE_BOX=1

string id                        # unique within a scene
string label                     # what people call it
uint8 shape
geometry_msgs/Vector3 size_m     # bounding box; a cylinder has size_m.x == size_m.y == its diameter
geometry_msgs/Pose pose          # centre of the base; rotation about z only
bool supports                    # true: other things may be placed on it (a bowl for a spoon)
"#),
    ("apprentice_msgs/msg/SegmentCritique", r#"# A person marks what is good and what is bad in a trajectory of a world; what is not marked says nothing.
# Idempotent: the same id with the same content counts once.
uint8 CONFIDENCE_SURE=0
uint8 CONFIDENCE_FAIRLY=1
uint8 CONFIDENCE_GUESS=2

std_msgs/Header header
string id                        # unique within a session
string query_id                  # the asker's question; empty: volunteered
string source                    # who: a node or a person
string world_id
uint32[] states                  # the trajectory
uint32[] actions                 # taken in each of its states
CritiqueSegment[] segments       # one or more, none overlapping another
uint8 confidence
"#),
    ("apprentice_msgs/msg/TableReach", r#"# Where the arm can put the target on the bare table.
std_msgs/Header header           # the frame of the table; no stamp
string robot_hash                # which arm, as in PlacementPlan
string target_id
float64 width_m                  # of the table
float64 depth_m
uint32 side                      # cells per axis; 0: not known, see reason
bool[] reachable                 # side x side, row-major, the first row nearest to the robot
string reason
"#),
    ("apprentice_msgs/msg/TableScene", r#"# What stands on the table, and what is to be placed.
std_msgs/Header header           # frame_id: the table's frame
string id                        # unique within a session
float64 width_m                  # extent along x
float64 depth_m                  # extent along y
SceneObject[] objects
SceneObject target               # the thing to place; its pose is ignored
"#),
    ("apprentice_msgs/msg/TabularWorld", r#"# A Markov decision process without a reward: what demonstrated actions and policies are about. Return = sum of
# gamma^t w.phi over t = 0, 1, …; a state without transitions is terminal, and its features count once.
uint8 STATE_FEATURES=0           # n_states x features, row-major
uint8 STATE_ACTION_FEATURES=1    # (n_states n_actions) x features, row state n_actions + action

uint8 CELLS=0                    # shape: rows and columns of a grid of states, row by row
uint8 ROAD=1                     # shape: lanes, the outer two off the road, and places of traffic, the farthest ahead first;
                                 # state = (own lane (lanes - 2) + lane of the traffic, the roadside not counted) places + its place

std_msgs/Header header
string id                        # unique within a session
float64 gamma                    # discount, 0 or more and below 1
uint32 n_states
uint32 n_actions
string[] feature_names           # one per weight
string[] action_names            # one per action; empty: numbers
float64[] initial                # probability of starting in each state
uint32[] from_state              # transitions, in four arrays of equal length
uint32[] action
uint32[] to_state
float64[] probability            # of each state and action that has any, they sum to 1
uint8 features_of
float64[] features
uint32[<=2] shape                # two numbers for pictures; empty: none
uint8 shape_of                   # what they count
"#),
    ("apprentice_msgs/msg/TrajectoryPreference", r#"# Which of several trajectories is better. Idempotent: the same id with the same content counts once.
uint8 RANKED=0                   # worst first; with more than two, every pair counts
uint8 EQUAL=1                    # about equally good; with more than two, every pair is
uint8 CANT_TELL=2                # no opinion, which says something about how rational the answers are

uint8 CONFIDENCE_SURE=0
uint8 CONFIDENCE_FAIRLY=1
uint8 CONFIDENCE_GUESS=2

std_msgs/Header header
string id                        # unique within a session
string query_id                  # the asker's question; empty: volunteered
string source                    # who: a node or a person
FeatureTrajectory[] trajectories # two or more, each once
uint8 answer
uint8 confidence
"#),
    ("apprentice_msgs/msg/WorldQuery", r#"# The open question about a world. Republished until evidence with its id answers it, or a QueryResponse.
uint8 ACTION=0                   # what to do in the state; answered by an ActionDemonstration of that state
uint8 CRITIQUE=1                 # what is good and what is bad in the trajectory; answered by a SegmentCritique of it
uint8 COMPARISON=2               # which of the two trajectories is better; answered by a TrajectoryPreference of the two

std_msgs/Header header           # stamp of the posterior
string id
uint64 revision                  # of the evidence that it asks to add to
uint32 ahead                     # 0: chosen by the posterior of its revision; n: by that of n revisions before, whose answers were not learned from
WorldReference world
uint8 kind
uint32 state                     # that it is about; where the trajectories begin
WorldTrajectory[<=2] trajectories  # none, one or two by kind; the first of two, by lot, is shown on the left
string reason                    # what is asked, and why, in words
float64 value_at_risk            # from the state on the MAP policy loses no more than this under alpha of the rewards that fit
float64 alpha
float64 gain                     # nats: what the answer is expected to tell; NaN where it was not chosen by that
float64 gain_per_second          # of the person's time
bool held_out                    # drawn at random, so that the answer is fair evidence against the model
uint32 n_candidates              # how many questions it was chosen from
float64 loss_bound               # on the normalised loss of the robot's policy; NaN without one
float64 epsilon_loss             # the lesson ends below it
"#),
    ("apprentice_msgs/msg/WorldReference", r#"# Which TabularWorld; the world itself is on the topics `world` and `lesson_world`.
string id
string hash                      # SHA-256 of the message without its header, hex
"#),
    ("apprentice_msgs/msg/WorldTrajectory", r#"# A trajectory of a world that a question shows.
string id                        # unique within a session; of the FeatureTrajectory that stands for it in an answer
uint32[] states
uint32[] actions                 # taken in each of the states
float64[] features               # one per weight, as in FeatureTrajectory
"#),
    ("apprentice_msgs/srv/SetPaused", r#"# Pauses or resumes a running replay.
bool paused
---
bool paused
string message
"#),
    ("builtin_interfaces/msg/Duration", r#"int32 sec
uint32 nanosec
"#),
    ("builtin_interfaces/msg/Time", r#"int32 sec
uint32 nanosec
"#),
    ("control_msgs/action/FollowJointTrajectory", r#"trajectory_msgs/JointTrajectory trajectory
trajectory_msgs/MultiDOFJointTrajectory multi_dof_trajectory
JointTolerance[] path_tolerance
JointComponentTolerance[] component_path_tolerance
JointTolerance[] goal_tolerance
JointComponentTolerance[] component_goal_tolerance
builtin_interfaces/Duration goal_time_tolerance
---
int32 SUCCESSFUL=0
int32 INVALID_GOAL=-1
int32 INVALID_JOINTS=-2
int32 OLD_HEADER_TIMESTAMP=-3
int32 PATH_TOLERANCE_VIOLATED=-4
int32 GOAL_TOLERANCE_VIOLATED=-5

int32 error_code
string error_string
---
std_msgs/Header header
string[] joint_names
trajectory_msgs/JointTrajectoryPoint desired
trajectory_msgs/JointTrajectoryPoint actual
trajectory_msgs/JointTrajectoryPoint error
string[] multi_dof_joint_names
trajectory_msgs/MultiDOFJointTrajectoryPoint multi_dof_desired
trajectory_msgs/MultiDOFJointTrajectoryPoint multi_dof_actual
trajectory_msgs/MultiDOFJointTrajectoryPoint multi_dof_error
"#),
    ("control_msgs/action/GripperCommand", r#"GripperCommand command
---
float64 position
float64 effort
bool stalled
bool reached_goal
---
float64 position
float64 effort
bool stalled
bool reached_goal
"#),
    ("control_msgs/msg/GripperCommand", r#"float64 position
float64 max_effort
"#),
    ("control_msgs/msg/JointComponentTolerance", r#"uint16 X_AXIS=1
uint16 Y_AXIS=2
uint16 Z_AXIS=3
uint16 TRANSLATION=4
uint16 ROTATION=5

string joint_name
uint16 component
float64 position
float64 velocity
float64 acceleration
"#),
    ("control_msgs/msg/JointTolerance", r#"string name
float64 position
float64 velocity
float64 acceleration
"#),
    ("diagnostic_msgs/msg/DiagnosticArray", r#"std_msgs/Header header
DiagnosticStatus[] status
"#),
    ("diagnostic_msgs/msg/DiagnosticStatus", r#"byte OK=0
byte WARN=1
byte ERROR=2
byte STALE=3

byte level
string name
string message
string hardware_id
KeyValue[] values
"#),
    ("diagnostic_msgs/msg/KeyValue", r#"string key
string value
"#),
    ("geometry_msgs/msg/Accel", r#"Vector3 linear
Vector3 angular
"#),
    ("geometry_msgs/msg/Point", r#"float64 x
float64 y
float64 z
"#),
    ("geometry_msgs/msg/Point32", r#"float32 x
float32 y
float32 z
"#),
    ("geometry_msgs/msg/PointStamped", r#"std_msgs/Header header
Point point
"#),
    ("geometry_msgs/msg/Polygon", r#"Point32[] points
"#),
    ("geometry_msgs/msg/Pose", r#"Point position
Quaternion orientation
"#),
    ("geometry_msgs/msg/PoseArray", r#"std_msgs/Header header
Pose[] poses
"#),
    ("geometry_msgs/msg/PoseStamped", r#"std_msgs/Header header
Pose pose
"#),
    ("geometry_msgs/msg/PoseWithCovariance", r#"Pose pose
float64[36] covariance
"#),
    ("geometry_msgs/msg/PoseWithCovarianceStamped", r#"std_msgs/Header header
PoseWithCovariance pose
"#),
    ("geometry_msgs/msg/Quaternion", r#"float64 x 0
float64 y 0
float64 z 0
float64 w 1
"#),
    ("geometry_msgs/msg/QuaternionStamped", r#"std_msgs/Header header
Quaternion quaternion
"#),
    ("geometry_msgs/msg/Transform", r#"Vector3 translation
Quaternion rotation
"#),
    ("geometry_msgs/msg/TransformStamped", r#"std_msgs/Header header
string child_frame_id
Transform transform
"#),
    ("geometry_msgs/msg/Twist", r#"Vector3 linear
Vector3 angular
"#),
    ("geometry_msgs/msg/TwistStamped", r#"std_msgs/Header header
Twist twist
"#),
    ("geometry_msgs/msg/Vector3", r#"float64 x
float64 y
float64 z
"#),
    ("geometry_msgs/msg/Vector3Stamped", r#"std_msgs/Header header
Vector3 vector
"#),
    ("geometry_msgs/msg/Wrench", r#"Vector3 force
Vector3 torque
"#),
    ("geometry_msgs/msg/WrenchStamped", r#"std_msgs/Header header
Wrench wrench
"#),
    ("moveit_msgs/msg/AllowedCollisionEntry", r#"bool[] enabled
"#),
    ("moveit_msgs/msg/AllowedCollisionMatrix", r#"string[] entry_names
AllowedCollisionEntry[] entry_values
string[] default_entry_names
bool[] default_entry_values
"#),
    ("moveit_msgs/msg/AttachedCollisionObject", r#"string link_name
CollisionObject object
string[] touch_links
trajectory_msgs/JointTrajectory detach_posture
float64 weight
"#),
    ("moveit_msgs/msg/CollisionObject", r#"byte ADD=0
byte REMOVE=1
byte APPEND=2
byte MOVE=3

std_msgs/Header header
geometry_msgs/Pose pose
string id
object_recognition_msgs/ObjectType type
shape_msgs/SolidPrimitive[] primitives
geometry_msgs/Pose[] primitive_poses
shape_msgs/Mesh[] meshes
geometry_msgs/Pose[] mesh_poses
shape_msgs/Plane[] planes
geometry_msgs/Pose[] plane_poses
string[] subframe_names
geometry_msgs/Pose[] subframe_poses
byte operation
"#),
    ("moveit_msgs/msg/LinkPadding", r#"string link_name
float64 padding
"#),
    ("moveit_msgs/msg/LinkScale", r#"string link_name
float64 scale
"#),
    ("moveit_msgs/msg/ObjectColor", r#"string id
std_msgs/ColorRGBA color
"#),
    ("moveit_msgs/msg/PlanningScene", r#"string name
RobotState robot_state
string robot_model_name
geometry_msgs/TransformStamped[] fixed_frame_transforms
AllowedCollisionMatrix allowed_collision_matrix
LinkPadding[] link_padding
LinkScale[] link_scale
ObjectColor[] object_colors
PlanningSceneWorld world
bool is_diff
"#),
    ("moveit_msgs/msg/PlanningSceneWorld", r#"CollisionObject[] collision_objects
octomap_msgs/OctomapWithPose octomap
"#),
    ("moveit_msgs/msg/RobotState", r#"sensor_msgs/JointState joint_state
sensor_msgs/MultiDOFJointState multi_dof_joint_state
AttachedCollisionObject[] attached_collision_objects
bool is_diff
"#),
    ("object_recognition_msgs/msg/ObjectType", r#"string key
string db
"#),
    ("octomap_msgs/msg/Octomap", r#"std_msgs/Header header
bool binary
string id
float64 resolution
int8[] data
"#),
    ("octomap_msgs/msg/OctomapWithPose", r#"std_msgs/Header header
geometry_msgs/Pose origin
Octomap octomap
"#),
    ("rcl_interfaces/msg/FloatingPointRange", r#"float64 from_value
float64 to_value
float64 step
"#),
    ("rcl_interfaces/msg/IntegerRange", r#"int64 from_value
int64 to_value
uint64 step
"#),
    ("rcl_interfaces/msg/ListParametersResult", r#"string[] names
string[] prefixes
"#),
    ("rcl_interfaces/msg/Log", r#"uint8 DEBUG=10
uint8 INFO=20
uint8 WARN=30
uint8 ERROR=40
uint8 FATAL=50

builtin_interfaces/Time stamp
uint8 level
string name
string msg
string file
string function
uint32 line
"#),
    ("rcl_interfaces/msg/Parameter", r#"string name
ParameterValue value
"#),
    ("rcl_interfaces/msg/ParameterDescriptor", r#"string name
uint8 type
string description
string additional_constraints
bool read_only false
bool dynamic_typing false
FloatingPointRange[<=1] floating_point_range
IntegerRange[<=1] integer_range
"#),
    ("rcl_interfaces/msg/ParameterEvent", r#"builtin_interfaces/Time stamp
string node
Parameter[] new_parameters
Parameter[] changed_parameters
Parameter[] deleted_parameters
"#),
    ("rcl_interfaces/msg/ParameterEventDescriptors", r#"ParameterDescriptor[] new_parameters
ParameterDescriptor[] changed_parameters
ParameterDescriptor[] deleted_parameters
"#),
    ("rcl_interfaces/msg/ParameterType", r#"uint8 PARAMETER_NOT_SET=0
uint8 PARAMETER_BOOL=1
uint8 PARAMETER_INTEGER=2
uint8 PARAMETER_DOUBLE=3
uint8 PARAMETER_STRING=4
uint8 PARAMETER_BYTE_ARRAY=5
uint8 PARAMETER_BOOL_ARRAY=6
uint8 PARAMETER_INTEGER_ARRAY=7
uint8 PARAMETER_DOUBLE_ARRAY=8
uint8 PARAMETER_STRING_ARRAY=9
"#),
    ("rcl_interfaces/msg/ParameterValue", r#"uint8 type
bool bool_value
int64 integer_value
float64 double_value
string string_value
byte[] byte_array_value
bool[] bool_array_value
int64[] integer_array_value
float64[] double_array_value
string[] string_array_value
"#),
    ("rcl_interfaces/msg/SetParametersResult", r#"bool successful
string reason
"#),
    ("rcl_interfaces/srv/DescribeParameters", r#"string[] names
---
ParameterDescriptor[] descriptors
"#),
    ("rcl_interfaces/srv/GetParameterTypes", r#"string[] names
---
uint8[] types
"#),
    ("rcl_interfaces/srv/GetParameters", r#"string[] names
---
ParameterValue[] values
"#),
    ("rcl_interfaces/srv/ListParameters", r#"uint64 DEPTH_RECURSIVE=0
string[] prefixes
uint64 depth
---
ListParametersResult result
"#),
    ("rcl_interfaces/srv/SetParameters", r#"Parameter[] parameters
---
SetParametersResult[] results
"#),
    ("rcl_interfaces/srv/SetParametersAtomically", r#"Parameter[] parameters
---
SetParametersResult result
"#),
    ("rosgraph_msgs/msg/Clock", r#"builtin_interfaces/Time clock
"#),
    ("sensor_msgs/msg/CompressedImage", r#"std_msgs/Header header
string format
uint8[] data
"#),
    ("sensor_msgs/msg/JointState", r#"std_msgs/Header header
string[] name
float64[] position
float64[] velocity
float64[] effort
"#),
    ("sensor_msgs/msg/MultiDOFJointState", r#"std_msgs/Header header
string[] joint_names
geometry_msgs/Transform[] transforms
geometry_msgs/Twist[] twist
geometry_msgs/Wrench[] wrench
"#),
    ("shape_msgs/msg/Mesh", r#"MeshTriangle[] triangles
geometry_msgs/Point[] vertices
"#),
    ("shape_msgs/msg/MeshTriangle", r#"uint32[3] vertex_indices
"#),
    ("shape_msgs/msg/Plane", r#"float64[4] coef
"#),
    ("shape_msgs/msg/SolidPrimitive", r#"uint8 BOX=1
uint8 SPHERE=2
uint8 CYLINDER=3
uint8 CONE=4
uint8 PRISM=5
uint8 BOX_X=0
uint8 BOX_Y=1
uint8 BOX_Z=2
uint8 SPHERE_RADIUS=0
uint8 CYLINDER_HEIGHT=0
uint8 CYLINDER_RADIUS=1
uint8 CONE_HEIGHT=0
uint8 CONE_RADIUS=1
uint8 PRISM_HEIGHT=0

uint8 type
float64[<=3] dimensions
geometry_msgs/Polygon polygon
"#),
    ("std_msgs/msg/Bool", r#"bool data
"#),
    ("std_msgs/msg/Byte", r#"byte data
"#),
    ("std_msgs/msg/Char", r#"char data
"#),
    ("std_msgs/msg/ColorRGBA", r#"float32 r
float32 g
float32 b
float32 a
"#),
    ("std_msgs/msg/Empty", r#""#),
    ("std_msgs/msg/Float32", r#"float32 data
"#),
    ("std_msgs/msg/Float32MultiArray", r#"MultiArrayLayout layout
float32[] data
"#),
    ("std_msgs/msg/Float64", r#"float64 data
"#),
    ("std_msgs/msg/Float64MultiArray", r#"MultiArrayLayout layout
float64[] data
"#),
    ("std_msgs/msg/Header", r#"builtin_interfaces/Time stamp
string frame_id
"#),
    ("std_msgs/msg/Int16", r#"int16 data
"#),
    ("std_msgs/msg/Int32", r#"int32 data
"#),
    ("std_msgs/msg/Int64", r#"int64 data
"#),
    ("std_msgs/msg/Int8", r#"int8 data
"#),
    ("std_msgs/msg/MultiArrayDimension", r#"string label
uint32 size
uint32 stride
"#),
    ("std_msgs/msg/MultiArrayLayout", r#"MultiArrayDimension[] dim
uint32 data_offset
"#),
    ("std_msgs/msg/String", r#"string data
"#),
    ("std_msgs/msg/UInt16", r#"uint16 data
"#),
    ("std_msgs/msg/UInt32", r#"uint32 data
"#),
    ("std_msgs/msg/UInt64", r#"uint64 data
"#),
    ("std_msgs/msg/UInt8", r#"uint8 data
"#),
    ("std_srvs/srv/Empty", r#"---
"#),
    ("std_srvs/srv/SetBool", r#"bool data
---
bool success
string message
"#),
    ("std_srvs/srv/Trigger", r#"---
bool success
string message
"#),
    ("tf2_msgs/msg/TFMessage", r#"geometry_msgs/TransformStamped[] transforms
"#),
    ("trajectory_msgs/msg/JointTrajectory", r#"std_msgs/Header header
string[] joint_names
JointTrajectoryPoint[] points
"#),
    ("trajectory_msgs/msg/JointTrajectoryPoint", r#"float64[] positions
float64[] velocities
float64[] accelerations
float64[] effort
builtin_interfaces/Duration time_from_start
"#),
    ("trajectory_msgs/msg/MultiDOFJointTrajectory", r#"std_msgs/Header header
string[] joint_names
MultiDOFJointTrajectoryPoint[] points
"#),
    ("trajectory_msgs/msg/MultiDOFJointTrajectoryPoint", r#"geometry_msgs/Transform[] transforms
geometry_msgs/Twist[] velocities
geometry_msgs/Twist[] accelerations
builtin_interfaces/Duration time_from_start
"#),
    ("unique_identifier_msgs/msg/UUID", r#"uint8[16] uuid
"#),
    ("vision_msgs/msg/BoundingBox3D", r#"geometry_msgs/Pose center
geometry_msgs/Vector3 size
"#),
    ("vision_msgs/msg/Detection3D", r#"std_msgs/Header header
ObjectHypothesisWithPose[] results
BoundingBox3D bbox
string id
"#),
    ("vision_msgs/msg/Detection3DArray", r#"std_msgs/Header header
Detection3D[] detections
"#),
    ("vision_msgs/msg/ObjectHypothesis", r#"string class_id
float64 score
"#),
    ("vision_msgs/msg/ObjectHypothesisWithPose", r#"ObjectHypothesis hypothesis
geometry_msgs/PoseWithCovariance pose
"#),
    ("visualization_msgs/msg/InteractiveMarker", r#"std_msgs/Header header
geometry_msgs/Pose pose
string name
string description
float32 scale
MenuEntry[] menu_entries
InteractiveMarkerControl[] controls
"#),
    ("visualization_msgs/msg/InteractiveMarkerControl", r#"uint8 INHERIT=0
uint8 FIXED=1
uint8 VIEW_FACING=2
uint8 NONE=0
uint8 MENU=1
uint8 BUTTON=2
uint8 MOVE_AXIS=3
uint8 MOVE_PLANE=4
uint8 ROTATE_AXIS=5
uint8 MOVE_ROTATE=6
uint8 MOVE_3D=7
uint8 ROTATE_3D=8
uint8 MOVE_ROTATE_3D=9

string name
geometry_msgs/Quaternion orientation
uint8 orientation_mode
uint8 interaction_mode
bool always_visible
Marker[] markers
bool independent_marker_orientation
string description
"#),
    ("visualization_msgs/msg/InteractiveMarkerFeedback", r#"uint8 KEEP_ALIVE=0
uint8 POSE_UPDATE=1
uint8 MENU_SELECT=2
uint8 BUTTON_CLICK=3
uint8 MOUSE_DOWN=4
uint8 MOUSE_UP=5

std_msgs/Header header
string client_id
string marker_name
string control_name
uint8 event_type
geometry_msgs/Pose pose
uint32 menu_entry_id
geometry_msgs/Point mouse_point
bool mouse_point_valid
"#),
    ("visualization_msgs/msg/InteractiveMarkerInit", r#"string server_id
uint64 seq_num
InteractiveMarker[] markers
"#),
    ("visualization_msgs/msg/InteractiveMarkerPose", r#"std_msgs/Header header
geometry_msgs/Pose pose
string name
"#),
    ("visualization_msgs/msg/InteractiveMarkerUpdate", r#"uint8 KEEP_ALIVE=0
uint8 UPDATE=1

string server_id
uint64 seq_num
uint8 type
InteractiveMarker[] markers
InteractiveMarkerPose[] poses
string[] erases
"#),
    ("visualization_msgs/msg/Marker", r#"int32 ARROW=0
int32 CUBE=1
int32 SPHERE=2
int32 CYLINDER=3
int32 LINE_STRIP=4
int32 LINE_LIST=5
int32 CUBE_LIST=6
int32 SPHERE_LIST=7
int32 POINTS=8
int32 TEXT_VIEW_FACING=9
int32 MESH_RESOURCE=10
int32 TRIANGLE_LIST=11
int32 ARROW_STRIP=12
int32 ADD=0
int32 MODIFY=0
int32 DELETE=2
int32 DELETEALL=3

std_msgs/Header header
string ns
int32 id
int32 type
int32 action
geometry_msgs/Pose pose
geometry_msgs/Vector3 scale
std_msgs/ColorRGBA color
builtin_interfaces/Duration lifetime
bool frame_locked
geometry_msgs/Point[] points
std_msgs/ColorRGBA[] colors
string texture_resource
sensor_msgs/CompressedImage texture
UVCoordinate[] uv_coordinates
string text
string mesh_resource
MeshFile mesh_file
bool mesh_use_embedded_materials
"#),
    ("visualization_msgs/msg/MarkerArray", r#"Marker[] markers
"#),
    ("visualization_msgs/msg/MenuEntry", r#"uint8 FEEDBACK=0
uint8 ROSRUN=1
uint8 ROSLAUNCH=2

uint32 id
uint32 parent_id
string title
string command
uint8 command_type
"#),
    ("visualization_msgs/msg/MeshFile", r#"string filename
uint8[] data
"#),
    ("visualization_msgs/msg/UVCoordinate", r#"float32 u
float32 v
"#),
    ("visualization_msgs/srv/GetInteractiveMarkers", r#"---
uint64 sequence_number
InteractiveMarker[] markers
"#),
];
