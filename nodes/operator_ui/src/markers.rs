//! The table for RViz, Foxglove and others that draw `visualization_msgs/MarkerArray`.

use crate::protocol::{BoundsView, ObjectView, PlanView, SceneView};
use apprentice_msgs::geometry_msgs::Vector3;
use apprentice_msgs::msg::PlacementQuery;
use apprentice_msgs::visualization_msgs::{Marker, MarkerArray};
use exchange::{broken_text, colour, delete_all_markers, marker, pose_at, text_marker};

const WOOD: [f32; 4] = [0.87, 0.80, 0.68, 1.0];
const OBJECT: [f32; 4] = [0.93, 0.92, 0.89, 1.0];
/// What is to be placed.
pub(crate) const TARGET: [f32; 4] = [0.85, 0.46, 0.17, 0.9];
const GUESS: [f32; 4] = [0.42, 0.31, 0.70, 0.55];
const OFFERED: [f32; 4] = [0.85, 0.46, 0.17, 0.45];
const TABLE_THICKNESS_M: f64 = 0.02;
const TEXT_M: f64 = 0.035;
/// Longer lines are broken, characters.
const LINE: usize = 56;

/// Table, objects, the robot's guess, and the bound in words; beside the table the target, or while a question is open its words and
/// the places that it offers: then the target is an interactive marker. The stamp is zero, which means "the newest transform" to those who draw.
pub(crate) fn markers(
    scene: &SceneView,
    asked: Option<&PlacementQuery>,
    plan: Option<&PlanView>,
    bounds: Option<&BoundsView>,
) -> MarkerArray {
    let frame = &scene.frame_id;
    let mut list = vec![delete_all_markers(frame)];
    list.push(Marker {
        r#type: Marker::CUBE,
        pose: pose_at([0.5 * scene.width_m, 0.5 * scene.depth_m, -0.5 * TABLE_THICKNESS_M], 0.0),
        scale: Vector3 { x: scene.width_m, y: scene.depth_m, z: TABLE_THICKNESS_M },
        color: colour(WOOD),
        ..marker(frame, "table", 0)
    });
    for (id, object) in (0..).zip(&scene.objects) {
        list.push(solid(frame, "objects", id, object, object.x_m, object.y_m, OBJECT));
        list.push(label(frame, "labels", id, &object.label, object.x_m, object.y_m, object.size_z_m + TEXT_M));
    }
    let target = &scene.target;
    let (beside_x, beside_y) = (scene.width_m + target.size_x_m, 0.5 * scene.depth_m);
    match asked {
        // Above the bound.
        Some(asked) => {
            list.push(question(frame, &asked.reason, [0.5 * scene.width_m, scene.depth_m + 3.0 * TEXT_M]));
            // Those who cannot press handles see them, too.
            for ((id, letter), option) in (0..).zip(["A", "B"]).zip(&asked.options) {
                let (x_m, y_m) = (option.placement.x, option.placement.y);
                list.push(solid(frame, "options", id, target, x_m, y_m, OFFERED));
                list.push(label(frame, "option letters", id, letter, x_m, y_m, target.size_z_m + TEXT_M));
            }
        }
        None => {
            list.push(solid(frame, "target", 0, target, beside_x, beside_y, TARGET));
            list.push(label(frame, "target", 1, &target.label, beside_x, beside_y, target.size_z_m + TEXT_M));
        }
    }
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

/// A thing without a place yet.
pub(crate) fn body(frame: &str, ns: &str, id: i32, object: &ObjectView, rgba: [f32; 4]) -> Marker {
    Marker {
        r#type: if object.shape == "box" { Marker::CUBE } else { Marker::CYLINDER },
        scale: Vector3 { x: object.size_x_m, y: object.size_y_m, z: object.size_z_m },
        color: colour(rgba),
        ..marker(frame, ns, id)
    }
}

/// What is asked, in lines that end above a point, metres.
pub(crate) fn question(frame: &str, words: &str, [x_m, y_m]: [f64; 2]) -> Marker {
    let text = broken_text(words, LINE);
    let half_m = TEXT_M * (0.6 * text.lines().count() as f64 + 1.0);
    label(frame, "question", 0, &text, x_m, y_m + half_m, TEXT_M)
}

fn solid(frame: &str, ns: &str, id: i32, object: &ObjectView, x_m: f64, y_m: f64, rgba: [f32; 4]) -> Marker {
    Marker { pose: pose_at([x_m, y_m, 0.5 * object.size_z_m], object.yaw_rad), ..body(frame, ns, id, object, rgba) }
}

fn label(frame: &str, ns: &str, id: i32, text: &str, x_m: f64, y_m: f64, z_m: f64) -> Marker {
    text_marker(frame, ns, id, text, [x_m, y_m, z_m], TEXT_M)
}
