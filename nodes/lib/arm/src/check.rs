//! From a parsed description to a tree that is known to be one.

use crate::read::{MeshUse, Meshes, MissingMesh, ReadOptions};
use crate::scan::{MAX_SOLIDS, Scan, shorten};
use crate::{
    Drive, Joint, JointKind, Limits, Link, Placed, Problem, Robot, Solid, UrdfError, oddities, rotation, stand_in,
};
use nalgebra::{Isometry3, Translation3, Unit, Vector3};
use std::collections::BTreeMap;

pub(crate) fn build(
    parsed: &urdf_rs::Robot,
    scan: &Scan,
    find_mesh: &mut dyn FnMut(&str) -> Result<Vec<u8>, String>,
    options: &ReadOptions,
) -> Result<Robot, UrdfError> {
    let order = tree_order(parsed, scan)?;
    let index: BTreeMap<&str, usize> =
        order.iter().enumerate().map(|(i, &(link, _))| (parsed.links[link].name.as_str(), i)).collect();
    let mut links = Vec::with_capacity(order.len());
    let mut joints = Vec::with_capacity(order.len());
    let mut problems = Vec::new();
    let mut meshes = Meshes::new(find_mesh, options);
    let mut n_solids = 0;
    for (i, &(link, joint)) in order.iter().enumerate() {
        n_solids += parsed.links[link].collision.len();
        if n_solids > MAX_SOLIDS {
            let line = line(&scan.links, &parsed.links[link].name);
            return Err(UrdfError::TooMany { line, what: "collision shapes", max: MAX_SOLIDS });
        }
        let reading = Reading { parsed, scan, missing: options.missing };
        links.push(reading.link(&parsed.links[link], &mut meshes, &mut problems)?);
        if let Some(joint) = joint {
            let joint = &parsed.joints[joint];
            joints.push(build_joint(joint, index[joint.parent.link.as_str()], i, scan, &mut problems)?);
        }
    }
    let driven = set_drives(&mut joints, parsed, scan)?;
    let mut robot = Robot { name: shorten(&parsed.name), links, joints, driven, problems };
    oddities::list(&mut robot);
    Ok(robot)
}

/// Limits beyond this are none, radians or metres.
const FARTHEST: f64 = 1e3;

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

/// What a link is read with.
struct Reading<'a> {
    parsed: &'a urdf_rs::Robot,
    scan: &'a Scan,
    missing: MissingMesh,
}

impl Reading<'_> {
    fn link(&self, link: &urdf_rs::Link, meshes: &mut Meshes, problems: &mut Vec<Problem>) -> Result<Link, UrdfError> {
        let starts = self.scan.collisions.get(&link.name);
        let mut solids = Vec::with_capacity(link.collision.len());
        let mut uses = Vec::new();
        for (i, collision) in link.collision.iter().enumerate() {
            let line = starts.and_then(|starts| starts.get(i)).copied().unwrap_or(0);
            let placed = if let urdf_rs::Geometry::Mesh { filename, scale } = &collision.geometry {
                let scale = scale.map_or([1.0; 3], |scale| *scale);
                if let Some(&got) = scale.iter().find(|&&v| v == 0.0) {
                    return Err(UrdfError::Size { line, link: shorten(&link.name), shape: "mesh", got });
                }
                match meshes.solid(filename, scale) {
                    Ok((solid, used)) => {
                        uses.push(used);
                        Placed { solid, owner_from_solid: pose(&collision.origin) }
                    }
                    Err(problem) if self.missing == MissingMesh::Refuse => {
                        let (link, file) = (shorten(&link.name).into(), long_name(filename).into());
                        return Err(UrdfError::Mesh { line, link, file, problem: problem.into() });
                    }
                    Err(problem) => {
                        let placed = self.stand_in(link);
                        problems.push(missing(line, link, filename, &problem, &placed));
                        uses.push(no_mesh(filename));
                        placed
                    }
                }
            } else {
                Placed { solid: primitive(&collision.geometry, link, line)?, owner_from_solid: pose(&collision.origin) }
            };
            solids.push(placed);
        }
        let line = line(&self.scan.links, &link.name);
        Ok(Link { name: link.name.clone(), line, solids, meshes: uses })
    }

    fn stand_in(&self, link: &urdf_rs::Link) -> Placed {
        let hanging = self.parsed.joints.iter().filter(|joint| joint.parent.link == link.name);
        let joints: Vec<Vector3<f64>> = hanging.map(|joint| Vector3::from(*joint.origin.xyz)).collect();
        stand_in::around(&link.inertial, &pose(&link.inertial.origin), &joints)
    }
}

