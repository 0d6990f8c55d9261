//! The problem (dissertation section 7.2): a process, an uncertain reward, and what policies are judged by.

use std::collections::VecDeque;

use mdp::{Mdp, Policy, feature_counts};

use crate::candidate::Candidate;
use crate::columns::Columns;
use crate::direct::Direct;
use crate::error::{RobustError, check_length, check_numbers};
use crate::level::Level;
use crate::objective::Objective;
use crate::planner::{Plan, Planner};
use crate::reachable::Reachable;
use crate::scenarios::Scenarios;
use crate::settings::{AUTOMATIC_ROUNDS, AUTOMATIC_STATES, MethodChoice, Settings};
use crate::solution::Solution;
use crate::value::Value;

/// Most λ of one frontier.
pub const MAX_POINTS: usize = 10_000;

/// A checked problem, to be solved for any α and λ.
#[derive(Debug, Clone)]
pub struct Problem<'a> {
    mdp: &'a Mdp,
    scenarios: Scenarios,
    reachable: Reachable,
    /// To be cloned, so that answers do not depend on what was asked before.
    planner: Planner<'a>,
    /// The optimal policy for the mean reward, and what no policy's expected return exceeds.
    mean: (f64, Plan),
    uniform_rest: bool,
    /// Typical size of returns.
    unit: f64,
}

/// The risk of some policy.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Risk {
    /// (1 − λ) CVaR_α(ψ) + λ E(return).
    pub objective: f64,
    /// E(return).
    pub expected_return: f64,
    /// VaR_α(ψ).
    pub value_at_risk: f64,
    /// CVaR_α(ψ).
    pub conditional_value_at_risk: f64,
}

impl<'a> Problem<'a> {
    /// The problem of `mdp` under posterior `draws` of the reward weights (N × k, row by row), with `weights` as their
    /// probabilities if they are not all 1/N. `threads` serve [`Objective::Loss`] alone, which plans under every draw; the
    /// answer is the same for any number of them.
    ///
    /// # Errors
    /// No draws, rows of the wrong length, numbers that are not finite; weights that are negative or do not sum to 1 within
    /// [`crate::WEIGHT_TOLERANCE`]; expert feature counts of the wrong number.
    pub fn new(
        mdp: &'a Mdp,
        draws: &[f64],
        weights: Option<&[f64]>,
        objective: Objective<'_>,
        threads: usize,
    ) -> Result<Self, RobustError> {
        let scenarios = Scenarios::new(mdp, draws, weights, objective, threads)?;
        let reachable = Reachable::new(mdp);
        // Returns may cancel, in which case one step is the measure.
        let step = scenarios.step_size(&reachable.largest_features(mdp));
        let mut planner = Planner::new(mdp, &scenarios, step);
        let mean = planner.plan_for_mean()?;
        let unit = scenarios.size(&mean.1.counts).max(step);
        Ok(Self { mdp, scenarios, reachable, planner, mean, uniform_rest: false, unit })
    }

    /// The same problem, but policies take every action equally often in states that they never visit.
    pub(crate) fn with_uniform_rest(self) -> Self {
        Self { uniform_rest: true, ..self }
    }

    /// The best policy for α in [0, 1) and λ in [0, 1]: λ = 0 looks at the worst share 1 − α of draws only, λ = 1 at the mean.
    ///
    /// # Errors
    /// α, λ or settings out of range; a process whose visits cannot be computed.
    pub fn solve(&self, alpha: f64, lambda: f64, settings: &Settings) -> Result<Solution, RobustError> {
        let mut solutions = self.frontier(alpha, &[lambda], settings)?;
        Ok(solutions.remove(0))
    }

    /// The best policy for each λ, in the order given (figure 7.3 b). What is learned for one serves the next, so that many
    /// cost little more than one.
    ///
    /// # Errors
    /// As [`Self::solve`]; no λ at all, or more than [`MAX_POINTS`].
    pub fn frontier(&self, alpha: f64, lambdas: &[f64], settings: &Settings) -> Result<Vec<Solution>, RobustError> {
        self.frontier_watched(alpha, lambdas, settings, &mut |_| {})
    }

    /// The same, telling `watch` of each solution as it is found; that is not in the order given.
    ///
    /// # Errors
    /// As [`Self::frontier`].
    pub fn frontier_watched(
        &self,
        alpha: f64,
        lambdas: &[f64],
        settings: &Settings,
        watch: &mut dyn FnMut(&Solution),
    ) -> Result<Vec<Solution>, RobustError> {
        settings.check()?;
        if lambdas.is_empty() {
            return Err(RobustError::Empty { what: "lambdas" });
        }
        if lambdas.len() > MAX_POINTS {
            return Err(RobustError::Size { what: "number of lambdas", got: lambdas.len(), most: MAX_POINTS });
        }
        let levels: Vec<Level> = lambdas.iter().map(|&lambda| Level::new(alpha, lambda)).collect::<Result<_, _>>()?;
        let mut columns = Columns::new(self.mdp, &self.scenarios, self.planner.clone(), self.mean.clone(), self.unit);
        let mut direct: Option<Direct<'_>> = None;
        let mut solutions: Vec<Option<Solution>> = vec![None; levels.len()];
        for index in from_the_ends(lambdas) {
            let level = levels[index];
            let upper_bound = chord(level.lambda, solutions.iter().flatten());
            let candidate = self.candidate(level, upper_bound, settings, &mut columns, &mut direct)?;
            let (otherwise, unit) = ((!self.uniform_rest).then_some(&self.mean.1.actions[..]), self.unit);
            let solution =
                Solution::new(self.mdp, &self.scenarios, level, candidate, otherwise, unit, settings.tolerance);
            watch(&solution);
            solutions[index] = Some(solution);
        }
        Ok(solutions.into_iter().flatten().collect())
    }

