//! Messages of the standard package `geometry_msgs`.
//!
//! Generated: do not edit. To write it anew: `cargo run --release -p apprentice_msgs --example generate`.

use serde::{Deserialize, Serialize};

/// The message `geometry_msgs/msg/Accel`.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub struct Accel {
    /// (`Vector3`)
    pub linear: super::geometry_msgs::Vector3,
    /// (`Vector3`)
    pub angular: super::geometry_msgs::Vector3,
}

impl crate::Message for Accel {
    const TYPE: &'static str = "geometry_msgs/msg/Accel";
}

/// The message `geometry_msgs/msg/Point`.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub struct Point {
    /// (`float64`)
    pub x: f64,
    /// (`float64`)
    pub y: f64,
    /// (`float64`)
    pub z: f64,
}

impl crate::Message for Point {
    const TYPE: &'static str = "geometry_msgs/msg/Point";
}

/// The message `geometry_msgs/msg/Point32`.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub struct Point32 {
    /// (`float32`)
    pub x: f32,
    /// (`float32`)
    pub y: f32,
    /// (`float32`)
    pub z: f32,
}

impl crate::Message for Point32 {
    const TYPE: &'static str = "geometry_msgs/msg/Point32";
}

/// The message `geometry_msgs/msg/PointStamped`.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct PointStamped {
    /// (`std_msgs/Header`)
    pub header: super::std_msgs::Header,
    /// (`Point`)
    pub point: super::geometry_msgs::Point,
}

impl crate::Message for PointStamped {
    const TYPE: &'static str = "geometry_msgs/msg/PointStamped";
}

/// The message `geometry_msgs/msg/Polygon`.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct Polygon {
    /// (`Point32[]`)
    pub points: Vec<super::geometry_msgs::Point32>,
}

impl crate::Message for Polygon {
    const TYPE: &'static str = "geometry_msgs/msg/Polygon";
}

/// The message `geometry_msgs/msg/Pose`.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub struct Pose {
    /// (`Point`)
    pub position: super::geometry_msgs::Point,
    /// (`Quaternion`)
    pub orientation: super::geometry_msgs::Quaternion,
}

impl crate::Message for Pose {
    const TYPE: &'static str = "geometry_msgs/msg/Pose";
}

/// The message `geometry_msgs/msg/PoseArray`.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct PoseArray {
    /// (`std_msgs/Header`)
    pub header: super::std_msgs::Header,
    /// (`Pose[]`)
    pub poses: Vec<super::geometry_msgs::Pose>,
}

impl crate::Message for PoseArray {
    const TYPE: &'static str = "geometry_msgs/msg/PoseArray";
}

/// The message `geometry_msgs/msg/PoseStamped`.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct PoseStamped {
    /// (`std_msgs/Header`)
    pub header: super::std_msgs::Header,
    /// (`Pose`)
    pub pose: super::geometry_msgs::Pose,
}

impl crate::Message for PoseStamped {
    const TYPE: &'static str = "geometry_msgs/msg/PoseStamped";
}

/// The message `geometry_msgs/msg/PoseWithCovariance`.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct PoseWithCovariance {
    /// (`Pose`)
    pub pose: super::geometry_msgs::Pose,
    /// (`float64[36]`)
    #[serde(with = "serde_big_array::BigArray")]
    pub covariance: [f64; 36],
}

impl Default for PoseWithCovariance {
    fn default() -> Self {
        PoseWithCovariance {
            pose: Default::default(),
            covariance: std::array::from_fn(|_| Default::default()),
        }
    }
}

impl crate::Message for PoseWithCovariance {
    const TYPE: &'static str = "geometry_msgs/msg/PoseWithCovariance";
}

/// The message `geometry_msgs/msg/PoseWithCovarianceStamped`.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct PoseWithCovarianceStamped {
    /// (`std_msgs/Header`)
    pub header: super::std_msgs::Header,
    /// (`PoseWithCovariance`)
    pub pose: super::geometry_msgs::PoseWithCovariance,
}

impl crate::Message for PoseWithCovarianceStamped {
    const TYPE: &'static str = "geometry_msgs/msg/PoseWithCovarianceStamped";
}

