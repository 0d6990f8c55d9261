//! Messages of the standard package `visualization_msgs`.
//!
//! Generated: do not edit. To write it anew: `cargo run --release -p apprentice_msgs --example generate`.

use serde::{Deserialize, Serialize};

/// The message `visualization_msgs/msg/InteractiveMarker`.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct InteractiveMarker {
    /// (`std_msgs/Header`)
    pub header: super::std_msgs::Header,
    /// (`geometry_msgs/Pose`)
    pub pose: super::geometry_msgs::Pose,
    /// (`string`)
    pub name: std::string::String,
    /// (`string`)
    pub description: std::string::String,
    /// (`float32`)
    pub scale: f32,
    /// (`MenuEntry[]`)
    pub menu_entries: Vec<super::visualization_msgs::MenuEntry>,
    /// (`InteractiveMarkerControl[]`)
    pub controls: Vec<super::visualization_msgs::InteractiveMarkerControl>,
}

impl crate::Message for InteractiveMarker {
    const TYPE: &'static str = "visualization_msgs/msg/InteractiveMarker";
}

/// The message `visualization_msgs/msg/InteractiveMarkerControl`.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct InteractiveMarkerControl {
    /// (`string`)
    pub name: std::string::String,
    /// (`geometry_msgs/Quaternion`)
    pub orientation: super::geometry_msgs::Quaternion,
    /// (`uint8`)
    pub orientation_mode: u8,
    /// (`uint8`)
    pub interaction_mode: u8,
    /// (`bool`)
    pub always_visible: bool,
    /// (`Marker[]`)
    pub markers: Vec<super::visualization_msgs::Marker>,
    /// (`bool`)
    pub independent_marker_orientation: bool,
    /// (`string`)
    pub description: std::string::String,
}

impl InteractiveMarkerControl {
    /// The constant `INHERIT`.
    pub const INHERIT: u8 = 0;
    /// The constant `FIXED`.
    pub const FIXED: u8 = 1;
    /// The constant `VIEW_FACING`.
    pub const VIEW_FACING: u8 = 2;
    /// The constant `NONE`.
    pub const NONE: u8 = 0;
    /// The constant `MENU`.
    pub const MENU: u8 = 1;
    /// The constant `BUTTON`.
    pub const BUTTON: u8 = 2;
    /// The constant `MOVE_AXIS`.
    pub const MOVE_AXIS: u8 = 3;
    /// The constant `MOVE_PLANE`.
    pub const MOVE_PLANE: u8 = 4;
    /// The constant `ROTATE_AXIS`.
    pub const ROTATE_AXIS: u8 = 5;
    /// The constant `MOVE_ROTATE`.
    pub const MOVE_ROTATE: u8 = 6;
    /// The constant `MOVE_3D`.
    pub const MOVE_3D: u8 = 7;
    /// The constant `ROTATE_3D`.
    pub const ROTATE_3D: u8 = 8;
    /// The constant `MOVE_ROTATE_3D`.
    pub const MOVE_ROTATE_3D: u8 = 9;
}

impl crate::Message for InteractiveMarkerControl {
    const TYPE: &'static str = "visualization_msgs/msg/InteractiveMarkerControl";
}

/// The message `visualization_msgs/msg/InteractiveMarkerFeedback`.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct InteractiveMarkerFeedback {
    /// (`std_msgs/Header`)
    pub header: super::std_msgs::Header,
    /// (`string`)
    pub client_id: std::string::String,
    /// (`string`)
    pub marker_name: std::string::String,
    /// (`string`)
    pub control_name: std::string::String,
    /// (`uint8`)
    pub event_type: u8,
    /// (`geometry_msgs/Pose`)
    pub pose: super::geometry_msgs::Pose,
    /// (`uint32`)
    pub menu_entry_id: u32,
    /// (`geometry_msgs/Point`)
    pub mouse_point: super::geometry_msgs::Point,
    /// (`bool`)
    pub mouse_point_valid: bool,
}

impl InteractiveMarkerFeedback {
    /// The constant `KEEP_ALIVE`.
    pub const KEEP_ALIVE: u8 = 0;
    /// The constant `POSE_UPDATE`.
    pub const POSE_UPDATE: u8 = 1;
    /// The constant `MENU_SELECT`.
    pub const MENU_SELECT: u8 = 2;
    /// The constant `BUTTON_CLICK`.
    pub const BUTTON_CLICK: u8 = 3;
    /// The constant `MOUSE_DOWN`.
    pub const MOUSE_DOWN: u8 = 4;
    /// The constant `MOUSE_UP`.
    pub const MOUSE_UP: u8 = 5;
}

