//! Messages of the standard package `rcl_interfaces`.
//!
//! Generated: do not edit. To write it anew: `cargo run --release -p apprentice_msgs --example generate`.

use serde::{Deserialize, Serialize};

/// The message `rcl_interfaces/msg/FloatingPointRange`.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub struct FloatingPointRange {
    /// (`float64`)
    pub from_value: f64,
    /// (`float64`)
    pub to_value: f64,
    /// (`float64`)
    pub step: f64,
}

impl crate::Message for FloatingPointRange {
    const TYPE: &'static str = "rcl_interfaces/msg/FloatingPointRange";
}

/// The message `rcl_interfaces/msg/IntegerRange`.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct IntegerRange {
    /// (`int64`)
    pub from_value: i64,
    /// (`int64`)
    pub to_value: i64,
    /// (`uint64`)
    pub step: u64,
}

impl crate::Message for IntegerRange {
    const TYPE: &'static str = "rcl_interfaces/msg/IntegerRange";
}

/// The message `rcl_interfaces/msg/ListParametersResult`.
#[derive(Debug, Clone, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct ListParametersResult {
    /// (`string[]`)
    pub names: Vec<std::string::String>,
    /// (`string[]`)
    pub prefixes: Vec<std::string::String>,
}

impl crate::Message for ListParametersResult {
    const TYPE: &'static str = "rcl_interfaces/msg/ListParametersResult";
}

/// The message `rcl_interfaces/msg/Log`.
#[derive(Debug, Clone, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Log {
    /// (`builtin_interfaces/Time`)
    pub stamp: super::builtin_interfaces::Time,
    /// (`uint8`)
    pub level: u8,
    /// (`string`)
    pub name: std::string::String,
    /// (`string`)
    pub msg: std::string::String,
    /// (`string`)
    pub file: std::string::String,
    /// (`string`)
    pub function: std::string::String,
    /// (`uint32`)
    pub line: u32,
}

impl Log {
    /// The constant `DEBUG`.
    pub const DEBUG: u8 = 10;
    /// The constant `INFO`.
    pub const INFO: u8 = 20;
    /// The constant `WARN`.
    pub const WARN: u8 = 30;
    /// The constant `ERROR`.
    pub const ERROR: u8 = 40;
    /// The constant `FATAL`.
    pub const FATAL: u8 = 50;
}

impl crate::Message for Log {
    const TYPE: &'static str = "rcl_interfaces/msg/Log";
}

/// The message `rcl_interfaces/msg/Parameter`.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct Parameter {
    /// (`string`)
    pub name: std::string::String,
    /// (`ParameterValue`)
    pub value: super::rcl_interfaces::ParameterValue,
}

impl crate::Message for Parameter {
    const TYPE: &'static str = "rcl_interfaces/msg/Parameter";
}

/// The message `rcl_interfaces/msg/ParameterDescriptor`.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct ParameterDescriptor {
    /// (`string`)
    pub name: std::string::String,
    /// (`uint8`)
    pub r#type: u8,
    /// (`string`)
    pub description: std::string::String,
    /// (`string`)
    pub additional_constraints: std::string::String,
    /// (`bool`)
    pub read_only: bool,
    /// (`bool`)
    pub dynamic_typing: bool,
    /// (`FloatingPointRange[<=1]`)
    #[serde(deserialize_with = "crate::bounded::at_most::<_, _, 1>")]
    pub floating_point_range: Vec<super::rcl_interfaces::FloatingPointRange>,
    /// (`IntegerRange[<=1]`)
    #[serde(deserialize_with = "crate::bounded::at_most::<_, _, 1>")]
    pub integer_range: Vec<super::rcl_interfaces::IntegerRange>,
}

impl crate::Message for ParameterDescriptor {
    const TYPE: &'static str = "rcl_interfaces/msg/ParameterDescriptor";
}

/// The message `rcl_interfaces/msg/ParameterEvent`.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct ParameterEvent {
    /// (`builtin_interfaces/Time`)
    pub stamp: super::builtin_interfaces::Time,
    /// (`string`)
    pub node: std::string::String,
    /// (`Parameter[]`)
    pub new_parameters: Vec<super::rcl_interfaces::Parameter>,
    /// (`Parameter[]`)
    pub changed_parameters: Vec<super::rcl_interfaces::Parameter>,
    /// (`Parameter[]`)
    pub deleted_parameters: Vec<super::rcl_interfaces::Parameter>,
}

impl crate::Message for ParameterEvent {
    const TYPE: &'static str = "rcl_interfaces/msg/ParameterEvent";
}

/// The message `rcl_interfaces/msg/ParameterEventDescriptors`.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct ParameterEventDescriptors {
    /// (`ParameterDescriptor[]`)
    pub new_parameters: Vec<super::rcl_interfaces::ParameterDescriptor>,
    /// (`ParameterDescriptor[]`)
    pub changed_parameters: Vec<super::rcl_interfaces::ParameterDescriptor>,
    /// (`ParameterDescriptor[]`)
    pub deleted_parameters: Vec<super::rcl_interfaces::ParameterDescriptor>,
}

