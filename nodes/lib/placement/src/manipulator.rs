//! An arm as this crate uses it: a robot, the chain to its tool, and how it holds the target over a table.

use crate::gripper::{ClosingAxis, Grasp, Gripper};
use crate::settings::{ABOVE_MARGIN_M, LEAST_APPROACH_M};
use crate::{MotionSettings, TablePose};
use arm::{
    AxisGoal, Chain, ChainError, Checker, CollisionModel, Exclusions, Goal, IkOutcome, IkSettings, Isometry3, Obstacle,
    Placed, Point3, Robot, Solid, Translation3, UrdfError, Vector3, World, about_z, solve,
};
use scene::{Object, Point, Scene, Shape};
use std::sync::Arc;
use thiserror::Error;

/// Thickness of the slab that stands for the table, metres.
pub const TABLE_THICKNESS_M: f64 = 0.04;

/// A joint that is slower than this cannot be used, radians or metres per second.
const SLOWEST: f64 = 1e-3;

/// An endless joint is taken to be no farther than this from 0, radians.
const FAR: f64 = 1e3;

/// A joint may be this far beyond its limits and count as at them, radians or metres: encoders are no more exact.
const BEYOND: f64 = 5e-3;

/// Why an arm cannot be used.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum ManipulatorError {
    /// The description is wrong.
    #[error(transparent)]
    Urdf(#[from] UrdfError),
    /// The tool link cannot be moved.
    #[error(transparent)]
    Chain(#[from] ChainError),
    /// A joint of the arm hardly moves, so no motion of it would end in time.
    #[error(
        "joint '{joint}' of the arm has the velocity limit {got}; at least {SLOWEST} rad/s or m/s is needed: give its largest speed in the robot description"
    )]
    Speed {
        /// The joint.
        joint: String,
        /// Its limit.
        got: f64,
    },
    /// The joint of the gripper.
    #[error("the gripper cannot be moved by joint '{joint}': {reason}")]
    Gripper {
        /// The joint.
        joint: String,
        /// Why not.
        reason: String,
    },
}

/// A robot arm with a tool.
#[derive(Debug, Clone)]
pub struct Manipulator {
    pub(crate) robot: Arc<Robot>,
    pub(crate) chain: Chain,
    model: Arc<CollisionModel>,
    hand: Vec<bool>,
    pub(crate) settings: MotionSettings,
}

/// An arm at a table, with the target in its hand.
#[derive(Clone)]
pub(crate) struct Cell<'a> {
    pub manipulator: &'a Manipulator,
    /// Moves the point of the hand that is above the middle of the target when it is held.
    pub chain: Chain,
    pub world: World,
    /// How the target is held, or why it cannot be: the hand is then taken to be above its middle.
    pub grasp: Result<Grasp, String>,
    pub(crate) root_from_table: Isometry3<f64>,
    pub(crate) grip_height_m: f64,
}

impl Manipulator {
    /// Reads an arm from a URDF whose collision shapes are primitives.
    ///
    /// # Errors
    /// A description that is wrong, or a tool link that is not there or does not move.
    pub fn from_urdf(text: &str, settings: MotionSettings) -> Result<Self, ManipulatorError> {
        Self::new(Robot::from_urdf(text)?, None, settings)
    }

    /// An arm that was read already, with the pairs of links that may touch; without such a list those that always do.
    ///
    /// # Errors
    /// A tool link that is not there or does not move, or a joint of the arm that may not move.
    pub fn new(
        robot: Robot,
        exclusions: Option<&Exclusions>,
        mut settings: MotionSettings,
    ) -> Result<Self, ManipulatorError> {
        // Nearer than the margin to what it is put on, the target would count as touching it.
        settings.release_m = settings.release_m.max(settings.margin_m + ABOVE_MARGIN_M);
        let chain = Chain::new(&robot, &settings.tool_link)?;
        let limits = |entry: usize| robot.driven_joint(entry).limits;
        if let Some(&still) = chain.entries.iter().find(|&&entry| limits(entry).velocity < SLOWEST) {
            let joint = robot.driven_joint(still).name.clone();
            return Err(ManipulatorError::Speed { joint, got: limits(still).velocity });
        }
        if let Some(gripper) = &settings.gripper {
            check_gripper(&robot, &chain, gripper)
                .map_err(|reason| ManipulatorError::Gripper { joint: gripper.joint.clone(), reason })?;
        }
        let model = match exclusions {
            Some(exclusions) => CollisionModel::new(&robot, exclusions),
            None => CollisionModel::new(&robot, &Exclusions::derived(&robot, settings.seed)),
        };
        let hand = chain.hand(&robot);
        Ok(Self { robot: Arc::new(robot), chain, model: Arc::new(model), hand, settings })
    }

