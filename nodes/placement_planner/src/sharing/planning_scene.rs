//! The table as MoveIt's planning scene: a diff that any `move_group` takes from `/planning_scene`.

use apprentice_msgs::moveit_msgs::{CollisionObject, ObjectColor, PlanningScene, PlanningSceneWorld, RobotState};
use apprentice_msgs::msg::{SceneObject, TableScene};
use apprentice_msgs::shape_msgs::SolidPrimitive;
use apprentice_msgs::std_msgs::{ColorRGBA, Header};
use exchange::pose_at;
use placement::TABLE_THICKNESS_M;
use std::collections::BTreeSet;

/// The id of the table top; an object of this id gives way.
const TABLE: &str = "table_top";
const WOOD: ColorRGBA = ColorRGBA { r: 0.87, g: 0.80, b: 0.68, a: 1.0 };
const TARGET: ColorRGBA = ColorRGBA { r: 0.85, g: 0.46, b: 0.17, a: 1.0 };

/// `solids` and the table top added, or put where they are now, and what was `told` before and is gone removed. Stamps are zero:
/// "with the newest transform".
pub(super) fn diff(
    scene: &TableScene,
    solids: &[&SceneObject],
    told: &mut (String, BTreeSet<String>),
) -> PlanningScene {
    let frame = &scene.header.frame_id;
    let mut objects = vec![table(frame, scene)];
    let known = |object: &&&SceneObject| object.id != TABLE && !object.id.is_empty();
    objects.extend(solids.iter().filter(known).map(|object| standing(frame, object)));
    let ids: BTreeSet<String> = objects.iter().map(|object| object.id.clone()).collect();
    let gone = told.1.iter().filter(|id| !ids.contains(*id)).map(|id| removed(&told.0, id));
    let collision_objects = gone.chain(objects).collect();
    *told = (frame.clone(), ids);
    let colour = |id: &str, color: &ColorRGBA| ObjectColor { id: id.to_owned(), color: *color };
    PlanningScene {
        object_colors: vec![colour(TABLE, &WOOD), colour(&scene.target.id, &TARGET)],
        world: PlanningSceneWorld { collision_objects, ..PlanningSceneWorld::default() },
        // Without this MoveIt would take the robot's state to be that of this message: empty.
        robot_state: RobotState { is_diff: true, ..RobotState::default() },
        is_diff: true,
        ..PlanningScene::default()
    }
}

fn header(frame: &str) -> Header {
    Header { frame_id: frame.to_owned(), ..Header::default() }
}

fn table(frame: &str, scene: &TableScene) -> CollisionObject {
    CollisionObject {
        header: header(frame),
        pose: pose_at([0.5 * scene.width_m, 0.5 * scene.depth_m, -0.5 * TABLE_THICKNESS_M], 0.0),
        id: TABLE.into(),
        primitives: vec![cuboid([scene.width_m, scene.depth_m, TABLE_THICKNESS_M])],
        primitive_poses: vec![pose_at([0.0; 3], 0.0)],
        operation: CollisionObject::ADD,
        ..CollisionObject::default()
    }
}

/// An object, whose origin is the middle of its base.
fn standing(frame: &str, object: &SceneObject) -> CollisionObject {
    let size = &object.size_m;
    let solid = match object.shape {
        SceneObject::SHAPE_BOX => cuboid([size.x, size.y, size.z]),
        _ => SolidPrimitive {
            r#type: SolidPrimitive::CYLINDER,
            dimensions: vec![size.z, 0.5 * size.x],
            ..SolidPrimitive::default()
        },
    };
    CollisionObject {
        header: header(frame),
        pose: object.pose,
        id: object.id.clone(),
        primitives: vec![solid],
        primitive_poses: vec![pose_at([0.0, 0.0, 0.5 * size.z], 0.0)],
        operation: CollisionObject::ADD,
        ..CollisionObject::default()
    }
}

fn removed(frame: &str, id: &str) -> CollisionObject {
    CollisionObject {
        header: header(frame),
        pose: pose_at([0.0; 3], 0.0),
        id: id.to_owned(),
        operation: CollisionObject::REMOVE,
        ..CollisionObject::default()
    }
}

fn cuboid(size_m: [f64; 3]) -> SolidPrimitive {
    SolidPrimitive { r#type: SolidPrimitive::BOX, dimensions: size_m.to_vec(), ..SolidPrimitive::default() }
}
