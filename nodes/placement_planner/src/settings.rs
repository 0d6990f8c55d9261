//! Parameters of the node.

use crate::carrying::Fingers;
use bus::{NodeSettings, ParameterSpec, Range};
use placement::{Gripper, MotionSettings, TablePose};
use serde::{Deserialize, Serialize};

/// Parameters of `placement_planner`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Settings {
    /// Seed of the search for motions.
    pub seed: i64,
    /// Which place is taken, of those in reach: `map`, `mean`, `var`, `cvar` or `most_likely`.
    pub choice: String,
    /// Level of `var` and `cvar`.
    pub alpha: f64,
    /// Threads; plans do not depend on it. 0: as many as there are cores.
    pub threads: i64,
    /// The link between the fingertips, whose z axis points out of the hand.
    pub tool_link: String,
    /// The joint that moves the fingers; empty: there is no gripper, and the target stays in the hand.
    pub gripper_joint: String,
    /// Where that joint is when the fingers touch each other, radians or metres.
    pub gripper_closed: f64,
    /// Where it is when they are as far apart as they go.
    pub gripper_open: f64,
    /// How far apart they are then, metres.
    pub gripper_opening_m: f64,
    /// The axis of the tool link along which they close: `x` or `y`.
    pub gripper_axis: String,
    /// The gripper's action, of the type `control_msgs/action/GripperCommand`; empty: its joint is moved on `/joint_trajectory`.
    pub gripper_controller: String,
    /// How hard it may press, as its controller understands it.
    pub gripper_effort: f64,
    /// Whether the target is picked up from where `target_pose` says it stands; else it is put into the hand.
    pub pick: bool,
    /// Nothing is picked up when the newest `target_pose` is older than this, seconds.
    pub target_age_s: f64,
    /// Where the origin of the table's frame is in the robot's root link: x, y, z, metres; empty: a fixed link of the robot
    /// has the frame's name.
    pub table_position_m: Vec<f64>,
    /// How the table is turned about the vertical there, radians.
    pub table_yaw_rad: f64,
    /// Folders that hold the packages of the robot's meshes, or are such packages; nothing else is read.
    pub package_paths: Vec<String>,
    /// A file with the robot's SRDF; empty: the topic `/robot_description_semantic`, if anything is said there.
    pub srdf: String,
    /// What to do about a mesh that is not found: `refuse` the robot, or `bound` the link by a box.
    pub missing_meshes: String,
    /// Things nearer than this count as touching, metres.
    pub margin_m: f64,
    /// How far above its place the target is brought before it is lowered, metres.
    pub approach_m: f64,
    /// Share of each joint's velocity limit that is used.
    pub speed: f64,
    /// Whether a taught robot moves: the plan's trajectory goes out on `/joint_trajectory`.
    pub execute: bool,
    /// The controller's action, of the type `control_msgs/action/FollowJointTrajectory`; empty: trajectories go out on
    /// `/joint_trajectory`.
    pub controller: String,
    /// A motion may take this much longer than planned, seconds.
    pub patience_s: f64,
    /// Nothing moves when the joint states are older than this, seconds.
    pub joint_age_s: f64,
    /// How often the newest guess and plan are sent again, seconds.
    pub republish_period_s: f64,
}

impl Default for Settings {
    fn default() -> Self {
        let motion = MotionSettings::default();
        Self {
            seed: 1,
            choice: motion.choice.name().to_owned(),
            alpha: 0.95,
            threads: 0,
            tool_link: motion.tool_link,
            gripper_joint: String::new(),
            gripper_closed: 0.0,
            gripper_open: 0.075,
            gripper_opening_m: 0.154,
            gripper_axis: "y".to_owned(),
            gripper_controller: String::new(),
            gripper_effort: 20.0,
            pick: false,
            target_age_s: 5.0,
            table_position_m: Vec::new(),
            table_yaw_rad: 0.0,
            package_paths: Vec::new(),
            srdf: String::new(),
            missing_meshes: "refuse".to_owned(),
            margin_m: motion.margin_m,
            approach_m: motion.approach_m,
            speed: motion.speed,
            execute: true,
            controller: String::new(),
            patience_s: 3.0,
            joint_age_s: 1.0,
            republish_period_s: 2.0,
        }
    }
}

