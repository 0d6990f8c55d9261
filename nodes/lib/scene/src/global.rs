//! The free placement of largest reward, with a proof: branch and bound over the table.
//!
//! A cell of the table holds no reward above the smaller of two bounds: every basis function at the point of the cell that
//! suits its weight best, and R(c) + |∇R(c)|·h + ½ M ‖h‖² from the cell's centre c and half extents h. The second is the
//! sharper one on small cells; M bounds upward curvature, which for exp(−r²/σ²) is at most 4e^{−3/2}/σ² (at r² = 3σ²/2)
//! and for −exp(−r²/σ²) at most 2/σ² (at its centre).

use crate::{Basis, Point, Rbf, Region, SIGMA_SQUARED, Scene, climb};
use std::cmp::Ordering;
use std::collections::BinaryHeap;

/// Cells along each axis that the search starts from.
const FIRST_SIDE: usize = 8;
/// 4 e^{−3/2}.
const HILL_CURVATURE: f64 = 0.892_520_640_593_719_4;
/// The search stops after this many cells; what is left unproved is in the answer.
const MOST_CELLS: usize = 200_000;

/// The best free placement, and how much better an unseen one could be.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct GlobalOptimum {
    /// Metres.
    pub at_m: Point,
    /// R there.
    pub reward: f64,
    /// No free placement has a reward above `reward + gap`.
    pub gap: f64,
}

struct Cell {
    bound: f64,
    /// Normalised centre and half extents.
    centre: Point,
    half: Point,
}

impl PartialEq for Cell {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}
impl Eq for Cell {}
impl PartialOrd for Cell {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}
impl Ord for Cell {
    /// By bound; places break ties, so that the order of the search is that of the problem alone.
    fn cmp(&self, other: &Self) -> Ordering {
        let places = || other.centre.x.total_cmp(&self.centre.x).then(other.centre.y.total_cmp(&self.centre.y));
        self.bound.total_cmp(&other.bound).then_with(places)
    }
}

struct Search<'a> {
    scene: &'a Scene,
    rbf: Rbf,
    basis: Basis,
    region: Region,
    w: &'a [f64],
    /// Bound on the second derivative of R along any direction, normalised coordinates.
    curvature: f64,
    best: Option<(Point, f64)>,
}

/// The free placement of largest reward wᵀφ, proved to within `tolerance · Σ|w|` unless the answer's gap says otherwise.
/// `None` when the search finds no free placement: then there is none but in crevices thinner than its smallest cells.
///
/// # Panics
/// When `w` has not one entry per feature of the scene.
pub fn global_placement(scene: &Scene, w: &[f64], tolerance: f64) -> Option<GlobalOptimum> {
    let rbf = Rbf::new(scene);
    assert_eq!(w.len(), rbf.n(), "one weight per feature");
    let up: f64 = w.iter().map(|&w| if w > 0.0 { HILL_CURVATURE * w } else { -2.0 * w }).sum();
    let mut search = Search {
        scene,
        rbf,
        basis: Basis::new(scene),
        region: Region::new(scene),
        w,
        curvature: up / SIGMA_SQUARED,
        best: None,
    };
    let accepted = tolerance * w.iter().map(|w| w.abs()).sum::<f64>();
    let (low, high) = (scene.normalised(search.region.low), scene.normalised(search.region.high));
    if low.x > high.x || low.y > high.y {
        return None;
    }
    let mut cells = BinaryHeap::new();
    let side = FIRST_SIDE as f64;
    let half = Point::new(0.5 * (high.x - low.x) / side, 0.5 * (high.y - low.y) / side);
    for i in 0..FIRST_SIDE * FIRST_SIDE {
        let (column, row) = ((i % FIRST_SIDE) as f64, (i / FIRST_SIDE) as f64);
        let centre = Point::new(low.x + (2.0 * column + 1.0) * half.x, low.y + (2.0 * row + 1.0) * half.y);
        search.push(&mut cells, centre, half);
    }
    let mut seen = cells.len();
    let mut unproved = f64::NEG_INFINITY;
    while let Some(cell) = cells.pop() {
        let reward = search.best.map_or(f64::NEG_INFINITY, |(_, reward)| reward);
        if cell.bound <= reward + accepted || seen >= MOST_CELLS {
            unproved = cell.bound;
            break;
        }
        let half = Point::new(0.5 * cell.half.x, 0.5 * cell.half.y);
        for (sx, sy) in [(-1.0, -1.0), (1.0, -1.0), (-1.0, 1.0), (1.0, 1.0)] {
            let centre = Point::new(cell.centre.x + sx * half.x, cell.centre.y + sy * half.y);
            search.push(&mut cells, centre, half);
        }
        seen += 4;
    }
    let (at_m, reward) = search.best?;
    Some(GlobalOptimum { at_m, reward, gap: (unproved - reward).max(0.0) })
}

impl Search<'_> {
    /// Takes a cell in, unless it is blocked as a whole or holds nothing better; a better centre is climbed from.
    fn push(&mut self, cells: &mut BinaryHeap<Cell>, centre: Point, half: Point) {
        let centre_m = self.scene.metres(centre);
        let radius_m = (half.x * self.scene.width_m).hypot(half.y * self.scene.depth_m);
        if self.region.is_blocked_around(centre_m, radius_m) {
            return;
        }
        let [value, gx, gy, ..] = self.rbf.derivatives(self.w, centre);
        let best = |search: &Self| search.best.map_or(f64::NEG_INFINITY, |(_, reward)| reward);
        if let Some((free_m, _)) = self.region.pull(centre_m) {
            let reward = self.rbf.reward(self.w, self.scene.normalised(free_m));
            if reward > best(self) {
                let top_m = climb(&self.basis, &self.region, self.w, free_m, radius_m.max(1e-6));
                let top = self.rbf.reward(self.w, self.scene.normalised(top_m));
                self.best = Some(if top >= reward { (top_m, top) } else { (free_m, reward) });
            }
        }
        let of_centre =
            value + gx.abs() * half.x + gy.abs() * half.y + 0.5 * self.curvature * (half.x * half.x + half.y * half.y);
        let bound = of_centre.min(self.bound_of_terms(centre, half));
        if bound > best(self) {
            cells.push(Cell { bound, centre, half });
        }
    }

    /// Σ_k w_k φ_k at the nearest point of the cell where w_k is positive, at the farthest where it is not.
    fn bound_of_terms(&self, centre: Point, half: Point) -> f64 {
        let terms = self.rbf.centres.iter().zip(self.w).map(|(c, &w)| {
            let (dx, dy) = ((c.x - centre.x).abs(), (c.y - centre.y).abs());
            let (dx, dy) =
                if w > 0.0 { ((dx - half.x).max(0.0), (dy - half.y).max(0.0)) } else { (dx + half.x, dy + half.y) };
            w * crate::exp(-(dx * dx + dy * dy) / SIGMA_SQUARED)
        });
        terms.sum()
    }
}
