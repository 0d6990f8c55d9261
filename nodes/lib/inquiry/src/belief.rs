//! What is believed: posterior draws by number, each with a weight.

use crate::InquiryError;
use crate::error::check_numbers;

/// Weights of n draws that sum to 1. The draws themselves stay with the caller; here they are numbers from 0.
#[derive(Debug, Clone, PartialEq)]
pub struct Belief {
    weights: Vec<f64>,
}

impl Belief {
    /// n draws, all equally probable.
    ///
    /// # Errors
    /// No draws.
    pub fn equal(n: usize) -> Result<Self, InquiryError> {
        if n == 0 {
            return Err(InquiryError::Empty { what: "draws" });
        }
        Ok(Self { weights: vec![1.0 / n as f64; n] })
    }

    /// Draws with probabilities in proportion to `weights`, such as importance weights.
    ///
    /// # Errors
    /// No draws, weights that are negative or not finite, or none positive.
    pub fn weighted(weights: &[f64]) -> Result<Self, InquiryError> {
        if weights.is_empty() {
            return Err(InquiryError::Empty { what: "draws" });
        }
        check_numbers("weight", weights, "finite and at least 0", |w| w.is_finite() && w >= 0.0)?;
        let largest = weights.iter().copied().fold(0.0, f64::max);
        if largest == 0.0 {
            return Err(InquiryError::Empty { what: "draws of positive weight" });
        }
        let scaled: Vec<f64> = weights.iter().map(|w| w / largest).collect();
        Ok(Self::normalised(scaled).expect("the largest weight is 1"))
    }

    /// Draws.
    pub fn n(&self) -> usize {
        self.weights.len()
    }

    /// Weight of each draw; they sum to 1.
    pub fn weights(&self) -> &[f64] {
        &self.weights
    }

    /// Expectation of something that has `values` under the draws.
    pub fn mean(&self, values: &[f64]) -> f64 {
        self.weights.iter().zip(values).map(|(w, x)| w * x).sum()
    }

    /// The belief after an answer whose probability under each draw is `likelihood` (Bayes' rule). `None` when it is
    /// impossible under all of them.
    pub fn after(&self, likelihood: &[f64]) -> Option<Self> {
        Self::normalised(self.weights.iter().zip(likelihood).map(|(w, p)| w * p).collect())
    }

    /// (Σw)²/Σw²: how many equally probable draws this is worth.
    pub fn effective_size(&self) -> f64 {
        1.0 / self.weights.iter().map(|w| w * w).sum::<f64>()
    }

    fn normalised(mut weights: Vec<f64>) -> Option<Self> {
        let total: f64 = weights.iter().sum();
        if !(total > 0.0 && total.is_finite()) {
            return None;
        }
        weights.iter_mut().for_each(|w| *w /= total);
        Some(Self { weights })
    }
}

#[cfg(test)]
mod tests {
    use super::Belief;
    use crate::InquiryError;

    #[test]
    fn bayes_rule_by_hand() {
        let belief = Belief::weighted(&[2.0, 1.0, 1.0]).expect("weights");
        assert_eq!(belief.weights(), [0.5, 0.25, 0.25]);
        // ½·0.2, ¼·0.8, ¼·0 of 0.3 in all.
        let after = belief.after(&[0.2, 0.8, 0.0]).expect("possible");
        assert!(after.weights().iter().zip([1.0 / 3.0, 2.0 / 3.0, 0.0]).all(|(a, b)| (a - b).abs() < 1e-15));
        assert_eq!(belief.after(&[0.0; 3]), None);
        assert!((belief.effective_size() - 8.0 / 3.0).abs() < 1e-12);
        assert_eq!(belief.mean(&[1.0, 2.0, 4.0]), 2.0);
    }

    #[test]
    fn what_is_no_belief_is_refused() {
        assert_eq!(Belief::equal(0), Err(InquiryError::Empty { what: "draws" }));
        assert!(Belief::weighted(&[0.0, 0.0]).is_err());
        assert!(Belief::weighted(&[1.0, -0.1]).is_err() && Belief::weighted(&[f64::NAN]).is_err());
        assert_eq!(Belief::weighted(&[1e300, 1e300]), Belief::equal(2));
    }
}