impl crate::Message for InteractiveMarkerFeedback {
    const TYPE: &'static str = "visualization_msgs/msg/InteractiveMarkerFeedback";
}

/// The message `visualization_msgs/msg/InteractiveMarkerInit`.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct InteractiveMarkerInit {
    /// (`string`)
    pub server_id: std::string::String,
    /// (`uint64`)
    pub seq_num: u64,
    /// (`InteractiveMarker[]`)
    pub markers: Vec<super::visualization_msgs::InteractiveMarker>,
}

impl crate::Message for InteractiveMarkerInit {
    const TYPE: &'static str = "visualization_msgs/msg/InteractiveMarkerInit";
}

/// The message `visualization_msgs/msg/InteractiveMarkerPose`.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct InteractiveMarkerPose {
    /// (`std_msgs/Header`)
    pub header: super::std_msgs::Header,
    /// (`geometry_msgs/Pose`)
    pub pose: super::geometry_msgs::Pose,
    /// (`string`)
    pub name: std::string::String,
}

impl crate::Message for InteractiveMarkerPose {
    const TYPE: &'static str = "visualization_msgs/msg/InteractiveMarkerPose";
}

/// The message `visualization_msgs/msg/InteractiveMarkerUpdate`.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct InteractiveMarkerUpdate {
    /// (`string`)
    pub server_id: std::string::String,
    /// (`uint64`)
    pub seq_num: u64,
    /// (`uint8`)
    pub r#type: u8,
    /// (`InteractiveMarker[]`)
    pub markers: Vec<super::visualization_msgs::InteractiveMarker>,
    /// (`InteractiveMarkerPose[]`)
    pub poses: Vec<super::visualization_msgs::InteractiveMarkerPose>,
    /// (`string[]`)
    pub erases: Vec<std::string::String>,
}

impl InteractiveMarkerUpdate {
    /// The constant `KEEP_ALIVE`.
    pub const KEEP_ALIVE: u8 = 0;
    /// The constant `UPDATE`.
    pub const UPDATE: u8 = 1;
}

impl crate::Message for InteractiveMarkerUpdate {
    const TYPE: &'static str = "visualization_msgs/msg/InteractiveMarkerUpdate";
}

/// The message `visualization_msgs/msg/Marker`.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct Marker {
    /// (`std_msgs/Header`)
    pub header: super::std_msgs::Header,
    /// (`string`)
    pub ns: std::string::String,
    /// (`int32`)
    pub id: i32,
    /// (`int32`)
    pub r#type: i32,
    /// (`int32`)
    pub action: i32,
    /// (`geometry_msgs/Pose`)
    pub pose: super::geometry_msgs::Pose,
    /// (`geometry_msgs/Vector3`)
    pub scale: super::geometry_msgs::Vector3,
    /// (`std_msgs/ColorRGBA`)
    pub color: super::std_msgs::ColorRGBA,
    /// (`builtin_interfaces/Duration`)
    pub lifetime: super::builtin_interfaces::Duration,
    /// (`bool`)
    pub frame_locked: bool,
    /// (`geometry_msgs/Point[]`)
    pub points: Vec<super::geometry_msgs::Point>,
    /// (`std_msgs/ColorRGBA[]`)
    pub colors: Vec<super::std_msgs::ColorRGBA>,
    /// (`string`)
    pub texture_resource: std::string::String,
    /// (`sensor_msgs/CompressedImage`)
    pub texture: super::sensor_msgs::CompressedImage,
    /// (`UVCoordinate[]`)
    pub uv_coordinates: Vec<super::visualization_msgs::UVCoordinate>,
    /// (`string`)
    pub text: std::string::String,
    /// (`string`)
    pub mesh_resource: std::string::String,
    /// (`MeshFile`)
    pub mesh_file: super::visualization_msgs::MeshFile,
    /// (`bool`)
    pub mesh_use_embedded_materials: bool,
}

