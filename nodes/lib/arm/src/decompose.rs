//! Convex pieces of a mesh that its hull describes badly.

use crate::convex::to_nalgebra;
use crate::hull::Hull;
use crate::mesh::Mesh;
use crate::read::THICKNESS;
use nalgebra::Vector3;
use parry3d_f64::math::Vector;
use parry3d_f64::transformation::vhacd::{VHACD, VHACDParameters};

/// A hull at most this much larger than its mesh stays one piece.
const CLOSE_ENOUGH: f64 = 1.15;

/// Whether the hull is so much larger than the mesh that pieces pay.
pub(crate) fn is_worth_it(mesh: &Mesh, hull: &Hull) -> bool {
    !hull.was_flat() && hull.volume() > CLOSE_ENOUGH * mesh.volume()
}

/// Pieces whose union holds the surface; `None` when none came out.
pub(crate) fn pieces(mesh: &Mesh, resolution: u32, most: u32) -> Option<Vec<Hull>> {
    let points: Vec<Vector> = mesh.vertices.iter().map(|v| Vector::new(v.x, v.y, v.z)).collect();
    let parameters = VHACDParameters {
        resolution: resolution.clamp(8, 256),
        max_convex_hulls: most.clamp(1, 256),
        ..VHACDParameters::default()
    };
    let parts = VHACD::decompose(&parameters, &points, &mesh.triangles, true);
    let hulls = parts.compute_exact_convex_hulls(&points, &mesh.triangles);
    let corners = |(corners, _): &(Vec<Vector>, Vec<[u32; 3]>)| -> Vec<Vector3<f64>> {
        corners.iter().map(|&c| to_nalgebra(c)).collect()
    };
    let hulls: Vec<Hull> = hulls.iter().filter_map(|hull| Hull::new(&corners(hull), THICKNESS)).collect();
    (!hulls.is_empty()).then_some(hulls)
}