/// The message `geometry_msgs/msg/Quaternion`.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Quaternion {
    /// (`float64`)
    pub x: f64,
    /// (`float64`)
    pub y: f64,
    /// (`float64`)
    pub z: f64,
    /// (`float64`)
    pub w: f64,
}

impl Default for Quaternion {
    fn default() -> Self {
        Quaternion {
            x: 0.0,
            y: 0.0,
            z: 0.0,
            w: 1.0,
        }
    }
}

impl crate::Message for Quaternion {
    const TYPE: &'static str = "geometry_msgs/msg/Quaternion";
}

/// The message `geometry_msgs/msg/QuaternionStamped`.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct QuaternionStamped {
    /// (`std_msgs/Header`)
    pub header: super::std_msgs::Header,
    /// (`Quaternion`)
    pub quaternion: super::geometry_msgs::Quaternion,
}

impl crate::Message for QuaternionStamped {
    const TYPE: &'static str = "geometry_msgs/msg/QuaternionStamped";
}

/// The message `geometry_msgs/msg/Transform`.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub struct Transform {
    /// (`Vector3`)
    pub translation: super::geometry_msgs::Vector3,
    /// (`Quaternion`)
    pub rotation: super::geometry_msgs::Quaternion,
}

impl crate::Message for Transform {
    const TYPE: &'static str = "geometry_msgs/msg/Transform";
}

/// The message `geometry_msgs/msg/TransformStamped`.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct TransformStamped {
    /// (`std_msgs/Header`)
    pub header: super::std_msgs::Header,
    /// (`string`)
    pub child_frame_id: std::string::String,
    /// (`Transform`)
    pub transform: super::geometry_msgs::Transform,
}

impl crate::Message for TransformStamped {
    const TYPE: &'static str = "geometry_msgs/msg/TransformStamped";
}

/// The message `geometry_msgs/msg/Twist`.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub struct Twist {
    /// (`Vector3`)
    pub linear: super::geometry_msgs::Vector3,
    /// (`Vector3`)
    pub angular: super::geometry_msgs::Vector3,
}

impl crate::Message for Twist {
    const TYPE: &'static str = "geometry_msgs/msg/Twist";
}

/// The message `geometry_msgs/msg/TwistStamped`.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct TwistStamped {
    /// (`std_msgs/Header`)
    pub header: super::std_msgs::Header,
    /// (`Twist`)
    pub twist: super::geometry_msgs::Twist,
}

impl crate::Message for TwistStamped {
    const TYPE: &'static str = "geometry_msgs/msg/TwistStamped";
}

/// The message `geometry_msgs/msg/Vector3`.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub struct Vector3 {
    /// (`float64`)
    pub x: f64,
    /// (`float64`)
    pub y: f64,
    /// (`float64`)
    pub z: f64,
}

impl crate::Message for Vector3 {
    const TYPE: &'static str = "geometry_msgs/msg/Vector3";
}

/// The message `geometry_msgs/msg/Vector3Stamped`.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct Vector3Stamped {
    /// (`std_msgs/Header`)
    pub header: super::std_msgs::Header,
    /// (`Vector3`)
    pub vector: super::geometry_msgs::Vector3,
}

impl crate::Message for Vector3Stamped {
    const TYPE: &'static str = "geometry_msgs/msg/Vector3Stamped";
}

/// The message `geometry_msgs/msg/Wrench`.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub struct Wrench {
    /// (`Vector3`)
    pub force: super::geometry_msgs::Vector3,
    /// (`Vector3`)
    pub torque: super::geometry_msgs::Vector3,
}

impl crate::Message for Wrench {
    const TYPE: &'static str = "geometry_msgs/msg/Wrench";
}

/// The message `geometry_msgs/msg/WrenchStamped`.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct WrenchStamped {
    /// (`std_msgs/Header`)
    pub header: super::std_msgs::Header,
    /// (`Wrench`)
    pub wrench: super::geometry_msgs::Wrench,
}

impl crate::Message for WrenchStamped {
    const TYPE: &'static str = "geometry_msgs/msg/WrenchStamped";
}
