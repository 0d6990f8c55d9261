//! Linear programs and clarabel, which solves them.

use clarabel::algebra::CscMatrix;
use clarabel::solver::{DefaultSettings, DefaultSolver, IPSolver, NonnegativeConeT, SolverStatus as Status, ZeroConeT};

use crate::outcome::SolverStatus;

/// min cᵀx with the first `n_equal` rows of A x = b and the others of A x ≤ b; built column by column.
#[derive(Debug, Clone)]
pub(super) struct Program {
    starts: Vec<usize>,
    rows: Vec<usize>,
    values: Vec<f64>,
    right: Vec<f64>,
    n_equal: usize,
}

/// When the solver may stop.
#[derive(Debug, Clone, Copy)]
pub(super) struct Effort {
    /// At relative and absolute errors of this.
    pub(super) accuracy: f64,
    /// After so many iterations.
    pub(super) max_iterations: usize,
}

/// What clarabel answers.
#[derive(Debug, Clone)]
pub(super) struct Answer {
    pub(super) status: SolverStatus,
    /// x.
    pub(super) variables: Vec<f64>,
    /// One number per row, those of the inequalities at least 0.
    pub(super) duals: Vec<f64>,
    pub(super) iterations: usize,
}

impl Program {
    /// A program without variables yet and with right-hand sides b, first those of the equalities.
    pub(super) fn new(right: Vec<f64>, n_equal: usize) -> Self {
        Self { starts: vec![0], rows: vec![], values: vec![], right, n_equal }
    }

    /// Adds a free variable with its (row, coefficient), rows ascending.
    pub(super) fn free(&mut self, entries: impl IntoIterator<Item = (usize, f64)>) {
        for (row, value) in entries {
            if value != 0.0 {
                self.rows.push(row);
                self.values.push(value);
            }
        }
        self.starts.push(self.rows.len());
    }

    /// The same for a variable of at least 0.
    pub(super) fn nonnegative(&mut self, entries: impl IntoIterator<Item = (usize, f64)>) {
        let row = self.right.len();
        self.right.push(0.0);
        self.free(entries.into_iter().chain([(row, -1.0)]));
    }

    /// A solver for costs c, one per variable. It is not told of the time: answers depend on the numbers alone.
    pub(super) fn prepare(&self, costs: &[f64], effort: Effort) -> Prepared {
        let (m, n) = (self.right.len(), self.starts.len() - 1);
        let matrix = CscMatrix::new(m, n, self.starts.clone(), self.rows.clone(), self.values.clone());
        let cones = [ZeroConeT(self.n_equal), NonnegativeConeT(m - self.n_equal)];
        let settings = DefaultSettings {
            verbose: false,
            max_iter: u32::try_from(effort.max_iterations).unwrap_or(u32::MAX),
            tol_gap_abs: effort.accuracy,
            tol_gap_rel: effort.accuracy,
            tol_feas: effort.accuracy,
            presolve_enable: false,
            max_threads: 1,
            direct_solve_method: "qdldl".to_owned(),
            ..DefaultSettings::default()
        };
        let quadratic = CscMatrix::zeros((n, n));
        let solver = DefaultSolver::new(&quadratic, costs, &matrix, &self.right, &cones, settings)
            .expect("sizes agree and the settings are constants");
        Prepared(solver)
    }
}

/// A program ready to be solved, again and again with other costs.
pub(super) struct Prepared(DefaultSolver<f64>);

impl Prepared {
    /// Puts other costs, one per variable.
    pub(super) fn set_costs(&mut self, costs: &[f64]) {
        self.0.update_q(&costs.to_vec()).expect("nothing was presolved and as many costs as variables are given");
    }

    /// The answer, whatever its status.
    pub(super) fn solve(&mut self) -> Answer {
        self.0.solve();
        let solution = &self.0.solution;
        Answer {
            status: status(solution.status),
            variables: solution.x.clone(),
            duals: solution.z.clone(),
            iterations: solution.iterations as usize,
        }
    }
}

fn status(status: Status) -> SolverStatus {
    match status {
        Status::Solved => SolverStatus::Solved,
        Status::AlmostSolved => SolverStatus::AlmostSolved,
        Status::PrimalInfeasible | Status::AlmostPrimalInfeasible => SolverStatus::Infeasible,
        Status::DualInfeasible | Status::AlmostDualInfeasible => SolverStatus::Unbounded,
        Status::MaxIterations => SolverStatus::IterationLimit,
        Status::MaxTime | Status::CallbackTerminated => SolverStatus::TimedOut,
        Status::InsufficientProgress => SolverStatus::InsufficientProgress,
        Status::NumericalError | Status::Unsolved => SolverStatus::NumericalError,
    }
}

#[cfg(test)]
mod tests {
    use super::{Effort, Program};
    use crate::outcome::{Outcome, SolverStatus};

    const EFFORT: Effort = Effort { accuracy: 1e-9, max_iterations: 100 };

    /// min c x with x ≥ 0 and x ≤ b, or −x ≤ b where `sign` is −1.
    fn answer(c: f64, sign: f64, b: f64, effort: Effort) -> super::Answer {
        let mut program = Program::new(vec![b], 0);
        program.nonnegative([(0, sign)]);
        program.prepare(&[c], effort).solve()
    }

    #[test]
    fn programs_without_an_answer_end_in_a_word() {
        let solved = answer(-1.0, 1.0, 2.0, EFFORT);
        assert_eq!(solved.status, SolverStatus::Solved);
        assert!((solved.variables[0] - 2.0).abs() < 1e-7);
        // Nothing is both at least 0 and at most −1, and nothing holds x back.
        let infeasible = answer(1.0, 1.0, -1.0, EFFORT).status;
        let unbounded = answer(-1.0, -1.0, 1.0, EFFORT).status;
        let cut = answer(-1.0, 1.0, 2.0, Effort { max_iterations: 1, ..EFFORT }).status;
        assert_eq!(
            [infeasible, unbounded, cut].map(SolverStatus::outcome),
            [Outcome::Infeasible, Outcome::Unbounded, Outcome::IterationLimit]
        );
    }
}
