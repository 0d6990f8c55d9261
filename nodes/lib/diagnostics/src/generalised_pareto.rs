//! The generalised Pareto distribution of values above 0, fitted after Zhang and Stephens (2009).

/// Weight, in observations, of the prior that pulls the shape of a short tail towards ½ (Vehtari et al. 2024, appendix C).
const PRIOR_OBSERVATIONS: f64 = 10.0;
/// Grid points of less posterior weight than this say nothing.
const NEGLIGIBLE: f64 = 10.0 * f64::EPSILON;

/// F(x) = 1 − (1 + k x / σ)^(−1/k): shape k, larger for heavier tails, and scale σ > 0.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct GeneralisedPareto {
    pub(super) shape: f64,
    pub(super) scale: f64,
}

impl GeneralisedPareto {
    /// Posterior mean of the profile likelihood over θ = −k/σ on the grid of Zhang and Stephens, then the shape pulled
    /// towards ½. `ascending` holds at least 5 positive values; `None` when their spread leaves no finite fit.
    pub(super) fn fit(ascending: &[f64]) -> Option<Self> {
        let n = ascending.len();
        let (n_, largest) = (n as f64, ascending[n - 1]);
        let quartile = ascending[(n_ / 4.0 + 0.5) as usize - 1];
        let n_grid = 30 + libm::sqrt(n_) as usize;
        let mean_log = |theta: f64| ascending.iter().map(|x| libm::log1p(-theta * x)).sum::<f64>() / n_;

        let grid = (0..n_grid)
            .map(|i| (1.0 - libm::sqrt(n_grid as f64 / (i as f64 + 0.5))) / (3.0 * quartile) + 1.0 / largest);
        let profile: Vec<(f64, f64)> = grid
            .map(|theta| {
                let k = mean_log(theta);
                (theta, n_ * (libm::log(-theta / k) - k - 1.0))
            })
            .filter(|(_, likelihood)| likelihood.is_finite())
            .collect();
        let weight = |own: f64| 1.0 / profile.iter().map(|(_, other)| libm::exp(other - own)).sum::<f64>();
        let kept: Vec<(f64, f64)> = profile
            .iter()
            .map(|&(theta, own)| (theta, weight(own)))
            .filter(|&(_, weight)| weight >= NEGLIGIBLE)
            .collect();
        let total: f64 = kept.iter().map(|(_, weight)| weight).sum();
        let theta = kept.iter().map(|(theta, weight)| theta * weight).sum::<f64>() / total;

        let k = mean_log(theta);
        let shape = (n_ * k + PRIOR_OBSERVATIONS * 0.5) / (n_ + PRIOR_OBSERVATIONS);
        let scale = -k / theta;
        (shape.is_finite() && scale.is_finite() && scale > 0.0).then_some(Self { shape, scale })
    }

    /// F⁻¹(p), p in (0, 1).
    pub(super) fn quantile(&self, p: f64) -> f64 {
        let exponential = -libm::log1p(-p);
        let standard = if self.shape.abs() < f64::EPSILON {
            exponential
        } else {
            libm::expm1(self.shape * exponential) / self.shape
        };
        standard * self.scale
    }
}

#[cfg(test)]
mod tests {
    use super::GeneralisedPareto;

    #[test]
    fn recovers_the_shape_of_exact_quantiles() {
        for shape in [-0.4, 0.0, 0.3, 0.7, 1.5] {
            let truth = GeneralisedPareto { shape, scale: 2.5 };
            let n = 4000;
            let values: Vec<f64> = (0..n).map(|i| truth.quantile((f64::from(i) + 0.5) / f64::from(n))).collect();
            let got = GeneralisedPareto::fit(&values).expect("a fit");
            assert!((got.shape - shape).abs() < 0.02 && (got.scale / 2.5 - 1.0).abs() < 0.02, "{got:?} vs {truth:?}");
        }
    }

    #[test]
    fn a_quantile_inverts_the_distribution() {
        let tail = GeneralisedPareto { shape: 0.5, scale: 2.0 };
        // 1 − (1 + x/4)⁻² = 3/4 at x = 4.
        assert!((tail.quantile(0.75) - 4.0).abs() < 1e-14);
        let exponential = GeneralisedPareto { shape: 0.0, scale: 2.0 };
        assert!((exponential.quantile(0.5) - 2.0 * std::f64::consts::LN_2).abs() < 1e-15);
    }
}
