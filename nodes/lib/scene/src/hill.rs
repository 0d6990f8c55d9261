//! The reward of one weight vector in one scene, with its derivatives, quickly: the nine fixed centres share three factors
//! along each axis.

use crate::{FIXED_CENTRES, MAX_OBJECTS, Point, Rbf, SIGMA_SQUARED, Scene, exp};

const N_FIXED: usize = FIXED_CENTRES.len();
const MAX_FEATURES: usize = MAX_OBJECTS + N_FIXED;
/// Coordinates of the fixed centres along each axis, in the order they first appear in [`FIXED_CENTRES`].
const FIXED_X: [f64; 3] = [FIXED_CENTRES[0].x, FIXED_CENTRES[1].x, FIXED_CENTRES[2].x];
const FIXED_Y: [f64; 3] = [FIXED_CENTRES[0].y, FIXED_CENTRES[3].y, FIXED_CENTRES[6].y];

/// R, ∂R/∂x, ∂R/∂y, ∂²R/∂x², ∂²R/∂x∂y, ∂²R/∂y² with lengths in metres.
pub(crate) type Derivatives = [f64; 6];

/// The part of a reward that is the same for every weight vector.
#[derive(Debug, Clone)]
pub struct Basis {
    /// Centres of the objects, normalised.
    objects: Vec<Point>,
    width_m: f64,
    depth_m: f64,
}

impl Basis {
    /// The basis of a scene.
    pub fn new(scene: &Scene) -> Self {
        let mut objects = Rbf::new(scene).centres;
        objects.truncate(objects.len() - N_FIXED);
        Self { objects, width_m: scene.width_m, depth_m: scene.depth_m }
    }

    /// Derivatives of wᵀφ at a point in metres. `w` has one entry per object, then nine.
    pub fn derivatives(&self, w: &[f64], at_m: Point) -> Derivatives {
        let n = self.objects.len();
        let (x, y) = (at_m.x / self.width_m, at_m.y / self.depth_m);
        // Exponents first, so that the exponentials are one loop the compiler can vectorise.
        let mut e = [0.0_f64; MAX_FEATURES];
        for (e, c) in e.iter_mut().zip(&self.objects) {
            *e = -((x - c.x) * (x - c.x) + (y - c.y) * (y - c.y)) / SIGMA_SQUARED;
        }
        for i in 0..3 {
            e[n + i] = -(x - FIXED_X[i]) * (x - FIXED_X[i]) / SIGMA_SQUARED;
            e[n + 3 + i] = -(y - FIXED_Y[i]) * (y - FIXED_Y[i]) / SIGMA_SQUARED;
        }
        for e in &mut e[..n + 6] {
            *e = exp(*e);
        }
        let mut d = [0.0; 6];
        for ((c, w), e) in self.objects.iter().zip(w).zip(&e) {
            add(&mut d, w * e, x - c.x, y - c.y);
        }
        for j in 0..3 {
            for i in 0..3 {
                let value = w[n + 3 * j + i] * e[n + i] * e[n + 3 + j];
                add(&mut d, value, x - FIXED_X[i], y - FIXED_Y[j]);
            }
        }
        // d holds sums of value·{1, dx, dy, dx², dx dy, dy²}.
        let s = 2.0 / SIGMA_SQUARED;
        let (kx, ky) = (1.0 / self.width_m, 1.0 / self.depth_m);
        [
            d[0],
            -s * d[1] * kx,
            -s * d[2] * ky,
            s * (s * d[3] - d[0]) * kx * kx,
            s * s * d[4] * kx * ky,
            s * (s * d[5] - d[0]) * ky * ky,
        ]
    }
}

#[inline(always)]
fn add(d: &mut [f64; 6], value: f64, dx: f64, dy: f64) {
    d[0] += value;
    d[1] += value * dx;
    d[2] += value * dy;
    d[3] += value * dx * dx;
    d[4] += value * dx * dy;
    d[5] += value * dy * dy;
}
