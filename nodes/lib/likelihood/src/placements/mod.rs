//! The likelihood of placements under a softmax over the table (method notes section 5):
//! log P(x_d | C_d, θ) = f_d R_θ(x_d) − log mean over the free cells c of exp(f_d R_θ(c)), with θ = β w and f_d the factor of
//! demonstration d. With a rate ε of placements at random, P becomes (1 − ε) P + ε/n_free, here (1 − ε) P + ε, since P is
//! relative to a uniform placement; then the likelihood is no longer concave.

mod cells;
mod curvature;
mod demonstration;
mod kernel;

use std::ops::RangeInclusive;

use cells::Cells;
pub use cells::Placement;
pub use demonstration::{Confidence, Demonstration, EvidenceError, Lesson, MAX_DEMONSTRATIONS};
pub use kernel::Scratch;

use cells::FixedTable;
use pulp::{Arch, Simd, WithSimd};
use scene::Grid;

/// Cells per axis of a grid that a likelihood can be normalised on.
pub const GRID_SIDE_RANGE: RangeInclusive<usize> = 4..=256;

/// Log-likelihood of the placements of a lesson as a function of the weights. A concave function of w where no placement is
/// at random.
#[derive(Debug, Clone)]
pub struct PlacementLikelihood {
    n_features: usize,
    fixed: FixedTable,
    cells: Vec<Cells>,
    /// Σ f_d φ(x_d).
    shown: Vec<f64>,
    /// f_d φ(x_d), one row a placement.
    shown_each: Vec<f64>,
    /// ε.
    wrong_rate: f64,
    arch: Arch,
}

impl PlacementLikelihood {
    /// The likelihood of `placements` normalised over the points of `grid`; `n_features` counts the nine fixed centres,
    /// and every scene has the other `n_features − 9` as objects.
    ///
    /// Scenes without a free grid point give a likelihood that is not a number: refuse them first ([`Self::n_free`]).
    pub fn new(n_features: usize, placements: &[Placement<'_>], grid: &Grid) -> Self {
        let cells = placements.iter().map(|placement| Cells::new(placement, grid)).collect();
        let mut shown = vec![0.0; n_features];
        let mut shown_each = Vec::with_capacity(n_features * placements.len());
        for placement in placements {
            for (shown, feature) in shown.iter_mut().zip(placement.features()) {
                *shown += placement.factor * feature;
                shown_each.push(placement.factor * feature);
            }
        }
        let fixed = FixedTable::new(grid);
        Self { n_features, fixed, cells, shown, shown_each, wrong_rate: 0.0, arch: Arch::new() }
    }

    /// The same with a rate ε in [0, 1) of placements at random, uniform over the free cells.
    ///
    /// # Errors
    /// A rate out of range.
    pub fn with_wrong_rate(mut self, wrong_rate: f64) -> Result<Self, EvidenceError> {
        if !(0.0..1.0).contains(&wrong_rate) {
            return Err(EvidenceError::WrongRate { got: wrong_rate });
        }
        self.wrong_rate = wrong_rate;
        Ok(self)
    }

    /// Rate ε of placements at random.
    pub fn wrong_rate(&self) -> f64 {
        self.wrong_rate
    }

    /// The same likelihood normalised over cells `factor` times as wide, each counted by how much of it is free. `None`
    /// where `factor` does not divide the side of the grid, which must be one of midpoints.
    pub fn coarsened(&self, placements: &[Placement<'_>], grid: &Grid, factor: usize) -> Option<Self> {
        if !grid.side().is_multiple_of(factor) {
            return None;
        }
        let coarse = Grid::midpoints(grid.side() / factor);
        let cells = placements.iter().map(|placement| Cells::coarsened(placement, grid, &coarse)).collect();
        let (shown, shown_each) = (self.shown.clone(), self.shown_each.clone());
        Some(Self { cells, fixed: FixedTable::new(&coarse), shown, shown_each, ..*self })
    }

    /// Number of weights.
    pub fn n_features(&self) -> usize {
        self.n_features
    }

    /// Number of placements.
    pub fn n_placements(&self) -> usize {
        self.cells.len()
    }

    /// Free grid points of each scene.
    pub fn n_free(&self) -> impl Iterator<Item = usize> {
        self.cells.iter().map(|cells| cells.n_free)
    }

    /// log P(placements | w), in nats relative to a uniform placement.
    pub fn value(&self, w: &[f64]) -> f64 {
        self.value_with(w, &mut self.scratch())
    }

    /// log P(placements | w); its gradient Σ f_d (φ(x_d) − E_d φ), each d times its chance of not being at random, goes to
    /// `gradient`.
    pub fn value_and_gradient(&self, w: &[f64], gradient: &mut [f64]) -> f64 {
        self.value_and_gradient_with(w, gradient, &mut self.scratch())
    }

    /// Buffers of one thread of evaluation.
    pub fn scratch(&self) -> Scratch {
        Scratch::new(self.fixed.side(), self.n_features)
    }

    /// [`Self::value`] with buffers.
    pub fn value_with(&self, w: &[f64], scratch: &mut Scratch) -> f64 {
        self.arch.dispatch(Value { likelihood: self, w, scratch })
    }

    /// [`Self::value_and_gradient`] with buffers.
    pub fn value_and_gradient_with(&self, w: &[f64], gradient: &mut [f64], scratch: &mut Scratch) -> f64 {
        self.arch.dispatch(ValueAndGradient { likelihood: self, w, gradient, scratch })
    }

    /// Fisher information −∇² = Σ f_d² Cov_d φ, row-major and symmetric; as if no placement were at random.
    pub fn information(&self, w: &[f64], scratch: &mut Scratch) -> Vec<f64> {
        self.arch.dispatch(Information { likelihood: self, w, scratch })
    }
}

// Named operations, because a closure would not be inlined into the dispatch and miss the machine's vectors.

struct Value<'a> {
    likelihood: &'a PlacementLikelihood,
    w: &'a [f64],
    scratch: &'a mut Scratch,
}

impl WithSimd for Value<'_> {
    type Output = f64;

