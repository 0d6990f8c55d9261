//! COLLADA: the triangles of every geometry, placed by the scene's nodes and scaled to metres.

use super::dae_scene::{self, Instance};
use super::xml::{self, Element};
use super::{MAX_VERTICES, Mesh, MeshError, fan, number};
use crate::scan::shorten;
use nalgebra::{Matrix4, Point3, Vector3};
use std::collections::BTreeMap;

/// Most entries of one list of indices or coordinates.
const MAX_ENTRIES: usize = 32_000_000;

pub(super) fn read(bytes: &[u8]) -> Result<Mesh, MeshError> {
    let text = String::from_utf8_lossy(bytes);
    let root = xml::parse(text.trim_start_matches('\u{feff}'))?;
    if root.name != "COLLADA" {
        return Err(syntax(&root, "the outermost element should be <COLLADA>"));
    }
    let unit = unit(&root)?;
    let geometries: BTreeMap<&str, &Element> = root
        .children_named("library_geometries")
        .flat_map(|library| library.children_named("geometry"))
        .filter_map(|geometry| geometry.attribute("id").map(|id| (id, geometry)))
        .collect();
    let mut instances = dae_scene::instances(&root)?;
    if instances.is_empty() {
        // Without a scene the geometries stand as they are.
        instances = geometries.keys().map(|&geometry| Instance { geometry, placed: Matrix4::identity() }).collect();
    }
    let mut loaded: BTreeMap<&str, Mesh> = BTreeMap::new();
    let mut mesh = Mesh { vertices: Vec::new(), triangles: Vec::new() };
    for Instance { geometry: id, placed } in instances {
        let Some(geometry) = geometries.get(id) else {
            let problem = format!("an instance of the geometry '{}', which is not there", shorten(id));
            return Err(MeshError::Syntax { place: "the scene".into(), problem });
        };
        let part = match loaded.entry(id) {
            std::collections::btree_map::Entry::Occupied(part) => part.into_mut(),
            std::collections::btree_map::Entry::Vacant(room) => room.insert(read_geometry(geometry)?),
        };
        add(&mut mesh, part, &(placed * unit))?;
    }
    Ok(mesh)
}

/// Metres per unit.
fn unit(root: &Element) -> Result<f64, MeshError> {
    let written = root.child("asset").and_then(|asset| asset.child("unit")).and_then(|unit| unit.attribute("meter"));
    let meter = written.map_or(Ok(1.0), |word| number(word.trim(), || "<unit meter>".into()))?;
    if meter < 1e-9 {
        return Err(MeshError::Number { place: "<unit meter>".into(), got: meter.to_string() });
    }
    Ok(meter)
}

/// Adds a part, moved by the upper three rows of a matrix.
fn add(mesh: &mut Mesh, part: &Mesh, placed: &Matrix4<f64>) -> Result<(), MeshError> {
    if mesh.vertices.len() + part.vertices.len() > MAX_VERTICES {
        return Err(MeshError::TooMany { what: "vertices", max: MAX_VERTICES });
    }
    if mesh.triangles.len() + part.triangles.len() > super::MAX_TRIANGLES {
        return Err(MeshError::TooMany { what: "triangles", max: super::MAX_TRIANGLES });
    }
    let first = mesh.vertices.len() as u32;
    for vertex in &part.vertices {
        let moved = (placed.fixed_view::<3, 4>(0, 0) * Point3::from(*vertex).to_homogeneous()).into_owned();
        if let Some(got) = moved.iter().find(|v| v.is_nan() || v.abs() > super::MAX_COORDINATE) {
            return Err(MeshError::Number { place: "a vertex placed by the scene".into(), got: got.to_string() });
        }
        mesh.vertices.push(moved);
    }
    mesh.triangles.extend(part.triangles.iter().map(|triangle| triangle.map(|i| first + i)));
    Ok(())
}

fn read_geometry(geometry: &Element) -> Result<Mesh, MeshError> {
    let mut mesh = Mesh { vertices: Vec::new(), triangles: Vec::new() };
    let Some(body) = geometry.child("mesh") else { return Ok(mesh) };
    // Primitives name a <vertices>, which names the source of its positions.
    let Some(vertices) = body.child("vertices") else { return Ok(mesh) };
    let position = vertices.children_named("input").find(|input| input.attribute("semantic") == Some("POSITION"));
    let position = position.ok_or_else(|| syntax(vertices, "without an input of positions"))?;
    let source = reference(position, "source")?;
    let source = body.children_named("source").find(|candidate| candidate.attribute("id") == Some(source));
    mesh.vertices = positions(source.ok_or_else(|| syntax(vertices, "its source of positions is not there"))?)?;
    for primitive in &body.children {
        match primitive.name.as_str() {
            "triangles" | "polylist" | "polygons" | "tristrips" | "trifans" => {
                read_primitive(primitive, mesh.vertices.len(), &mut mesh.triangles)?;
            }
            _ => {}
        }
    }
    Ok(mesh)
}

