//! Messages of the standard package `moveit_msgs`.
//!
//! Generated: do not edit. To write it anew: `cargo run --release -p apprentice_msgs --example generate`.

use serde::{Deserialize, Serialize};

/// The message `moveit_msgs/msg/AllowedCollisionEntry`.
#[derive(Debug, Clone, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct AllowedCollisionEntry {
    /// (`bool[]`)
    pub enabled: Vec<bool>,
}

impl crate::Message for AllowedCollisionEntry {
    const TYPE: &'static str = "moveit_msgs/msg/AllowedCollisionEntry";
}

/// The message `moveit_msgs/msg/AllowedCollisionMatrix`.
#[derive(Debug, Clone, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct AllowedCollisionMatrix {
    /// (`string[]`)
    pub entry_names: Vec<std::string::String>,
    /// (`AllowedCollisionEntry[]`)
    pub entry_values: Vec<super::moveit_msgs::AllowedCollisionEntry>,
    /// (`string[]`)
    pub default_entry_names: Vec<std::string::String>,
    /// (`bool[]`)
    pub default_entry_values: Vec<bool>,
}

impl crate::Message for AllowedCollisionMatrix {
    const TYPE: &'static str = "moveit_msgs/msg/AllowedCollisionMatrix";
}

/// The message `moveit_msgs/msg/AttachedCollisionObject`.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct AttachedCollisionObject {
    /// (`string`)
    pub link_name: std::string::String,
    /// (`CollisionObject`)
    pub object: super::moveit_msgs::CollisionObject,
    /// (`string[]`)
    pub touch_links: Vec<std::string::String>,
    /// (`trajectory_msgs/JointTrajectory`)
    pub detach_posture: super::trajectory_msgs::JointTrajectory,
    /// (`float64`)
    pub weight: f64,
}

impl crate::Message for AttachedCollisionObject {
    const TYPE: &'static str = "moveit_msgs/msg/AttachedCollisionObject";
}

/// The message `moveit_msgs/msg/CollisionObject`.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct CollisionObject {
    /// (`std_msgs/Header`)
    pub header: super::std_msgs::Header,
    /// (`geometry_msgs/Pose`)
    pub pose: super::geometry_msgs::Pose,
    /// (`string`)
    pub id: std::string::String,
    /// (`object_recognition_msgs/ObjectType`)
    pub r#type: super::object_recognition_msgs::ObjectType,
    /// (`shape_msgs/SolidPrimitive[]`)
    pub primitives: Vec<super::shape_msgs::SolidPrimitive>,
    /// (`geometry_msgs/Pose[]`)
    pub primitive_poses: Vec<super::geometry_msgs::Pose>,
    /// (`shape_msgs/Mesh[]`)
    pub meshes: Vec<super::shape_msgs::Mesh>,
    /// (`geometry_msgs/Pose[]`)
    pub mesh_poses: Vec<super::geometry_msgs::Pose>,
    /// (`shape_msgs/Plane[]`)
    pub planes: Vec<super::shape_msgs::Plane>,
    /// (`geometry_msgs/Pose[]`)
    pub plane_poses: Vec<super::geometry_msgs::Pose>,
    /// (`string[]`)
    pub subframe_names: Vec<std::string::String>,
    /// (`geometry_msgs/Pose[]`)
    pub subframe_poses: Vec<super::geometry_msgs::Pose>,
    /// (`byte`)
    pub operation: u8,
}

impl CollisionObject {
    /// The constant `ADD`.
    pub const ADD: u8 = 0;
    /// The constant `REMOVE`.
    pub const REMOVE: u8 = 1;
    /// The constant `APPEND`.
    pub const APPEND: u8 = 2;
    /// The constant `MOVE`.
    pub const MOVE: u8 = 3;
}

impl crate::Message for CollisionObject {
    const TYPE: &'static str = "moveit_msgs/msg/CollisionObject";
}

/// The message `moveit_msgs/msg/LinkPadding`.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct LinkPadding {
    /// (`string`)
    pub link_name: std::string::String,
    /// (`float64`)
    pub padding: f64,
}

impl crate::Message for LinkPadding {
    const TYPE: &'static str = "moveit_msgs/msg/LinkPadding";
}

/// The message `moveit_msgs/msg/LinkScale`.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct LinkScale {
    /// (`string`)
    pub link_name: std::string::String,
    /// (`float64`)
    pub scale: f64,
}

impl crate::Message for LinkScale {
    const TYPE: &'static str = "moveit_msgs/msg/LinkScale";
}

/// The message `moveit_msgs/msg/ObjectColor`.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct ObjectColor {
    /// (`string`)
    pub id: std::string::String,
    /// (`std_msgs/ColorRGBA`)
    pub color: super::std_msgs::ColorRGBA,
}

impl crate::Message for ObjectColor {
    const TYPE: &'static str = "moveit_msgs/msg/ObjectColor";
}

/// The message `moveit_msgs/msg/PlanningScene`.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct PlanningScene {
    /// (`string`)
    pub name: std::string::String,
    /// (`RobotState`)
    pub robot_state: super::moveit_msgs::RobotState,
    /// (`string`)
    pub robot_model_name: std::string::String,
    /// (`geometry_msgs/TransformStamped[]`)
    pub fixed_frame_transforms: Vec<super::geometry_msgs::TransformStamped>,
    /// (`AllowedCollisionMatrix`)
    pub allowed_collision_matrix: super::moveit_msgs::AllowedCollisionMatrix,
    /// (`LinkPadding[]`)
    pub link_padding: Vec<super::moveit_msgs::LinkPadding>,
    /// (`LinkScale[]`)
    pub link_scale: Vec<super::moveit_msgs::LinkScale>,
    /// (`ObjectColor[]`)
    pub object_colors: Vec<super::moveit_msgs::ObjectColor>,
    /// (`PlanningSceneWorld`)
    pub world: super::moveit_msgs::PlanningSceneWorld,
    /// (`bool`)
    pub is_diff: bool,
}

impl crate::Message for PlanningScene {
    const TYPE: &'static str = "moveit_msgs/msg/PlanningScene";
}

/// The message `moveit_msgs/msg/PlanningSceneWorld`.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct PlanningSceneWorld {
    /// (`CollisionObject[]`)
    pub collision_objects: Vec<super::moveit_msgs::CollisionObject>,
    /// (`octomap_msgs/OctomapWithPose`)
    pub octomap: super::octomap_msgs::OctomapWithPose,
}

impl crate::Message for PlanningSceneWorld {
    const TYPE: &'static str = "moveit_msgs/msg/PlanningSceneWorld";
}

/// The message `moveit_msgs/msg/RobotState`.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct RobotState {
    /// (`sensor_msgs/JointState`)
    pub joint_state: super::sensor_msgs::JointState,
    /// (`sensor_msgs/MultiDOFJointState`)
    pub multi_dof_joint_state: super::sensor_msgs::MultiDOFJointState,
    /// (`AttachedCollisionObject[]`)
    pub attached_collision_objects: Vec<super::moveit_msgs::AttachedCollisionObject>,
    /// (`bool`)
    pub is_diff: bool,
}

impl crate::Message for RobotState {
    const TYPE: &'static str = "moveit_msgs/msg/RobotState";
}
