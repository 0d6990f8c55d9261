//! The placement loss of every draw in every scene: how far the best placement under the draw is from the best under the
//! MAP weights.

use crate::tabulated::Tabulated;
use scene::{Point, Scene};

/// Draws of reward weights and what to compare them with.
#[derive(Debug, Clone, Copy)]
pub struct LossBatch<'a> {
    /// n × k weights, row-major, one draw a row.
    pub draws: &'a [f32],
    /// k: the objects of the scenes, then the nine fixed centres.
    pub n_features: usize,
    /// k weights.
    pub map_weights: &'a [f64],
    /// How many threads share the draws; the answer does not depend on it.
    pub threads: usize,
}

/// What the draws say about one scene.
#[derive(Debug, Clone, PartialEq)]
pub struct SceneLosses {
    /// Best placement under the MAP weights, metres.
    pub map_placement_m: Point,
    /// ‖x*_w − x*_MAP‖ of every draw in order, metres.
    pub losses_m: Vec<f64>,
}

/// The placement losses of all draws in all scenes; `None` for a scene without a free place. Scenes may differ in anything
/// but the number of objects; it is quick when each differs from most others in few objects.
///
/// Hills are told apart on a grid of 32 × 32; each placement is the top of the best one, on the boundary of the free area
/// where that cuts the hill. Two hills whose tops differ by less than the grid resolves, or than `f32` does, are a
/// near-tie, decided by the grid.
///
/// # Panics
/// When the numbers of draws, weights and objects do not fit together.
pub fn placement_losses(scenes: &[Scene], batch: &LossBatch) -> Vec<Option<SceneLosses>> {
    placement_optima(scenes, batch)
        .into_iter()
        .map(|found| {
            found.map(|(map_placement_m, optima_m)| SceneLosses {
                map_placement_m,
                losses_m: optima_m.iter().map(|x| x.distance(map_placement_m)).collect(),
            })
        })
        .collect()
}

/// As [`placement_losses`], but the placements themselves: under the MAP weights, and under every draw in order, metres.
///
/// # Panics
/// When the numbers of draws, weights and objects do not fit together.
pub fn placement_optima(scenes: &[Scene], batch: &LossBatch) -> Vec<Option<(Point, Vec<Point>)>> {
    let k = batch.n_features;
    assert!(k > 0 && batch.draws.len().is_multiple_of(k), "draws come in rows of n_features weights");
    assert_eq!(batch.map_weights.len(), k, "one MAP weight per feature");
    let n = batch.draws.len() / k;
    let tables = Tabulated::new(scenes, k);
    let n_scenes = tables.n_scenes();
    let mut of_map = vec![Point::default(); n_scenes];
    tables.optima(batch.map_weights.iter().copied(), &mut tables.scratch(), |s, top| of_map[s] = top);
    // Draw by draw, all scenes of a draw together; threads take ranges of draws.
    let mut tops = vec![Point::default(); n * n_scenes];
    if n > 0 && n_scenes > 0 {
        let share = n.div_ceil(batch.threads.clamp(1, n));
        let parts = batch.draws.chunks(share * k).zip(tops.chunks_mut(share * n_scenes));
        if batch.threads <= 1 {
            parts.for_each(|(draws, tops)| fill(&tables, draws, k, tops));
        } else {
            std::thread::scope(|scope| {
                for (draws, tops) in parts {
                    let tables = &tables;
                    scope.spawn(move || fill(tables, draws, k, tops));
                }
            });
        }
    }
    (0..n_scenes)
        .map(|s| tables.has_free(s).then(|| (of_map[s], tops.iter().skip(s).step_by(n_scenes).copied().collect())))
        .collect()
}

fn fill(tables: &Tabulated, draws: &[f32], k: usize, tops: &mut [Point]) {
    let mut scratch = tables.scratch();
    for (w, tops) in draws.chunks_exact(k).zip(tops.chunks_exact_mut(tables.n_scenes())) {
        tables.optima(w.iter().map(|&w| f64::from(w)), &mut scratch, |s, top| tops[s] = top);
    }
}
