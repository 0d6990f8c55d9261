//! Tables of one scene on the grid, laid out for the inner loops: rows padded to whole vectors of eight.

use scene::{FIXED_CENTRES, Field, Grid, Point, Rbf, Scene};

/// Loops run over vectors of this many numbers, whatever the machine's width, so that sums have the same bits everywhere.
pub(super) const LANES: usize = 8;
pub(super) type Lanes = [f64; LANES];
/// Fixed centres per axis: they form a grid of their own.
pub(super) const FIXED_SIDE: usize = 3;
/// Log weight of cells the target cannot take: far below anything, yet finite.
const OCCUPIED: f64 = -1e30;

/// One placement, and how much it counts.
#[derive(Debug, Clone, Copy)]
pub struct Placement<'a> {
    /// What stood on the table.
    pub scene: &'a Scene,
    /// Where the target was put; normalised coordinates.
    pub at: Point,
    /// Factor on θ by the confidence of the person; times β where weights rather than θ are given.
    pub factor: f64,
    /// Whether occupied grid points are left out of the normaliser.
    pub masked: bool,
}

impl Placement<'_> {
    /// φ(x_d).
    pub(super) fn features(&self) -> Vec<f64> {
        Rbf::new(self.scene).features(self.at)
    }
}

/// A scene on the grid.
#[derive(Debug, Clone)]
pub(super) struct Cells {
    pub(super) factor: f64,
    pub(super) n_objects: usize,
    /// Vectors per row of the grid.
    pub(super) row_length: usize,
    /// Factor of object k along x: `gx[chunk * n_objects + k]`.
    pub(super) gx: Vec<Lanes>,
    /// Factor of object k along y: `gy[k * side + row]`.
    pub(super) gy: Vec<f64>,
    /// Log of the share of a cell that is free: `log_weight[row * chunks + chunk]`.
    pub(super) log_weight: Vec<Lanes>,
    /// Log of the number of free cells, shares counted.
    pub(super) log_n_free: f64,
    pub(super) n_free: usize,
}

impl Cells {
    pub(super) fn new(placement: &Placement<'_>, grid: &Grid) -> Self {
        let field = Field::new(&Rbf::new(placement.scene), grid, placement.masked.then_some(placement.scene));
        let weights: Vec<f64> = field.free().iter().map(|&free| f64::from(u8::from(free))).collect();
        Self::with_weights(placement.factor, &field, &weights)
    }

    pub(super) fn coarsened(placement: &Placement<'_>, fine: &Grid, coarse: &Grid) -> Self {
        let rbf = Rbf::new(placement.scene);
        let free = Field::new(&rbf, fine, placement.masked.then_some(placement.scene));
        let factor = fine.side() / coarse.side();
        let mut weights = vec![0.0; coarse.n()];
        for (index, _) in free.free().iter().enumerate().filter(|(_, free)| **free) {
            let (row, column) = (index / fine.side() / factor, index % fine.side() / factor);
            weights[row * coarse.side() + column] += 1.0 / (factor * factor) as f64;
        }
        Self::with_weights(placement.factor, &Field::new(&rbf, coarse, None), &weights)
    }

    fn with_weights(factor: f64, field: &Field, weights: &[f64]) -> Self {
        let side = field.side();
        let n_objects = field.n_features() - FIXED_CENTRES.len();
        let gx =
            (0..chunks(side)).flat_map(|chunk| (0..n_objects).map(move |k| padded(field.gx(k), chunk, 0.0))).collect();
        let gy = (0..n_objects).flat_map(|k| field.gy(k)).copied().collect();
        let log = |weight: &f64| if *weight > 0.0 { libm::log(*weight) } else { OCCUPIED };
        let log_weights: Vec<f64> = weights.iter().map(log).collect();
        let log_weight = log_weights
            .chunks_exact(side)
            .flat_map(|row| (0..chunks(side)).map(move |chunk| padded(row, chunk, OCCUPIED)))
            .collect();
        Self {
            factor,
            n_objects,
            row_length: chunks(side),
            gx,
            gy,
            log_weight,
            log_n_free: libm::log(weights.iter().sum()),
            n_free: weights.iter().filter(|&&weight| weight > 0.0).count(),
        }
    }
}

/// The nine fixed centres on the grid: products of three factors per axis, the same for every scene.
#[derive(Debug, Clone)]
pub(super) struct FixedTable {
    /// `gx[chunk * 3 + a]`.
    pub(super) gx: Vec<Lanes>,
    /// `gy[b * side + row]`.
    pub(super) gy: Vec<f64>,
}

impl FixedTable {
    pub(super) fn new(grid: &Grid) -> Self {
        // Centre 3b + a is (x_a, y_b).
        let field = Field::new(&Rbf { centres: FIXED_CENTRES.to_vec() }, grid, None);
        let columns = |chunk| (0..FIXED_SIDE).map(move |a| (a, chunk));
        let gx = (0..chunks(grid.side())).flat_map(columns).map(|(a, chunk)| padded(field.gx(a), chunk, 0.0)).collect();
        let gy = (0..FIXED_SIDE).flat_map(|b| field.gy(FIXED_SIDE * b)).copied().collect();
        Self { gx, gy }
    }

    pub(super) fn side(&self) -> usize {
        self.gy.len() / FIXED_SIDE
    }
}

/// Vectors per row.
pub(super) fn chunks(side: usize) -> usize {
    side.div_ceil(LANES)
}

fn padded(row: &[f64], chunk: usize, padding: f64) -> Lanes {
    std::array::from_fn(|lane| row.get(chunk * LANES + lane).copied().unwrap_or(padding))
}

#[cfg(test)]
mod tests {
    use super::FIXED_SIDE;
    use scene::FIXED_CENTRES;

    #[test]
    fn fixed_centres_form_a_grid() {
        for (index, centre) in FIXED_CENTRES.iter().enumerate() {
            assert_eq!(centre.x, FIXED_CENTRES[index % FIXED_SIDE].x);
            assert_eq!(centre.y, FIXED_CENTRES[index / FIXED_SIDE * FIXED_SIDE].y);
        }
    }
}
