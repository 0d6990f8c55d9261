//! Column generation (Dantzig and Wolfe 1960): mixtures of policies that are each optimal for one reward.
//!
//! CVaR_α(ψ) is the least Σ q_i ψ_i over the envelope {0 ≤ q ≤ p / (1 − α), Σ q = 1}, so the optimum is that of a game between
//! a mixture of policies and q. A search over the policies known finds the best mixture and the q that holds it down;
//! planning for the reward (1 − λ) Σ q_i w_i + λ w̄ finds the policy that q overlooked, and a bound that no policy exceeds.
//! The process itself is only ever planned in, so its size hardly matters.

use mdp::{Mdp, MdpError, occupancy};

use crate::candidate::Candidate;
use crate::level::Level;
use crate::outcome::{Method, SolverStatus};
use crate::planner::{Plan, Planner, Price};
use crate::scenarios::{Scenarios, dot};
use crate::value::Value;
use crate::vertex::{Best, Game, Vertex};

/// Rounds after which q is taken to swing from corner to corner, so that planning looks for q nearer to that of the best bound
/// (Wentges 1997)…
const PATIENCE: usize = 20;
/// … by this share at first, and at most.
const SMOOTHING: f64 = 0.5;
/// Most vertices that are kept.
const MAX_VERTICES: usize = 64;
/// Share of the gap at hand to which plans are exact.
const EXACTNESS: f64 = 0.05;
/// Gains below this share of the unit are rounding.
const ROUNDING: f64 = 1e-11;

/// All policies found so far, which serve every λ of a frontier.
#[derive(Debug, Clone)]
pub(crate) struct Columns<'a> {
    mdp: &'a Mdp,
    scenarios: &'a Scenarios,
    planner: Planner<'a>,
    plans: Vec<Plan>,
    /// The last vertex of every λ so far, all for one α.
    vertices: Vec<(Level, Vertex)>,
    /// Of the best bound of the last level.
    center: Option<Price>,
    /// The optimal value for the mean reward, for plan 0.
    mean_bound: f64,
    unit: f64,
}

/// How far a search has come.
struct Search {
    /// (plan, share) of the best mixture.
    shares: Vec<(usize, f64)>,
    objective: f64,
    upper_bound: f64,
    status: SolverStatus,
    rounds: usize,
    steps: usize,
}

impl<'a> Columns<'a> {
    /// Begins with `mean`, the optimal policy for the mean reward and a bound on what it is worth. Returns are counted in
    /// `unit`.
    pub(crate) fn new(
        mdp: &'a Mdp,
        scenarios: &'a Scenarios,
        planner: Planner<'a>,
        mean: (f64, Plan),
        unit: f64,
    ) -> Self {
        let (mean_bound, plan) = mean;
        Self { mdp, scenarios, planner, plans: vec![plan], vertices: vec![], center: None, mean_bound, unit }
    }

    /// The best policy for `level` within `tolerance` of the unit, or the best after `max_rounds` rounds. No policy is known to
    /// exceed `upper_bound`, which may be infinite.
    ///
    /// # Errors
    /// A process whose visits cannot be computed.
    pub(crate) fn solve(
        &mut self,
        level: Level,
        upper_bound: f64,
        tolerance: f64,
        max_rounds: usize,
    ) -> Result<Candidate, MdpError> {
        let objective = Value::new(self.scenarios, level, &self.plans[0].counts).objective;
        let status = SolverStatus::NotNeeded;
        let mut search = Search { shares: vec![(0, 1.0)], objective, upper_bound, status, rounds: 0, steps: 0 };
        if self.unit == 0.0 {
            // No reward that is possible is ever met: there is nothing to gain.
            search.upper_bound = objective;
        } else if level.is_neutral() {
            let offset: f64 = self.scenarios.masses.iter().zip(&self.scenarios.offsets).map(|(p, b)| p * b).sum();
            search.upper_bound = self.mean_bound - level.risk() * offset;
        } else {
            self.go_on(level, &mut search, tolerance, max_rounds)?;
        }
        Ok(Candidate {
            occupancy: self.occupancy(&search.shares)?,
            objective: search.objective,
            upper_bound: search.upper_bound,
            method: Method::ColumnGeneration,
            status: search.status,
            rounds: search.rounds,
            solver_iterations: search.steps,
        })
    }

