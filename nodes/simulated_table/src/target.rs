//! The thing to place, as it stands, is held and falls.

use crate::{RobotError, RobotModel, Settings};
use arm::{Isometry3, Robot, Translation3, Vector3, about_z};
use placement::{Gripper, Stand, resting_height_m};
use scene::{Point, Scene, Shape};

/// The tool may be this far outside of what it takes hold of, metres.
const NEAR_M: f64 = 0.02;
/// Fingers that are farther apart than what they hold by this let it go, metres.
const LETS_GO_M: f64 = 1e-4;

/// See the module.
#[derive(Debug, Clone)]
pub(crate) struct Target {
    robot: Robot,
    table_from_root: Isometry3<f64>,
    tool: usize,
    /// The gripper's joint in a configuration.
    finger: usize,
    gripper: Gripper,
    /// How wide it is between the fingers; `None`: they cannot hold it.
    width_m: Option<f64>,
    stand: Stand,
    /// tool_from_target, of its base.
    held: Option<Isometry3<f64>>,
    /// Whether the fingers were wide enough for it at the last tick.
    was_open: bool,
}

impl Target {
    /// What the settings say stands somewhere.
    ///
    /// # Errors
    /// A tool or a gripper that the robot does not have.
    pub fn new(settings: &Settings, robot: &RobotModel, scene: &Scene) -> Result<Option<Self>, RobotError> {
        let [x, y] = *settings.target_position_m.as_slice() else { return Ok(None) };
        let model = robot.read()?;
        let missing = |what: &'static str, name: &str| RobotError::Missing { what, name: name.to_owned() };
        let tool = model.link_index(&settings.tool_link).ok_or_else(|| missing("link", &settings.tool_link))?;
        let gripper = settings.gripper().ok_or_else(|| missing("gripper joint", ""))?;
        let finger = robot.joints.iter().position(|known| known.name == gripper.joint);
        let finger = finger.ok_or_else(|| missing("driven joint", &gripper.joint))?;
        let [bx, by, bz] = settings.robot_base_m();
        let table_from_root = match robot.root == scene.frame {
            true => Isometry3::identity(),
            false => Isometry3::from_parts(Translation3::new(bx, by, bz), about_z(settings.robot_base_yaw_rad)),
        };
        let at_m = Point::new(x, y);
        let base_m = resting_height_m(scene, at_m);
        Ok(Some(Self {
            width_m: gripper.grasp(&scene.target.shape).ok().map(|grasp| grasp.width_m),
            stand: Stand { at_m, base_m, yaw_rad: settings.target_yaw_rad },
            was_open: false,
            held: None,
            robot: model,
            table_from_root,
            tool,
            finger,
            gripper,
        }))
    }

    /// Where it is.
    pub fn stand(&self) -> &Stand {
        &self.stand
    }

    /// Lets it follow the arm to a configuration, in which fingers that hold it are stopped by it.
    pub fn follow(&mut self, scene: &Scene, q: &mut [f64]) {
        let Some(width_m) = self.width_m else { return };
        let apart_m = self.gripper.apart_m(q[self.finger]);
        let mut poses = Vec::new();
        self.robot.link_poses(q, &mut poses);
        let tool = self.table_from_root * poses[self.tool];
        match self.held {
            None if self.was_open && apart_m < width_m && self.is_about(&tool, &scene.target.shape) => {
                self.held = Some(tool.inverse() * self.pose());
            }
            Some(tool_from_target) => {
                let pose = tool * tool_from_target;
                let (at, x_axis) = (pose.translation.vector, pose.rotation * Vector3::x());
                self.stand =
                    Stand { at_m: Point::new(at.x, at.y), base_m: at.z, yaw_rad: libm::atan2(x_axis.y, x_axis.x) };
                if apart_m > width_m + LETS_GO_M {
                    self.held = None;
                    self.stand.base_m = resting_height_m(scene, self.stand.at_m);
                }
            }
            None => {}
        }
        self.was_open = apart_m >= width_m;
        if self.held.is_some() {
            q[self.finger] = self.gripper.position(width_m);
        }
    }

    fn pose(&self) -> Isometry3<f64> {
        let at = self.stand.at_m;
        Isometry3::from_parts(Translation3::new(at.x, at.y, self.stand.base_m), about_z(self.stand.yaw_rad))
    }

    /// Whether the tool is at it.
    fn is_about(&self, tool: &Isometry3<f64>, shape: &Shape) -> bool {
        let at = (self.pose().inverse() * tool).translation.vector;
        let inside = match *shape {
            Shape::Cylinder { radius_m, .. } => at.xy().norm() <= radius_m + NEAR_M,
            Shape::Box { width_m, depth_m, .. } => {
                at.x.abs() <= 0.5 * width_m + NEAR_M && at.y.abs() <= 0.5 * depth_m + NEAR_M
            }
        };
        inside && (-NEAR_M..=shape.height_m() + NEAR_M).contains(&at.z)
    }
}
