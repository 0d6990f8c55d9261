//! The table as ROS parameters: one list per property, one entry per object.

use bus::{NodeSettings, ParameterSpec, Range};
use placement::Gripper;
use serde::{Deserialize, Serialize};

/// Parameters of the simulated table.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Settings {
    /// Id of the scene.
    pub scene_id: String,
    /// Frame of every coordinate.
    pub frame: String,
    /// Extent along x, metres.
    pub table_width_m: f64,
    /// Extent along y, metres.
    pub table_depth_m: f64,
    /// Unique ids.
    pub object_ids: Vec<String>,
    /// What people call them; one per object, or none to use the ids.
    pub object_labels: Vec<String>,
    /// "cylinder" or "box"; one per object.
    pub object_shapes: Vec<String>,
    /// Three extents per object (x, y, z), metres; a cylinder's x and y are its diameter.
    pub object_sizes_m: Vec<f64>,
    /// Two coordinates per object (x, y), metres.
    pub object_positions_m: Vec<f64>,
    /// Rotation about the vertical; one per object, or none for all zero.
    pub object_yaws_rad: Vec<f64>,
    /// Whether other things may stand on it; one per object, or none for all false.
    pub object_supports: Vec<bool>,
    /// Id of the thing to place.
    pub target_id: String,
    /// What people call it.
    pub target_label: String,
    /// "cylinder" or "box".
    pub target_shape: String,
    /// Three extents, metres.
    pub target_size_m: Vec<f64>,
    /// Where the thing to place stands at first (x, y), metres; it may be beside the table. Empty: it is in the robot's hand.
    pub target_position_m: Vec<f64>,
    /// How it is turned about the vertical there, radians.
    pub target_yaw_rad: f64,
    /// The link between the fingertips, whose z axis points out of the hand.
    pub tool_link: String,
    /// The joint that moves the fingers; empty: there is no gripper.
    pub gripper_joint: String,
    /// Where that joint is when the fingers touch each other, radians or metres.
    pub gripper_closed: f64,
    /// Where it is when they are as far apart as they go.
    pub gripper_open: f64,
    /// How far apart they are then, metres.
    pub gripper_opening_m: f64,
    /// The axis of the tool link along which they close: "x" or "y".
    pub gripper_axis: String,
    /// A URDF file; empty: the arm built in.
    pub urdf: String,
    /// Where the robot's root link is in the table's frame (x, y, z), metres.
    pub robot_base_position_m: Vec<f64>,
    /// Rotation of the robot's root link about the vertical, radians.
    pub robot_base_yaw_rad: f64,
    /// Joint positions at the start, radians or metres; empty: the position nearest 0 within the limits.
    pub start_positions: Vec<f64>,
}

impl Default for Settings {
    fn default() -> Self {
        Self {
            scene_id: "table".to_owned(),
            frame: "table".to_owned(),
            table_width_m: 1.0,
            table_depth_m: 1.0,
            object_ids: Vec::new(),
            object_labels: Vec::new(),
            object_shapes: Vec::new(),
            object_sizes_m: Vec::new(),
            object_positions_m: Vec::new(),
            object_yaws_rad: Vec::new(),
            object_supports: Vec::new(),
            target_id: "target".to_owned(),
            target_label: "target".to_owned(),
            target_shape: "cylinder".to_owned(),
            target_size_m: vec![0.08, 0.08, 0.2],
            target_position_m: Vec::new(),
            target_yaw_rad: 0.0,
            tool_link: "tool0".to_owned(),
            gripper_joint: String::new(),
            gripper_closed: 0.0,
            gripper_open: 0.075,
            gripper_opening_m: 0.154,
            gripper_axis: "y".to_owned(),
            urdf: String::new(),
            robot_base_position_m: vec![0.0, 0.0, 0.0],
            robot_base_yaw_rad: 0.0,
            start_positions: Vec::new(),
        }
    }
}

const EXTENT_M: Range = Range::Float { min: 0.001, max: 100.0 };
const POSITION_M: Range = Range::Float { min: -100.0, max: 100.0 };
const ANGLE_RAD: Range = Range::Float { min: -7.0, max: 7.0 };
const SHAPES: Range = Range::Choice(&["cylinder", "box"]);

