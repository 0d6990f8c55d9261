//! The tree of links, drawn.

use crate::json::kind;
use arm::{Drive, Joint, JointKind, Link, Robot, Solid};

/// One line a link, its joint before it, what it is for collisions after it.
pub(crate) fn draw(robot: &Robot) -> String {
    let mut children: Vec<Vec<usize>> = vec![Vec::new(); robot.links.len()];
    robot.joints.iter().for_each(|joint| children[joint.parent].push(joint.child));
    let mut rows = Vec::new();
    // (link, what is drawn before it, what before its children)
    let mut stack = vec![(0, String::from("  "), String::from("  "))];
    while let Some((link, before, below)) = stack.pop() {
        let (joint, limits) = match robot.holder(link) {
            Some(joint) => (format!("{} {} → ", joint.name, kind(joint.kind)), limits(robot, joint)),
            None => (String::new(), String::new()),
        };
        rows.push([format!("{before}{joint}{}", robot.links[link].name), limits, solids(&robot.links[link])]);
        for (i, &child) in children[link].iter().enumerate().rev() {
            let last = i + 1 == children[link].len();
            let (branch, line) = if last { ("└ ", "  ") } else { ("├ ", "│ ") };
            stack.push((child, format!("{below}{branch}"), format!("{below}{line}")));
        }
    }
    let width = |column: usize| rows.iter().map(|row| row[column].chars().count()).max().unwrap_or(0);
    let (first, second) = (width(0), width(1));
    let pad = |text: &str, width: usize| format!("{text}{}", " ".repeat(width - text.chars().count()));
    let line = |row: &[String; 3]| {
        let line = format!("{}  {}  {}", pad(&row[0], first), pad(&row[1], second), row[2]);
        line.trim_end().to_owned() + "\n"
    };
    rows.iter().map(line).collect()
}

fn limits(robot: &Robot, joint: &Joint) -> String {
    let unit = if joint.kind == JointKind::Prismatic { "m" } else { "rad" };
    let limits = &joint.limits;
    let speed = if limits.velocity.is_finite() { format!(", {} {unit}/s", limits.velocity) } else { String::new() };
    let range = match joint.kind {
        JointKind::Fixed => return String::new(),
        JointKind::Continuous => "without end".into(),
        _ => format!("[{:.4}, {:.4}] {unit}", limits.lower, limits.upper),
    };
    match joint.drive {
        Drive::Mimic { leader, multiplier, offset } => {
            format!("= {multiplier} · {} + {offset}", robot.driven_joint(leader).name)
        }
        _ => format!("{range}{speed}"),
    }
}

fn solids(link: &Link) -> String {
    let mut meshes = link.meshes.iter();
    let words = link.solids.iter().map(|placed| match &placed.solid {
        Solid::Ball { radius } => format!("ball r {radius}"),
        Solid::Box { half_extents: [x, y, z] } => match meshes.as_slice().first() {
            // A box stands in for a mesh that is not there.
            Some(mesh) if mesh.n_triangles == 0 => {
                meshes.next();
                format!("box {:.2} x {:.2} x {:.2} for a missing mesh", 2.0 * x, 2.0 * y, 2.0 * z)
            }
            _ => format!("box {} x {} x {}", round(2.0 * x), round(2.0 * y), round(2.0 * z)),
        },
        Solid::Cylinder { radius, half_length } => format!("cylinder r {radius} l {}", round(2.0 * half_length)),
        Solid::Capsule { radius, half_length } => format!("capsule r {radius} l {}", round(2.0 * half_length)),
        Solid::Hulls(_) => match meshes.next() {
            Some(mesh) => {
                let file = mesh.file.rsplit('/').next().unwrap_or(&mesh.file);
                let pieces = if mesh.n_hulls == 1 { "hull".into() } else { format!("{} pieces", mesh.n_hulls) };
                format!("{file}: {pieces} of {} corners", mesh.n_corners)
            }
            None => "hull".into(),
        },
    });
    let words: Vec<String> = words.collect();
    match words.len() {
        0..=3 => words.join(", "),
        n => format!("{}, and {} more", words[..2].join(", "), n - 2),
    }
}

fn round(value: f64) -> f64 {
    (1e6 * value).round() / 1e6
}
