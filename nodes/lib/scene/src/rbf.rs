//! The reward of a placement: a weighted sum of Gaussian radial basis functions (dissertation eq. 8.3 and 8.4).

use crate::{Point, Scene, exp};

/// σ² of every basis function, in normalised coordinates (the value of the author's program, method notes section 5).
pub const SIGMA_SQUARED: f64 = 0.3;

/// Centres that do not move with the objects: y = 1, ½, 0 outer, x = 0, ½, 1 inner.
pub const FIXED_CENTRES: [Point; 9] = [
    Point::new(0.0, 1.0),
    Point::new(0.5, 1.0),
    Point::new(1.0, 1.0),
    Point::new(0.0, 0.5),
    Point::new(0.5, 0.5),
    Point::new(1.0, 0.5),
    Point::new(0.0, 0.0),
    Point::new(0.5, 0.0),
    Point::new(1.0, 0.0),
];
const FIXED_NAMES: [&str; 9] = [
    "table far left",
    "table far middle",
    "table far right",
    "table middle left",
    "table centre",
    "table middle right",
    "table near left",
    "table near middle",
    "table near right",
];

/// The basis of a scene: one function per object, then the nine fixed ones. Normalised coordinates.
#[derive(Debug, Clone, PartialEq)]
pub struct Rbf {
    /// Objects in the scene's order, then [`FIXED_CENTRES`].
    pub centres: Vec<Point>,
}

impl Rbf {
    /// The basis of a scene.
    pub fn new(scene: &Scene) -> Self {
        let objects = scene.objects.iter().map(|object| scene.normalised(object.position_m));
        Self { centres: objects.chain(FIXED_CENTRES).collect() }
    }

    /// What each weight is about: object ids, then names of the fixed centres.
    pub fn names(scene: &Scene) -> Vec<String> {
        let objects = scene.objects.iter().map(|object| object.id.clone());
        objects.chain(FIXED_NAMES.map(String::from)).collect()
    }

    /// Number of features.
    pub fn n(&self) -> usize {
        self.centres.len()
    }

    /// φ(x): exp(−‖x − c‖²/σ²) for every centre.
    pub fn features(&self, at: Point) -> Vec<f64> {
        self.centres.iter().map(|&centre| basis(at, centre)).collect()
    }

    /// R(x) = wᵀφ(x), eq. 8.3.
    pub fn reward(&self, w: &[f64], at: Point) -> f64 {
        debug_assert_eq!(w.len(), self.n());
        self.centres.iter().zip(w).map(|(&centre, w)| w * basis(at, centre)).sum()
    }

    /// ∇R(x), eq. 8.4.
    pub fn gradient(&self, w: &[f64], at: Point) -> [f64; 2] {
        let [_, gx, gy, ..] = self.derivatives(w, at);
        [gx, gy]
    }

    /// R, ∂R/∂x, ∂R/∂y, ∂²R/∂x², ∂²R/∂x∂y, ∂²R/∂y² at a point.
    pub fn derivatives(&self, w: &[f64], at: Point) -> [f64; 6] {
        let scale = 2.0 / SIGMA_SQUARED;
        let mut d = [0.0; 6];
        for (centre, w) in self.centres.iter().zip(w) {
            let value = w * basis(at, *centre);
            let (dx, dy) = (at.x - centre.x, at.y - centre.y);
            d[0] += value;
            d[1] -= value * scale * dx;
            d[2] -= value * scale * dy;
            d[3] += value * scale * (scale * dx * dx - 1.0);
            d[4] += value * scale * scale * dx * dy;
            d[5] += value * scale * (scale * dy * dy - 1.0);
        }
        d
    }
}

#[inline]
fn basis(at: Point, centre: Point) -> f64 {
    let (dx, dy) = (at.x - centre.x, at.y - centre.y);
    exp(-(dx * dx + dy * dy) / SIGMA_SQUARED)
}
