//! The arm for those who draw it: its solids once, where its links are, and how it would carry out a plan.

use super::{Way, standing};
use apprentice_msgs::builtin_interfaces::Time;
use apprentice_msgs::geometry_msgs::{Point, Pose, Quaternion, Vector3};
use apprentice_msgs::msg::{ArmModel, ArmMotion, ArmPart, ArmPose, PlacementPlan};
use apprentice_msgs::std_msgs::Header;
use arm::{Isometry3, Solid};
use placement::Manipulator;

/// Corners of a mesh that are drawn, at most.
const MAX_CORNERS: usize = 200;
/// Moments of a motion that are drawn, at most.
const MAX_MOMENTS: usize = 61;

/// What the arm looks like in a frame.
pub(super) fn model(arm: &Manipulator, robot_hash: &str, frame: &str) -> ArmModel {
    let links = &arm.robot().links;
    let parts = (0..).zip(links).flat_map(|(link, of)| of.solids.iter().map(move |placed| (link, placed)));
    ArmModel {
        header: header(Time::default(), frame),
        robot_hash: robot_hash.to_owned(),
        link_names: links.iter().map(|link| link.name.clone()).collect(),
        parts: parts.flat_map(|(link, placed)| drawn(link, &placed.solid, &placed.owner_from_solid)).collect(),
    }
}

/// A solid; one of several pieces is as many parts.
fn drawn(link: u32, solid: &Solid, at: &Isometry3<f64>) -> Vec<ArmPart> {
    let part = |shape, [x, y, z]: [f64; 3]| {
        let size_m = Vector3 { x, y, z };
        ArmPart { link, shape, pose: pose(at), size_m, ..ArmPart::default() }
    };
    match solid {
        Solid::Box { half_extents } => vec![part(ArmPart::BOX, half_extents.map(|half| 2.0 * half))],
        Solid::Cylinder { radius, half_length } => {
            vec![part(ArmPart::CYLINDER, [2.0 * radius, 2.0 * radius, 2.0 * half_length])]
        }
        Solid::Capsule { radius, half_length } => {
            vec![part(ArmPart::CAPSULE, [2.0 * radius, 2.0 * radius, 2.0 * half_length])]
        }
        Solid::Ball { radius } => vec![part(ArmPart::SPHERE, [2.0 * radius; 3])],
        Solid::Hulls(hulls) => hulls
            .iter()
            .map(|hull| {
                let (corners, triangles) = hull.surface(MAX_CORNERS);
                ArmPart {
                    points: corners.iter().flat_map(|c| [c.x as f32, c.y as f32, c.z as f32]).collect(),
                    triangles: triangles.into_iter().flatten().collect(),
                    ..part(ArmPart::MESH, [0.0; 3])
                }
            })
            .collect(),
    }
}

/// Where its links are; `None` where nobody says where the table is.
pub(super) fn arm_pose(
    arm: &Manipulator,
    robot_hash: &str,
    frame: &str,
    joints: &[(String, f64)],
    now: Time,
) -> Option<ArmPose> {
    let poses = flat(&arm.link_poses(frame, joints)?);
    Some(ArmPose { header: header(now, frame), robot_hash: robot_hash.to_owned(), poses })
}

/// How it would carry out a plan: some moments of the motion, evenly spaced in time, the last among them, and those when the target
/// comes into the hand and leaves it.
pub(super) fn motion(plan: &PlacementPlan, way: &Way) -> ArmMotion {
    let last_s = way.moments.last().map_or(0.0, |(s, _)| *s);
    let n = MAX_MOMENTS.min(way.moments.len());
    let even = (0..n).map(|i| last_s * i as f64 / (n - 1).max(1) as f64);
    let first = |at_s: f64| way.moments.partition_point(|(s, _)| *s < at_s).min(way.moments.len().saturating_sub(1));
    let mut moments: Vec<usize> = even.chain(way.held_s.into_iter().filter(|_| n > 0)).map(first).collect();
    moments.sort_unstable();
    moments.dedup();
    ArmMotion {
        header: plan.scene.header.clone(),
        revision: plan.revision,
        robot_hash: plan.robot_hash.clone(),
        times_s: moments.iter().map(|&i| way.moments[i].0).collect(),
        poses: moments.iter().flat_map(|&i| flat(&way.moments[i].1)).collect(),
        way_m: way.points_m.iter().flatten().copied().collect(),
        held_from_s: way.held_s[0],
        held_until_s: way.held_s[1],
        pick: plan.pick,
        target: standing(plan, way).unwrap_or_default(),
    }
}

fn flat(poses: &[Isometry3<f64>]) -> Vec<f32> {
    let seven = |at: &Isometry3<f64>| {
        let (t, q) = (at.translation.vector, at.rotation.coords);
        [t.x, t.y, t.z, q.x, q.y, q.z, q.w].map(|x| x as f32)
    };
    poses.iter().flat_map(seven).collect()
}

fn pose(at: &Isometry3<f64>) -> Pose {
    let (t, q) = (at.translation.vector, at.rotation.coords);
    Pose { position: Point { x: t.x, y: t.y, z: t.z }, orientation: Quaternion { x: q.x, y: q.y, z: q.z, w: q.w } }
}

fn header(stamp: Time, frame: &str) -> Header {
    Header { stamp, frame_id: frame.to_owned() }
}
