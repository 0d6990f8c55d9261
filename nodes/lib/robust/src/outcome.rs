//! How an optimisation ended: outcomes, not errors.

/// What the returned policy is known to be.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Outcome {
    /// Optimal: the gap between its objective and a bound no policy exceeds, both computed apart from the solver, is
    /// within the tolerance, and its visits satisfy the constraints.
    Optimal,
    /// The solver could not come closer: the gap is as reported.
    Inaccurate,
    /// The iterations allowed did not suffice: the gap is as reported.
    IterationLimit,
    /// The solver ran out of time: the gap is as reported.
    TimedOut,
    /// The solver takes the problem for infeasible.
    Infeasible,
    /// The solver takes the problem for unbounded.
    Unbounded,
    /// The returned visits violate the constraints: see [`crate::Checks`].
    ConstraintsViolated,
}

impl Outcome {
    /// `optimal`, `inaccurate`, …
    pub fn name(self) -> &'static str {
        match self {
            Self::Optimal => "optimal",
            Self::Inaccurate => "inaccurate",
            Self::IterationLimit => "iteration_limit",
            Self::TimedOut => "timed_out",
            Self::Infeasible => "infeasible",
            Self::Unbounded => "unbounded",
            Self::ConstraintsViolated => "constraints_violated",
        }
    }
}

/// What the linear-programming solver said last.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SolverStatus {
    /// It was not needed: planning for one reward decided.
    NotNeeded,
    /// Solved to full accuracy.
    Solved,
    /// Solved to reduced accuracy.
    AlmostSolved,
    /// Infeasible.
    Infeasible,
    /// Unbounded.
    Unbounded,
    /// Out of iterations.
    IterationLimit,
    /// Out of time.
    TimedOut,
    /// Steps became too short.
    InsufficientProgress,
    /// Numbers became useless.
    NumericalError,
}

impl SolverStatus {
    /// `solved`, `almost_solved`, …
    pub fn name(self) -> &'static str {
        match self {
            Self::NotNeeded => "not_needed",
            Self::Solved => "solved",
            Self::AlmostSolved => "almost_solved",
            Self::Infeasible => "infeasible",
            Self::Unbounded => "unbounded",
            Self::IterationLimit => "iteration_limit",
            Self::TimedOut => "timed_out",
            Self::InsufficientProgress => "insufficient_progress",
            Self::NumericalError => "numerical_error",
        }
    }

    /// What an answer of this status is when its gap is too wide.
    pub(crate) fn outcome(self) -> Outcome {
        match self {
            Self::Infeasible => Outcome::Infeasible,
            Self::Unbounded => Outcome::Unbounded,
            Self::IterationLimit => Outcome::IterationLimit,
            Self::TimedOut => Outcome::TimedOut,
            _ => Outcome::Inaccurate,
        }
    }
}

/// How a policy was found.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Method {
    /// One linear program over all visits.
    Direct,
    /// Mixtures of policies that are optimal for one reward each.
    ColumnGeneration,
}

impl Method {
    /// `direct` or `column_generation`.
    pub fn name(self) -> &'static str {
        match self {
            Self::Direct => "direct",
            Self::ColumnGeneration => "column_generation",
        }
    }
}
