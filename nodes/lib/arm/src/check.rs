//! From a parsed description to a tree that is known to be one.

use crate::scan::{MAX_SOLIDS, Scan, shorten};
use crate::{Drive, Joint, JointKind, Limits, Link, Placed, Robot, Solid, UrdfError, rotation};
use nalgebra::{Isometry3, Translation3, Unit, Vector3};
use std::collections::BTreeMap;

pub(crate) fn build(parsed: &urdf_rs::Robot, scan: &Scan) -> Result<Robot, UrdfError> {
    let order = tree_order(parsed, scan)?;
    let index: BTreeMap<&str, usize> =
        order.iter().enumerate().map(|(i, &(link, _))| (parsed.links[link].name.as_str(), i)).collect();
    let mut links = Vec::with_capacity(order.len());
    let mut joints = Vec::with_capacity(order.len());
    let mut n_solids = 0;
    for (i, &(link, joint)) in order.iter().enumerate() {
        n_solids += parsed.links[link].collision.len();
        if n_solids > MAX_SOLIDS {
            let line = line(&scan.links, &parsed.links[link].name);
            return Err(UrdfError::TooMany { line, what: "collision shapes", max: MAX_SOLIDS });
        }
        links.push(build_link(&parsed.links[link], scan)?);
        if let Some(joint) = joint {
            let joint = &parsed.joints[joint];
            joints.push(build_joint(joint, index[joint.parent.link.as_str()], i, scan)?);
        }
    }
    let driven = set_drives(&mut joints, parsed, scan)?;
    Ok(Robot { name: shorten(&parsed.name), links, joints, driven })
}

fn line(places: &BTreeMap<String, usize>, name: &str) -> usize {
    places.get(name).copied().unwrap_or(0)
}

/// Indices of links, each after its parent, with the index of the joint that holds it; siblings in the order of the text.
fn tree_order(parsed: &urdf_rs::Robot, scan: &Scan) -> Result<Vec<(usize, Option<usize>)>, UrdfError> {
    let index: BTreeMap<&str, usize> = parsed.links.iter().enumerate().map(|(i, l)| (l.name.as_str(), i)).collect();
    let mut holder: Vec<Option<usize>> = vec![None; parsed.links.len()];
    let mut children: Vec<Vec<(usize, usize)>> = vec![Vec::new(); parsed.links.len()];
    for (j, joint) in parsed.joints.iter().enumerate() {
        let find = |role, link: &str| {
            index.get(link).copied().ok_or_else(|| UrdfError::MissingLink {
                line: line(&scan.joints, &joint.name),
                joint: shorten(&joint.name),
                role,
                link: shorten(link),
            })
        };
        let parent = find("parent", &joint.parent.link)?;
        let child = find("child", &joint.child.link)?;
        if let Some(first) = holder[child] {
            return Err(UrdfError::TwoParents {
                line: line(&scan.joints, &joint.name),
                link: shorten(&parsed.links[child].name),
                first: shorten(&parsed.joints[first].name),
                second: shorten(&joint.name),
            });
        }
        holder[child] = Some(j);
        children[parent].push((child, j));
    }
    let roots: Vec<usize> = (0..parsed.links.len()).filter(|&l| holder[l].is_none()).collect();
    if let [first, second, ..] = roots[..] {
        return Err(UrdfError::SeveralRoots {
            n: roots.len(),
            first: shorten(&parsed.links[first].name),
            second: shorten(&parsed.links[second].name),
        });
    }
    let mut order: Vec<(usize, Option<usize>)> = Vec::with_capacity(parsed.links.len());
    let mut stack: Vec<(usize, Option<usize>)> = roots.iter().map(|&root| (root, None)).collect();
    let mut reached = vec![false; parsed.links.len()];
    while let Some((link, joint)) = stack.pop() {
        reached[link] = true;
        order.push((link, joint));
        stack.extend(children[link].iter().rev().map(|&(child, joint)| (child, Some(joint))));
    }
    match reached.iter().position(|reached| !reached) {
        // Every link has at most one holder, so what no root reaches hangs on itself.
        Some(link) => {
            let name = &parsed.links[link].name;
            Err(UrdfError::Loop { line: line(&scan.links, name), link: shorten(name) })
        }
        None => Ok(order),
    }
}

fn pose(pose: &urdf_rs::Pose) -> Isometry3<f64> {
    let [x, y, z] = *pose.xyz;
    Isometry3::from_parts(Translation3::new(x, y, z), rotation::from_rpy(*pose.rpy))
}

