//! Messages of the standard package `sensor_msgs`.
//!
//! Generated: do not edit. To write it anew: `cargo run --release -p apprentice_msgs --example generate`.

use serde::{Deserialize, Serialize};

/// The message `sensor_msgs/msg/CompressedImage`.
#[derive(Debug, Clone, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct CompressedImage {
    /// (`std_msgs/Header`)
    pub header: super::std_msgs::Header,
    /// (`string`)
    pub format: std::string::String,
    /// (`uint8[]`)
    #[serde(with = "serde_bytes")]
    pub data: Vec<u8>,
}

impl crate::Message for CompressedImage {
    const TYPE: &'static str = "sensor_msgs/msg/CompressedImage";
}

/// The message `sensor_msgs/msg/JointState`.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct JointState {
    /// (`std_msgs/Header`)
    pub header: super::std_msgs::Header,
    /// (`string[]`)
    pub name: Vec<std::string::String>,
    /// (`float64[]`)
    pub position: Vec<f64>,
    /// (`float64[]`)
    pub velocity: Vec<f64>,
    /// (`float64[]`)
    pub effort: Vec<f64>,
}

impl crate::Message for JointState {
    const TYPE: &'static str = "sensor_msgs/msg/JointState";
}

/// The message `sensor_msgs/msg/MultiDOFJointState`.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct MultiDOFJointState {
    /// (`std_msgs/Header`)
    pub header: super::std_msgs::Header,
    /// (`string[]`)
    pub joint_names: Vec<std::string::String>,
    /// (`geometry_msgs/Transform[]`)
    pub transforms: Vec<super::geometry_msgs::Transform>,
    /// (`geometry_msgs/Twist[]`)
    pub twist: Vec<super::geometry_msgs::Twist>,
    /// (`geometry_msgs/Wrench[]`)
    pub wrench: Vec<super::geometry_msgs::Wrench>,
}

impl crate::Message for MultiDOFJointState {
    const TYPE: &'static str = "sensor_msgs/msg/MultiDOFJointState";
}
