//! Tables: scenes, objects and points.

use crate::drawing::pose_at;
use apprentice_msgs::builtin_interfaces::Time;
use apprentice_msgs::geometry_msgs::{Point as PointMessage, Quaternion, Vector3};
use apprentice_msgs::msg::{SceneObject, TableScene};
use apprentice_msgs::std_msgs::Header;
use scene::{MAX_OBJECTS, Object, Point, Scene, SceneError, Shape};
use thiserror::Error;

/// How far a rotation may tilt from the vertical, as the sum of squares of the quaternion's x and y.
const TILT: f64 = 1e-4;

/// Why a message cannot be used.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum ExchangeError {
    /// The scene itself is wrong.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// Only the numbered shapes are known.
    #[error("object '{id}' has shape {got}; 0 (cylinder) and 1 (box) are known")]
    Shape {
        /// The object.
        id: String,
        /// Got.
        got: u8,
    },
    /// A cylinder is as wide as it is deep.
    #[error("object '{id}' is a cylinder but {x_m} m by {y_m} m; a cylinder's size_m.x and size_m.y are its diameter")]
    Cylinder {
        /// The object.
        id: String,
        /// Got.
        x_m: f64,
        /// Got.
        y_m: f64,
    },
    /// Objects stand upright.
    #[error("object '{id}' is tilted; only rotations about z are supported")]
    Tilted {
        /// The object.
        id: String,
    },
    /// A coordinate is not a number.
    #[error("{what} is ({x}, {y}, {z}); finite metres are needed")]
    NotFinite {
        /// Of what.
        what: &'static str,
        /// Got.
        x: f64,
        /// Got.
        y: f64,
        /// Got.
        z: f64,
    },
}

/// Whether two messages show the same table but for what perception may be off: see [`Scene::stands_as`]. Not when one of them
/// cannot be used.
pub fn stands_as(a: &TableScene, b: &TableScene) -> bool {
    match (scene_from_message(a), scene_from_message(b)) {
        (Ok(a), Ok(b)) => a.stands_as(&b),
        _ => false,
    }
}

/// The checked scene of a message.
pub fn scene_from_message(message: &TableScene) -> Result<Scene, ExchangeError> {
    if message.objects.len() > MAX_OBJECTS {
        return Err(SceneError::TooMany { scene: message.id.clone(), got: message.objects.len() }.into());
    }
    let scene = Scene {
        id: message.id.clone(),
        frame: message.header.frame_id.clone(),
        width_m: message.width_m,
        depth_m: message.depth_m,
        objects: message.objects.iter().map(object_from_message).collect::<Result<_, _>>()?,
        target: object_from_message(&message.target)?,
    };
    scene.check()?;
    Ok(scene)
}

/// The message of a scene.
pub fn scene_to_message(scene: &Scene, stamp: Time) -> TableScene {
    TableScene {
        header: Header { stamp, frame_id: scene.frame.clone() },
        id: scene.id.clone(),
        width_m: scene.width_m,
        depth_m: scene.depth_m,
        objects: scene.objects.iter().map(object_to_message).collect(),
        target: object_to_message(&scene.target),
    }
}

/// The point of a message, in metres; its height is dropped.
pub fn point_from_message(what: &'static str, message: &PointMessage) -> Result<Point, ExchangeError> {
    let PointMessage { x, y, z } = *message;
    if [x, y, z].iter().all(|v| v.is_finite()) {
        Ok(Point::new(x, y))
    } else {
        Err(ExchangeError::NotFinite { what, x, y, z })
    }
}

/// The message of a point in metres, on the table's surface.
pub fn point_to_message(at_m: Point) -> PointMessage {
    PointMessage { x: at_m.x, y: at_m.y, z: 0.0 }
}

