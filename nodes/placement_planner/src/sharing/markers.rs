//! A plan for RViz and others that draw `visualization_msgs/MarkerArray`: the places that were considered and what became of them,
//! the target where it will stand, and the way of the hand.

use super::{at, standing};
use apprentice_msgs::geometry_msgs::{Point, Vector3};
use apprentice_msgs::msg::{PlacementCandidate, PlacementPlan, SceneObject};
use apprentice_msgs::std_msgs::{ColorRGBA, Header};
use apprentice_msgs::visualization_msgs::{Marker, MarkerArray};

const GOOD: [f32; 3] = [0.13, 0.55, 0.33];
const SPARE: [f32; 3] = [0.20, 0.45, 0.75];
const BAD: [f32; 3] = [0.75, 0.22, 0.17];
const INK: [f32; 3] = [0.15, 0.15, 0.17];
const SPOT_M: f64 = 0.03;
const SPOT_HEIGHT_M: f64 = 0.004;
const LINE_M: f64 = 0.006;
const TEXT_M: f64 = 0.022;

/// Draws `plan`, and `path_m`, the way of the tool in the table's frame. What was drawn before is deleted. Stamps are zero,
/// which means "the newest transform" to those who draw.
pub(crate) fn markers(plan: &PlacementPlan, path_m: &[[f64; 3]]) -> MarkerArray {
    let frame = &plan.scene.header.frame_id;
    let mut list = vec![Marker { action: Marker::DELETEALL, ..blank(frame, "all", 0) }];
    for (id, candidate) in (0..).zip(&plan.candidates) {
        let Point { x, y, .. } = candidate.position;
        let (rgb, what) = verdict(candidate);
        list.push(Marker {
            r#type: Marker::CYLINDER,
            pose: at(x, y, 0.5 * SPOT_HEIGHT_M),
            scale: Vector3 { x: SPOT_M, y: SPOT_M, z: SPOT_HEIGHT_M },
            color: colour(rgb, 0.9),
            ..blank(frame, "candidates", id)
        });
        let text = format!("{}. {what}", id + 1);
        list.push(label(frame, "verdicts", id, text, [x, y, 0.02 + TEXT_M], INK));
    }
    if let Some(target) = standing(plan) {
        let size = &target.size_m;
        let place = &target.pose.position;
        list.push(Marker {
            r#type: if target.shape == SceneObject::SHAPE_BOX { Marker::CUBE } else { Marker::CYLINDER },
            pose: apprentice_msgs::geometry_msgs::Pose {
                position: Point { x: place.x, y: place.y, z: place.z + 0.5 * size.z },
                orientation: target.pose.orientation,
            },
            scale: *size,
            color: colour(if plan.outcome == PlacementPlan::PLANNED { GOOD } else { BAD }, 0.35),
            ..blank(frame, "target", 0)
        });
        let above = [place.x, place.y, place.z + size.z + TEXT_M];
        list.push(label(frame, "target", 1, plan.reason.clone(), above, INK));
    }
    if path_m.len() > 1 {
        list.push(Marker {
            r#type: Marker::LINE_STRIP,
            pose: at(0.0, 0.0, 0.0),
            scale: Vector3 { x: LINE_M, y: 0.0, z: 0.0 },
            color: colour(if plan.inside_bound { GOOD } else { SPARE }, 1.0),
            points: path_m.iter().map(|&[x, y, z]| Point { x, y, z }).collect(),
            ..blank(frame, "path", 0)
        });
    }
    MarkerArray { markers: list }
}

fn verdict(candidate: &PlacementCandidate) -> ([f32; 3], String) {
    match candidate.verdict {
        PlacementCandidate::CHOSEN => (GOOD, "chosen".into()),
        PlacementCandidate::NEXT_BEST => (SPARE, "would do".into()),
        // In words: out of reach, what touches what, or no way there.
        _ => (BAD, candidate.reason.clone()),
    }
}

fn label(frame: &str, ns: &str, id: i32, text: String, [x, y, z]: [f64; 3], rgb: [f32; 3]) -> Marker {
    Marker {
        r#type: Marker::TEXT_VIEW_FACING,
        pose: at(x, y, z),
        scale: Vector3 { x: 0.0, y: 0.0, z: TEXT_M },
        color: colour(rgb, 1.0),
        text,
        ..blank(frame, ns, id)
    }
}

fn blank(frame: &str, ns: &str, id: i32) -> Marker {
    Marker {
        header: Header { frame_id: frame.to_owned(), ..Header::default() },
        ns: ns.to_owned(),
        id,
        action: Marker::ADD,
        pose: at(0.0, 0.0, 0.0),
        ..Marker::default()
    }
}

fn colour([r, g, b]: [f32; 3], a: f32) -> ColorRGBA {
    ColorRGBA { r, g, b, a }
}
