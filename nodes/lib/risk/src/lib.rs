//! How wrong a policy may still be: risk measures of a loss or a return over posterior draws, bounded with a stated
//! confidence; the bounds that need no posterior; and policies ranked by what is certain of them.

mod binomial;
mod bound;
mod distribution;
mod empirical;
mod envelope;
mod error;
mod feature_count;
mod hoeffding;
mod measure;
mod normalised_loss;
mod order_statistic;
mod ranking;
mod risk_bound;
mod sample;
mod spending;
mod warning;

pub use binomial::{cdf, quantile};
pub use bound::{Bound, MAX_RHAT, Outcome, Receipt, lower_bound, upper_bound};
pub use distribution::Distribution;
pub use empirical::{Tail, cvar, value_at_risk};
pub use envelope::distribution_shift;
pub use error::RiskError;
pub use feature_count::worst_case_feature_count_bound;
pub use hoeffding::{hoeffding_demonstrations, hoeffding_loss_bound};
pub use measure::Measure;
pub use normalised_loss::{NormalisedLosses, Reference, normalised_losses};
pub use order_statistic::{n_min, order_index};
pub use ranking::{RankedPolicy, Ranking, rank_policies};
pub use risk_bound::{RiskBound, RiskOutcome, RiskReceipt, risk_bound, risk_bounds};
pub use sample::{Sample, WeightsReceipt};
pub use spending::{ErrorBudget, delta_spent};
pub use warning::Warning;
