//! Modified policy iteration: greedy choices and Gauss–Seidel sweeps in turn, for processes whose factors cost too much.

use std::sync::Arc;

use crate::linear::Sweeps;
use crate::model::Mdp;
use crate::solver::Working;
use crate::solver::evaluated::{Evaluated, Memory};
use crate::solver::greedy::Tolerances;
use crate::solver::recent::Recent;
use crate::solver::tables::Tables;

/// Share of the residual that sweeps leave before actions are chosen again.
const SHARE: f64 = 0.05;
/// Rounds without a smaller residual after which only rounding is left, once the residual is within [`NEAR_ROUNDING`] of it.
/// Far from it the residual may stand still for long, while values spread through the process.
const PATIENCE: usize = 10;
/// Multiples of the residual that is wanted.
const NEAR_ROUNDING: f64 = 1e4;
/// Rounds, at most: the values that are left then are judged by their error bound.
const MAX_ROUNDS: usize = 5000;
/// States are put in order anew once one row in so many was replaced.
const OUT_OF_ORDER: usize = 8;
/// Sweeps between two choices of actions, at most.
const MAX_SWEEPS: usize = 200;

/// How exact an answer is to be.
#[derive(Debug, Clone, Copy)]
pub(super) struct Wanted {
    pub(super) tolerances: Tolerances,
    /// Values may be off by as much.
    pub(super) error: f64,
}

/// A chain, laid out.
#[derive(Debug, Clone)]
struct Layout {
    sweeps: Arc<Sweeps>,
    /// Rows that were replaced since states were put in order.
    changes: usize,
}

#[derive(Debug, Clone)]
pub(super) struct Sweeping {
    current: Arc<Evaluated>,
    memory: Memory,
    /// The policy that is being improved.
    policy: Vec<usize>,
    /// Its rewards.
    rewards: Vec<f64>,
    /// Its chain.
    layout: Option<Layout>,
    /// Where the policy changed last.
    changed: Vec<u32>,
    recent: Recent,
    /// Whether no state is terminal.
    never_ends: bool,
}

impl Sweeping {
    pub(super) fn new(mdp: &Mdp) -> Self {
        let policy = vec![0; mdp.n_states()];
        let mut memory = Memory::new(policy.len() * (mdp.n_features() + 2));
        let current = memory.add(Evaluated::new(policy.clone()));
        let never_ends = (0..policy.len()).all(|state| !mdp.is_terminal(state));
        let (rewards, recent) = (vec![0.0; policy.len()], Recent::new(policy.len(), mdp.n_features()));
        Self { current, memory, policy, rewards, layout: None, changed: vec![], recent, never_ends }
    }

    /// The policy last found.
    pub(super) fn current(&self) -> Arc<Evaluated> {
        Arc::clone(&self.current)
    }

    /// The chain of a policy, if it is laid out.
    pub(super) fn layout_of(&self, evaluated: &Evaluated) -> Option<Arc<Sweeps>> {
        self.layout.as_ref().filter(|_| self.policy == evaluated.policy).map(|layout| Arc::clone(&layout.sweeps))
    }