    /// One for each thread.
    pub(crate) fn checker(&self) -> Checker {
        Checker::new(Arc::clone(&self.robot), Arc::clone(&self.model))
    }

    /// The robot.
    pub fn robot(&self) -> &Robot {
        &self.robot
    }

    /// Names of the joints that move the tool, in the order of a trajectory.
    pub fn joint_names(&self) -> Vec<String> {
        self.chain.joint_names(&self.robot).map(String::from).collect()
    }

    /// Joints that move the tool of which nothing is said, in the order of a trajectory.
    pub fn unheard(&self, joints: &[(String, f64)]) -> Vec<String> {
        let heard = |name: &String| joints.iter().any(|(joint, position)| joint == name && position.is_finite());
        self.joint_names().into_iter().filter(|name| !heard(name)).collect()
    }

    /// The first joint that moves the tool and is beyond its limits by more than [`BEYOND`], in words.
    pub(crate) fn outside(&self, joints: &[(String, f64)]) -> Option<String> {
        self.chain.entries.iter().find_map(|&entry| {
            let joint = self.robot.driven_joint(entry);
            let (lower, upper) = (joint.limits.lower.max(-FAR), joint.limits.upper.min(FAR));
            let (_, at) = joints.iter().find(|(name, _)| *name == joint.name)?;
            let beyond = *at < lower - BEYOND || *at > upper + BEYOND;
            beyond.then(|| format!("joint '{}' is at {at:.3}, outside its limits {lower:.3} to {upper:.3}", joint.name))
        })
    }

    /// Joints that move the tool by name but have nowhere to go.
    pub(crate) fn stuck(&self) -> Vec<&str> {
        let joints = self.chain.entries.iter().map(|&entry| self.robot.driven_joint(entry));
        let stuck = joints.filter(|joint| joint.limits.upper - joint.limits.lower < BEYOND);
        stuck.map(|joint| joint.name.as_str()).collect()
    }

    /// A configuration of the whole robot from named positions, clamped to limits: what is not named, or not finite,
    /// rests. Names that are none of the robot's are ignored.
    pub fn configuration(&self, joints: &[(String, f64)]) -> Vec<f64> {
        let mut q = self.robot.rest();
        for (i, q) in q.iter_mut().enumerate() {
            let joint = self.robot.driven_joint(i);
            let named = joints.iter().find(|(name, position)| *name == joint.name && position.is_finite());
            if let Some((_, position)) = named {
                let limits = &joint.limits;
                *q = position.clamp(limits.lower.max(-FAR), limits.upper.min(FAR));
            }
        }
        q
    }

    /// A configuration with the gripper's joint where it is told to go.
    pub(crate) fn with_gripper_at(&self, position: f64, q: &[f64]) -> Vec<f64> {
        let mut q = q.to_vec();
        let joint = self.settings.gripper.as_ref().and_then(|gripper| driven(&self.robot, &gripper.joint));
        if let Some(entry) = joint {
            q[entry] = position;
        }
        q
    }

    /// How the gripper takes hold of the target of a scene; `None` without a gripper.
    ///
    /// # Errors
    /// In words: why it cannot.
    pub fn grasp(&self, scene: &Scene) -> Option<Result<Grasp, String>> {
        self.settings.gripper.as_ref().map(|gripper| gripper.grasp(&scene.target.shape))
    }

    /// How a held target is turned about the vertical, seen from the tool, radians.
    pub fn turn_in_hand_rad(&self, scene: &Scene) -> f64 {
        self.grasp(scene).and_then(Result::ok).map_or(0.0, |grasp| grasp.turn_rad)
    }

    /// The gripper.
    pub fn gripper(&self) -> Option<&Gripper> {
        self.settings.gripper.as_ref()
    }

    /// Which links the hand is made of, one entry per link.
    pub(crate) fn hand(&self) -> &[bool] {
        &self.hand
    }

