//! The table as markers, so that RViz and Foxglove show it without knowing our messages.

use apprentice_msgs::builtin_interfaces::Time;
use apprentice_msgs::geometry_msgs::{Point, Pose, Quaternion, Vector3};
use apprentice_msgs::std_msgs::{ColorRGBA, Header};
use apprentice_msgs::visualization_msgs::{Marker, MarkerArray};
use scene::{Object, Scene, Shape};

/// Thickness of the table top, metres; its upper side is at z = 0.
const TOP_M: f64 = 0.02;
const LABEL_M: f64 = 0.04;
const WOOD: [f32; 4] = [0.76, 0.65, 0.52, 1.0];
const THING: [f32; 4] = [0.36, 0.52, 0.68, 1.0];
const SUPPORT: [f32; 4] = [0.42, 0.62, 0.45, 1.0];
const INK: [f32; 4] = [0.15, 0.15, 0.15, 1.0];

/// One box for the table top; for every object its solid and its label. Ids are the same for the same scene.
pub fn scene_markers(scene: &Scene, stamp: &Time) -> MarkerArray {
    let marker = |namespace: &str, id: usize, kind: i32, at: [f64; 3], size_m: [f64; 3], colour: [f32; 4]| Marker {
        header: Header { stamp: stamp.clone(), frame_id: scene.frame.clone() },
        ns: namespace.to_owned(),
        id: i32::try_from(id).unwrap_or(i32::MAX),
        r#type: kind,
        action: Marker::ADD,
        pose: Pose {
            position: Point { x: at[0], y: at[1], z: at[2] },
            orientation: Quaternion { x: 0.0, y: 0.0, z: 0.0, w: 1.0 },
        },
        scale: Vector3 { x: size_m[0], y: size_m[1], z: size_m[2] },
        color: ColorRGBA { r: colour[0], g: colour[1], b: colour[2], a: colour[3] },
        ..Marker::default()
    };
    let middle = [0.5 * scene.width_m, 0.5 * scene.depth_m, -0.5 * TOP_M];
    let mut markers = vec![marker("table", 0, Marker::CUBE, middle, [scene.width_m, scene.depth_m, TOP_M], WOOD)];
    for (i, object) in scene.objects.iter().enumerate() {
        let Object { position_m: at, shape, .. } = object;
        let height_m = shape.height_m();
        let (kind, size_m) = match *shape {
            Shape::Cylinder { radius_m, .. } => (Marker::CYLINDER, [2.0 * radius_m, 2.0 * radius_m, height_m]),
            Shape::Box { width_m, depth_m, .. } => (Marker::CUBE, [width_m, depth_m, height_m]),
        };
        let colour = if object.supports { SUPPORT } else { THING };
        let mut solid = marker("objects", i, kind, [at.x, at.y, 0.5 * height_m], size_m, colour);
        let (sin, cos) = (0.5 * object.yaw_rad).sin_cos();
        solid.pose.orientation = Quaternion { x: 0.0, y: 0.0, z: sin, w: cos };
        let above = [at.x, at.y, height_m + LABEL_M];
        let label = marker("labels", i, Marker::TEXT_VIEW_FACING, above, [0.0, 0.0, LABEL_M], INK);
        markers.extend([solid, Marker { text: object.label.clone(), ..label }]);
    }
    MarkerArray { markers }
}