impl crate::Message for ParameterEventDescriptors {
    const TYPE: &'static str = "rcl_interfaces/msg/ParameterEventDescriptors";
}

/// The message `rcl_interfaces/msg/ParameterType`.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct ParameterType {
    /// Always 0; on the wire a message without members is one octet.
    #[serde(default)]
    pub structure_needs_at_least_one_member: u8,
}

impl ParameterType {
    /// The constant `PARAMETER_NOT_SET`.
    pub const PARAMETER_NOT_SET: u8 = 0;
    /// The constant `PARAMETER_BOOL`.
    pub const PARAMETER_BOOL: u8 = 1;
    /// The constant `PARAMETER_INTEGER`.
    pub const PARAMETER_INTEGER: u8 = 2;
    /// The constant `PARAMETER_DOUBLE`.
    pub const PARAMETER_DOUBLE: u8 = 3;
    /// The constant `PARAMETER_STRING`.
    pub const PARAMETER_STRING: u8 = 4;
    /// The constant `PARAMETER_BYTE_ARRAY`.
    pub const PARAMETER_BYTE_ARRAY: u8 = 5;
    /// The constant `PARAMETER_BOOL_ARRAY`.
    pub const PARAMETER_BOOL_ARRAY: u8 = 6;
    /// The constant `PARAMETER_INTEGER_ARRAY`.
    pub const PARAMETER_INTEGER_ARRAY: u8 = 7;
    /// The constant `PARAMETER_DOUBLE_ARRAY`.
    pub const PARAMETER_DOUBLE_ARRAY: u8 = 8;
    /// The constant `PARAMETER_STRING_ARRAY`.
    pub const PARAMETER_STRING_ARRAY: u8 = 9;
}

impl crate::Message for ParameterType {
    const TYPE: &'static str = "rcl_interfaces/msg/ParameterType";
}

/// The message `rcl_interfaces/msg/ParameterValue`.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct ParameterValue {
    /// (`uint8`)
    pub r#type: u8,
    /// (`bool`)
    pub bool_value: bool,
    /// (`int64`)
    pub integer_value: i64,
    /// (`float64`)
    pub double_value: f64,
    /// (`string`)
    pub string_value: std::string::String,
    /// (`byte[]`)
    #[serde(with = "serde_bytes")]
    pub byte_array_value: Vec<u8>,
    /// (`bool[]`)
    pub bool_array_value: Vec<bool>,
    /// (`int64[]`)
    pub integer_array_value: Vec<i64>,
    /// (`float64[]`)
    pub double_array_value: Vec<f64>,
    /// (`string[]`)
    pub string_array_value: Vec<std::string::String>,
}

impl crate::Message for ParameterValue {
    const TYPE: &'static str = "rcl_interfaces/msg/ParameterValue";
}

/// The message `rcl_interfaces/msg/SetParametersResult`.
#[derive(Debug, Clone, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct SetParametersResult {
    /// (`bool`)
    pub successful: bool,
    /// (`string`)
    pub reason: std::string::String,
}

impl crate::Message for SetParametersResult {
    const TYPE: &'static str = "rcl_interfaces/msg/SetParametersResult";
}

/// The message `rcl_interfaces/srv/DescribeParameters_Request`.
#[derive(Debug, Clone, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct DescribeParametersRequest {
    /// (`string[]`)
    pub names: Vec<std::string::String>,
}

impl crate::Message for DescribeParametersRequest {
    const TYPE: &'static str = "rcl_interfaces/srv/DescribeParameters_Request";
}

/// The message `rcl_interfaces/srv/DescribeParameters_Response`.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct DescribeParametersResponse {
    /// (`ParameterDescriptor[]`)
    pub descriptors: Vec<super::rcl_interfaces::ParameterDescriptor>,
}

impl crate::Message for DescribeParametersResponse {
    const TYPE: &'static str = "rcl_interfaces/srv/DescribeParameters_Response";
}

/// The message `rcl_interfaces/srv/GetParameterTypes_Request`.
#[derive(Debug, Clone, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct GetParameterTypesRequest {
    /// (`string[]`)
    pub names: Vec<std::string::String>,
}

impl crate::Message for GetParameterTypesRequest {
    const TYPE: &'static str = "rcl_interfaces/srv/GetParameterTypes_Request";
}

/// The message `rcl_interfaces/srv/GetParameterTypes_Response`.
#[derive(Debug, Clone, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct GetParameterTypesResponse {
    /// (`uint8[]`)
    #[serde(with = "serde_bytes")]
    pub types: Vec<u8>,
}

impl crate::Message for GetParameterTypesResponse {
    const TYPE: &'static str = "rcl_interfaces/srv/GetParameterTypes_Response";
}