    fn go_on(&mut self, level: Level, search: &mut Search, tolerance: f64, max_rounds: usize) -> Result<(), MdpError> {
        let mut vertex = self.nearest_vertex(level);
        let mut smoothing = SMOOTHING;
        while search.upper_bound - search.objective > tolerance * self.unit {
            if search.rounds >= max_rounds {
                search.status = SolverStatus::IterationLimit;
                break;
            }
            search.rounds += 1;
            let Some(best) = self.best_mixture(level, &mut vertex) else {
                search.status = SolverStatus::NumericalError;
                break;
            };
            search.steps += best.steps;
            search.status = SolverStatus::Solved;
            let counts = self.mixed_counts(&best.shares);
            let objective = Value::new(self.scenarios, level, &counts).objective;
            if objective > search.objective {
                (search.objective, search.shares) = (objective, best.shares);
            }
            if search.upper_bound - search.objective <= tolerance * self.unit {
                break;
            }
            let price = Price::new(self.scenarios, &best.tail);
            // While the gap is wide, plans need not be exact.
            let gap = search.upper_bound - search.objective;
            let error = if gap.is_finite() { EXACTNESS * gap } else { EXACTNESS * self.unit };
            if let Some(center) = self.center.as_ref().filter(|_| search.rounds > PATIENCE) {
                let smoothed = price.towards(center, smoothing);
                if self.look(level, search, smoothed, &price, objective, error)? {
                    smoothing = SMOOTHING.min(smoothing * 1.2);
                    continue;
                }
                // Too far from what holds this mixture down: plan for exactly that.
                smoothing *= 0.7;
            }
            if self.look(level, search, price.clone(), &price, objective, error)? {
                continue;
            }
            // Nothing gains as far as that plan can tell.
            if search.upper_bound - search.objective > tolerance * self.unit
                && !self.look(level, search, price.clone(), &price, objective, 0.0)?
            {
                break;
            }
        }
        self.vertices.retain(|(known, _)| known.alpha == level.alpha && known.lambda != level.lambda);
        if self.vertices.len() == MAX_VERTICES {
            self.vertices.remove(0);
        }
        self.vertices.push((level, vertex));
        Ok(())
    }

    /// Plans for one price and takes over its bound; whether the policy it finds would gain at `price`, which holds the
    /// present mixture down to `objective`.
    fn look(
        &mut self,
        level: Level,
        search: &mut Search,
        at: Price,
        price: &Price,
        objective: f64,
        error: f64,
    ) -> Result<bool, MdpError> {
        let (bound, index, new) = self.plan(level, &at, error)?;
        if bound < search.upper_bound {
            search.upper_bound = bound;
            self.center = Some(at);
        }
        let counts = &self.plans[index].counts;
        let tail = dot(&price.weights, counts) - price.offset;
        let worth = level.risk() * tail + level.lambda * self.scenarios.expected_return(counts);
        Ok(new && worth - objective > ROUNDING * self.unit)
    }

    /// Plans; the bound, the index of the plan, and whether it is new.
    fn plan(&mut self, level: Level, price: &Price, error: f64) -> Result<(f64, usize, bool), MdpError> {
        let (bound, plan) = self.planner.plan(level, price, error)?;
        if let Some(known) = self.plans.iter().position(|known| known.counts == plan.counts) {
            return Ok((bound, known, false));
        }
        self.plans.push(plan);
        Ok((bound, self.plans.len() - 1, true))
    }

    /// Where a search begins: where that of the nearest λ ended, if there was any.
    fn nearest_vertex(&self, level: Level) -> Vertex {
        let known = self.vertices.iter().filter(|(known, _)| known.alpha == level.alpha);
        let distance = |known: &Level| (known.lambda - level.lambda).abs();
        match known.min_by(|(a, _), (b, _)| distance(a).total_cmp(&distance(b))) {
            Some((_, vertex)) => vertex.clone(),
            None => self.first_vertex(level),
        }
    }

    /// Where the first search begins.
    fn first_vertex(&self, level: Level) -> Vertex {
        let values = self.scenarios.values(&self.plans[0].counts);
        Vertex::new(self.scenarios, level, 0, &values, self.unit)
    }

    /// The best mixture of all plans; where rounding stops the search it starts again, once.
    fn best_mixture(&self, level: Level, vertex: &mut Vertex) -> Option<Best> {
        let columns: Vec<&[f64]> = self.plans.iter().map(|plan| &plan.counts[..]).collect();
        let game = Game { scenarios: self.scenarios, level, columns: &columns };
        vertex.best(&game).or_else(|| {
            *vertex = self.first_vertex(level);
            vertex.best(&game)
        })
    }

    fn mixed_counts(&self, shares: &[(usize, f64)]) -> Vec<f64> {
        let mut counts = vec![0.0; self.scenarios.n_features];
        for &(index, share) in shares {
            counts.iter_mut().zip(&self.plans[index].counts).for_each(|(sum, x)| *sum += share * x);
        }
        counts
    }

    /// Mixed visits: S × A.
    fn occupancy(&mut self, shares: &[(usize, f64)]) -> Result<Vec<f64>, MdpError> {
        let n_actions = self.mdp.n_actions();
        let mut mixed = vec![0.0; self.mdp.n_states() * n_actions];
        for &(index, share) in shares {
            let plan = &mut self.plans[index];
            if plan.visits.is_none() {
                let rows = occupancy(self.mdp, &plan.policy())?;
                plan.visits = Some(rows.chunks(n_actions).map(|row| row.iter().sum()).collect());
            }
            let visits = plan.visits.as_ref().expect("computed above");
            for ((row, &action), visits) in mixed.chunks_mut(n_actions).zip(&plan.actions).zip(visits) {
                row[action as usize] += share * visits;
            }
        }
        Ok(mixed)
    }
}
