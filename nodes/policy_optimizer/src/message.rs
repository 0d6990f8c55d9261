//! Outcomes, objectives and methods of the core as the numbers of the messages.

use crate::settings::Objective;
use apprentice_msgs::msg::RobustPolicy;
use robust::{Method, Outcome};

/// The outcome's number.
pub(crate) fn outcome_number(outcome: Outcome) -> u8 {
    match outcome {
        Outcome::Optimal => RobustPolicy::OPTIMAL,
        Outcome::Inaccurate => RobustPolicy::INACCURATE,
        Outcome::IterationLimit => RobustPolicy::ITERATION_LIMIT,
        Outcome::TimedOut => RobustPolicy::TIMED_OUT,
        Outcome::Infeasible => RobustPolicy::INFEASIBLE,
        Outcome::Unbounded => RobustPolicy::UNBOUNDED,
        Outcome::ConstraintsViolated => RobustPolicy::CONSTRAINTS_VIOLATED,
    }
}

/// Whether a solution's policy may be shown: its numbers are computed from its visits, which were checked, and its gap is
/// proved, whatever the solver said.
pub(crate) fn has_policy(outcome: Outcome) -> bool {
    matches!(outcome, Outcome::Optimal | Outcome::Inaccurate | Outcome::IterationLimit)
}

/// The objective's number.
pub(crate) fn objective_number(objective: Objective) -> u8 {
    match objective {
        Objective::Robust => RobustPolicy::ROBUST,
        Objective::Regret => RobustPolicy::REGRET,
        Objective::Evd => RobustPolicy::EVD,
    }
}

/// The method's number.
pub(crate) fn method_number(method: Method) -> u8 {
    match method {
        Method::Direct => RobustPolicy::DIRECT,
        Method::ColumnGeneration => RobustPolicy::COLUMN_GENERATION,
    }
}