fn build_link(link: &urdf_rs::Link, scan: &Scan) -> Result<Link, UrdfError> {
    let line = line(&scan.links, &link.name);
    let mut solids = Vec::with_capacity(link.collision.len());
    for collision in &link.collision {
        let (shape, extents, solid) = match &collision.geometry {
            urdf_rs::Geometry::Box { size } => {
                ("box", size.to_vec(), Solid::Box { half_extents: size.map(|v| 0.5 * v) })
            }
            &urdf_rs::Geometry::Cylinder { radius, length } => {
                ("cylinder", vec![radius, length], Solid::Cylinder { radius, half_length: 0.5 * length })
            }
            &urdf_rs::Geometry::Capsule { radius, length } => {
                ("capsule", vec![radius, length], Solid::Capsule { radius, half_length: 0.5 * length })
            }
            &urdf_rs::Geometry::Sphere { radius } => ("sphere", vec![radius], Solid::Ball { radius }),
            urdf_rs::Geometry::Mesh { filename, .. } => {
                return Err(UrdfError::Mesh { line, link: shorten(&link.name), file: shorten(filename) });
            }
        };
        if let Some(&got) = extents.iter().find(|&&v| !(v > 0.0 && v.is_finite())) {
            return Err(UrdfError::Size { line, link: shorten(&link.name), shape, got });
        }
        solids.push(Placed { solid, owner_from_solid: pose(&collision.origin) });
    }
    Ok(Link { name: link.name.clone(), solids })
}

fn build_joint(joint: &urdf_rs::Joint, parent: usize, child: usize, scan: &Scan) -> Result<Joint, UrdfError> {
    let line = line(&scan.joints, &joint.name);
    let name = || shorten(&joint.name);
    let kind = match joint.joint_type {
        urdf_rs::JointType::Revolute => JointKind::Revolute,
        urdf_rs::JointType::Continuous => JointKind::Continuous,
        urdf_rs::JointType::Prismatic => JointKind::Prismatic,
        urdf_rs::JointType::Fixed => JointKind::Fixed,
        ref other => {
            return Err(UrdfError::JointType { line, joint: name(), got: format!("{other:?}").to_lowercase() });
        }
    };
    let axis = match Unit::try_new(Vector3::from(*joint.axis.xyz), 1e-9) {
        Some(axis) => axis,
        None if kind == JointKind::Fixed => Vector3::x_axis(),
        None => return Err(UrdfError::ZeroAxis { line, joint: name() }),
    };
    let limited = scan.limited.contains(&joint.name);
    let limit = &joint.limit;
    let ranged = matches!(kind, JointKind::Revolute | JointKind::Prismatic);
    if ranged && limit.lower > limit.upper {
        return Err(UrdfError::LimitsReversed { line, joint: name(), lower: limit.lower, upper: limit.upper });
    }
    if kind != JointKind::Fixed && limited && limit.velocity <= 0.0 {
        return Err(UrdfError::Velocity { line, joint: name(), got: limit.velocity });
    }
    let unlimited = |wanted: bool, value: f64| if wanted { value } else { f64::INFINITY };
    Ok(Joint {
        name: joint.name.clone(),
        kind,
        parent,
        child,
        parent_from_joint: pose(&joint.origin),
        axis,
        limits: Limits {
            lower: -unlimited(ranged, -limit.lower),
            upper: unlimited(ranged, limit.upper),
            velocity: unlimited(limited, limit.velocity),
            effort: unlimited(limited, limit.effort),
        },
        drive: Drive::Fixed,
    })
}

/// Numbers the joints that lead, ties the ones that mimic to their leaders, and returns the indices of the leaders.
fn set_drives(joints: &mut [Joint], parsed: &urdf_rs::Robot, scan: &Scan) -> Result<Vec<usize>, UrdfError> {
    let sources: BTreeMap<&str, &urdf_rs::Joint> = parsed.joints.iter().map(|j| (j.name.as_str(), j)).collect();
    let mut driven = Vec::new();
    let mut entry: BTreeMap<&str, usize> = BTreeMap::new();
    for (j, joint) in joints.iter_mut().enumerate() {
        let (name, source) = sources.get_key_value(joint.name.as_str()).expect("joints were built from these");
        if joint.kind != JointKind::Fixed && source.mimic.is_none() {
            entry.insert(name, driven.len());
            joint.drive = Drive::Position(driven.len());
            driven.push(j);
        }
    }
    for joint in joints.iter_mut() {
        let line = line(&scan.joints, &joint.name);
        let (mut multiplier, mut offset) = (1.0, 0.0);
        let mut source = sources[joint.name.as_str()];
        if joint.kind == JointKind::Fixed || source.mimic.is_none() {
            continue;
        }
        let mut steps = 0;
        while let Some(mimic) = &source.mimic {
            // q = m (m' q' + o') + o, leader by leader.
            offset += multiplier * mimic.offset.unwrap_or(0.0);
            multiplier *= mimic.multiplier.unwrap_or(1.0);
            source = match sources.get(mimic.joint.as_str()) {
                Some(leader) if leader.joint_type != urdf_rs::JointType::Fixed => leader,
                _ => {
                    let leader = shorten(&mimic.joint);
                    return Err(UrdfError::MimicUnknown { line, joint: shorten(&joint.name), leader });
                }
            };
            steps += 1;
            if steps > parsed.joints.len() {
                return Err(UrdfError::MimicLoop { line, joint: shorten(&joint.name) });
            }
        }
        joint.drive = Drive::Mimic { leader: entry[source.name.as_str()], multiplier, offset };
    }
    Ok(driven)
}
