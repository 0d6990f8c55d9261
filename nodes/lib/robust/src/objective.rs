//! What a policy is judged by under an uncertain reward (dissertation section 7.2.2 and 9.4).

/// ψ(π, w), the larger the better, whose tail is the risk.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Objective<'a> {
    /// The return wᵀμ_π.
    Robust,
    /// The return above that of an expert, wᵀ(μ_π − μ_E).
    Regret {
        /// μ_E, k numbers: see [`crate::expert_feature_counts`].
        expert: &'a [f64],
    },
    /// The negated loss against the best policy for each reward, wᵀμ_π − V*_w (eq. 9.1).
    Loss,
}

impl Objective<'_> {
    /// `robust`, `regret` or `evd`.
    pub fn name(self) -> &'static str {
        match self {
            Self::Robust => "robust",
            Self::Regret { .. } => "regret",
            Self::Loss => "evd",
        }
    }
}
