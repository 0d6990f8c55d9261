//! Messages of the standard package `std_msgs`.
//!
//! Generated: do not edit. To write it anew: `cargo run --release -p apprentice_msgs --example generate`.

use serde::{Deserialize, Serialize};

/// The message `std_msgs/msg/Bool`.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Bool {
    /// (`bool`)
    pub data: bool,
}

impl crate::Message for Bool {
    const TYPE: &'static str = "std_msgs/msg/Bool";
}

/// The message `std_msgs/msg/Byte`.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Byte {
    /// (`byte`)
    pub data: u8,
}

impl crate::Message for Byte {
    const TYPE: &'static str = "std_msgs/msg/Byte";
}

/// The message `std_msgs/msg/Char`.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Char {
    /// (`char`)
    pub data: u8,
}

impl crate::Message for Char {
    const TYPE: &'static str = "std_msgs/msg/Char";
}

/// The message `std_msgs/msg/ColorRGBA`.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub struct ColorRGBA {
    /// (`float32`)
    pub r: f32,
    /// (`float32`)
    pub g: f32,
    /// (`float32`)
    pub b: f32,
    /// (`float32`)
    pub a: f32,
}

impl crate::Message for ColorRGBA {
    const TYPE: &'static str = "std_msgs/msg/ColorRGBA";
}

/// The message `std_msgs/msg/Empty`.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Empty {
    /// Always 0; on the wire a message without members is one octet.
    #[serde(default)]
    pub structure_needs_at_least_one_member: u8,
}

impl crate::Message for Empty {
    const TYPE: &'static str = "std_msgs/msg/Empty";
}

/// The message `std_msgs/msg/Float32`.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub struct Float32 {
    /// (`float32`)
    pub data: f32,
}

impl crate::Message for Float32 {
    const TYPE: &'static str = "std_msgs/msg/Float32";
}

/// The message `std_msgs/msg/Float32MultiArray`.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct Float32MultiArray {
    /// (`MultiArrayLayout`)
    pub layout: super::std_msgs::MultiArrayLayout,
    /// (`float32[]`)
    pub data: Vec<f32>,
}

impl crate::Message for Float32MultiArray {
    const TYPE: &'static str = "std_msgs/msg/Float32MultiArray";
}

/// The message `std_msgs/msg/Float64`.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub struct Float64 {
    /// (`float64`)
    pub data: f64,
}

impl crate::Message for Float64 {
    const TYPE: &'static str = "std_msgs/msg/Float64";
}

/// The message `std_msgs/msg/Float64MultiArray`.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct Float64MultiArray {
    /// (`MultiArrayLayout`)
    pub layout: super::std_msgs::MultiArrayLayout,
    /// (`float64[]`)
    pub data: Vec<f64>,
}

impl crate::Message for Float64MultiArray {
    const TYPE: &'static str = "std_msgs/msg/Float64MultiArray";
}

/// The message `std_msgs/msg/Header`.
#[derive(Debug, Clone, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Header {
    /// (`builtin_interfaces/Time`)
    pub stamp: super::builtin_interfaces::Time,
    /// (`string`)
    pub frame_id: std::string::String,
}

impl crate::Message for Header {
    const TYPE: &'static str = "std_msgs/msg/Header";
}

/// The message `std_msgs/msg/Int16`.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Int16 {
    /// (`int16`)
    pub data: i16,
}

impl crate::Message for Int16 {
    const TYPE: &'static str = "std_msgs/msg/Int16";
}

/// The message `std_msgs/msg/Int32`.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Int32 {
    /// (`int32`)
    pub data: i32,
}

impl crate::Message for Int32 {
    const TYPE: &'static str = "std_msgs/msg/Int32";
}

/// The message `std_msgs/msg/Int64`.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Int64 {
    /// (`int64`)
    pub data: i64,
}

impl crate::Message for Int64 {
    const TYPE: &'static str = "std_msgs/msg/Int64";
}

/// The message `std_msgs/msg/Int8`.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Int8 {
    /// (`int8`)
    pub data: i8,
}

impl crate::Message for Int8 {
    const TYPE: &'static str = "std_msgs/msg/Int8";
}

/// The message `std_msgs/msg/MultiArrayDimension`.
#[derive(Debug, Clone, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct MultiArrayDimension {
    /// (`string`)
    pub label: std::string::String,
    /// (`uint32`)
    pub size: u32,
    /// (`uint32`)
    pub stride: u32,
}

impl crate::Message for MultiArrayDimension {
    const TYPE: &'static str = "std_msgs/msg/MultiArrayDimension";
}

/// The message `std_msgs/msg/MultiArrayLayout`.
#[derive(Debug, Clone, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct MultiArrayLayout {
    /// (`MultiArrayDimension[]`)
    pub dim: Vec<super::std_msgs::MultiArrayDimension>,
    /// (`uint32`)
    pub data_offset: u32,
}

impl crate::Message for MultiArrayLayout {
    const TYPE: &'static str = "std_msgs/msg/MultiArrayLayout";
}

/// The message `std_msgs/msg/String`.
#[derive(Debug, Clone, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct String {
    /// (`string`)
    pub data: std::string::String,
}

impl crate::Message for String {
    const TYPE: &'static str = "std_msgs/msg/String";
}

/// The message `std_msgs/msg/UInt16`.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct UInt16 {
    /// (`uint16`)
    pub data: u16,
}

impl crate::Message for UInt16 {
    const TYPE: &'static str = "std_msgs/msg/UInt16";
}

/// The message `std_msgs/msg/UInt32`.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct UInt32 {
    /// (`uint32`)
    pub data: u32,
}

impl crate::Message for UInt32 {
    const TYPE: &'static str = "std_msgs/msg/UInt32";
}

/// The message `std_msgs/msg/UInt64`.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct UInt64 {
    /// (`uint64`)
    pub data: u64,
}

impl crate::Message for UInt64 {
    const TYPE: &'static str = "std_msgs/msg/UInt64";
}

/// The message `std_msgs/msg/UInt8`.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct UInt8 {
    /// (`uint8`)
    pub data: u8,
}

impl crate::Message for UInt8 {
    const TYPE: &'static str = "std_msgs/msg/UInt8";
}
