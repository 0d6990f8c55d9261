//! How wrong a policy may still be: values at risk of a loss over posterior draws, bounded with a stated confidence.

mod binomial;
mod bound;
mod empirical;
mod order_statistic;

pub use binomial::{cdf, quantile};
pub use bound::{Bound, MAX_RHAT, Outcome, Receipt, RiskError, lower_bound, upper_bound};
pub use empirical::{Tail, cvar, value_at_risk};
pub use order_statistic::{delta_spent, n_min, order_index};
