//! The whole problem as one linear program, solved by clarabel.

mod active;
mod broil;
mod program;
mod shares;
mod units;

use mdp::{Mdp, MdpError, Policy, occupancy};

use active::Active;
use broil::Broil;
use program::Effort;

use shares::tail_shares;
use units::Units;

use crate::candidate::Candidate;
use crate::level::Level;
use crate::outcome::{Method, SolverStatus};
use crate::planner::{Plan, Planner, Price};
use crate::policy::{counts_of, policy_of};
use crate::reachable::Reachable;
use crate::scenarios::Scenarios;
use crate::value::Value;

/// Most times that draws are added.
const MAX_ROUNDS: usize = 30;
/// The solver is asked for this share of the tolerance.
const SHARE: f64 = 0.01;
/// Shares of a state's visits up to these are taken for the solver's noise, if the policy is no worse without them.
const NOISE: [f64; 3] = [1e-5, 1e-7, 0.0];

/// Solves one program after another for the levels of a frontier.
pub(crate) struct Direct<'a> {
    mdp: &'a Mdp,
    scenarios: &'a Scenarios,
    planner: Planner<'a>,
    reachable: &'a Reachable,
    /// The optimal policy for the mean reward.
    mean: Plan,
    program: Option<(Level, Active, Broil)>,
}

impl<'a> Direct<'a> {
    /// Begins with the optimal policy for the mean reward.
    pub(crate) fn new(
        mdp: &'a Mdp,
        scenarios: &'a Scenarios,
        reachable: &'a Reachable,
        planner: Planner<'a>,
        mean: Plan,
    ) -> Self {
        Self { mdp, scenarios, planner, reachable, mean, program: None }
    }

    /// The best policy for `level`, within about `tolerance` of the size of returns.
    ///
    /// # Errors
    /// A process whose visits cannot be computed.
    pub(crate) fn solve(
        &mut self,
        level: Level,
        upper_bound: f64,
        tolerance: f64,
        max_iterations: usize,
    ) -> Result<Candidate, MdpError> {
        let value = Value::new(self.scenarios, level, &self.mean.counts);
        let start = occupancy(self.mdp, &self.mean.policy())?;
        let units = self.units(&self.mean.counts, value.tail.value_at_risk, start.iter().sum());
        let mut best = Candidate {
            occupancy: start,
            objective: value.objective,
            upper_bound,
            method: Method::Direct,
            status: SolverStatus::NotNeeded,
            rounds: 0,
            solver_iterations: 0,
        };
        let fits = |known: &Level| known.alpha == level.alpha && known.is_neutral() == level.is_neutral();
        let mut known = self.program.take().filter(|(known, ..)| fits(known));
        let mut active = match &known {
            Some((_, active, _)) => active.clone(),
            None => Active::new(self.scenarios, level, &value.values),
        };
        let effort = Effort { accuracy: SHARE * tolerance, max_iterations };
        while best.rounds < MAX_ROUNDS {
            best.rounds += 1;
            let mut broil = match known.take() {
                Some((.., mut broil)) => {
                    broil.set_level(self.scenarios, &active, level);
                    broil
                }
                None => Broil::new(self.mdp, self.reachable, self.scenarios, &active, units.clone(), level, effort),
            };
            let (answer, solved) = broil.solve(self.mdp, self.reachable, level);
            best.status = answer.status;
            best.solver_iterations += answer.iterations;
            let Some(solved) = solved else { break };
            let value = self.take(level, &solved.occupancy, &mut best)?;
            let shares = tail_shares(self.scenarios, &active, level, &solved.duals, &value.values);
            let (bound, _) = self.planner.plan(level, &Price::new(self.scenarios, &shares), 0.0)?;
            best.upper_bound = best.upper_bound.min(bound);
            let before = active.clone();
            let more = active.extend(self.scenarios, level, &value.values, solved.edge);
            if !more || best.upper_bound - best.objective <= tolerance * units.unit {
                self.program = Some((level, before, broil));
                break;
            }
        }
        Ok(best)
    }

    fn units(&self, counts: &[f64], edge: f64, visits: f64) -> Units {
        let spread = self.reachable.largest_features(self.mdp).iter().map(|phi| visits * phi).collect();
        Units::new(self.scenarios, counts.to_vec(), spread, edge, visits)
    }

    /// Makes policies of visits that satisfy the constraints nearly, with and without what may be noise, and takes over the
    /// best one's own visits if they are better than `best`. What the last policy is worth.
    fn take(&self, level: Level, visits: &[f64], best: &mut Candidate) -> Result<Value, MdpError> {
        let mut last = None;
        for noise in NOISE {
            let policy = Policy::Stochastic(policy_of(visits, self.mdp.n_actions(), Some(&self.mean.actions), noise));
            let exact = occupancy(self.mdp, &policy)?;
            let value = Value::new(self.scenarios, level, &counts_of(self.mdp, &exact));
            if value.objective > best.objective {
                (best.objective, best.occupancy) = (value.objective, exact);
            }
            last = Some(value);
        }
        Ok(last.expect("there is a noise"))
    }
}