impl NodeSettings for Settings {
    const NODE: &'static str = "simulated_table";
    const ABOUT: &'static str = "A simulated world: a table with things on it, and an arm that follows trajectories.";
    const PARAMETERS: &'static [ParameterSpec] = &[
        ParameterSpec { name: "scene_id", about: "id of the scene", range: Range::Any },
        ParameterSpec { name: "frame", about: "frame of every coordinate", range: Range::Any },
        ParameterSpec { name: "table_width_m", about: "extent of the table along x, metres", range: EXTENT_M },
        ParameterSpec { name: "table_depth_m", about: "extent of the table along y, metres", range: EXTENT_M },
        ParameterSpec { name: "object_ids", about: "unique ids of the things on the table", range: Range::Any },
        ParameterSpec {
            name: "object_labels",
            about: "what people call them; one per object, or none to use the ids",
            range: Range::Any,
        },
        ParameterSpec { name: "object_shapes", about: "one per object", range: SHAPES },
        ParameterSpec {
            name: "object_sizes_m",
            about: "three extents per object: x, y, z, metres; a cylinder's x and y are its diameter",
            range: EXTENT_M,
        },
        ParameterSpec {
            name: "object_positions_m",
            about: "two coordinates per object: x to the right, y away from the robot, metres",
            range: POSITION_M,
        },
        ParameterSpec {
            name: "object_yaws_rad",
            about: "rotation about the vertical, radians; one per object, or none for all zero",
            range: ANGLE_RAD,
        },
        ParameterSpec {
            name: "object_supports",
            about: "whether other things may stand on it; one per object, or none for all false",
            range: Range::Any,
        },
        ParameterSpec { name: "target_id", about: "id of the thing to place", range: Range::Any },
        ParameterSpec { name: "target_label", about: "what people call it", range: Range::Any },
        ParameterSpec { name: "target_shape", about: "its shape", range: SHAPES },
        ParameterSpec { name: "target_size_m", about: "its three extents: x, y, z, metres", range: EXTENT_M },
        ParameterSpec {
            name: "target_position_m",
            about: "where it stands at first: x, y, metres, on the table or beside it; empty: in the robot's hand",
            range: POSITION_M,
        },
        ParameterSpec {
            name: "target_yaw_rad",
            about: "how it is turned about the vertical there, radians",
            range: ANGLE_RAD,
        },
        ParameterSpec {
            name: "tool_link",
            about: "link between the fingertips, whose z axis points out of the hand",
            range: Range::Any,
        },
        ParameterSpec {
            name: "gripper_joint",
            about: "joint that moves the fingers, others mimic it; empty: there is no gripper",
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
            about: "how far apart they are then, metres",
            range: Range::Float { min: 0.001, max: 1.0 },
        },
        ParameterSpec {
            name: "gripper_axis",
            about: "axis of the tool link along which the fingers close",
            range: Range::Choice(&["x", "y"]),
        },
        ParameterSpec { name: "urdf", about: "a URDF file; empty: the arm built in", range: Range::Any },
        ParameterSpec {
            name: "robot_base_position_m",
            about: "where the robot's root link is in the table's frame: x, y, z, metres",
            range: POSITION_M,
        },
        ParameterSpec {
            name: "robot_base_yaw_rad",
            about: "rotation of the robot's root link about the vertical, radians",
            range: ANGLE_RAD,
        },
        ParameterSpec {
            name: "start_positions",
            about: "joint positions at the start, radians or metres; empty: nearest 0 within the limits",
            range: Range::Float { min: -1000.0, max: 1000.0 },
        },
    ];

    fn check(&self) -> Result<(), String> {
        crate::task_scene(self).map_err(|error| error.to_string())?;
        if ![0, 2].contains(&self.target_position_m.len()) {
            let got = self.target_position_m.len();
            return Err(format!("target_position_m has {got} entries; it must have 2 (x, y), or none"));
        }
        if !self.target_position_m.is_empty() && self.gripper_joint.is_empty() {
            return Err(
                "what stands at target_position_m is picked up by a gripper: name its joint in gripper_joint".into()
            );
        }
        self.gripper().map_or(Ok(()), |gripper| gripper.check())?;
        match self.robot_base_position_m.len() {
            3 => Ok(()),
            got => Err(format!("robot_base_position_m has {got} entries; it must have 3 (x, y, z)")),
        }
    }
}

impl Settings {
    /// What picks the target up.
    pub(crate) fn gripper(&self) -> Option<Gripper> {
        (!self.gripper_joint.is_empty()).then(|| Gripper {
            joint: self.gripper_joint.clone(),
            closed: self.gripper_closed,
            open: self.gripper_open,
            opening_m: self.gripper_opening_m,
            axis: self.gripper_axis.parse().unwrap_or_default(),
        })
    }

    /// Where the robot's root link is in the table's frame, metres.
    pub(crate) fn robot_base_m(&self) -> [f64; 3] {
        std::array::from_fn(|i| self.robot_base_position_m.get(i).copied().unwrap_or(0.0))
    }
}

#[cfg(test)]
mod tests {
    use super::Settings;

    #[test]
    fn the_table_of_parameters_matches_the_settings() {
        bus::testing::check_parameters::<Settings>();
    }
}