    /// The first optimal policy under weights `w`, whose rewards are at hand; V and Q into `values`, from which the search starts
    /// where nothing better is known, and `q`.
    pub(super) fn solve(
        &mut self,
        tables: &Tables<'_>,
        w: &[f64],
        Wanted { tolerances, error }: Wanted,
        working: &mut Working,
        values: &mut [f64],
        q: &mut [f64],
    ) -> Arc<Evaluated> {
        let (mdp, gamma) = (tables.mdp, tables.mdp.gamma());
        let rounding = (1.0 - gamma) * tolerances.rounding;
        let enough = rounding.max((1.0 - gamma) * error);
        self.recent.expect(w, values);
        if values.iter().any(|value| !value.is_finite()) {
            values.fill(0.0);
        }
        let (mut least, mut since) = (f64::INFINITY, 0);
        let mut prepared: Option<Vec<f64>> = None;
        for _ in 0..MAX_ROUNDS {
            tables.backup(&working.rewards, values, q);
            working.greedy.set(q, tolerances.tie);
            let residual = largest_difference(&working.greedy.best, values);
            if residual < least {
                (least, since) = (residual, 0);
            } else {
                since += 1;
            }
            if residual <= enough || (since > PATIENCE && residual <= NEAR_ROUNDING * rounding.max(f64::MIN_POSITIVE)) {
                break;
            }
            self.improve(tables, working, q);
            if !self.changed.is_empty() {
                prepared = None;
            }
            let sweeps = lay_out(&mut self.layout, mdp, &self.policy, &self.changed);
            let prepared = prepared.get_or_insert_with(|| sweeps.prepared(&self.rewards, 1));
            let residual = if self.never_ends { shift(&working.greedy.best, values, gamma) } else { residual };
            sweeps.relax(prepared, values, (SHARE * residual).max(0.5 * enough), MAX_SWEEPS);
        }
        self.recent.add(w, values);
        if working.greedy.first != self.current.actions {
            let first = &working.greedy.first;
            self.current = self.memory.find(first).unwrap_or_else(|| {
                self.memory.add(Evaluated::new(first.iter().map(|&action| action as usize).collect()))
            });
        }
        self.current()
    }

    /// Takes the best action wherever it is better than the present one, and notes where that is.
    fn improve(&mut self, tables: &Tables<'_>, working: &Working, q: &[f64]) {
        let n = self.policy.len();
        self.changed.clear();
        for (state, action) in self.policy.iter_mut().enumerate() {
            let best = working.greedy.best[state];
            if best > q[*action * n + state] {
                *action = q[state..].iter().step_by(n).position(|q| *q == best).unwrap_or(0);
                self.changed.push(state as u32);
            }
            self.rewards[state] = working.rewards[tables.reward_index(state, *action)];
        }
    }
}

/// The chain of `policy`, from that of the policy before it `changed` in these states.
fn lay_out<'s>(layout: &'s mut Option<Layout>, mdp: &Mdp, policy: &[usize], changed: &[u32]) -> &'s Sweeps {
    let (n, gamma) = (policy.len(), mdp.gamma());
    let fits = layout.as_mut().is_some_and(|layout| {
        layout.changes += changed.len();
        // Rows out of order cost more sweeps than a new order does.
        layout.changes * OUT_OF_ORDER <= n && {
            let sweeps = Arc::make_mut(&mut layout.sweeps);
            changed.iter().all(|&s| sweeps.replace(s as usize, gamma, mdp.row(s as usize, policy[s as usize])))
        }
    });
    if !fits {
        *layout = None;
    }
    let new = || Sweeps::new(n, gamma, gamma, |state| mdp.row(state, policy[state]));
    &layout.get_or_insert_with(|| Layout { sweeps: Arc::new(new()), changes: 0 }).sweeps
}

/// Adds the same to all values, so that `best`, what one backup makes of them, lies as far above as below: where nothing ends,
/// TV + c becomes TV + γ c (Porteus 1975). The largest difference that is left.
///
/// Sweeps shrink differences between states fast, but what all states have in common only by γ each.
fn shift(best: &[f64], values: &mut [f64], gamma: f64) -> f64 {
    let differences = best.iter().zip(&*values).map(|(best, value)| best - value);
    let (least, most) =
        differences.fold((f64::INFINITY, f64::NEG_INFINITY), |(least, most), x| (least.min(x), most.max(x)));
    let all = 0.5 * (least + most) / (1.0 - gamma);
    values.iter_mut().for_each(|value| *value += all);
    0.5 * (most - least)
}

fn largest_difference(x: &[f64], y: &[f64]) -> f64 {
    x.iter().zip(y).fold(0.0, |most, (x, y)| most.max((x - y).abs()))
}
