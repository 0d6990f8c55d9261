//! The world as a pure state machine: time and trajectories in, the table and the arm's joints out.

use crate::target::Target;
use crate::{Follower, LayoutError, RobotError, RobotModel, Settings, task_scene};
use apprentice_msgs::builtin_interfaces::Time;
use apprentice_msgs::geometry_msgs::{PoseStamped, Transform, TransformStamped, Vector3};
use apprentice_msgs::msg::TableScene;
use apprentice_msgs::sensor_msgs::JointState;
use apprentice_msgs::std_msgs::{self, Header};
use apprentice_msgs::tf2_msgs::TFMessage;
use apprentice_msgs::trajectory_msgs::JointTrajectory;
use placement::Stand;
use scene::Scene;
use thiserror::Error;

/// What the node takes.
#[derive(Debug, Clone, PartialEq)]
pub enum Event {
    /// Say again what stands on the table.
    Announce,
    /// Say where the joints are.
    Tick,
    /// Move the arm.
    Trajectory(JointTrajectory),
}

/// What the node gives.
#[derive(Debug, Clone, PartialEq)]
pub enum Output {
    /// What stands on the table.
    Scene(TableScene),
    /// The robot's URDF.
    RobotDescription(std_msgs::String),
    /// Where the robot stands.
    Transform(TFMessage),
    /// Where the joints are.
    Joints(JointState),
    /// Where the thing to place is: the middle of its base.
    TargetPose(PoseStamped),
    /// Something for the log.
    Warning(String),
}

/// Why there is no world.
#[derive(Debug, Error)]
pub enum TableError {
    /// The table.
    #[error(transparent)]
    Layout(#[from] LayoutError),
    /// The robot.
    #[error(transparent)]
    Robot(#[from] RobotError),
}

/// The simulated world.
#[derive(Debug)]
pub struct SimulatedTableNode {
    scene: Scene,
    robot: RobotModel,
    base_m: [f64; 3],
    base_yaw_rad: f64,
    follower: Follower,
    target: Option<Target>,
    /// Where it was said to be last, and when.
    told: Option<(Stand, Time)>,
    announced: Option<Time>,
    announcements: u64,
}

/// The robot's description is said again with every so many announcements of the table.
const ROBOT_EVERY: u64 = 5;
/// Where the thing to place is is said this often while it stands, nanoseconds.
const TARGET_EVERY_NS: i128 = 500_000_000;

impl SimulatedTableNode {
    /// The world that the settings describe; `urdf` is the text of the robot's description.
    ///
    /// # Errors
    /// When the table or the robot is wrong.
    pub fn new(settings: &Settings, urdf: String) -> Result<Self, TableError> {
        let robot = RobotModel::new(urdf, &settings.start_positions)?;
        let scene = task_scene(settings)?;
        Ok(Self {
            target: Target::new(settings, &robot, &scene)?,
            told: None,
            scene,
            follower: Follower::new(robot.joints.clone(), robot.start.clone()),
            robot,
            base_m: settings.robot_base_m(),
            base_yaw_rad: settings.robot_base_yaw_rad,
            announced: None,
            announcements: 0,
        })
    }

    /// The table.
    pub fn scene(&self) -> &Scene {
        &self.scene
    }

    /// Takes one event at a time.
    pub fn step(&mut self, now: Time, event: Event) -> Vec<Output> {
        match event {
            Event::Announce => self.announce(now),
            Event::Tick => self.tick(now),
            Event::Trajectory(trajectory) => match self.follower.follow(now.nanoseconds(), &trajectory) {
                Ok(()) => Vec::new(),
                Err(error) => vec![Output::Warning(format!("ignored a joint trajectory: {error}"))],
            },
        }
    }

    fn tick(&mut self, now: Time) -> Vec<Output> {
        let mut positions = self.follower.positions(now.nanoseconds());
        if let Some(target) = &mut self.target {
            target.follow(&self.scene, &mut positions);
        }
        let mut outputs = vec![Output::Joints(self.joints(now, positions))];
        if let Some(target) = &self.target {
            let stand = *target.stand();
            let is_known = |(told, at): &(Stand, Time)| {
                *told == stand && (0..TARGET_EVERY_NS).contains(&now.nanoseconds_since(at))
            };
            if !self.told.as_ref().is_some_and(is_known) {
                self.told = Some((stand, now));
                let header = Header { stamp: now, frame_id: self.scene.frame.clone() };
                let pose = exchange::pose_at([stand.at_m.x, stand.at_m.y, stand.base_m], stand.yaw_rad);
                outputs.push(Output::TargetPose(PoseStamped { header, pose }));
            }
        }
        outputs
    }

    /// The table keeps the stamp of its first announcement: it has not changed since.
    fn announce(&mut self, now: Time) -> Vec<Output> {
        let with_robot = self.announcements.is_multiple_of(ROBOT_EVERY);
        self.announcements += 1;
        let stamp = *self.announced.get_or_insert(now);
        let scene = exchange::scene_to_message(&self.scene, stamp);
        let mut outputs = vec![Output::Scene(scene)];
        if with_robot {
            outputs.push(Output::RobotDescription(std_msgs::String { data: self.robot.urdf.clone() }));
            // A robot whose root link is the table itself needs no transform.
            if self.robot.root != self.scene.frame {
                outputs.push(Output::Transform(self.transform(stamp)));
            }
        }
        outputs
    }

    fn transform(&self, stamp: Time) -> TFMessage {
        let [x, y, z] = self.base_m;
        TFMessage {
            transforms: vec![TransformStamped {
                header: Header { stamp, frame_id: self.scene.frame.clone() },
                child_frame_id: self.robot.root.clone(),
                transform: Transform {
                    translation: Vector3 { x, y, z },
                    rotation: exchange::upright(self.base_yaw_rad),
                },
            }],
        }
    }

    fn joints(&self, now: Time, position: Vec<f64>) -> JointState {
        JointState {
            name: self.follower.joints().iter().map(|joint| joint.name.clone()).collect(),
            position,
            header: Header { stamp: now, frame_id: String::new() },
            ..JointState::default()
        }
    }
}
