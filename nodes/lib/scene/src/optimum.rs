//! Where a reward puts the target: the best free grid point, then the top of its hill within the free region.

use crate::{Basis, Field, Point, Rbf, Region, Scene, climb};

/// The best placement under one reward.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Optimum {
    /// Normalised coordinates.
    pub at: Point,
    /// R there.
    pub reward: f64,
}

/// The free placement of largest reward: argmax over the field's free grid points (first of equals), then [`climb`] to the
/// top of that hill, along the edges of the table and the outlines of objects where they cut it. `None` when no grid point
/// is free. The field must be the scene's own.
///
/// `scratch` is resized to the grid and overwritten.
pub fn best_placement(scene: &Scene, rbf: &Rbf, field: &Field, w: &[f64], scratch: &mut Vec<f64>) -> Option<Optimum> {
    scratch.resize(field.grid().n(), 0.0);
    field.rewards(w, scratch);
    let mut best: Option<(usize, f64)> = None;
    for (i, (&reward, &free)) in scratch.iter().zip(field.free()).enumerate() {
        if free && best.is_none_or(|(_, top)| reward > top) {
            best = Some((i, reward));
        }
    }
    let start_m = scene.metres(field.grid().at(best?.0));
    let reach_m = scene.width_m.max(scene.depth_m) / field.side() as f64;
    let at = scene.normalised(climb(&Basis::new(scene), &Region::new(scene), w, start_m, reach_m));
    Some(Optimum { at, reward: rbf.reward(w, at) })
}