    /// Every link in the table's frame, in the order of [`Robot::links`]. `None` where nobody says where the table is.
    pub fn link_poses(&self, table_frame: &str, joints: &[(String, f64)]) -> Option<Vec<Isometry3<f64>>> {
        let table_from_root = self.root_from_table(table_frame)?.inverse();
        let mut poses = Vec::new();
        self.robot.link_poses(&self.configuration(joints), &mut poses);
        poses.iter_mut().for_each(|pose| *pose = table_from_root * *pose);
        Some(poses)
    }

    /// The same along a trajectory: for each of `points`, positions of the joints `names`; other joints stay where `start` has them.
    pub fn poses_along<'p>(
        &self,
        table_frame: &str,
        start: &[(String, f64)],
        names: &[String],
        points: impl Iterator<Item = &'p [f64]>,
    ) -> Option<Vec<Vec<Isometry3<f64>>>> {
        let mut joints = start.to_vec();
        points
            .map(|positions| {
                for (name, &position) in names.iter().zip(positions) {
                    match joints.iter_mut().find(|(joint, _)| joint == name) {
                        Some((_, at)) => *at = position,
                        None => joints.push((name.clone(), position)),
                    }
                }
                self.link_poses(table_frame, &joints)
            })
            .collect()
    }

    /// The link that holds the target, in the order of [`Robot::links`].
    pub fn tool_link(&self) -> usize {
        self.chain.tool
    }

    fn root_from_table(&self, frame: &str) -> Option<Isometry3<f64>> {
        match (self.robot.link_index(frame), self.settings.table) {
            (Some(link), _) => self.robot.fixed_pose(link),
            (None, Some(TablePose { position_m: [x, y, z], yaw_rad })) => {
                Some(Isometry3::from_parts(Translation3::new(x, y, z), about_z(yaw_rad)))
            }
            (None, None) => None,
        }
    }

    /// Why it does not stand at the table of a scene.
    pub(crate) fn not_at(&self, scene: &Scene) -> String {
        format!(
            "the robot '{}' has no fixed link '{}', the frame of the table; join one to its base by a fixed joint, or say where the table is",
            self.robot.name, scene.frame
        )
    }

    /// The arm at the table of a scene with the target in hand, `None` when no link of the robot is the scene's frame (and the
    /// settings do not say where it is) or that link moves. Objects are left out unless `with_objects`.
    pub(crate) fn at_table(&self, scene: &Scene, with_objects: bool) -> Option<Cell<'_>> {
        let root_from_table = self.root_from_table(&scene.frame)?;
        let mut world = World::new();
        let half_extents = [0.5 * scene.width_m, 0.5 * scene.depth_m, 0.5 * TABLE_THICKNESS_M];
        let middle = Translation3::new(half_extents[0], half_extents[1], -half_extents[2]);
        world.add(Obstacle {
            name: "table".into(),
            solid: Solid::Box { half_extents },
            root_from_solid: root_from_table * middle,
        });
        if with_objects {
            for object in &scene.objects {
                let at = Translation3::new(object.position_m.x, object.position_m.y, 0.5 * object.shape.height_m());
                world.add(Obstacle {
                    name: object.id.clone(),
                    solid: solid(object),
                    root_from_solid: root_from_table * Isometry3::from_parts(at, about_z(object.yaw_rad)),
                });
            }
        }
        let height = scene.target.shape.height_m();
        let grip_height_m = height - self.settings.grip_m.min(0.5 * height);
        let grasp = self.grasp(scene).unwrap_or(Ok(Grasp::CENTRAL));
        let held = grasp.clone().unwrap_or(Grasp::CENTRAL);
        let axis = self.gripper().map_or(ClosingAxis::default(), |gripper| gripper.axis);
        let tool_from_point = held.tool_from_point(axis);
        // The tool's z axis points down, the target's centre is below the tool.
        let below =
            Isometry3::from_parts(Translation3::new(0.0, 0.0, grip_height_m - 0.5 * height), about_z(held.turn_rad));
        let placed = Placed { solid: solid(&scene.target), owner_from_solid: tool_from_point * below };
        world.hold(&scene.target.id, self.chain.tool, placed, self.hand.clone());
        let chain = self.chain.moving_point(&tool_from_point);
        Some(Cell { manipulator: self, chain, world, grasp, root_from_table, grip_height_m })
    }
}

