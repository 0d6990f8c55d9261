//! A robust policy with everything that is known of it, checked apart from whoever found it.

use mdp::{Mdp, Policy};

use crate::candidate::Candidate;
use crate::level::Level;
use crate::outcome::{Method, Outcome, SolverStatus};
use crate::policy::{UNVISITED, counts_of, policy_of};
use crate::scenarios::Scenarios;
use crate::value::Value;

/// Largest residual of the flow of visits, as a share of all visits.
const MAX_RESIDUAL: f64 = 1e-9;
/// Largest difference between the objective claimed and the one of the visits, as a share of the unit.
const MAX_DIFFERENCE: f64 = 1e-9;

/// The policy that maximises (1 − λ) CVaR_α(ψ) + λ E(return), or the best that was found.
#[derive(Debug, Clone, PartialEq)]
pub struct Solution {
    /// What it is known to be.
    pub outcome: Outcome,
    /// α.
    pub alpha: f64,
    /// λ.
    pub lambda: f64,
    /// π: stochastic, S × A. In a state that it never visits it takes the best action for the mean reward.
    pub policy: Policy,
    /// u, its discounted visits: S × A.
    pub occupancy: Vec<f64>,
    /// States that it never visits, ascending.
    pub unvisited: Vec<usize>,
    /// μ = Φᵀu: k numbers.
    pub feature_counts: Vec<f64>,
    /// (1 − λ) CVaR_α(ψ) + λ E(return), from u.
    pub objective: f64,
    /// No policy has a larger objective: found by planning for one reward, at least `objective`.
    pub upper_bound: f64,
    /// E(return).
    pub expected_return: f64,
    /// VaR_α(ψ) = sup{x : P(ψ ≥ x) ≥ α}, from u.
    pub value_at_risk: f64,
    /// CVaR_α(ψ), from u: at λ = 1 the solver's σ and z mean nothing.
    pub conditional_value_at_risk: f64,
    /// Typical size of returns: gaps within the tolerance's share of it count as none.
    pub unit: f64,
    /// Who found it.
    pub method: Method,
    /// What the solver said last.
    pub status: SolverStatus,
    /// Rounds of column generation, or programs solved.
    pub rounds: usize,
    /// Steps or iterations of the solver in all.
    pub solver_iterations: usize,
    /// How well the constraints hold.
    pub checks: Checks,
}

/// The constraints of the problem, computed from u alone.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Checks {
    /// max_s′ |Σ_a u(s′, a) − γ Σ P(s′|s, a) u(s, a) − p₀(s′)| as a share of all visits.
    pub flow_residual: f64,
    /// Smallest u(s, a), before what is below 0 by rounding is put to 0.
    pub smallest_visit: f64,
    /// |objective the method claims − objective from u| as a share of the unit.
    pub objective_difference: f64,
}

impl Checks {
    /// Whether everything is as it must be.
    pub fn hold(&self) -> bool {
        self.flow_residual <= MAX_RESIDUAL
            && self.smallest_visit >= -MAX_RESIDUAL
            && self.objective_difference <= MAX_DIFFERENCE
    }
}

impl Solution {
    /// Primal–dual gap: by how much any policy's objective may exceed this one's.
    pub fn gap(&self) -> f64 {
        self.upper_bound - self.objective
    }

    /// Checks a candidate. Where it never comes the policy takes `otherwise`, or any action
    /// equally often.
    pub(crate) fn new(
        mdp: &Mdp,
        scenarios: &Scenarios,
        level: Level,
        candidate: Candidate,
        otherwise: Option<&[u32]>,
        unit: f64,
        tolerance: f64,
    ) -> Self {
        let n_actions = mdp.n_actions();
        let mut occupancy = candidate.occupancy;
        let all: f64 = occupancy.iter().sum();
        let smallest_visit = occupancy.iter().copied().fold(f64::INFINITY, f64::min) / all;
        let mut unvisited = vec![];
        for (state, row) in occupancy.chunks_mut(n_actions).enumerate() {
            row.iter_mut().for_each(|u| *u = u.max(0.0));
            if row.iter().sum::<f64>() <= UNVISITED * all {
                row.fill(0.0);
                unvisited.push(state);
            }
        }
        let policy = Policy::Stochastic(policy_of(&occupancy, n_actions, otherwise, 0.0));
        let feature_counts = counts_of(mdp, &occupancy);
        let value = Value::new(scenarios, level, &feature_counts);
        let objective = value.objective;
        let checks = Checks {
            flow_residual: flow_residual(mdp, &occupancy) / all,
            smallest_visit,
            objective_difference: if unit > 0.0 { (candidate.objective - objective).abs() / unit } else { 0.0 },
        };
        let upper_bound = candidate.upper_bound.max(objective);
        let outcome = if !checks.hold() {
            Outcome::ConstraintsViolated
        } else if upper_bound - objective <= tolerance * unit {
            Outcome::Optimal
        } else {
            candidate.status.outcome()
        };
        Self {
            outcome,
            alpha: level.alpha,
            lambda: level.lambda,
            policy,
            occupancy,
            unvisited,
            feature_counts,
            objective,
            upper_bound,
            expected_return: value.expected_return,
            value_at_risk: value.tail.value_at_risk,
            conditional_value_at_risk: value.tail.conditional_value_at_risk,
            unit,
            method: candidate.method,
            status: candidate.status,
            rounds: candidate.rounds,
            solver_iterations: candidate.solver_iterations,
            checks,
        }
    }
}