/// The message `rcl_interfaces/srv/GetParameters_Request`.
#[derive(Debug, Clone, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct GetParametersRequest {
    /// (`string[]`)
    pub names: Vec<std::string::String>,
}

impl crate::Message for GetParametersRequest {
    const TYPE: &'static str = "rcl_interfaces/srv/GetParameters_Request";
}

/// The message `rcl_interfaces/srv/GetParameters_Response`.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct GetParametersResponse {
    /// (`ParameterValue[]`)
    pub values: Vec<super::rcl_interfaces::ParameterValue>,
}

impl crate::Message for GetParametersResponse {
    const TYPE: &'static str = "rcl_interfaces/srv/GetParameters_Response";
}

/// The message `rcl_interfaces/srv/ListParameters_Request`.
#[derive(Debug, Clone, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct ListParametersRequest {
    /// (`string[]`)
    pub prefixes: Vec<std::string::String>,
    /// (`uint64`)
    pub depth: u64,
}

impl ListParametersRequest {
    /// The constant `DEPTH_RECURSIVE`.
    pub const DEPTH_RECURSIVE: u64 = 0;
}

impl crate::Message for ListParametersRequest {
    const TYPE: &'static str = "rcl_interfaces/srv/ListParameters_Request";
}

/// The message `rcl_interfaces/srv/ListParameters_Response`.
#[derive(Debug, Clone, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct ListParametersResponse {
    /// (`ListParametersResult`)
    pub result: super::rcl_interfaces::ListParametersResult,
}

impl crate::Message for ListParametersResponse {
    const TYPE: &'static str = "rcl_interfaces/srv/ListParameters_Response";
}

/// The message `rcl_interfaces/srv/SetParameters_Request`.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct SetParametersRequest {
    /// (`Parameter[]`)
    pub parameters: Vec<super::rcl_interfaces::Parameter>,
}

impl crate::Message for SetParametersRequest {
    const TYPE: &'static str = "rcl_interfaces/srv/SetParameters_Request";
}

/// The message `rcl_interfaces/srv/SetParameters_Response`.
#[derive(Debug, Clone, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct SetParametersResponse {
    /// (`SetParametersResult[]`)
    pub results: Vec<super::rcl_interfaces::SetParametersResult>,
}

impl crate::Message for SetParametersResponse {
    const TYPE: &'static str = "rcl_interfaces/srv/SetParameters_Response";
}

/// The message `rcl_interfaces/srv/SetParametersAtomically_Request`.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct SetParametersAtomicallyRequest {
    /// (`Parameter[]`)
    pub parameters: Vec<super::rcl_interfaces::Parameter>,
}

impl crate::Message for SetParametersAtomicallyRequest {
    const TYPE: &'static str = "rcl_interfaces/srv/SetParametersAtomically_Request";
}

/// The message `rcl_interfaces/srv/SetParametersAtomically_Response`.
#[derive(Debug, Clone, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct SetParametersAtomicallyResponse {
    /// (`SetParametersResult`)
    pub result: super::rcl_interfaces::SetParametersResult,
}

impl crate::Message for SetParametersAtomicallyResponse {
    const TYPE: &'static str = "rcl_interfaces/srv/SetParametersAtomically_Response";
}

/// The service `rcl_interfaces/srv/DescribeParameters`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct DescribeParameters;

impl crate::Service for DescribeParameters {
    type Request = DescribeParametersRequest;
    type Response = DescribeParametersResponse;
    const TYPE: &'static str = "rcl_interfaces/srv/DescribeParameters";
}

/// The service `rcl_interfaces/srv/GetParameterTypes`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct GetParameterTypes;

impl crate::Service for GetParameterTypes {
    type Request = GetParameterTypesRequest;
    type Response = GetParameterTypesResponse;
    const TYPE: &'static str = "rcl_interfaces/srv/GetParameterTypes";
}

/// The service `rcl_interfaces/srv/GetParameters`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct GetParameters;

impl crate::Service for GetParameters {
    type Request = GetParametersRequest;
    type Response = GetParametersResponse;
    const TYPE: &'static str = "rcl_interfaces/srv/GetParameters";
}

/// The service `rcl_interfaces/srv/ListParameters`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct ListParameters;

impl crate::Service for ListParameters {
    type Request = ListParametersRequest;
    type Response = ListParametersResponse;
    const TYPE: &'static str = "rcl_interfaces/srv/ListParameters";
}

/// The service `rcl_interfaces/srv/SetParameters`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct SetParameters;

impl crate::Service for SetParameters {
    type Request = SetParametersRequest;
    type Response = SetParametersResponse;
    const TYPE: &'static str = "rcl_interfaces/srv/SetParameters";
}

/// The service `rcl_interfaces/srv/SetParametersAtomically`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct SetParametersAtomically;

impl crate::Service for SetParametersAtomically {
    type Request = SetParametersAtomicallyRequest;
    type Response = SetParametersAtomicallyResponse;
    const TYPE: &'static str = "rcl_interfaces/srv/SetParametersAtomically";
}