/// The entry of a joint in a configuration.
fn driven(robot: &Robot, joint: &str) -> Option<usize> {
    (0..robot.dof()).find(|&i| robot.driven_joint(i).name == joint)
}

fn check_gripper(robot: &Robot, chain: &Chain, gripper: &Gripper) -> Result<(), String> {
    let Some(entry) = driven(robot, &gripper.joint) else {
        return Err("no joint of that name can be driven; a joint that mimics another moves with that one".into());
    };
    if chain.entries.contains(&entry) {
        return Err("it moves the tool".into());
    }
    let limits = robot.driven_joint(entry).limits;
    for (what, at) in [("closed", gripper.closed), ("open", gripper.open)] {
        if !(at >= limits.lower - 1e-6 && at <= limits.upper + 1e-6) {
            let (lower, upper) = (limits.lower, limits.upper);
            return Err(format!("{what} at {at:.4} is outside its limits {lower:.4} to {upper:.4}"));
        }
    }
    gripper.check()
}

impl Cell<'_> {
    /// Where the tool is when the target's base is `base_m` above the table at a point.
    pub fn goal(&self, at_m: Point, base_m: f64) -> Goal {
        let position = self.root_from_table * Point3::new(at_m.x, at_m.y, base_m + self.grip_height_m);
        let direction = self.root_from_table.rotation * -Vector3::z_axis();
        Goal::Axis(AxisGoal { position: position.coords, direction })
    }

    /// Whether nothing touches in a configuration.
    pub fn is_free(&self, q: &[f64], checker: &mut Checker) -> bool {
        checker.is_free(q, &self.world, self.manipulator.settings.margin_m)
    }

    /// What touches in a configuration.
    pub fn contact(&self, q: &[f64]) -> Option<(String, String)> {
        let Manipulator { robot, settings, .. } = self.manipulator;
        let contact = self.manipulator.checker().first_contact(q, &self.world, settings.margin_m)?;
        Some((contact.a.name(robot, &self.world).into(), contact.b.name(robot, &self.world).into()))
    }

    /// A configuration that puts the target's base `base_m` above a point and touches nothing, there and a little above;
    /// `None` when none was found.
    pub fn place(&self, at_m: Point, base_m: f64, start: &[f64], restarts: usize) -> Option<Vec<f64>> {
        let Manipulator { robot, settings, .. } = self.manipulator;
        let chain = &self.chain;
        let ik = IkSettings { restarts, seed: settings.seed, ..IkSettings::default() };
        let above = IkSettings { restarts: 0, ..ik };
        let lifted = self.goal(at_m, base_m + LEAST_APPROACH_M);
        let mut checker = self.manipulator.checker();
        let outcome = solve(robot, chain, &self.goal(at_m, base_m), start, &ik, |q| {
            let rises = |checker: &mut Checker| match solve(robot, chain, &lifted, q, &above, |_| true) {
                IkOutcome::Solved(up) => self.is_free(&up, checker),
                _ => false,
            };
            self.is_free(q, &mut checker) && rises(&mut checker)
        });
        match outcome {
            IkOutcome::Solved(q) => Some(q),
            _ => None,
        }
    }
}

pub(crate) fn solid(object: &Object) -> Solid {
    match object.shape {
        Shape::Cylinder { radius_m, height_m } => Solid::Cylinder { radius: radius_m, half_length: 0.5 * height_m },
        Shape::Box { width_m, depth_m, height_m } => {
            Solid::Box { half_extents: [0.5 * width_m, 0.5 * depth_m, 0.5 * height_m] }
        }
    }
}

/// What the target stands on at a point, besides the table.
pub(crate) fn under(scene: &Scene, at_m: Point) -> impl Iterator<Item = &Object> {
    let radius_m = scene.target.shape.bounding_radius_m();
    scene.objects.iter().filter(move |object| object.supports && object.distance_m(at_m) < radius_m)
}

/// Height of the target's base where it stands at a point, metres above the table: on what supports it, if anything does.
pub fn resting_height_m(scene: &Scene, at_m: Point) -> f64 {
    under(scene, at_m).map(|object| object.shape.height_m()).fold(0.0, f64::max)
}