/// An object by itself; whether its numbers make sense is for its scene to say.
///
/// # Errors
/// A shape that is not known, or one that stands at a tilt.
pub fn object_from_message(message: &SceneObject) -> Result<Object, ExchangeError> {
    let id = || message.id.chars().take(128).collect::<String>();
    let Vector3 { x, y, z } = message.size_m;
    let shape = match message.shape {
        SceneObject::SHAPE_CYLINDER if (x - y).abs() > 1e-9 => {
            return Err(ExchangeError::Cylinder { id: id(), x_m: x, y_m: y });
        }
        SceneObject::SHAPE_CYLINDER => Shape::Cylinder { radius_m: 0.5 * x, height_m: z },
        SceneObject::SHAPE_BOX => Shape::Box { width_m: x, depth_m: y, height_m: z },
        got => return Err(ExchangeError::Shape { id: id(), got }),
    };
    let Quaternion { x: qx, y: qy, z: qz, w: qw } = message.pose.orientation;
    if qx * qx + qy * qy > TILT {
        return Err(ExchangeError::Tilted { id: id() });
    }
    Ok(Object {
        id: message.id.clone(),
        label: message.label.clone(),
        shape,
        position_m: Point::new(message.pose.position.x, message.pose.position.y),
        yaw_rad: 2.0 * qz.atan2(qw),
        supports: message.supports,
    })
}

fn object_to_message(object: &Object) -> SceneObject {
    let (shape, size_m) = match object.shape {
        Shape::Cylinder { radius_m, height_m } => {
            (SceneObject::SHAPE_CYLINDER, Vector3 { x: 2.0 * radius_m, y: 2.0 * radius_m, z: height_m })
        }
        Shape::Box { width_m, depth_m, height_m } => {
            (SceneObject::SHAPE_BOX, Vector3 { x: width_m, y: depth_m, z: height_m })
        }
    };
    SceneObject {
        id: object.id.clone(),
        label: object.label.clone(),
        shape,
        size_m,
        pose: pose_at([object.position_m.x, object.position_m.y, 0.0], object.yaw_rad),
        supports: object.supports,
    }
}

#[cfg(test)]
mod tests {
    use super::{ExchangeError, point_from_message, scene_from_message, scene_to_message};
    use apprentice_msgs::builtin_interfaces::Time;
    use apprentice_msgs::geometry_msgs::Point as PointMessage;
    use scene::{Object, Point, Scene, Shape};

    fn scene() -> Scene {
        let object = |id: &str, shape, yaw_rad| Object {
            id: id.into(),
            label: format!("the {id}"),
            shape,
            position_m: Point::new(0.25, 0.5),
            yaw_rad,
            supports: id == "bowl",
        };
        Scene {
            id: "s".into(),
            frame: "table".into(),
            width_m: 1.0,
            depth_m: 0.8,
            objects: vec![
                object("bowl", Shape::Cylinder { radius_m: 0.07, height_m: 0.05 }, 0.0),
                object("tray", Shape::Box { width_m: 0.3, depth_m: 0.2, height_m: 0.02 }, 0.7),
            ],
            target: object("spoon", Shape::Cylinder { radius_m: 0.02, height_m: 0.01 }, 0.0),
        }
    }

    #[test]
    fn a_scene_survives_the_way_through_a_message() {
        let back = scene_from_message(&scene_to_message(&scene(), Time::default())).expect("the scene is right");
        assert!((back.objects[1].yaw_rad - 0.7).abs() < 1e-15);
        let mut expected = scene();
        expected.objects[1].yaw_rad = back.objects[1].yaw_rad;
        assert_eq!(back, expected);
    }

    #[test]
    fn what_cannot_be_used_is_named() {
        let mut message = scene_to_message(&scene(), Time::default());
        message.objects[1].shape = 7;
        assert_eq!(scene_from_message(&message), Err(ExchangeError::Shape { id: "tray".into(), got: 7 }));
        let mut message = scene_to_message(&scene(), Time::default());
        message.objects[0].size_m.x = 0.2;
        assert!(matches!(scene_from_message(&message), Err(ExchangeError::Cylinder { .. })));
        let mut message = scene_to_message(&scene(), Time::default());
        message.objects[0].pose.orientation.x = 0.5;
        assert_eq!(scene_from_message(&message), Err(ExchangeError::Tilted { id: "bowl".into() }));
        let mut message = scene_to_message(&scene(), Time::default());
        message.objects[0].pose.position.x = f64::NAN;
        assert!(matches!(scene_from_message(&message), Err(ExchangeError::Scene(_))));
        let nan = PointMessage { x: f64::NAN, y: 0.0, z: 0.0 };
        let text = point_from_message("the placement", &nan).expect_err("NaN is no place").to_string();
        assert_eq!(text, "the placement is (NaN, 0, 0); finite metres are needed");
    }
}
