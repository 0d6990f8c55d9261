//! The table of the tests: a cup and a plate on a square metre, and a vase to be placed.

use apprentice_msgs::geometry_msgs::{Point, Pose, Quaternion, Vector3};
use apprentice_msgs::msg::{SceneObject, TableScene};

fn object(id: &str, x: f64, y: f64) -> SceneObject {
    SceneObject {
        id: id.into(),
        label: id.into(),
        shape: SceneObject::SHAPE_CYLINDER,
        size_m: Vector3 { x: 0.1, y: 0.1, z: 0.1 },
        pose: Pose { position: Point { x, y, z: 0.0 }, orientation: Quaternion { x: 0.0, y: 0.0, z: 0.0, w: 1.0 } },
        supports: false,
    }
}

/// As the lesson is about it.
pub fn task() -> TableScene {
    TableScene {
        id: "task".into(),
        width_m: 1.0,
        depth_m: 1.0,
        objects: vec![object("cup", 0.25, 0.25), object("plate", 0.75, 0.75)],
        target: object("vase", 0.0, 0.0),
        ..TableScene::default()
    }
}
