//! The problem (dissertation section 7.2): a process, an uncertain reward, and what policies are judged by.

use std::collections::VecDeque;
use std::panic::resume_unwind;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::mpsc::{Sender, channel};
use std::thread::ScopedJoinHandle;

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
/// How many λ of a frontier are solved before it is parted between them: the first that are not more than half of it.
const SHARED: [usize; 2] = [5, 3];

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
    threads: usize,
    /// Typical size of returns.
    unit: f64,
}

/// Part of a frontier, with all that was learned for it.
struct Span<'b> {
    levels: &'b [Level],
    columns: Columns<'b>,
    direct: Option<Direct<'b>>,
    /// Places in `levels`, in the order in which they were solved.
    found: Vec<(usize, Solution)>,
}

impl Span<'_> {
    /// The same, to go on with elsewhere; what [`Direct`] keeps is found anew where it is needed.
    fn fork(&self) -> Self {
        Self { levels: self.levels, columns: self.columns.clone(), direct: None, found: self.found.clone() }
    }
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
    /// probabilities if they are not all 1/N. `threads` serve [`Objective::Loss`], which plans under every draw, and frontiers,
    /// whose parts are found at once; the answer is the same for any number of them.
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
        Ok(Self { mdp, scenarios, reachable, planner, mean, uniform_rest: false, threads, unit })
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
    /// cost less than each alone.
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
        let order = from_the_ends(lambdas);
        let columns = Columns::new(self.mdp, &self.scenarios, self.planner.clone(), self.mean.clone(), self.unit);
        let first = Span { levels: &levels, columns, direct: None, found: Vec::new() };
        // A few all over the frontier first: what lies between two of them is then found on its own, whether at the same time
        // or not.
        let n_shared = SHARED.iter().copied().find(|n| 2 * n <= order.len()).unwrap_or(order.len());
        let (shared, rest) = order.split_at(n_shared);
        let first = self.span(first, shared, settings, watch)?;
        let between = between(lambdas, shared, rest);
        let (tell, told) = channel();
        let next = AtomicUsize::new(0);
        let work = |tell: Sender<Solution>| {
            let mut found = Vec::new();
            while let Some(indices) = between.get(next.fetch_add(1, Ordering::Relaxed)) {
                // Whoever listens outlives this.
                let mut tell = |solution: &Solution| drop(tell.send(solution.clone()));
                found.extend(self.span(first.fork(), indices, settings, &mut tell)?.found.split_off(n_shared));
            }
            Ok::<_, RobustError>(found)
        };
        let parts = std::thread::scope(|scope| {
            let tellers = std::iter::repeat_n(tell, self.threads.max(1).min(between.len()));
            let workers: Vec<_> = tellers.map(|tell| scope.spawn(|| work(tell))).collect();
            // Until the last worker is done.
            told.iter().for_each(|solution| watch(&solution));
            let join = |worker: ScopedJoinHandle<'_, _>| worker.join().unwrap_or_else(|panic| resume_unwind(panic));
            workers.into_iter().map(join).collect::<Result<Vec<_>, _>>()
        })?;
        let mut solutions: Vec<(usize, Solution)> = parts.into_iter().flatten().chain(first.found).collect();
        solutions.sort_by_key(|(index, _)| *index);
        Ok(solutions.into_iter().map(|(_, solution)| solution).collect())
    }

    /// Solves some more of the levels of a frontier, each with what was learned from those before it.
    fn span<'b>(
        &'b self,
        mut span: Span<'b>,
        indices: &[usize],
        settings: &Settings,
        watch: &mut dyn FnMut(&Solution),
    ) -> Result<Span<'b>, RobustError> {
        for &index in indices {
            let level = span.levels[index];
            let upper_bound = chord(level.lambda, span.found.iter().map(|(_, solution)| solution));
            let candidate = self.candidate(level, upper_bound, settings, &mut span.columns, &mut span.direct)?;
            let (otherwise, unit) = ((!self.uniform_rest).then_some(&self.mean.1.actions[..]), self.unit);
            let solution =
                Solution::new(self.mdp, &self.scenarios, level, candidate, otherwise, unit, settings.tolerance);
            watch(&solution);
            span.found.push((index, solution));
        }
        Ok(span)
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

/// The places `rest`, in their order, parted by the λ of those that are `shared`; parts of nothing are left out.
fn between(lambdas: &[f64], shared: &[usize], rest: &[usize]) -> Vec<Vec<usize>> {
    let mut parts = vec![Vec::new(); shared.len() + 1];
    for &index in rest {
        let n_below = shared.iter().filter(|&&known| lambdas[known] < lambdas[index]).count();
        parts[n_below].push(index);
    }
    parts.retain(|part| !part.is_empty());
    parts
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
