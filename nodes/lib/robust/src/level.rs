//! How much the tail matters, and how deep it is.

use crate::error::RobustError;

/// α and λ (dissertation section 7.2.1).
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Level {
    /// The tail is the worst share 1 − α, α in [0, 1).
    pub(crate) alpha: f64,
    /// Weight of the expected return against the tail's 1 − λ, in [0, 1].
    pub(crate) lambda: f64,
}

impl Level {
    /// Refuses levels out of range.
    pub(crate) fn new(alpha: f64, lambda: f64) -> Result<Self, RobustError> {
        if !(0.0..1.0).contains(&alpha) {
            return Err(RobustError::Range { name: "alpha", got: alpha, expected: "at least 0 and less than 1" });
        }
        if !(0.0..=1.0).contains(&lambda) {
            return Err(RobustError::Range { name: "lambda", got: lambda, expected: "from 0 to 1" });
        }
        Ok(Self { alpha, lambda })
    }

    /// 1 − λ.
    pub(crate) fn risk(self) -> f64 {
        1.0 - self.lambda
    }

    /// Whether only the mean reward matters.
    pub(crate) fn is_neutral(self) -> bool {
        self.alpha == 0.0 || self.lambda == 1.0
    }

    /// The largest share of the tail that a draw of probability `mass` can hold: c = p / (1 − α), at most 1, which rounding
    /// does not miss.
    pub(crate) fn held(self, mass: f64) -> f64 {
        let held = mass / (1.0 - self.alpha);
        if held > 1.0 - 1e-12 { 1.0 } else { held }
    }
}