fn positions(source: &Element) -> Result<Vec<Vector3<f64>>, MeshError> {
    let array = source.child("float_array").ok_or_else(|| syntax(source, "without a <float_array>"))?;
    let accessor = source.child("technique_common").and_then(|technique| technique.child("accessor"));
    let count = |name: &str, default: usize| match accessor.and_then(|accessor| accessor.attribute(name)) {
        Some(word) => word.trim().parse().map_err(|_| syntax(source, "its accessor has no whole number there")),
        None => Ok(default),
    };
    let (offset, stride): (usize, usize) = (count("offset", 0)?, count("stride", 3)?);
    if stride < 3 || offset > MAX_ENTRIES || stride > MAX_ENTRIES {
        return Err(syntax(source, "positions of fewer than three numbers"));
    }
    let mut numbers = Vec::new();
    for word in array.text.split_ascii_whitespace() {
        if numbers.len() == 3 * MAX_VERTICES {
            return Err(MeshError::TooMany { what: "vertices", max: MAX_VERTICES });
        }
        numbers.push(number(word, || array.place())?);
    }
    let from = numbers.get(offset..).unwrap_or_default();
    Ok(from.chunks(stride).filter(|v| v.len() >= 3).map(|v| Vector3::new(v[0], v[1], v[2])).collect())
}

/// Adds the triangles of one primitive over `n` vertices.
fn read_primitive(primitive: &Element, n: usize, triangles: &mut Vec<[u32; 3]>) -> Result<(), MeshError> {
    let mut stride = 1;
    let mut offset = None;
    for input in primitive.children_named("input") {
        let word = input.attribute("offset").unwrap_or("0").trim();
        let at: usize = word.parse().map_err(|_| syntax(primitive, "an input whose offset is no whole number"))?;
        if at > 64 {
            return Err(syntax(primitive, "an input's offset beyond 64"));
        }
        stride = stride.max(at + 1);
        if input.attribute("semantic") == Some("VERTEX") {
            offset = Some(at);
        }
    }
    let offset = offset.ok_or_else(|| syntax(primitive, "without an input of vertices"))?;
    for list in primitive.children_named("p").chain(primitive.children_named("ph").filter_map(|ph| ph.child("p"))) {
        let corners = corners(list, primitive, (stride, offset), n)?;
        match primitive.name.as_str() {
            "triangles" => corners.chunks_exact(3).try_for_each(|triangle| fan(triangle, triangles))?,
            "tristrips" => corners.windows(3).try_for_each(|triangle| fan(triangle, triangles))?,
            "polylist" => {
                let mut rest = &corners[..];
                let counts = primitive.child("vcount").map_or("", |counts| counts.text.as_str());
                for word in counts.split_ascii_whitespace() {
                    let count: usize =
                        word.parse().map_err(|_| syntax(primitive, "a count that is no whole number"))?;
                    let Some((polygon, after)) = rest.split_at_checked(count) else {
                        return Err(syntax(primitive, "cut off: fewer corners than its counts ask for"));
                    };
                    fan(polygon, triangles)?;
                    rest = after;
                }
            }
            _ => fan(&corners, triangles)?,
        }
    }
    Ok(())
}

/// The vertices that a list of interleaved indices names.
fn corners(
    list: &Element,
    primitive: &Element,
    (stride, offset): (usize, usize),
    n: usize,
) -> Result<Vec<u32>, MeshError> {
    let mut corners = Vec::new();
    for (i, word) in list.text.split_ascii_whitespace().enumerate() {
        if i == MAX_ENTRIES {
            return Err(MeshError::TooMany { what: "entries of one list", max: MAX_ENTRIES });
        }
        if i % stride != offset {
            continue;
        }
        let got: i64 = word.parse().map_err(|_| syntax(primitive, "an index that is no whole number"))?;
        match u32::try_from(got) {
            Ok(index) if (index as usize) < n => corners.push(index),
            _ => return Err(MeshError::Index { place: primitive.place(), got, n }),
        }
    }
    Ok(corners)
}

/// The id that `#id` in an attribute names.
pub(super) fn reference<'a>(element: &'a Element, attribute: &str) -> Result<&'a str, MeshError> {
    let value = element.attribute(attribute).unwrap_or("");
    value.strip_prefix('#').ok_or_else(|| syntax(element, &format!("its '{attribute}' names nothing in this file")))
}

pub(super) fn syntax(element: &Element, problem: &str) -> MeshError {
    MeshError::Syntax { place: element.place(), problem: problem.into() }
}
