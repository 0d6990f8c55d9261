//! What is claimed about a figure, and whether it holds.

use super::statistics::bootstrap_interval;
use serde::{Deserialize, Serialize};

/// Against what a claim is made.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum ClaimKind {
    /// The dissertation's result is found again.
    Match,
    /// Ours is better.
    Beat,
}

/// A claim and its evidence; one that does not hold is printed like any other.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct Claim {
    /// Against what.
    pub kind: ClaimKind,
    /// What is claimed.
    pub claim: String,
    /// What was found.
    pub found: String,
    /// Whether it holds.
    pub held: bool,
}

impl Claim {
    /// A result of the dissertation is found again.
    pub fn matched(claim: impl Into<String>, held: bool, found: impl Into<String>) -> Self {
        Self { kind: ClaimKind::Match, claim: claim.into(), found: found.into(), held }
    }

    /// Ours is better by a criterion without sampling error.
    pub fn beaten(claim: impl Into<String>, held: bool, found: impl Into<String>) -> Self {
        Self { kind: ClaimKind::Beat, claim: claim.into(), found: found.into(), held }
    }

    /// Ours is smaller: the 95 % bootstrap interval of the mean of the paired `differences`, ours minus the other, lies
    /// below 0.
    pub fn smaller(claim: impl Into<String>, differences: &[f64], seed: u64) -> Self {
        let [low, high] = bootstrap_interval(differences, seed);
        let found = format!("difference {} [{}, {}]", signed(mean(differences)), signed(low), signed(high));
        Self { kind: ClaimKind::Beat, claim: claim.into(), found, held: high < 0.0 }
    }

    /// `match  held      claim  (found)`.
    pub fn line(&self) -> String {
        let kind = match self.kind {
            ClaimKind::Match => "match",
            ClaimKind::Beat => "beat ",
        };
        let held = if self.held { "held    " } else { "NOT HELD" };
        format!("{kind}  {held}  {} ({})", self.claim, self.found)
    }
}

fn mean(values: &[f64]) -> f64 {
    super::sum_in_order(values) / values.len() as f64
}

fn signed(x: f64) -> String {
    format!("{x:+.4}")
}

#[cfg(test)]
mod tests {
    use super::Claim;

    #[test]
    fn smaller_means_that_the_interval_excludes_zero() {
        let clearly: Vec<f64> = (0..40).map(|i| -1.0 + 0.01 * f64::from(i)).collect();
        assert!(Claim::smaller("a", &clearly, 1).held);
        let hardly: Vec<f64> = (0..40).map(|i| if i % 2 == 0 { -1.0 } else { 0.99 }).collect();
        assert!(!Claim::smaller("b", &hardly, 1).held);
        let worse: Vec<f64> = clearly.iter().map(|x| -x).collect();
        assert!(!Claim::smaller("c", &worse, 1).held);
    }
}