impl NodeSettings for Settings {
    const NODE: &'static str = "placement_planner";
    const ABOUT: &'static str = "Plans where to put the target and how the arm gets it there, free of collisions";
    const PARAMETERS: &'static [ParameterSpec] = &[
        ParameterSpec {
            name: "seed",
            about: "seed of the search for motions",
            range: Range::Integer { min: 0, max: i64::MAX },
        },
        ParameterSpec {
            name: "choice",
            about: "which place is taken, of those in reach: the best under the `map` or `mean` reward; the one with the smallest \
                    `var` or `cvar` of the distance to the person's; or the `most_likely` best",
            range: Range::Choice(&["map", "mean", "var", "cvar", "most_likely"]),
        },
        ParameterSpec {
            name: "alpha",
            about: "level of the risk that `var` and `cvar` make small",
            range: Range::Float { min: 0.5, max: 0.999 },
        },
        ParameterSpec {
            name: "threads",
            about: "threads; 0: as many as there are cores. Plans do not depend on it",
            range: Range::Integer { min: 0, max: 1024 },
        },
        ParameterSpec {
            name: "tool_link",
            about: "link between the fingertips, whose z axis points out of the hand",
            range: Range::Any,
        },
        ParameterSpec {
            name: "gripper_joint",
            about: "joint that moves the fingers, others mimic it; empty: there is no gripper, and the target stays in the hand",
            range: Range::Any,
        },
        ParameterSpec {
            name: "gripper_closed",
            about: "where that joint is when the fingers touch each other, radians or metres",
            range: Range::Float { min: -10.0, max: 10.0 },
        },
        ParameterSpec {
            name: "gripper_open",
            about: "where it is when they are as far apart as they go, radians or metres",
            range: Range::Float { min: -10.0, max: 10.0 },
        },
        ParameterSpec {
            name: "gripper_opening_m",
            about: "how far apart the fingers are then, metres: what is wider is taken by its rim if it is round, else not at all",
            range: Range::Float { min: 0.001, max: 1.0 },
        },
        ParameterSpec {
            name: "gripper_axis",
            about: "axis of the tool link along which the fingers close",
            range: Range::Choice(&["x", "y"]),
        },
        ParameterSpec {
            name: "gripper_controller",
            about: "action of a gripper's controller (control_msgs/action/GripperCommand), such as \
                    /gripper_controller/gripper_cmd; empty: the joint is moved on /joint_trajectory",
            range: Range::Any,
        },
        ParameterSpec {
            name: "gripper_effort",
            about: "how hard the fingers may press, as their controller understands it",
            range: Range::Float { min: 0.0, max: 10_000.0 },
        },
        ParameterSpec {
            name: "pick",
            about: "whether the target is picked up from where target_pose says it stands; else somebody puts it into the hand",
            range: Range::Any,
        },
        ParameterSpec {
            name: "target_age_s",
            about: "nothing is picked up when the newest target_pose is older than this, seconds",
            range: Range::Float { min: 0.1, max: 3600.0 },
        },
        ParameterSpec {
            name: "table_position_m",
            about: "where the origin of the table's frame is in the robot's root link: x, y, z, metres; empty: a fixed link of \
                    the robot has the frame's name",
            range: Range::Float { min: -100.0, max: 100.0 },
        },
        ParameterSpec {
            name: "table_yaw_rad",
            about: "how the table is turned about the vertical there, radians",
            range: Range::Float { min: -7.0, max: 7.0 },
        },
        ParameterSpec {
            name: "package_paths",
            about: "folders that hold the packages of the robot's meshes, or are such packages; nothing else is read",
            range: Range::Any,
        },
        ParameterSpec {
            name: "srdf",
            about: "file with the robot's SRDF: which links may touch; empty: as said on /robot_description_semantic, else \
                    those that always do",
            range: Range::Any,
        },
        ParameterSpec {
            name: "missing_meshes",
            about: "what to do about a mesh that is not found: `refuse` the robot, or `bound` the link by a box that is guessed",
            range: Range::Choice(&["refuse", "bound"]),
        },
        ParameterSpec {
            name: "margin_m",
            about: "things nearer than this count as touching, metres",
            range: Range::Float { min: 0.0, max: 0.1 },
        },
        ParameterSpec {
            name: "approach_m",
            about: "how far above its place the target is brought before it is lowered, metres",
            range: Range::Float { min: 0.03, max: 1.0 },
        },
        ParameterSpec {
            name: "speed",
            about: "share of each joint's velocity limit that is used",
            range: Range::Float { min: 0.01, max: 1.0 },
        },
        ParameterSpec {
            name: "execute",
            about: "whether a taught robot moves by itself; goals of place_object move it anyway, once it is taught",
            range: Range::Any,
        },
        ParameterSpec {
            name: "controller",
            about: "action of a joint trajectory controller, such as /joint_trajectory_controller/follow_joint_trajectory; \
                    empty: trajectories go out on /joint_trajectory",
            range: Range::Any,
        },
        ParameterSpec {
            name: "patience_s",
            about: "a motion may take this much longer than planned, seconds",
            range: Range::Float { min: 0.1, max: 600.0 },
        },
        ParameterSpec {
            name: "joint_age_s",
            about: "nothing moves when the joint states are older than this, seconds",
            range: Range::Float { min: 0.01, max: 60.0 },
        },
        ParameterSpec {
            name: "republish_period_s",
            about: "how often the newest guess and plan are sent again, seconds",
            range: Range::Float { min: 0.1, max: 3600.0 },
        },
    ];

    fn check(&self) -> Result<(), String> {
        if !(1..=128).contains(&self.tool_link.len()) {
            return Err(format!("tool_link has {} characters; 1 to 128 are allowed", self.tool_link.len()));
        }
        if self.gripper_joint.is_empty() && (self.pick || !self.gripper_controller.is_empty()) {
            return Err("picking something up takes a gripper: name its joint in gripper_joint".into());
        }
        self.gripper().map_or(Ok(()), |gripper| gripper.check())?;
        match self.table_position_m.len() {
            0 | 3 => Ok(()),
            got => Err(format!("table_position_m has {got} entries; it must have 3 (x, y, z), or none")),
        }
    }

    fn seed(&self) -> u64 {
        self.seed.unsigned_abs()
    }
}

