//! Where frames are to each other, by the newest transform of each.

use apprentice_msgs::geometry_msgs::{Pose, Quaternion, Transform};
use apprentice_msgs::tf2_msgs::TFMessage;
use arm::{Isometry3, Translation3, UnitQuaternion};
use std::collections::BTreeMap;

/// More frames are not kept.
const MAX_FRAMES: usize = 4096;
/// A chain of more frames is no chain: somewhere it goes in a circle.
const MAX_CHAIN: usize = 64;
/// A quaternion whose length is further from 1 turns nothing.
const UNIT: f64 = 0.1;

/// The newest transform from every frame to its parent.
#[derive(Debug, Clone, Default)]
pub struct Frames {
    parents: BTreeMap<String, (String, Isometry3<f64>)>,
}

impl Frames {
    /// Takes transforms; those that are none (not finite, or without a direction) are left out. Whether all could be used.
    pub fn take(&mut self, message: &TFMessage) -> bool {
        let mut all = true;
        for stamped in &message.transforms {
            let child = plain(&stamped.child_frame_id);
            let has_room = self.parents.len() < MAX_FRAMES || self.parents.contains_key(child);
            match isometry_of_transform(&stamped.transform).filter(|_| has_room && !child.is_empty()) {
                Some(at) => {
                    let parent = plain(&stamped.header.frame_id).to_owned();
                    self.parents.insert(child.to_owned(), (parent, at));
                }
                None => all = false,
            }
        }
        all
    }

    /// The pose of frame `of` in frame `to`; none while nothing connects them.
    pub fn between(&self, to: &str, of: &str) -> Option<Isometry3<f64>> {
        let (to_root, to_pose) = self.up(plain(to))?;
        let (of_root, of_pose) = self.up(plain(of))?;
        (to_root == of_root).then(|| to_pose.inverse() * of_pose)
    }

    /// The topmost frame above one, and the pose in it.
    fn up<'a>(&'a self, frame: &'a str) -> Option<(&'a str, Isometry3<f64>)> {
        let (mut at, mut pose) = (frame, Isometry3::identity());
        for _ in 0..MAX_CHAIN {
            match self.parents.get(at) {
                Some((parent, above)) => {
                    pose = above * pose;
                    at = parent;
                }
                None => return Some((at, pose)),
            }
        }
        None
    }
}

/// Old programs write frames with a slash before them.
fn plain(frame: &str) -> &str {
    frame.strip_prefix('/').unwrap_or(frame)
}

fn isometry_of_transform(transform: &Transform) -> Option<Isometry3<f64>> {
    let at = &transform.translation;
    isometry([at.x, at.y, at.z], &transform.rotation)
}

/// A pose as a map from its own frame; none when it is not finite or has no direction.
pub(crate) fn isometry_of_pose(pose: &Pose) -> Option<Isometry3<f64>> {
    let at = &pose.position;
    isometry([at.x, at.y, at.z], &pose.orientation)
}

fn isometry([x, y, z]: [f64; 3], turn: &Quaternion) -> Option<Isometry3<f64>> {
    let length = (turn.x * turn.x + turn.y * turn.y + turn.z * turn.z + turn.w * turn.w).sqrt();
    if ![x, y, z].iter().all(|v| v.is_finite()) || !(length - 1.0).abs().lt(&UNIT) {
        return None;
    }
    let raw = UnitQuaternion::identity().into_inner();
    let mut quaternion = raw;
    (quaternion.coords.x, quaternion.coords.y, quaternion.coords.z, quaternion.coords.w) =
        (turn.x, turn.y, turn.z, turn.w);
    Some(Isometry3::from_parts(Translation3::new(x, y, z), UnitQuaternion::from_quaternion(quaternion)))
}
