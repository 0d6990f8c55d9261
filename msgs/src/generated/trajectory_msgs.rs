//! Messages of the standard package `trajectory_msgs`.
//!
//! Generated: do not edit. To write it anew: `cargo run --release -p apprentice_msgs --example generate`.

use serde::{Deserialize, Serialize};

/// The message `trajectory_msgs/msg/JointTrajectory`.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct JointTrajectory {
    /// (`std_msgs/Header`)
    pub header: super::std_msgs::Header,
    /// (`string[]`)
    pub joint_names: Vec<std::string::String>,
    /// (`JointTrajectoryPoint[]`)
    pub points: Vec<super::trajectory_msgs::JointTrajectoryPoint>,
}

impl crate::Message for JointTrajectory {
    const TYPE: &'static str = "trajectory_msgs/msg/JointTrajectory";
}

/// The message `trajectory_msgs/msg/JointTrajectoryPoint`.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct JointTrajectoryPoint {
    /// (`float64[]`)
    pub positions: Vec<f64>,
    /// (`float64[]`)
    pub velocities: Vec<f64>,
    /// (`float64[]`)
    pub accelerations: Vec<f64>,
    /// (`float64[]`)
    pub effort: Vec<f64>,
    /// (`builtin_interfaces/Duration`)
    pub time_from_start: super::builtin_interfaces::Duration,
}

impl crate::Message for JointTrajectoryPoint {
    const TYPE: &'static str = "trajectory_msgs/msg/JointTrajectoryPoint";
}

/// The message `trajectory_msgs/msg/MultiDOFJointTrajectory`.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct MultiDOFJointTrajectory {
    /// (`std_msgs/Header`)
    pub header: super::std_msgs::Header,
    /// (`string[]`)
    pub joint_names: Vec<std::string::String>,
    /// (`MultiDOFJointTrajectoryPoint[]`)
    pub points: Vec<super::trajectory_msgs::MultiDOFJointTrajectoryPoint>,
}

impl crate::Message for MultiDOFJointTrajectory {
    const TYPE: &'static str = "trajectory_msgs/msg/MultiDOFJointTrajectory";
}

/// The message `trajectory_msgs/msg/MultiDOFJointTrajectoryPoint`.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct MultiDOFJointTrajectoryPoint {
    /// (`geometry_msgs/Transform[]`)
    pub transforms: Vec<super::geometry_msgs::Transform>,
    /// (`geometry_msgs/Twist[]`)
    pub velocities: Vec<super::geometry_msgs::Twist>,
    /// (`geometry_msgs/Twist[]`)
    pub accelerations: Vec<super::geometry_msgs::Twist>,
    /// (`builtin_interfaces/Duration`)
    pub time_from_start: super::builtin_interfaces::Duration,
}

impl crate::Message for MultiDOFJointTrajectoryPoint {
    const TYPE: &'static str = "trajectory_msgs/msg/MultiDOFJointTrajectoryPoint";
}
