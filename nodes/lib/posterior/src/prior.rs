//! Priors as transforms of independent standard normals, so that a sampler sees no constraint.
//!
//! L1 sphere: x = F⁻¹_Laplace(Φ(z)) elementwise, w = x/‖x‖₁ is uniform on ‖w‖₁ = 1. L2 sphere: w = z/‖z‖₂. Gaussian: w = σ z.
//! Laplace: w = b F⁻¹_Laplace(Φ(z)). No density needs a Jacobian term: z keeps its normal prior and the likelihood is a function
//! of w(z).

use std::f64::consts::{FRAC_1_SQRT_2, PI};

use crate::Prior;

/// Scratch for one weight vector and its derivatives.
#[derive(Debug, Clone)]
pub(crate) struct Transform {
    prior: Prior,
    /// dx/dz, elementwise.
    slope: Vec<f64>,
    /// ‖x‖ on a sphere, else 1.
    norm: f64,
}

impl Transform {
    pub(crate) fn new(prior: Prior, n_features: usize) -> Self {
        Self { prior, slope: vec![1.0; n_features], norm: 1.0 }
    }

    /// w(z) into `w`; remembers the derivatives there.
    pub(crate) fn weights(&mut self, z: &[f64], w: &mut [f64]) {
        match self.prior {
            Prior::L1Sphere | Prior::Laplace { .. } => {
                for ((w, slope), &z) in w.iter_mut().zip(&mut self.slope).zip(z) {
                    (*w, *slope) = laplace_from_normal(z);
                }
            }
            Prior::L2Sphere | Prior::Gaussian { .. } => w.copy_from_slice(z),
        }
        match self.prior {
            Prior::L1Sphere | Prior::L2Sphere => {
                // All weights zero has probability zero, but a number must come out.
                self.norm = norm(self.prior, w).max(f64::MIN_POSITIVE);
                w.iter_mut().for_each(|w| *w /= self.norm);
            }
            Prior::Gaussian { scale } | Prior::Laplace { scale } => w.iter_mut().for_each(|w| *w *= scale),
        }
    }

    /// Turns ∇_w into ∇_z at the point last given to [`Transform::weights`], whose weights are `w`: Jᵀ∇.
    pub(crate) fn pull_back(&self, w: &[f64], gradient: &mut [f64]) {
        if let Prior::Gaussian { scale } | Prior::Laplace { scale } = self.prior {
            for (g, slope) in gradient.iter_mut().zip(&self.slope) {
                *g *= scale * slope;
            }
            return;
        }
        let radial: f64 = gradient.iter().zip(w).map(|(g, w)| g * w).sum();
        for ((g, w), slope) in gradient.iter_mut().zip(w).zip(&self.slope) {
            let outward = if self.prior == Prior::L2Sphere {
                *w
            } else {
                f64::from(u8::from(*w > 0.0)) - f64::from(u8::from(*w < 0.0))
            };
            *g = (*g - outward * radial) * slope / self.norm;
        }
    }
}

/// Log prior density of w up to a constant, where the prior has one on all of space; 0 on a sphere.
pub(crate) fn log_prior(prior: Prior, w: &[f64]) -> f64 {
    match prior {
        Prior::L1Sphere | Prior::L2Sphere => 0.0,
        Prior::Gaussian { scale } => -0.5 * w.iter().map(|w| w * w).sum::<f64>() / (scale * scale),
        Prior::Laplace { scale } => -w.iter().map(|w| w.abs()).sum::<f64>() / scale,
    }
}

/// ‖w‖ in the norm of the prior.
pub(crate) fn norm(prior: Prior, w: &[f64]) -> f64 {
    match prior {
        Prior::L1Sphere | Prior::Laplace { .. } => w.iter().map(|w| w.abs()).sum(),
        Prior::L2Sphere | Prior::Gaussian { .. } => libm::sqrt(w.iter().map(|w| w * w).sum()),
    }
}

/// The point of the ball ‖w‖ ≤ 1 nearest to `w` (Euclidean distance).
pub(crate) fn nearest_in_ball(prior: Prior, w: &[f64]) -> Vec<f64> {
    if norm(prior, w) <= 1.0 { w.to_vec() } else { nearest_on_sphere(prior, w) }
}

/// The point of the sphere ‖w‖ = 1 in the norm of the prior nearest to `w` (Euclidean distance); a weight of zero counts as
/// positive.
pub(crate) fn nearest_on_sphere(prior: Prior, w: &[f64]) -> Vec<f64> {
    let n = w.len() as f64;
    let norm = norm(prior, w);
    match prior {
        Prior::L2Sphere | Prior::Gaussian { .. } if norm > 0.0 => w.iter().map(|w| w / norm).collect(),
        Prior::L2Sphere | Prior::Gaussian { .. } => vec![1.0 / libm::sqrt(n); w.len()],
        Prior::L1Sphere | Prior::Laplace { .. } => {
            // |w_i| − θ where that is positive, θ such that they sum to 1; θ < 0 inside the sphere.
            let mut sizes: Vec<f64> = w.iter().map(|w| w.abs()).collect();
            sizes.sort_unstable_by(|a, b| b.total_cmp(a));
            let (mut sum, mut threshold) = (0.0, 0.0);
            for (i, size) in sizes.iter().enumerate() {
                sum += size;
                let candidate = (sum - 1.0) / (i + 1) as f64;
                if *size > candidate {
                    threshold = candidate;
                }
            }
            let shrunk = |w: &f64| f64::max(w.abs() - threshold, 0.0).copysign(if *w < 0.0 { -1.0 } else { 1.0 });
            w.iter().map(shrunk).collect()
        }
    }
}