    #[inline(always)]
    fn with_simd<S: Simd>(self, _simd: S) -> f64 {
        kernel::value(self.likelihood, self.w, self.scratch)
    }
}

struct ValueAndGradient<'a> {
    likelihood: &'a PlacementLikelihood,
    w: &'a [f64],
    gradient: &'a mut [f64],
    scratch: &'a mut Scratch,
}

impl WithSimd for ValueAndGradient<'_> {
    type Output = f64;

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> f64 {
        kernel::value_and_gradient(simd, self.likelihood, self.w, self.gradient, self.scratch)
    }
}

struct Information<'a> {
    likelihood: &'a PlacementLikelihood,
    w: &'a [f64],
    scratch: &'a mut Scratch,
}

impl WithSimd for Information<'_> {
    type Output = Vec<f64>;

    #[inline(always)]
    fn with_simd<S: Simd>(self, _simd: S) -> Vec<f64> {
        curvature::information(self.likelihood, self.w, self.scratch)
    }
}

#[cfg(test)]
mod tests {
    use super::{Placement, PlacementLikelihood};
    use pulp::Arch;
    use scene::{Grid, Object, Point, Scene, Shape};

    fn scene() -> Scene {
        let cup = |id: &str, x: f64, y: f64| Object {
            id: id.into(),
            label: id.into(),
            shape: Shape::Cylinder { radius_m: 0.05, height_m: 0.1 },
            position_m: Point::new(x, y),
            yaw_rad: 0.0,
            supports: false,
        };
        Scene {
            id: "table".into(),
            frame: "table".into(),
            width_m: 1.0,
            depth_m: 1.0,
            objects: vec![cup("a", 0.2, 0.3), cup("b", 0.6, 0.8)],
            target: cup("target", 0.0, 0.0),
        }
    }

    fn weights() -> Vec<f64> {
        (0..11).map(|k| f64::from(k * k % 7 - 3) / 20.0).collect()
    }

    #[test]
    fn every_vector_width_gives_the_same_bits() {
        let scene = scene();
        for (beta, side) in [(100.0, 64), (3000.0, 16), (5.0, 13)] {
            let placement = Placement { scene: &scene, at: Point::new(0.4, 0.5), factor: beta, masked: true };
            let widest = PlacementLikelihood::new(11, &[placement, placement], &Grid::midpoints(side));
            let scalar = PlacementLikelihood { arch: Arch::Scalar, ..widest.clone() };
            let of = |likelihood: &PlacementLikelihood| {
                let mut gradient = vec![0.0; 11];
                let value = likelihood.value_and_gradient(&weights(), &mut gradient);
                let information = likelihood.information(&weights(), &mut likelihood.scratch());
                (value.to_bits(), likelihood.value(&weights()).to_bits(), gradient, information)
            };
            assert_eq!(of(&widest), of(&scalar));
        }
    }

    #[test]
    fn information_is_minus_the_second_derivative() {
        let scene = scene();
        let placement = Placement { scene: &scene, at: Point::new(0.4, 0.5), factor: 30.0, masked: true };
        let likelihood = PlacementLikelihood::new(11, &[placement], &Grid::midpoints(24));
        let information = likelihood.information(&weights(), &mut likelihood.scratch());
        let gradient = |k: usize, by: f64| {
            let (mut w, mut gradient) = (weights(), vec![0.0; 11]);
            w[k] += by;
            likelihood.value_and_gradient(&w, &mut gradient);
            gradient
        };
        for k in 0..11 {
            let (above, below) = (gradient(k, 1e-6), gradient(k, -1e-6));
            for i in 0..11 {
                let numeric = -(above[i] - below[i]) / 2e-6;
                let got = information[k * 11 + i];
                assert!((got - numeric).abs() < 1e-4 * (1.0 + numeric.abs()), "{k}, {i}: {got} vs {numeric}");
            }
        }
    }

    #[test]
    fn wide_cells_come_close_and_count_what_is_free() {
        let scene = scene();
        let placement = [Placement { scene: &scene, at: Point::new(0.4, 0.5), factor: 100.0, masked: true }];
        let grid = Grid::midpoints(64);
        let exact = PlacementLikelihood::new(11, &placement, &grid);
        let wide = exact.coarsened(&placement, &grid, 4).expect("4 divides 64");
        assert_eq!(wide.fixed.side(), 16);
        // A hill in the middle of the table, as in a lesson.
        let hill: Vec<f64> = (0..11).map(|k| if k == 6 { 0.8 } else { -0.02 }).collect();
        let (near, value) = (wide.value(&hill), exact.value(&hill));
        assert!((near - value).abs() < 0.02, "{near} vs {value}");
        assert!((wide.cells[0].log_n_free - libm::log(exact.cells[0].n_free as f64 / 16.0)).abs() < 1e-12);
        assert!(exact.coarsened(&placement, &grid, 3).is_none());
    }
}