impl Marker {
    /// The constant `ARROW`.
    pub const ARROW: i32 = 0;
    /// The constant `CUBE`.
    pub const CUBE: i32 = 1;
    /// The constant `SPHERE`.
    pub const SPHERE: i32 = 2;
    /// The constant `CYLINDER`.
    pub const CYLINDER: i32 = 3;
    /// The constant `LINE_STRIP`.
    pub const LINE_STRIP: i32 = 4;
    /// The constant `LINE_LIST`.
    pub const LINE_LIST: i32 = 5;
    /// The constant `CUBE_LIST`.
    pub const CUBE_LIST: i32 = 6;
    /// The constant `SPHERE_LIST`.
    pub const SPHERE_LIST: i32 = 7;
    /// The constant `POINTS`.
    pub const POINTS: i32 = 8;
    /// The constant `TEXT_VIEW_FACING`.
    pub const TEXT_VIEW_FACING: i32 = 9;
    /// The constant `MESH_RESOURCE`.
    pub const MESH_RESOURCE: i32 = 10;
    /// The constant `TRIANGLE_LIST`.
    pub const TRIANGLE_LIST: i32 = 11;
    /// The constant `ARROW_STRIP`.
    pub const ARROW_STRIP: i32 = 12;
    /// The constant `ADD`.
    pub const ADD: i32 = 0;
    /// The constant `MODIFY`.
    pub const MODIFY: i32 = 0;
    /// The constant `DELETE`.
    pub const DELETE: i32 = 2;
    /// The constant `DELETEALL`.
    pub const DELETEALL: i32 = 3;
}

impl crate::Message for Marker {
    const TYPE: &'static str = "visualization_msgs/msg/Marker";
}

/// The message `visualization_msgs/msg/MarkerArray`.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct MarkerArray {
    /// (`Marker[]`)
    pub markers: Vec<super::visualization_msgs::Marker>,
}

impl crate::Message for MarkerArray {
    const TYPE: &'static str = "visualization_msgs/msg/MarkerArray";
}

/// The message `visualization_msgs/msg/MenuEntry`.
#[derive(Debug, Clone, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct MenuEntry {
    /// (`uint32`)
    pub id: u32,
    /// (`uint32`)
    pub parent_id: u32,
    /// (`string`)
    pub title: std::string::String,
    /// (`string`)
    pub command: std::string::String,
    /// (`uint8`)
    pub command_type: u8,
}

impl MenuEntry {
    /// The constant `FEEDBACK`.
    pub const FEEDBACK: u8 = 0;
    /// The constant `ROSRUN`.
    pub const ROSRUN: u8 = 1;
    /// The constant `ROSLAUNCH`.
    pub const ROSLAUNCH: u8 = 2;
}

impl crate::Message for MenuEntry {
    const TYPE: &'static str = "visualization_msgs/msg/MenuEntry";
}

/// The message `visualization_msgs/msg/MeshFile`.
#[derive(Debug, Clone, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct MeshFile {
    /// (`string`)
    pub filename: std::string::String,
    /// (`uint8[]`)
    #[serde(with = "serde_bytes")]
    pub data: Vec<u8>,
}

impl crate::Message for MeshFile {
    const TYPE: &'static str = "visualization_msgs/msg/MeshFile";
}

/// The message `visualization_msgs/msg/UVCoordinate`.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub struct UVCoordinate {
    /// (`float32`)
    pub u: f32,
    /// (`float32`)
    pub v: f32,
}

impl crate::Message for UVCoordinate {
    const TYPE: &'static str = "visualization_msgs/msg/UVCoordinate";
}

/// The message `visualization_msgs/srv/GetInteractiveMarkers_Request`.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct GetInteractiveMarkersRequest {
    /// Always 0; on the wire a message without members is one octet.
    #[serde(default)]
    pub structure_needs_at_least_one_member: u8,
}

impl crate::Message for GetInteractiveMarkersRequest {
    const TYPE: &'static str = "visualization_msgs/srv/GetInteractiveMarkers_Request";
}

/// The message `visualization_msgs/srv/GetInteractiveMarkers_Response`.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct GetInteractiveMarkersResponse {
    /// (`uint64`)
    pub sequence_number: u64,
    /// (`InteractiveMarker[]`)
    pub markers: Vec<super::visualization_msgs::InteractiveMarker>,
}

impl crate::Message for GetInteractiveMarkersResponse {
    const TYPE: &'static str = "visualization_msgs/srv/GetInteractiveMarkers_Response";
}

/// The service `visualization_msgs/srv/GetInteractiveMarkers`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct GetInteractiveMarkers;

impl crate::Service for GetInteractiveMarkers {
    type Request = GetInteractiveMarkersRequest;
    type Response = GetInteractiveMarkersResponse;
    const TYPE: &'static str = "visualization_msgs/srv/GetInteractiveMarkers";
}
