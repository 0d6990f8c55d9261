//! What a policy with given feature counts is worth.

use crate::level::Level;
use crate::scenarios::Scenarios;
use crate::tail::{LowerTail, lower_tail};

/// The objective and what it is made of.
#[derive(Debug, Clone)]
pub(crate) struct Value {
    /// (1 − λ) CVaR_α(ψ) + λ E(return).
    pub(crate) objective: f64,
    /// E(return).
    pub(crate) expected_return: f64,
    /// ψ of every draw.
    pub(crate) values: Vec<f64>,
    pub(crate) tail: LowerTail,
}

impl Value {
    /// Of a policy with feature counts μ: k numbers.
    pub(crate) fn new(scenarios: &Scenarios, level: Level, counts: &[f64]) -> Self {
        let values = scenarios.values(counts);
        let tail = lower_tail(&values, &scenarios.masses, level.alpha);
        let expected_return = scenarios.expected_return(counts);
        let objective = level.risk() * tail.conditional_value_at_risk + level.lambda * expected_return;
        Self { objective, expected_return, values, tail }
    }
}
