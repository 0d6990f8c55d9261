//! The table for RViz, Foxglove and others that draw `visualization_msgs/MarkerArray`.

use crate::protocol::{BoundsView, ObjectView, PlanView, SceneView};
use apprentice_msgs::geometry_msgs::{Point, Pose, Quaternion, Vector3};
use apprentice_msgs::std_msgs::{ColorRGBA, Header};
use apprentice_msgs::visualization_msgs::{Marker, MarkerArray};

const WOOD: [f32; 4] = [0.87, 0.80, 0.68, 1.0];
const OBJECT: [f32; 4] = [0.93, 0.92, 0.89, 1.0];
const TARGET: [f32; 4] = [0.85, 0.46, 0.17, 0.9];
const GUESS: [f32; 4] = [0.42, 0.31, 0.70, 0.55];
const INK: [f32; 4] = [0.15, 0.15, 0.17, 1.0];
const TABLE_THICKNESS_M: f64 = 0.02;
const TEXT_M: f64 = 0.035;

/// Table, objects, the target beside the table, the robot's guess, and the bound in words. The stamp is zero, which
/// means "the newest transform" to those who draw.
pub(crate) fn markers(scene: &SceneView, plan: Option<&PlanView>, bounds: Option<&BoundsView>) -> MarkerArray {
    let frame = &scene.frame_id;
    let mut list = vec![Marker { action: Marker::DELETEALL, ..blank(frame, "all", 0) }];
    list.push(Marker {
        r#type: Marker::CUBE,
        pose: pose(0.5 * scene.width_m, 0.5 * scene.depth_m, -0.5 * TABLE_THICKNESS_M, 0.0),
        scale: Vector3 { x: scene.width_m, y: scene.depth_m, z: TABLE_THICKNESS_M },
        color: colour(WOOD),
        ..blank(frame, "table", 0)
    });
    for (id, object) in (0..).zip(&scene.objects) {
        list.push(solid(frame, "objects", id, object, object.x_m, object.y_m, OBJECT));
        list.push(label(frame, "labels", id, &object.label, object.x_m, object.y_m, object.size_z_m + TEXT_M));
    }
    let target = &scene.target;
    let (beside_x, beside_y) = (scene.width_m + target.size_x_m, 0.5 * scene.depth_m);
    list.push(solid(frame, "target", 0, target, beside_x, beside_y, TARGET));
    list.push(label(frame, "target", 1, &target.label, beside_x, beside_y, target.size_z_m + TEXT_M));
    if let Some(spot) = plan.and_then(|plan| plan.map_placement) {
        list.push(solid(frame, "guess", 0, target, spot.x_m, spot.y_m, GUESS));
        list.push(label(frame, "guess", 1, "robot's guess", spot.x_m, spot.y_m, target.size_z_m + TEXT_M));
    }
    if let Some(bounds) = bounds {
        let text = match bounds.bound_m {
            Some(bound_m) => format!("at worst {:.1} cm off (revision {})", 100.0 * bound_m, bounds.revision),
            None => format!("no bound yet (revision {})", bounds.revision),
        };
        list.push(label(frame, "bound", 0, &text, 0.5 * scene.width_m, scene.depth_m + 2.0 * TEXT_M, TEXT_M));
    }
    MarkerArray { markers: list }
}

fn blank(frame: &str, ns: &str, id: i32) -> Marker {
    Marker {
        header: Header { frame_id: frame.to_owned(), ..Header::default() },
        ns: ns.to_owned(),
        id,
        action: Marker::ADD,
        pose: pose(0.0, 0.0, 0.0, 0.0),
        ..Marker::default()
    }
}

fn solid(frame: &str, ns: &str, id: i32, object: &ObjectView, x_m: f64, y_m: f64, rgba: [f32; 4]) -> Marker {
    Marker {
        r#type: if object.shape == "box" { Marker::CUBE } else { Marker::CYLINDER },
        pose: pose(x_m, y_m, 0.5 * object.size_z_m, object.yaw_rad),
        scale: Vector3 { x: object.size_x_m, y: object.size_y_m, z: object.size_z_m },
        color: colour(rgba),
        ..blank(frame, ns, id)
    }
}

fn label(frame: &str, ns: &str, id: i32, text: &str, x_m: f64, y_m: f64, z_m: f64) -> Marker {
    Marker {
        r#type: Marker::TEXT_VIEW_FACING,
        pose: pose(x_m, y_m, z_m, 0.0),
        scale: Vector3 { x: 0.0, y: 0.0, z: TEXT_M },
        color: colour(INK),
        text: text.to_owned(),
        ..blank(frame, ns, id)
    }
}

fn pose(x: f64, y: f64, z: f64, yaw_rad: f64) -> Pose {
    let (sin, cos) = (0.5 * yaw_rad).sin_cos();
    Pose { position: Point { x, y, z }, orientation: Quaternion { x: 0.0, y: 0.0, z: sin, w: cos } }
}

fn colour([r, g, b, a]: [f32; 4]) -> ColorRGBA {
    ColorRGBA { r, g, b, a }
}