/// x = F⁻¹_Laplace(Φ(z)) and dx/dz: x = −sign(z) ln erfc(|z|/√2), accurate near 0 and without underflow in the tails.
fn laplace_from_normal(z: f64) -> (f64, f64) {
    let t = z.abs() * FRAC_1_SQRT_2;
    let (x, scaled) = if t < 5.0 {
        let complement = libm::erfc(t);
        let x = if t < 0.5 { -libm::log1p(-libm::erf(t)) } else { -libm::log(complement) };
        (x, libm::exp(t * t) * complement)
    } else {
        let scaled = scaled_erfc(t);
        (t * t - libm::log(scaled), scaled)
    };
    (x.copysign(z), libm::sqrt(2.0 / PI) / scaled)
}

/// exp(t²) erfc(t) for t ≥ 5, by its continued fraction from the inside out.
fn scaled_erfc(t: f64) -> f64 {
    let tail = (1..=24).rev().fold(0.0, |tail, k| 0.5 * f64::from(k) / (t + tail));
    1.0 / (libm::sqrt(PI) * (t + tail))
}

#[cfg(test)]
#[allow(clippy::excessive_precision)]
mod tests {
    use super::{Transform, laplace_from_normal, nearest_in_ball, nearest_on_sphere, norm};
    use crate::Prior;
    use proptest::prelude::{prop_assert, proptest};

    #[test]
    fn laplace_values_are_exact_at_the_centre_and_in_the_tails() {
        // x = -ln erfc(z/√2), dx/dz = √(2/π) / erfcx(z/√2), in 40-digit arithmetic.
        let cases = [
            (1e-9, 7.97884561121175292e-10, 0.797884561439485128),
            (0.01, 0.0080107128844247862, 0.804261640077079224),
            (0.7, 0.72582058097158627, 1.29049933945816651),
            (2.0, 3.09003715312208664, 2.37321553282284087),
            (6.5, 23.2450023146018932, 6.64730136119049069),
            (7.2, 28.1383103397619337, 7.3339847267267345),
            (12.0, 74.7175258210088506, 12.0822141752542843),
            (40.0, 803.915294833193843, 40.0249688472072637),
            (1000.0, 500007.133547631624, 1000.00099999800001),
        ];
        for (z, x, slope) in cases {
            let got = laplace_from_normal(z);
            assert!((got.0 - x).abs() <= 4e-15 * x, "{z}: {} vs {x}", got.0);
            assert!((got.1 - slope).abs() <= 4e-14 * slope, "{z}: {} vs {slope}", got.1);
            let mirrored = laplace_from_normal(-z);
            assert_eq!(mirrored, (-got.0, got.1));
        }
        assert_eq!(laplace_from_normal(0.0).0, 0.0);
    }

    proptest! {
        #[test]
        fn projections_are_nearest(
            w in proptest::collection::vec(-1.5..1.5_f64, 4..5), other in proptest::collection::vec(-1.0..1.0_f64, 4..5), l1: bool,
        ) {
            let prior = if l1 { Prior::L1Sphere } else { Prior::L2Sphere };
            let distance = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| (a - b) * (a - b)).sum::<f64>();
            let on = nearest_on_sphere(prior, &w);
            prop_assert!((norm(prior, &on) - 1.0).abs() < 1e-12);
            let rival: Vec<f64> = other.iter().map(|x| x / norm(prior, &other)).collect();
            prop_assert!(distance(&w, &on) <= distance(&w, &rival) + 1e-12);
            let within = nearest_in_ball(prior, &w);
            prop_assert!(norm(prior, &within) <= 1.0 + 1e-12);
            prop_assert!(distance(&w, &within) <= distance(&w, &on) + 1e-12);
        }

        #[test]
        fn pull_back_is_the_derivative(z in proptest::collection::vec(-6.0..6.0_f64, 2..6), which in 0..4_usize, seed in 0..50_u8) {
            let prior = [
                Prior::L1Sphere,
                Prior::L2Sphere,
                Prior::Gaussian { scale: 1.7 },
                Prior::Laplace { scale: 0.4 },
            ][which];
            let n = z.len();
            let direction: Vec<f64> = (0..n).map(|i| f64::from(seed) * 0.1 + i as f64 - 1.5).collect();
            let mut transform = Transform::new(prior, n);
            let mut w = vec![0.0; n];
            let mut value = |transform: &mut Transform, z: &[f64]| {
                transform.weights(z, &mut w);
                w.iter().zip(&direction).map(|(w, d)| w * d).sum::<f64>()
            };
            for i in 0..n {
                let h = 1e-6;
                if z[i].abs() < 1e-3 { continue; }
                let (mut above, mut below) = (z.clone(), z.clone());
                above[i] += h;
                below[i] -= h;
                let numeric = (value(&mut transform, &above) - value(&mut transform, &below)) / (2.0 * h);
                let mut gradient = direction.clone();
                let mut w = vec![0.0; n];
                transform.weights(&z, &mut w);
                transform.pull_back(&w, &mut gradient);
                prop_assert!((gradient[i] - numeric).abs() < 1e-6 * (1.0 + numeric.abs()), "{} vs {numeric}", gradient[i]);
            }
            let mut w = vec![0.0; n];
            transform.weights(&z, &mut w);
            if which < 2 {
                prop_assert!((norm(prior, &w) - 1.0).abs() < 1e-12);
            }
        }
    }
}
