//! Rewards over a grid of the table. A Gaussian basis function is a product of one factor per axis, so the grid costs
//! one multiply-add a cell and feature, and only two short tables per feature.

use crate::{Point, Rbf, SIGMA_SQUARED, Scene, exp};

/// Sample points of the unit square, `side` × `side`, row-major: y outer, the first row has the smallest y.
#[derive(Debug, Clone, PartialEq)]
pub struct Grid {
    axis: Vec<f64>,
}

impl Grid {
    /// Midpoints of `side` × `side` equal cells. `side` must be at least 1.
    pub fn midpoints(side: usize) -> Self {
        Self { axis: (0..side).map(|i| (i as f64 + 0.5) / side as f64).collect() }
    }

    /// Points from edge to edge, as numpy's `linspace(0, 1, side)`. `side` must be at least 2.
    pub fn linspace(side: usize) -> Self {
        Self { axis: (0..side).map(|i| i as f64 / (side - 1) as f64).collect() }
    }

    /// Coordinates along x (and along y: the grid is square).
    pub fn axis(&self) -> &[f64] {
        &self.axis
    }

    /// Points per axis.
    pub fn side(&self) -> usize {
        self.axis.len()
    }

    /// Points in all.
    pub fn n(&self) -> usize {
        self.axis.len() * self.axis.len()
    }

    /// The point with a row-major index below [`Grid::n`].
    pub fn at(&self, index: usize) -> Point {
        Point::new(self.axis[index % self.side()], self.axis[index / self.side()])
    }
}

/// The basis of a scene tabulated on a grid, and which grid points the target may take.
#[derive(Debug, Clone, PartialEq)]
pub struct Field {
    grid: Grid,
    /// `gx[k * side + i]`, the factor of feature k along x.
    gx: Vec<f64>,
    gy: Vec<f64>,
    free: Vec<bool>,
    n_free: usize,
}

impl Field {
    /// Tabulates a basis; with a scene, grid points where the target cannot be are not free.
    pub fn new(rbf: &Rbf, grid: &Grid, scene: Option<&Scene>) -> Self {
        let factor = |c: f64| grid.axis.iter().map(move |v| exp(-(v - c) * (v - c) / SIGMA_SQUARED));
        let gx = rbf.centres.iter().flat_map(|c| factor(c.x)).collect();
        let gy = rbf.centres.iter().flat_map(|c| factor(c.y)).collect();
        let free: Vec<bool> = match scene {
            None => vec![true; grid.n()],
            Some(scene) => {
                let occupied = scene.occupied();
                (0..grid.n()).map(|i| occupied.is_free(scene.metres(grid.at(i)))).collect()
            }
        };
        let n_free = free.iter().filter(|&&free| free).count();
        Self { grid: grid.clone(), gx, gy, free, n_free }
    }

    /// The grid.
    pub fn grid(&self) -> &Grid {
        &self.grid
    }

    /// Points per axis.
    pub fn side(&self) -> usize {
        self.grid.side()
    }

    /// Number of features.
    pub fn n_features(&self) -> usize {
        self.gx.len() / self.side()
    }

    /// Factors of feature `k` along x, one per column.
    pub fn gx(&self, k: usize) -> &[f64] {
        &self.gx[k * self.side()..(k + 1) * self.side()]
    }

    /// Factors of feature `k` along y, one per row.
    pub fn gy(&self, k: usize) -> &[f64] {
        &self.gy[k * self.side()..(k + 1) * self.side()]
    }

    /// Which grid points the target may take, row-major.
    pub fn free(&self) -> &[bool] {
        &self.free
    }

    /// How many grid points the target may take.
    pub fn n_free(&self) -> usize {
        self.n_free
    }

    /// R = wᵀφ at every grid point, row-major; `out` has [`Grid::n`] entries.
    pub fn rewards(&self, w: &[f64], out: &mut [f64]) {
        out.fill(0.0);
        self.add_rewards(w, 0, out);
    }

    /// Adds the rewards of the features from `first` on, with weights `w`, to every grid point.
    pub fn add_rewards(&self, w: &[f64], first: usize, out: &mut [f64]) {
        let side = self.side();
        debug_assert_eq!(out.len(), side * side);
        for (j, row) in out.chunks_exact_mut(side).enumerate() {
            for (k, w) in w.iter().enumerate() {
                let k = first + k;
                let scale = w * self.gy[k * side + j];
                for (out, gx) in row.iter_mut().zip(self.gx(k)) {
                    *out += scale * gx;
                }
            }
        }
    }
}
