//! Lengths in joint space: each joint counts by how long it takes at full speed.

use crate::Limits;

/// A weighted Euclidean length. With the inverse of the velocity limits as weights it is in seconds.
#[derive(Debug, Clone, PartialEq)]
pub struct Metric {
    weights: Vec<f64>,
}

impl Metric {
    /// Every joint counts by the seconds it takes at its velocity limit.
    pub fn of_limits(limits: &Limits) -> Self {
        Self { weights: limits.velocity().iter().map(|v| 1.0 / v).collect() }
    }

    /// All joints alike.
    pub fn even(n_joints: usize) -> Self {
        Self { weights: vec![1.0; n_joints] }
    }

    /// The length of the edge from `a` to `b`.
    pub fn distance(&self, a: &[f64], b: &[f64]) -> f64 {
        self.squared(a, b).sqrt()
    }

    pub(crate) fn squared(&self, a: &[f64], b: &[f64]) -> f64 {
        let terms = self.weights.iter().zip(a).zip(b);
        terms.map(|((w, a), b)| (w * (a - b)) * (w * (a - b))).sum()
    }
}