/// max_s′ |Σ_a u(s′, a) − γ Σ P(s′|s, a) u(s, a) − p₀(s′)|.
fn flow_residual(mdp: &Mdp, occupancy: &[f64]) -> f64 {
    let mut balance: Vec<f64> = mdp.initial().iter().map(|p| -p).collect();
    for (state, row) in occupancy.chunks(mdp.n_actions()).enumerate() {
        for (action, u) in row.iter().enumerate() {
            balance[state] += u;
            for (target, p) in mdp.successors(state, action) {
                balance[target] -= mdp.gamma() * p * u;
            }
        }
    }
    // Not `max`, which would drop what is not a number.
    balance.iter().fold(0.0, |most, x| if x.abs() <= most { most } else { x.abs() })
}

#[cfg(test)]
mod tests {
    use super::{Outcome, Solution};
    use crate::candidate::Candidate;
    use crate::level::Level;
    use crate::objective::Objective;
    use crate::outcome::{Method, SolverStatus};
    use crate::scenarios::Scenarios;
    use crate::value::Value;
    use mdp::{Features, Mdp, MdpParts, Policy, occupancy};

    fn process() -> Mdp {
        Mdp::new(MdpParts {
            gamma: 0.9,
            n_states: 2,
            n_actions: 2,
            n_features: 1,
            initial: vec![1.0, 0.0],
            transitions: vec![(0, 0, 1, 1.0), (0, 1, 0, 1.0), (1, 0, 0, 1.0), (1, 1, 1, 1.0)],
            features: Features::State(vec![0.0, 1.0]),
            actions: vec![],
            shape: None,
        })
        .expect("a process")
    }

    /// A solver's claim about visits: as they are, and that no policy is better.
    fn judged(visits: Vec<f64>, flattery: f64) -> Solution {
        let mdp = process();
        let scenarios = Scenarios::new(&mdp, &[1.0, 0.5], None, Objective::Robust, 1).expect("draws");
        let level = Level::new(0.5, 0.0).expect("a level");
        let counts = crate::policy::counts_of(&mdp, &visits);
        let objective = Value::new(&scenarios, level, &counts).objective + flattery;
        let (method, status) = (Method::Direct, SolverStatus::Solved);
        let upper_bound = objective;
        let candidate =
            Candidate { occupancy: visits, objective, upper_bound, method, status, rounds: 1, solver_iterations: 9 };
        Solution::new(&mdp, &scenarios, level, candidate, None, 1.0, 1e-8)
    }

    #[test]
    fn what_a_solver_claims_is_checked_by_the_visits_alone() {
        let visits = occupancy(&process(), &Policy::uniform(&process())).expect("visits");
        let good = judged(visits.clone(), 0.0);
        assert_eq!(good.outcome, Outcome::Optimal);
        assert!(good.checks.hold() && good.gap() == 0.0);
        // Visits out of nothing, fewer than none, and more return than they bring.
        let mut created = visits.clone();
        created[3] += 1e-6;
        let created = judged(created, 0.0);
        assert_eq!(created.outcome, Outcome::ConstraintsViolated);
        assert!(created.checks.flow_residual > 1e-9);
        let mut negative = visits.clone();
        negative[0] = -1e-6;
        assert_eq!(judged(negative, 0.0).outcome, Outcome::ConstraintsViolated);
        let flattered = judged(visits.clone(), 1e-6);
        assert_eq!(flattered.outcome, Outcome::ConstraintsViolated);
        assert!((flattered.objective - good.objective).abs() < 1e-12, "only what the visits bring counts");
        let nothing = judged(vec![f64::NAN; 4], 0.0);
        assert_eq!(nothing.outcome, Outcome::ConstraintsViolated);
    }
}
