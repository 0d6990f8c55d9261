//! The answer as one JSON object; the format is in the repository's README of formats.

use crate::{Answer, Posture, RobotError};
use arm::{Drive, Joint, JointKind, Problem, Robot};
use serde_json::{Map, Value, json};

pub(crate) fn answer(answer: &Answer) -> Value {
    let robot = &answer.robot;
    let joints: Map<String, Value> =
        robot.joints.iter().map(|joint| (joint.name.clone(), joint_json(robot, joint))).collect();
    let first = &answer.postures[0];
    let mut object = json!({
        "robot": robot.name,
        "root": robot.links[0].name,
        "n_links": robot.links.len(),
        "n_driven": robot.dof(),
        "driven": robot.joint_names().collect::<Vec<_>>(),
        "problems": problems(&answer.problems),
        "joints": joints,
        "meshes": meshes(robot),
        "tested_pairs": answer.n_pairs,
        "movable_pairs": answer.n_movable_pairs,
    });
    let fields = object.as_object_mut().expect("it was made an object");
    if answer.is_list {
        fields.insert("poses".into(), answer.postures.iter().map(|posture| links(robot, posture)).collect());
        fields.insert("collisions".into(), answer.postures.iter().map(|posture| contacts(robot, posture)).collect());
        fields.insert("clearance".into(), answer.postures.iter().map(|posture| clearance(robot, posture)).collect());
    } else {
        fields.insert("links".into(), links(robot, first));
        fields.insert("collisions".into(), contacts(robot, first));
        fields.insert("clearance".into(), clearance(robot, first));
    }
    object
}

/// What is said when there is no answer.
pub(crate) fn refusal(error: &RobotError) -> Value {
    json!({ "robot": null, "problems": problems(&error.problems()) })
}

fn problems(problems: &[Problem]) -> Value {
    problems.iter().map(|p| json!({ "line": p.line, "problem": p.what, "advice": p.advice })).collect()
}

fn joint_json(robot: &Robot, joint: &Joint) -> Value {
    // JSON has no infinity: what has no limit has null.
    let finite = |value: f64| if value.is_finite() { json!(value) } else { Value::Null };
    let mimic = match joint.drive {
        Drive::Mimic { leader, multiplier, offset } => {
            json!({ "joint": robot.driven_joint(leader).name, "multiplier": multiplier, "offset": offset })
        }
        _ => Value::Null,
    };
    json!({
        "type": kind(joint.kind),
        "line": joint.line,
        "parent": robot.links[joint.parent].name,
        "child": robot.links[joint.child].name,
        "axis": [joint.axis.x, joint.axis.y, joint.axis.z],
        "limits": {
            "lower": finite(joint.limits.lower),
            "upper": finite(joint.limits.upper),
            "velocity": finite(joint.limits.velocity),
            "effort": finite(joint.limits.effort),
        },
        "mimic": mimic,
    })
}

pub(crate) fn kind(kind: JointKind) -> &'static str {
    match kind {
        JointKind::Revolute => "revolute",
        JointKind::Continuous => "continuous",
        JointKind::Prismatic => "prismatic",
        JointKind::Fixed => "fixed",
    }
}

fn meshes(robot: &Robot) -> Value {
    let of_link = |link: &arm::Link| -> Vec<Value> {
        let one = |mesh: &arm::MeshUse| {
            json!({
                "link": link.name,
                "file": mesh.file,
                "triangles": mesh.n_triangles,
                "pieces": mesh.n_hulls,
                "corners": mesh.n_corners,
                "mesh_volume_m3": mesh.mesh_volume,
                "pieces_volume_m3": mesh.hull_volume,
            })
        };
        link.meshes.iter().map(one).collect()
    };
    robot.links.iter().flat_map(of_link).collect()
}

/// Name to [x, y, z, qx, qy, qz, qw] in the root frame.
fn links(robot: &Robot, posture: &Posture) -> Value {
    let pose = |(link, pose): (&arm::Link, &arm::Isometry3<f64>)| {
        let (t, r) = (&pose.translation.vector, &pose.rotation.coords);
        (link.name.clone(), json!([t.x, t.y, t.z, r.x, r.y, r.z, r.w]))
    };
    Value::Object(robot.links.iter().zip(&posture.poses).map(pose).collect())
}

fn contacts(robot: &Robot, posture: &Posture) -> Value {
    posture.contacts.iter().map(|&(a, b)| json!([robot.links[a].name, robot.links[b].name])).collect()
}

fn clearance(robot: &Robot, posture: &Posture) -> Value {
    match posture.nearest {
        Some(((a, b), distance)) => {
            json!({ "distance_m": distance, "links": [robot.links[a].name, robot.links[b].name] })
        }
        None => Value::Null,
    }
}