fn primitive(geometry: &urdf_rs::Geometry, link: &urdf_rs::Link, line: usize) -> Result<Solid, UrdfError> {
    let (shape, extents, solid) = match *geometry {
        urdf_rs::Geometry::Box { ref size } => {
            ("box", size.to_vec(), Solid::Box { half_extents: size.map(|v| 0.5 * v) })
        }
        urdf_rs::Geometry::Cylinder { radius, length } => {
            ("cylinder", vec![radius, length], Solid::Cylinder { radius, half_length: 0.5 * length })
        }
        urdf_rs::Geometry::Capsule { radius, length } => {
            ("capsule", vec![radius, length], Solid::Capsule { radius, half_length: 0.5 * length })
        }
        urdf_rs::Geometry::Sphere { radius } => ("sphere", vec![radius], Solid::Ball { radius }),
        urdf_rs::Geometry::Mesh { .. } => unreachable!("meshes are read elsewhere"),
    };
    match extents.iter().find(|&&v| !(v > 0.0 && v.is_finite())) {
        Some(&got) => Err(UrdfError::Size { line, link: shorten(&link.name), shape, got }),
        None => Ok(solid),
    }
}

fn missing(line: usize, link: &urdf_rs::Link, file: &str, problem: &str, placed: &Placed) -> Problem {
    let (low, high) = placed.solid.bounds();
    let size = high - low;
    Problem {
        line,
        what: format!(
            "the collision mesh of link '{}' cannot be used: {}: {problem}; a box of {:.2} x {:.2} x {:.2} m around its \
             inertia and joints stands in for it, a guess",
            shorten(&link.name),
            long_name(file),
            size.x,
            size.y,
            size.z
        ),
        advice: "give the mesh before you trust collision checks".into(),
    }
}

fn no_mesh(file: &str) -> MeshUse {
    let file = file.to_owned();
    MeshUse { file, n_triangles: 0, n_hulls: 0, n_corners: 0, mesh_volume: 0.0, hull_volume: 0.0, is_flat: false }
}

/// The name of a file, for a message: its end tells most.
fn long_name(file: &str) -> String {
    let n = file.chars().count();
    let kept: String = file.chars().skip(n.saturating_sub(120)).map(|c| if c.is_control() { ' ' } else { c }).collect();
    if n > 120 { format!("…{kept}") } else { kept }
}

fn build_joint(
    joint: &urdf_rs::Joint,
    parent: usize,
    child: usize,
    scan: &Scan,
    problems: &mut Vec<Problem>,
) -> Result<Joint, UrdfError> {
    let line = line(&scan.joints, &joint.name);
    let name = || shorten(&joint.name);
    let kind = match joint.joint_type {
        urdf_rs::JointType::Revolute => JointKind::Revolute,
        urdf_rs::JointType::Continuous => JointKind::Continuous,
        urdf_rs::JointType::Prismatic => JointKind::Prismatic,
        urdf_rs::JointType::Fixed => JointKind::Fixed,
        urdf_rs::JointType::Floating | urdf_rs::JointType::Planar => {
            let words = format!("{:?}", joint.joint_type).to_lowercase();
            problems.push(Problem {
                line,
                what: format!("joint '{}' is {words}: it is taken to be fixed where its origin is", name()),
                advice: "describe where the robot stands by a fixed joint, and a moving base by joints of its own"
                    .into(),
            });
            JointKind::Fixed
        }
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
    if kind != JointKind::Fixed && limited && limit.velocity < 0.0 {
        return Err(UrdfError::Velocity { line, joint: name(), got: limit.velocity });
    }
    let unlimited = |wanted: bool, value: f64| if wanted { value } else { f64::INFINITY };
    let endless = |value: f64| if value > FARTHEST { f64::INFINITY } else { value };
    if ranged && (-limit.lower > FARTHEST || limit.upper > FARTHEST) {
        problems.push(Problem {
            line,
            what: format!(
                "joint '{}' has limits [{}, {}]: beyond {FARTHEST} it counts as endless",
                name(),
                limit.lower,
                limit.upper
            ),
            advice: "make it continuous, or give its real limits".into(),
        });
    }
    Ok(Joint {
        name: joint.name.clone(),
        line,
        kind,
        parent,
        child,
        parent_from_joint: pose(&joint.origin),
        axis,
        limits: Limits {
            lower: -unlimited(ranged, endless(-limit.lower)),
            upper: unlimited(ranged, endless(limit.upper)),
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
                Some(leader) if is_moving(leader) => leader,
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

fn is_moving(joint: &urdf_rs::Joint) -> bool {
    use urdf_rs::JointType::{Continuous, Prismatic, Revolute};
    matches!(joint.joint_type, Revolute | Continuous | Prismatic)
}