    fn candidate<'b>(
        &'b self,
        level: Level,
        upper_bound: f64,
        settings: &Settings,
        columns: &mut Columns<'b>,
        direct: &mut Option<Direct<'b>>,
    ) -> Result<Candidate, RobustError> {
        let Settings { method, tolerance, max_rounds, max_iterations } = *settings;
        let automatic = method == MethodChoice::Automatic && self.reachable.states.len() <= AUTOMATIC_STATES;
        let mut best = None;
        if method != MethodChoice::Direct {
            let max_rounds = if automatic { max_rounds.min(AUTOMATIC_ROUNDS) } else { max_rounds };
            let candidate = columns.solve(level, upper_bound, tolerance, max_rounds)?;
            if !automatic || candidate.upper_bound - candidate.objective <= tolerance * self.unit {
                return Ok(candidate);
            }
            best = Some(candidate);
        }
        let direct = direct.get_or_insert_with(|| {
            let (planner, mean) = (self.planner.clone(), self.mean.1.clone());
            Direct::new(self.mdp, &self.scenarios, &self.reachable, planner, mean)
        });
        let candidate = direct.solve(level, upper_bound, tolerance, max_iterations)?;
        Ok(match best {
            Some(best) => best.or(candidate),
            None => candidate,
        })
    }

    /// The risk of any policy of the process, such as a baseline's.
    ///
    /// # Errors
    /// α or λ out of range; a policy that is not one of the process.
    pub fn risk(&self, policy: &Policy, alpha: f64, lambda: f64) -> Result<Risk, RobustError> {
        self.risk_of(&feature_counts(self.mdp, policy)?, alpha, lambda)
    }

    /// The same from feature counts μ: k numbers.
    ///
    /// # Errors
    /// α or λ out of range; counts of the wrong number or not finite.
    pub fn risk_of(&self, counts: &[f64], alpha: f64, lambda: f64) -> Result<Risk, RobustError> {
        let level = Level::new(alpha, lambda)?;
        check_length("feature counts", counts.len(), self.scenarios.n_features, "one per feature")?;
        check_numbers("feature counts", counts)?;
        let value = Value::new(&self.scenarios, level, counts);
        Ok(Risk {
            objective: value.objective,
            expected_return: value.expected_return,
            value_at_risk: value.tail.value_at_risk,
            conditional_value_at_risk: value.tail.conditional_value_at_risk,
        })
    }

    /// The distribution of ψ for feature counts μ (figures 7.3 c and 7.5): (ψ, probability) of every different draw, ψ
    /// ascending.
    ///
    /// # Errors
    /// Counts of the wrong number or not finite.
    pub fn distribution(&self, counts: &[f64]) -> Result<Vec<(f64, f64)>, RobustError> {
        check_length("feature counts", counts.len(), self.scenarios.n_features, "one per feature")?;
        check_numbers("feature counts", counts)?;
        let values = self.scenarios.values(counts);
        let mut points: Vec<(f64, f64)> = values.into_iter().zip(self.scenarios.masses.iter().copied()).collect();
        points.sort_by(|a, b| a.0.total_cmp(&b.0));
        Ok(points)
    }

    /// States that no policy ever visits, ascending.
    pub fn unreachable(&self) -> Vec<usize> {
        let reached = &self.reachable.states;
        (0..self.mdp.n_states()).filter(|state| reached.binary_search(state).is_err()).collect()
    }

    /// Different draws of positive probability.
    pub fn n_draws(&self) -> usize {
        self.scenarios.n()
    }

    /// The mean of the draws: k numbers.
    pub fn mean_weights(&self) -> &[f64] {
        &self.scenarios.mean
    }
}

/// Places of `lambdas` in the order in which they are best solved: the smallest, the largest, then always those in the middle.
fn from_the_ends(lambdas: &[f64]) -> Vec<usize> {
    let mut ascending: Vec<usize> = (0..lambdas.len()).collect();
    ascending.sort_by(|&i, &j| lambdas[i].total_cmp(&lambdas[j]).then(i.cmp(&j)));
    let last = ascending.len() - 1;
    let mut order = vec![ascending[last]];
    if last > 0 {
        order.push(ascending[0]);
    }
    let mut spans = VecDeque::from([(0_usize, last)]);
    while let Some((low, high)) = spans.pop_front() {
        let middle = low.midpoint(high);
        if middle > low {
            order.push(ascending[middle]);
            spans.extend([(low, middle), (middle, high)]);
        }
    }
    order
}

/// What no objective exceeds at λ, from the bounds at its neighbours on both sides: the optimum is convex in λ, being the
/// largest of functions that are linear in it.
fn chord<'s>(lambda: f64, solutions: impl Iterator<Item = &'s Solution>) -> f64 {
    let (mut below, mut above): (Option<&Solution>, Option<&Solution>) = (None, None);
    for solution in solutions {
        if solution.lambda <= lambda && below.is_none_or(|known| known.lambda < solution.lambda) {
            below = Some(solution);
        }
        if solution.lambda >= lambda && above.is_none_or(|known| known.lambda > solution.lambda) {
            above = Some(solution);
        }
    }
    match (below, above) {
        (Some(below), Some(above)) if below.lambda < above.lambda => {
            let share = (lambda - below.lambda) / (above.lambda - below.lambda);
            (1.0 - share) * below.upper_bound + share * above.upper_bound
        }
        (Some(same), Some(_)) => same.upper_bound,
        _ => f64::INFINITY,
    }
}
