//! Messages of the standard package `octomap_msgs`.
//!
//! Generated: do not edit. To write it anew: `cargo run --release -p apprentice_msgs --example generate`.

use serde::{Deserialize, Serialize};

/// The message `octomap_msgs/msg/Octomap`.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct Octomap {
    /// (`std_msgs/Header`)
    pub header: super::std_msgs::Header,
    /// (`bool`)
    pub binary: bool,
    /// (`string`)
    pub id: std::string::String,
    /// (`float64`)
    pub resolution: f64,
    /// (`int8[]`)
    pub data: Vec<i8>,
}

impl crate::Message for Octomap {
    const TYPE: &'static str = "octomap_msgs/msg/Octomap";
}

/// The message `octomap_msgs/msg/OctomapWithPose`.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct OctomapWithPose {
    /// (`std_msgs/Header`)
    pub header: super::std_msgs::Header,
    /// (`geometry_msgs/Pose`)
    pub origin: super::geometry_msgs::Pose,
    /// (`Octomap`)
    pub octomap: super::octomap_msgs::Octomap,
}

impl crate::Message for OctomapWithPose {
    const TYPE: &'static str = "octomap_msgs/msg/OctomapWithPose";
}
