//! A small table, and things a person may say about it.

use apprentice_msgs::builtin_interfaces::Time;
use apprentice_msgs::geometry_msgs::Point as PointMessage;
use apprentice_msgs::msg::{PlacementDemonstration, Retraction, TableScene};
use apprentice_msgs::std_msgs::Header;
use exchange::scene_to_message;
use scene::{Object, Point, Scene, Shape};

fn object(id: &str, x: f64, y: f64) -> Object {
    Object {
        id: id.to_owned(),
        label: id.to_owned(),
        shape: Shape::Cylinder { radius_m: 0.05, height_m: 0.1 },
        position_m: Point::new(x, y),
        yaw_rad: 0.0,
        supports: false,
    }
}

/// A table of 1 m by 1 m with a cup, a plate and a place for a vase.
pub fn table() -> TableScene {
    let scene = Scene {
        id: "task".to_owned(),
        frame: "table".to_owned(),
        width_m: 1.0,
        depth_m: 1.0,
        objects: vec![object("cup", 0.25, 0.25), object("plate", 0.75, 0.7)],
        target: object("vase", 0.5, 0.5),
    };
    scene_to_message(&scene, Time { sec: 7, nanosec: 0 })
}

/// "The vase belongs there", not asked for.
pub fn volunteered(id: &str, x: f64, y: f64) -> PlacementDemonstration {
    PlacementDemonstration {
        header: Header { stamp: Time { sec: 100, nanosec: 0 }, frame_id: "table".to_owned() },
        id: id.to_owned(),
        query_id: String::new(),
        source: "test".to_owned(),
        scene: table(),
        placement: PointMessage { x, y, z: 0.0 },
        confidence: PlacementDemonstration::CONFIDENCE_SURE,
    }
}

/// Takes a piece of evidence back.
pub fn retraction(id: &str, evidence_id: &str) -> Retraction {
    Retraction {
        id: id.to_owned(),
        evidence_id: evidence_id.to_owned(),
        source: "test".to_owned(),
        ..Retraction::default()
    }
}
