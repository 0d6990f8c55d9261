//! A plan for RViz and others that draw `visualization_msgs/MarkerArray`: the places that were considered and what became of them,
//! the target where it will stand, and the way of the hand.

use super::{Way, standing};
use apprentice_msgs::geometry_msgs::{Point, Pose, Vector3};
use apprentice_msgs::msg::{PlacementCandidate, PlacementPlan, SceneObject};
use apprentice_msgs::std_msgs::ColorRGBA;
use apprentice_msgs::visualization_msgs::{Marker, MarkerArray};
use exchange::{colour, delete_all_markers, marker, pose_at, text_marker};

const GOOD: [f32; 3] = [0.13, 0.55, 0.33];
const SPARE: [f32; 3] = [0.20, 0.45, 0.75];
const BAD: [f32; 3] = [0.75, 0.22, 0.17];
const SPOT_M: f64 = 0.03;
const SPOT_HEIGHT_M: f64 = 0.004;
const LINE_M: f64 = 0.006;
const TEXT_M: f64 = 0.022;

/// Draws `plan` and its way. What was drawn before is deleted.
pub(super) fn markers(plan: &PlacementPlan, way: &Way) -> MarkerArray {
    let frame = &plan.scene.header.frame_id;
    let mut list = vec![delete_all_markers(frame)];
    for (id, candidate) in (0..).zip(&plan.candidates) {
        let Point { x, y, .. } = candidate.position;
        let (rgb, what) = verdict(candidate);
        list.push(Marker {
            r#type: Marker::CYLINDER,
            pose: pose_at([x, y, 0.5 * SPOT_HEIGHT_M], 0.0),
            scale: Vector3 { x: SPOT_M, y: SPOT_M, z: SPOT_HEIGHT_M },
            color: shade(rgb, 0.9),
            ..marker(frame, "candidates", id)
        });
        let text = format!("{}. {what}", id + 1);
        list.push(text_marker(frame, "verdicts", id, &text, [x, y, 0.02 + TEXT_M], TEXT_M));
    }
    if let Some(target) = standing(plan, way) {
        let size = &target.size_m;
        let place = &target.pose.position;
        list.push(Marker {
            r#type: if target.shape == SceneObject::SHAPE_BOX { Marker::CUBE } else { Marker::CYLINDER },
            pose: Pose {
                position: Point { x: place.x, y: place.y, z: place.z + 0.5 * size.z },
                orientation: target.pose.orientation,
            },
            scale: *size,
            color: shade(if plan.outcome == PlacementPlan::PLANNED { GOOD } else { BAD }, 0.35),
            ..marker(frame, "target", 0)
        });
        let above = [place.x, place.y, place.z + size.z + TEXT_M];
        list.push(text_marker(frame, "target", 1, &plan.reason, above, TEXT_M));
    }
    if way.points_m.len() > 1 {
        list.push(Marker {
            r#type: Marker::LINE_STRIP,
            scale: Vector3 { x: LINE_M, y: 0.0, z: 0.0 },
            color: shade(if plan.inside_bound { GOOD } else { SPARE }, 1.0),
            points: way.points_m.iter().map(|&[x, y, z]| Point { x, y, z }).collect(),
            ..marker(frame, "path", 0)
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

/// The picture without a plan: nothing.
pub(super) fn no_markers(frame: &str) -> MarkerArray {
    MarkerArray { markers: vec![delete_all_markers(frame)] }
}

fn shade([r, g, b]: [f32; 3], opacity: f32) -> ColorRGBA {
    colour([r, g, b, opacity])
}
