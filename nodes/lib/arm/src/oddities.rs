//! What is allowed in a URDF and still seldom meant.

use crate::scan::shorten;
use crate::{Drive, JointKind, Problem, Robot};

/// Links farther across than this are probably in millimetres.
const LARGEST_LINK_M: f64 = 5.0;
/// And links smaller than this too small to be meant.
const SMALLEST_LINK_M: f64 = 5e-4;
/// A hull this many times its mesh is worth a word.
const LOOSE_HULL: f64 = 2.0;

/// Adds what is odd about a robot to its problems, and sorts them.
pub(crate) fn list(robot: &mut Robot) {
    let mut found = Vec::new();
    for joint in &robot.joints {
        joint_oddities(robot, joint, &mut found);
    }
    for link in &robot.links {
        let name = shorten(&link.name);
        let mut note = |what: String, advice: &str| {
            found.push(Problem { line: link.line, what, advice: advice.into() });
        };
        for mesh in &link.meshes {
            let file = mesh.file.rsplit('/').next().unwrap_or(&mesh.file);
            if mesh.is_flat {
                note(
                    format!(
                        "the collision mesh {} of link '{name}' encloses no volume: it is made 0.2 mm thick",
                        shorten(file)
                    ),
                    "use a closed mesh",
                );
            } else if mesh.n_hulls == 1 && mesh.hull_volume > LOOSE_HULL * mesh.mesh_volume && mesh.mesh_volume > 0.0 {
                note(
                    format!(
                        "the convex hull of {} of link '{name}' has {:.1} times the volume of the mesh (of what of it is closed)",
                        shorten(file),
                        mesh.hull_volume / mesh.mesh_volume
                    ),
                    "ask for convex pieces, or model the link by several primitives, if it should pass through narrow places",
                );
            }
        }
        let across = link.solids.iter().map(|placed| 2.0 * placed.solid.bounding_radius()).fold(0.0, f64::max);
        if across > LARGEST_LINK_M {
            note(
                format!("a collision shape of link '{name}' is about {across:.0} m large"),
                "if its file is in millimetres, set scale=\"0.001 0.001 0.001\" on its <mesh>",
            );
        } else if !link.solids.is_empty() && across < SMALLEST_LINK_M {
            note(
                format!("the collision shapes of link '{name}' are smaller than {:.1} mm", 1e3 * SMALLEST_LINK_M),
                "check the scale on its <mesh>, or its sizes: URDF is in metres",
            );
        }
    }
    robot.problems.append(&mut found);
    robot.problems.sort_by_key(|problem| problem.line);
}

fn joint_oddities(robot: &Robot, joint: &crate::Joint, found: &mut Vec<Problem>) {
    let name = shorten(&joint.name);
    let mut note = |what: String, advice: &str| {
        found.push(Problem { line: joint.line, what, advice: advice.into() });
    };
    let limits = &joint.limits;
    match joint.drive {
        Drive::Fixed => {}
        Drive::Position(_) => {
            if limits.lower == limits.upper {
                note(
                    format!("joint '{name}' has both limits at {}: it cannot move", limits.lower),
                    "give its real limits, or make it fixed",
                );
            }
            if limits.velocity == 0.0 {
                note(
                    format!("joint '{name}' has the velocity limit 0: no motion of it can be timed"),
                    "give its largest speed",
                );
            }
            if limits.lower > 0.0 || limits.upper < 0.0 {
                note(
                    format!(
                        "position 0 of joint '{name}' is outside of its limits [{}, {}]",
                        limits.lower, limits.upper
                    ),
                    "mind this where other programs take 0 as the start",
                );
            }
        }
        Drive::Mimic { leader, multiplier, offset } => {
            let lead = robot.driven_joint(leader).limits;
            let (a, b) = (multiplier * lead.lower + offset, multiplier * lead.upper + offset);
            let (low, high) = (a.min(b), a.max(b));
            let ranged = joint.kind != JointKind::Continuous;
            if ranged && (low < limits.lower - 1e-6 || high > limits.upper + 1e-6) {
                note(
                    format!(
                        "joint '{name}' follows '{}' from {low:.4} to {high:.4}, beyond its own limits [{}, {}]",
                        shorten(&robot.driven_joint(leader).name),
                        limits.lower,
                        limits.upper
                    ),
                    "make the limits of the two agree",
                );
            }
        }
    }
}
