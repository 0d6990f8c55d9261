//! How far a placement is from where the person would have put the target; for benchmarks, never published.

use crate::{GRID_SIDE, Person};
use scene::{Field, Grid, Point, Rbf, Scene, best_placement};

/// Distance in metres between a placement and the person's best one; `None` when the target fits nowhere.
pub fn true_error_m(person: &Person, scene: &Scene, placement_m: Point) -> Option<f64> {
    let rbf = Rbf::new(scene);
    let field = Field::new(&rbf, &Grid::midpoints(GRID_SIDE), Some(scene));
    let best = best_placement(scene, &rbf, &field, &person.weights(scene), &mut Vec::new())?;
    Some(scene.metres(best.at).distance(placement_m))
}
