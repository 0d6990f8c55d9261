//! Where the nodes of a COLLADA scene put its geometries.

use super::dae::{reference, syntax};
use super::xml::Element;
use super::{MeshError, number};
use crate::rotation::about_axis;
use nalgebra::{Matrix4, Unit, Vector3};
use std::collections::BTreeMap;

/// Most geometries placed by one scene.
const MAX_INSTANCES: usize = 10_000;
/// Deepest nesting of nodes, with those that nodes refer to.
const MAX_NODE_DEPTH: usize = 64;
/// Most nodes visited: a node may be referred to twice by one that is referred to twice, and so on.
const MAX_VISITS: usize = 100_000;

/// A geometry of the scene.
pub(super) struct Instance<'a> {
    /// Its id.
    pub geometry: &'a str,
    /// Scene from geometry.
    pub placed: Matrix4<f64>,
}

struct Walk<'a> {
    /// Nodes that others may refer to.
    nodes: BTreeMap<&'a str, &'a Element>,
    /// Geometries behind skins.
    skins: BTreeMap<&'a str, &'a str>,
    found: Vec<Instance<'a>>,
    visits: usize,
}

/// The geometries of a document's scene, none when it has no scene.
pub(super) fn instances(root: &Element) -> Result<Vec<Instance<'_>>, MeshError> {
    let library = |name: &'static str| root.children_named(name);
    let mut walk = Walk { nodes: BTreeMap::new(), skins: BTreeMap::new(), found: Vec::new(), visits: 0 };
    for node in library("library_nodes").flat_map(|library| library.children_named("node")) {
        walk.nodes.extend(node.attribute("id").map(|id| (id, node)));
    }
    for controller in library("library_controllers").flat_map(|library| library.children_named("controller")) {
        if let (Some(id), Some(skin)) = (controller.attribute("id"), controller.child("skin")) {
            walk.skins.insert(id, reference(skin, "source")?);
        }
    }
    let wanted = root.child("scene").and_then(|scene| scene.child("instance_visual_scene"));
    let wanted = wanted.map(|instance| reference(instance, "url")).transpose()?;
    let mut scenes = library("library_visual_scenes").flat_map(|library| library.children_named("visual_scene"));
    let scene = match wanted {
        Some(id) => scenes.find(|scene| scene.attribute("id") == Some(id)),
        None => scenes.next(),
    };
    for node in scene.into_iter().flat_map(|scene| scene.children_named("node")) {
        walk.visit(node, &Matrix4::identity(), 0)?;
    }
    Ok(walk.found)
}

impl<'a> Walk<'a> {
    fn visit(&mut self, node: &'a Element, parent: &Matrix4<f64>, depth: usize) -> Result<(), MeshError> {
        self.visits += 1;
        if depth > MAX_NODE_DEPTH {
            return Err(syntax(node, "nodes refer to each other too deep, or in a circle"));
        }
        if self.visits > MAX_VISITS {
            return Err(MeshError::TooMany { what: "nodes", max: MAX_VISITS });
        }
        let mut placed = *parent;
        for child in &node.children {
            if let Some(motion) = motion(child)? {
                placed *= motion;
            }
        }
        for child in &node.children {
            let geometry = match child.name.as_str() {
                "node" => {
                    self.visit(child, &placed, depth + 1)?;
                    continue;
                }
                "instance_node" => {
                    // A node of another file or none at all: nothing to place.
                    if let Some(&other) = self.nodes.get(reference(child, "url")?) {
                        self.visit(other, &placed, depth + 1)?;
                    }
                    continue;
                }
                "instance_geometry" => reference(child, "url")?,
                "instance_controller" => match self.skins.get(reference(child, "url")?) {
                    Some(geometry) => geometry,
                    None => continue,
                },
                _ => continue,
            };
            if self.found.len() == MAX_INSTANCES {
                return Err(MeshError::TooMany { what: "instances", max: MAX_INSTANCES });
            }
            self.found.push(Instance { geometry, placed });
        }
        Ok(())
    }
}

/// The matrix of a transformation element; `None` for other elements.
fn motion(element: &Element) -> Result<Option<Matrix4<f64>>, MeshError> {
    let count = match element.name.as_str() {
        "matrix" => 16,
        "translate" | "scale" => 3,
        "rotate" => 4,
        "lookat" | "skew" => return Err(syntax(element, "this transformation is not supported")),
        _ => return Ok(None),
    };
    let mut values = [0.0; 16];
    let mut words = element.text.split_ascii_whitespace();
    for value in &mut values[..count] {
        *value = number(words.next().unwrap_or(""), || element.place())?;
    }
    let first = Vector3::new(values[0], values[1], values[2]);
    Ok(Some(match element.name.as_str() {
        "matrix" => Matrix4::from_row_slice(&values),
        "translate" => Matrix4::new_translation(&first),
        "scale" => Matrix4::new_nonuniform_scaling(&first),
        _ => match Unit::try_new(first, 1e-12) {
            Some(axis) => about_axis(&axis, values[3].to_radians()).to_homogeneous(),
            None => Matrix4::identity(),
        },
    }))
}
