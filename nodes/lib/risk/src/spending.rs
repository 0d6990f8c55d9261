//! How an allowed probability of error is shared by claims that must hold together.

use std::f64::consts::PI;

use crate::error::{RiskError, check_level};

/// Share of δ to spend on look number `look` (from 1) of a session that bounds again after every answer: 6δ/(π²t²).
/// Over any number of looks no more than δ is spent.
pub fn delta_spent(delta: f64, look: u64) -> f64 {
    let look = look.max(1) as f64;
    6.0 * delta / (PI * PI * look * look)
}

/// A probability of error that may still be divided: what is taken from it by [`at_look`](Self::at_look) over all looks, or
/// by [`shared_by`](Self::shared_by) over all claims, adds up to no more than the whole, so by the union bound all claims
/// hold together with the confidence that it leaves.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ErrorBudget(f64);

impl ErrorBudget {
    /// A budget of δ in (0, 1).
    ///
    /// # Errors
    /// δ outside (0, 1).
    pub fn new(delta: f64) -> Result<Self, RiskError> {
        check_level("delta", delta)?;
        Ok(Self(delta))
    }

    /// The δ to spend.
    pub fn delta(self) -> f64 {
        self.0
    }

    /// The part of look number `look`, from 1 (see [`delta_spent`]).
    pub fn at_look(self, look: u64) -> Self {
        Self(delta_spent(self.0, look))
    }

    /// The equal part of each of `n_claims` claims (of one when there are none).
    pub fn shared_by(self, n_claims: usize) -> Self {
        Self(self.0 / n_claims.max(1) as f64)
    }
}

#[cfg(test)]
mod tests {
    use super::{ErrorBudget, delta_spent};

    #[test]
    fn looks_spend_no_more_than_delta() {
        let spent: f64 = (1..100_000).map(|look| delta_spent(0.05, look)).sum();
        assert!(spent < 0.05 && spent > 0.0499);
    }

    #[test]
    fn claims_of_a_look_share_its_part() {
        let budget = ErrorBudget::new(0.05).expect("a level");
        assert_eq!(budget.at_look(3).shared_by(51).delta(), delta_spent(0.05, 3) / 51.0);
        let spent: f64 = (1..1000).map(|look| 7.0 * budget.at_look(look).shared_by(7).delta()).sum();
        assert!(spent < 0.05);
        assert_eq!(budget.shared_by(0), budget);
        assert!(ErrorBudget::new(0.0).is_err() && ErrorBudget::new(f64::NAN).is_err());
    }
}
