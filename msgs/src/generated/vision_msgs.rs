//! Messages of the standard package `vision_msgs`.
//!
//! Generated: do not edit. To write it anew: `cargo run --release -p apprentice_msgs --example generate`.

use serde::{Deserialize, Serialize};

/// The message `vision_msgs/msg/BoundingBox3D`.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub struct BoundingBox3D {
    /// (`geometry_msgs/Pose`)
    pub center: super::geometry_msgs::Pose,
    /// (`geometry_msgs/Vector3`)
    pub size: super::geometry_msgs::Vector3,
}

impl crate::Message for BoundingBox3D {
    const TYPE: &'static str = "vision_msgs/msg/BoundingBox3D";
}

/// The message `vision_msgs/msg/Detection3D`.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct Detection3D {
    /// (`std_msgs/Header`)
    pub header: super::std_msgs::Header,
    /// (`ObjectHypothesisWithPose[]`)
    pub results: Vec<super::vision_msgs::ObjectHypothesisWithPose>,
    /// (`BoundingBox3D`)
    pub bbox: super::vision_msgs::BoundingBox3D,
    /// (`string`)
    pub id: std::string::String,
}

impl crate::Message for Detection3D {
    const TYPE: &'static str = "vision_msgs/msg/Detection3D";
}

/// The message `vision_msgs/msg/Detection3DArray`.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct Detection3DArray {
    /// (`std_msgs/Header`)
    pub header: super::std_msgs::Header,
    /// (`Detection3D[]`)
    pub detections: Vec<super::vision_msgs::Detection3D>,
}

impl crate::Message for Detection3DArray {
    const TYPE: &'static str = "vision_msgs/msg/Detection3DArray";
}

/// The message `vision_msgs/msg/ObjectHypothesis`.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct ObjectHypothesis {
    /// (`string`)
    pub class_id: std::string::String,
    /// (`float64`)
    pub score: f64,
}

impl crate::Message for ObjectHypothesis {
    const TYPE: &'static str = "vision_msgs/msg/ObjectHypothesis";
}

/// The message `vision_msgs/msg/ObjectHypothesisWithPose`.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct ObjectHypothesisWithPose {
    /// (`ObjectHypothesis`)
    pub hypothesis: super::vision_msgs::ObjectHypothesis,
    /// (`geometry_msgs/PoseWithCovariance`)
    pub pose: super::geometry_msgs::PoseWithCovariance,
}

impl crate::Message for ObjectHypothesisWithPose {
    const TYPE: &'static str = "vision_msgs/msg/ObjectHypothesisWithPose";
}
