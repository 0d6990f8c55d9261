//! Where things stand, for tf. On `/tf`, since they may be moved: `/tf_static` is for what never is.

use apprentice_msgs::builtin_interfaces::Time;
use apprentice_msgs::geometry_msgs::{Transform, TransformStamped, Vector3};
use apprentice_msgs::msg::SceneObject;
use apprentice_msgs::std_msgs::Header;
use apprentice_msgs::tf2_msgs::TFMessage;

/// Object `cup` is the frame `object/cup`: a link of the robot may have the object's name, and a frame has one parent.
const PREFIX: &str = "object/";

/// The middle of the base of every object, in the table's frame.
pub(super) fn transforms(now: Time, frame: &str, solids: &[&SceneObject]) -> TFMessage {
    let transform = |object: &&SceneObject| {
        let at = &object.pose.position;
        TransformStamped {
            header: Header { stamp: now, frame_id: frame.to_owned() },
            child_frame_id: format!("{PREFIX}{}", object.id),
            transform: Transform {
                translation: Vector3 { x: at.x, y: at.y, z: at.z },
                rotation: object.pose.orientation,
            },
        }
    };
    TFMessage { transforms: solids.iter().map(transform).collect() }
}
