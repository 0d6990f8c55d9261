//! What robust policies are compared with (dissertation section 7.3.2 and appendix F).

mod lpal;
mod max_entropy;
mod optimal;
mod soft;

pub use lpal::{Lpal, Signs, lpal};
pub use max_entropy::{Convergence, Horizon, MaxEntropy, MaxEntropySettings, WeightNorm, max_entropy};
pub use optimal::{Baseline, climb_value_at_risk, optimal_policy};