impl Settings {
    /// The part of the parameters that is about motion.
    pub(crate) fn motion(&self) -> MotionSettings {
        MotionSettings {
            choice: self.choice.parse().unwrap_or_default(),
            tool_link: self.tool_link.clone(),
            gripper: self.gripper(),
            table: match *self.table_position_m.as_slice() {
                [x, y, z] => Some(TablePose { position_m: [x, y, z], yaw_rad: self.table_yaw_rad }),
                _ => None,
            },
            margin_m: self.margin_m,
            approach_m: self.approach_m,
            speed: self.speed,
            seed: self.seed.unsigned_abs(),
            ..MotionSettings::default()
        }
    }

    fn gripper(&self) -> Option<Gripper> {
        (!self.gripper_joint.is_empty()).then(|| Gripper {
            joint: self.gripper_joint.clone(),
            closed: self.gripper_closed,
            open: self.gripper_open,
            opening_m: self.gripper_opening_m,
            axis: self.gripper_axis.parse().unwrap_or_default(),
        })
    }

    /// The gripper, and how it is told.
    pub(crate) fn fingers(&self) -> Option<Fingers> {
        let has_controller = !self.gripper_controller.is_empty();
        self.gripper().map(|gripper| Fingers { gripper, has_controller, effort: self.gripper_effort })
    }

    /// Threads to plan with.
    pub(crate) fn n_threads(&self) -> usize {
        match usize::try_from(self.threads) {
            Ok(threads) if threads > 0 => threads,
            _ => std::thread::available_parallelism().map_or(1, std::num::NonZero::get),
        }
    }
}
