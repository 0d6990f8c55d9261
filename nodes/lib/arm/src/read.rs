//! Collision meshes on the way from a file's bytes to convex pieces, each file once.

use crate::hull::Hull;
use crate::mesh::{Mesh, MeshError, MeshFormat};
use crate::scan::shorten;
use crate::{Solid, decompose};
use std::collections::BTreeMap;
use std::sync::Arc;

/// What encloses no volume is made this thick to each side, metres.
pub(crate) const THICKNESS: f64 = 1e-4;
/// Most triangles of all meshes of one robot.
const MAX_ROBOT_TRIANGLES: usize = 5_000_000;

/// How to read a robot.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct ReadOptions {
    /// A mesh that cannot be had or read.
    pub missing: MissingMesh,
    /// What becomes of a mesh.
    pub detail: MeshDetail,
}

/// What to do without a mesh.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum MissingMesh {
    /// The robot is refused.
    #[default]
    Refuse,
    /// A box around the link's inertia and its joints stands in for it: a guess, and listed among the problems.
    Bound,
}

/// What stands for a mesh in collision checks.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub enum MeshDetail {
    /// Its convex hull: fast and never too small.
    #[default]
    Hull,
    /// Several convex pieces (V-HACD, Mamou 2016), where the hull is much larger than the mesh.
    Pieces {
        /// Voxels along the longest side: what is found is no finer.
        resolution: u32,
        /// Most pieces of one mesh.
        most: u32,
    },
}

/// A collision mesh of a link.
#[derive(Debug, Clone, PartialEq)]
pub struct MeshUse {
    /// As the description names it.
    pub file: String,
    /// Triangles of the file; 0 when a bounding shape stands in for it.
    pub n_triangles: usize,
    /// Convex pieces that stand for it.
    pub n_hulls: usize,
    /// Corners of all pieces.
    pub n_corners: usize,
    /// Volume of the mesh, cubic metres; meaningless when it is not closed.
    pub mesh_volume: f64,
    /// Volume of the pieces, cubic metres.
    pub hull_volume: f64,
    /// Whether the pieces had to be thickened.
    pub is_flat: bool,
}

/// Meshes found so far.
pub(crate) struct Meshes<'a> {
    find: &'a mut dyn FnMut(&str) -> Result<Vec<u8>, String>,
    options: &'a ReadOptions,
    /// By name.
    files: BTreeMap<String, Result<Mesh, String>>,
    /// By name and the bits of the scale.
    solids: BTreeMap<(String, [u64; 3]), (Solid, MeshUse)>,
    n_triangles: usize,
}

impl<'a> Meshes<'a> {
    pub fn new(find: &'a mut dyn FnMut(&str) -> Result<Vec<u8>, String>, options: &'a ReadOptions) -> Self {
        Self { find, options, files: BTreeMap::new(), solids: BTreeMap::new(), n_triangles: 0 }
    }

    /// The solid that stands for a mesh, or why there is none.
    pub fn solid(&mut self, file: &str, scale: [f64; 3]) -> Result<(Solid, MeshUse), String> {
        let key = (file.to_owned(), scale.map(f64::to_bits));
        if let Some(known) = self.solids.get(&key) {
            return Ok(known.clone());
        }
        let (find, n) = (&mut self.find, &mut self.n_triangles);
        let mesh = self.files.entry(file.to_owned()).or_insert_with(|| load(*find, file, n)).clone()?.scaled(scale);
        let hulls = self.hulls(&mesh).ok_or_else(|| MeshError::Empty.to_string())?;
        let found = MeshUse {
            file: file.to_owned(),
            n_triangles: mesh.triangles.len(),
            n_hulls: hulls.len(),
            n_corners: hulls.iter().map(|hull| hull.corners().len()).sum(),
            mesh_volume: mesh.volume(),
            hull_volume: hulls.iter().map(|hull| hull.volume()).sum(),
            is_flat: hulls.iter().any(|hull| hull.was_flat()),
        };
        let solid = Solid::Hulls(hulls.into_iter().map(Arc::new).collect());
        self.solids.insert(key, (solid.clone(), found.clone()));
        Ok((solid, found))
    }

    fn hulls(&self, mesh: &Mesh) -> Option<Vec<Hull>> {
        let hull = Hull::new(&mesh.used_vertices(), THICKNESS)?;
        match self.options.detail {
            MeshDetail::Pieces { resolution, most } if decompose::is_worth_it(mesh, &hull) => {
                Some(decompose::pieces(mesh, resolution, most).unwrap_or_else(|| vec![hull]))
            }
            _ => Some(vec![hull]),
        }
    }
}

impl Solid {
    /// The convex hull of a mesh, `None` when no triangle is in it.
    pub fn hull_of(mesh: &Mesh) -> Option<Self> {
        Hull::new(&mesh.used_vertices(), THICKNESS).map(|hull| Self::Hulls(vec![Arc::new(hull)]))
    }

    /// Several convex pieces of a mesh (V-HACD), its hull where that is about the mesh itself; `None` when no triangle is in
    /// it. The arguments are those of [`MeshDetail::Pieces`].
    pub fn pieces_of(mesh: &Mesh, resolution: u32, most: u32) -> Option<Self> {
        let hull = Hull::new(&mesh.used_vertices(), THICKNESS)?;
        let worth = decompose::is_worth_it(mesh, &hull);
        let pieces = if worth { decompose::pieces(mesh, resolution, most) } else { None };
        Some(Self::Hulls(pieces.unwrap_or_else(|| vec![hull]).into_iter().map(Arc::new).collect()))
    }
}

fn load(
    find: &mut dyn FnMut(&str) -> Result<Vec<u8>, String>,
    file: &str,
    n_triangles: &mut usize,
) -> Result<Mesh, String> {
    let format = MeshFormat::of(file).map_err(|error| error.to_string())?;
    let bytes = find(file).map_err(|problem| shorten_long(&problem))?;
    let mesh = Mesh::read(format, &bytes).map_err(|error| error.to_string())?;
    *n_triangles += mesh.triangles.len();
    if *n_triangles > MAX_ROBOT_TRIANGLES {
        return Err(MeshError::TooMany { what: "triangles in all its meshes", max: MAX_ROBOT_TRIANGLES }.to_string());
    }
    Ok(mesh)
}

/// A reason may name a path, which is longer than other foreign text.
fn shorten_long(text: &str) -> String {
    let words: Vec<String> =
        text.split(' ').map(|word| if word.len() <= 200 { word.to_owned() } else { shorten(word) }).collect();
    words.join(" ").chars().filter(|c| !c.is_control()).take(600).collect()
}
