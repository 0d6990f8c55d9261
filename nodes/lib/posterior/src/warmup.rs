//! Finding a step size and a scale before draws are kept.

use crate::linear::cholesky;

/// Nesterov's dual averaging of the log step size (Hoffman and Gelman 2014, section 3.2).
#[derive(Debug, Clone, Copy)]
pub(crate) struct DualAveraging {
    target: f64,
    centre: f64,
    shortfall: f64,
    average: f64,
    count: f64,
    current: f64,
}

impl DualAveraging {
    /// Aims at the share `target` of accepted proposals.
    pub(crate) fn new(step_size: f64, target: f64) -> Self {
        let log = libm::log(step_size);
        Self { target, centre: log + libm::log(3.0), shortfall: 0.0, average: 0.0, count: 0.0, current: log }
    }

    /// Takes in how the last transition did.
    pub(crate) fn update(&mut self, acceptance: f64) {
        self.count += 1.0;
        let weight = 1.0 / (self.count + 10.0);
        self.shortfall += weight * (self.target - acceptance - self.shortfall);
        self.current = (self.centre - libm::sqrt(self.count) / 0.05 * self.shortfall).clamp(-14.0, 1.0);
        let forget = libm::pow(self.count, -0.75);
        self.average += forget * (self.current - self.average);
    }

    /// To explore with.
    pub(crate) fn step_size(&self) -> f64 {
        libm::exp(self.current)
    }

    /// To keep; the starting one before any update.
    pub(crate) fn averaged(&self) -> f64 {
        libm::exp(if self.count > 0.0 { self.average } else { self.current })
    }
}

/// Lower factor of the covariance of positions pooled over chains, each about its own mean, shrunk to its diagonal as far
/// as the number of positions asks for. `chains` holds one row-major list of n-vectors per chain.
pub(crate) fn pooled_scale(chains: &[Vec<f64>], n: usize) -> Option<Vec<f64>> {
    let mut covariance = vec![0.0; n * n];
    let mut count = 0.0;
    for chain in chains {
        let length = (chain.len() / n) as f64;
        let mut mean = vec![0.0; n];
        for z in chain.chunks_exact(n) {
            for (mean, z) in mean.iter_mut().zip(z) {
                *mean += z / length;
            }
        }
        for z in chain.chunks_exact(n) {
            for i in 0..n {
                for j in 0..=i {
                    covariance[i * n + j] += (z[i] - mean[i]) * (z[j] - mean[j]);
                }
            }
        }
        count += length - 1.0;
    }
    let keep = count / (count + n as f64);
    for i in 0..n {
        for j in 0..=i {
            covariance[i * n + j] *= if i == j { 1.0 } else { keep } / count;
        }
    }
    cholesky(&covariance, n)
}
