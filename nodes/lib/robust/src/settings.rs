//! How a robust policy is looked for.

use crate::error::RobustError;

/// Which method is to be used.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum MethodChoice {
    /// Column generation; where it does not come to an end within [`AUTOMATIC_ROUNDS`] rounds and the process is small enough,
    /// the linear program as well.
    #[default]
    Automatic,
    /// One linear program over all visits.
    Direct,
    /// Column generation.
    ColumnGeneration,
}

/// Rounds of column generation after which a linear program is tried.
pub const AUTOMATIC_ROUNDS: usize = 250;
/// Most states that can be visited of a process for which a linear program is tried.
pub const AUTOMATIC_STATES: usize = 1500;

/// How long and how exactly to look. Limits are numbers of steps, not seconds: answers are the same on every machine.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Settings {
    /// Which method.
    pub method: MethodChoice,
    /// Largest gap that is called optimal, as a share of the typical size of returns, in [1e-12, 0.1].
    pub tolerance: f64,
    /// Most rounds of column generation for one λ, at least 1.
    pub max_rounds: usize,
    /// Most iterations of the linear-programming solver each time it is called, at least 1.
    pub max_iterations: usize,
}

impl Default for Settings {
    fn default() -> Self {
        Self { method: MethodChoice::Automatic, tolerance: 1e-8, max_rounds: 5000, max_iterations: 200 }
    }
}

impl Settings {
    pub(crate) fn check(&self) -> Result<(), RobustError> {
        if !(1e-12..=0.1).contains(&self.tolerance) {
            return Err(RobustError::Range {
                name: "tolerance",
                got: self.tolerance,
                expected: "between 1e-12 and 0.1",
            });
        }
        for (name, got) in [("max_rounds", self.max_rounds), ("max_iterations", self.max_iterations)] {
            if got == 0 {
                return Err(RobustError::Range { name, got: 0.0, expected: "at least 1" });
            }
        }
        Ok(())
    }
}
