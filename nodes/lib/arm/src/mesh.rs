//! Triangles of a mesh file, read from bytes that may be anything.
//!
//! The readers are our own: the collision check needs positions and triangles only, and the crates that read these formats
//! allocate what a file declares, index without a check, or never return on some files (mesh-loader 0.1.13, COLLADA).

mod dae;
mod dae_scene;
mod obj;
mod stl;
mod xml;

use crate::scan::shorten;
use nalgebra::Vector3;
use thiserror::Error;

/// Largest mesh file read, bytes.
pub const MAX_MESH_BYTES: usize = 64_000_000;
/// Most vertices of a mesh.
pub const MAX_VERTICES: usize = 3_000_000;
/// Most triangles of a mesh.
pub const MAX_TRIANGLES: usize = 1_000_000;
/// Coordinates beyond this are refused, metres (before the scale of the URDF).
pub(crate) const MAX_COORDINATE: f64 = 1e6;

/// Triangles over vertices. Every index is in range and every coordinate finite.
#[derive(Debug, Clone, PartialEq)]
pub struct Mesh {
    /// Positions; metres once scaled.
    pub vertices: Vec<Vector3<f64>>,
    /// Three indices into `vertices` each; at least one.
    pub triangles: Vec<[u32; 3]>,
}

/// How a mesh is written.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum MeshFormat {
    /// STL, text or binary.
    Stl,
    /// COLLADA.
    Dae,
    /// Wavefront.
    Obj,
}

/// Why bytes are no mesh.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum MeshError {
    /// The name says none of the formats.
    #[error("'{name}' is no .stl, .dae or .obj file")]
    Format {
        /// The end of the name.
        name: String,
    },
    /// Refused before parsing.
    #[error("{got} bytes; at most {MAX_MESH_BYTES} are read")]
    TooLarge {
        /// Got.
        got: usize,
    },
    /// Refused before allocating.
    #[error("more than {max} {what}; a collision mesh needs a few hundred triangles: simplify it")]
    TooMany {
        /// "vertices", "triangles", "elements" or "instances".
        what: &'static str,
        /// Allowed.
        max: usize,
    },
    /// A binary STL that is shorter than it says.
    #[error("cut off: it declares {declared} triangles and holds {held}")]
    CutOff {
        /// By its header.
        declared: usize,
        /// That fit into the bytes.
        held: usize,
    },
    /// A number that is none, not finite or too large.
    #[error("{place}: '{got}' is no finite number of at most {MAX_COORDINATE}")]
    Number {
        /// "line 12" or the name of an element.
        place: String,
        /// Found.
        got: String,
    },
    /// A triangle uses a vertex that is not there.
    #[error("{place}: index {got}, but there are {n} vertices before it")]
    Index {
        /// "line 12" or the name of an element.
        place: String,
        /// Found, as written.
        got: i64,
        /// Vertices.
        n: usize,
    },
    /// Not what the format asks for.
    #[error("{place}: {problem}")]
    Syntax {
        /// "line 12" or the name of an element.
        place: String,
        /// What is wrong.
        problem: String,
    },
    /// Nothing in it.
    #[error("it holds no triangle")]
    Empty,
}

impl MeshFormat {
    /// By the end of a file name, upper or lower case.
    ///
    /// # Errors
    /// Another ending, or none.
    pub fn of(name: &str) -> Result<Self, MeshError> {
        let tail = name.rsplit(['/', '\\']).next().unwrap_or(name);
        let ending = tail.rsplit_once('.').map(|(_, ending)| ending.to_ascii_lowercase());
        match ending.as_deref() {
            Some("stl" | "stlb") => Ok(Self::Stl),
            Some("dae") => Ok(Self::Dae),
            Some("obj") => Ok(Self::Obj),
            _ => Err(MeshError::Format { name: shorten(tail) }),
        }
    }
}

impl Mesh {
    /// Reads a mesh. The unit of a COLLADA file is applied, its up axis is not: URDF takes the coordinates as they are
    /// written, as RViz and Coal do.
    ///
    /// # Errors
    /// Bytes that are no such mesh, or a larger one than is read.
    pub fn read(format: MeshFormat, bytes: &[u8]) -> Result<Self, MeshError> {
        if bytes.len() > MAX_MESH_BYTES {
            return Err(MeshError::TooLarge { got: bytes.len() });
        }
        let mesh = match format {
            MeshFormat::Stl => stl::read(bytes)?,
            MeshFormat::Dae => dae::read(bytes)?,
            MeshFormat::Obj => obj::read(bytes)?,
        };
        if mesh.triangles.is_empty() {
            return Err(MeshError::Empty);
        }
        Ok(mesh)
    }

    /// Stretches it along the axes.
    pub fn scaled(mut self, scale: [f64; 3]) -> Self {
        for vertex in &mut self.vertices {
            vertex.component_mul_assign(&Vector3::from(scale));
        }
        self
    }

    /// The vertices that a triangle uses.
    pub fn used_vertices(&self) -> Vec<Vector3<f64>> {
        let mut used = vec![false; self.vertices.len()];
        self.triangles.iter().flatten().for_each(|&i| used[i as usize] = true);
        self.vertices.iter().zip(used).filter_map(|(vertex, used)| used.then_some(*vertex)).collect()
    }

    /// Volume inside, cubic metres, by the divergence theorem; meaningless when the surface is not closed.
    pub fn volume(&self) -> f64 {
        let corner = |i: u32| self.vertices[i as usize];
        let signed: f64 = self.triangles.iter().map(|&[a, b, c]| corner(a).dot(&corner(b).cross(&corner(c)))).sum();
        signed.abs() / 6.0
    }
}

/// A finite number of reasonable size.
fn number(word: &str, place: impl Fn() -> String) -> Result<f64, MeshError> {
    match word.parse::<f64>() {
        Ok(value) if value.is_finite() && value.abs() <= MAX_COORDINATE => Ok(value),
        _ => Err(MeshError::Number { place: place(), got: shorten(word) }),
    }
}

/// Adds a triangle fan over the corners of a polygon.
fn fan(polygon: &[u32], triangles: &mut Vec<[u32; 3]>) -> Result<(), MeshError> {
    for pair in polygon.get(1..).unwrap_or_default().windows(2) {
        if triangles.len() == MAX_TRIANGLES {
            return Err(MeshError::TooMany { what: "triangles", max: MAX_TRIANGLES });
        }
        triangles.push([polygon[0], pair[0], pair[1]]);
    }
    Ok(())
}
