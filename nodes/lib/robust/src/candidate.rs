//! What a method proposes, before it is checked.

use crate::outcome::{Method, SolverStatus};

/// Visits and what is claimed of them.
#[derive(Debug, Clone)]
pub(crate) struct Candidate {
    /// u: S × A.
    pub(crate) occupancy: Vec<f64>,
    /// Objective as the method has it.
    pub(crate) objective: f64,
    /// What no policy exceeds.
    pub(crate) upper_bound: f64,
    pub(crate) method: Method,
    pub(crate) status: SolverStatus,
    pub(crate) rounds: usize,
    pub(crate) solver_iterations: usize,
}

impl Candidate {
    /// The better one, with the tighter bound of both.
    pub(crate) fn or(self, other: Self) -> Self {
        let upper_bound = self.upper_bound.min(other.upper_bound);
        let better = if other.objective > self.objective { other } else { self };
        Self { upper_bound, ..better }
    }
}
