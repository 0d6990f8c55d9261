//! Corners joined by straight edges in joint space.

use crate::Metric;

/// A polyline of configurations. It has at least one corner.
#[derive(Debug, Clone, PartialEq)]
pub struct Path {
    corners: Vec<Vec<f64>>,
}

impl Path {
    /// A path through the given corners; `None` without any, or when their numbers of joints differ.
    pub fn new(corners: Vec<Vec<f64>>) -> Option<Self> {
        let n_joints = corners.first()?.len();
        corners.iter().all(|q| q.len() == n_joints).then_some(Self { corners })
    }

    /// Its corners in order, the ends among them.
    pub fn corners(&self) -> &[Vec<f64>] {
        &self.corners
    }

    /// Where it starts.
    pub fn start(&self) -> &[f64] {
        &self.corners[0]
    }

    /// Where it ends.
    pub fn end(&self) -> &[f64] {
        &self.corners[self.corners.len() - 1]
    }

    /// Its length.
    pub fn length(&self, metric: &Metric) -> f64 {
        self.corners.windows(2).map(|edge| metric.distance(&edge[0], &edge[1])).sum()
    }

    /// The same way back.
    pub fn reversed(&self) -> Self {
        Self { corners: self.corners.iter().rev().cloned().collect() }
    }

    pub(crate) fn replace(&mut self, corners: Vec<Vec<f64>>) {
        self.corners = corners;
    }
}

/// The point a share of the way from `a` to `b`.
pub(crate) fn between(a: &[f64], b: &[f64], share: f64) -> Vec<f64> {
    a.iter().zip(b).map(|(a, b)| a + (b - a) * share).collect()
}
