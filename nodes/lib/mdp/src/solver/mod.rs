//! Exact optimal control for many weight vectors, one after another.

mod base;
mod direct;
mod evaluated;
mod greedy;
mod optimum;
mod recent;
mod sweeping;
mod tables;

pub use optimum::Optimum;

use std::sync::Arc;

use direct::Direct;
use greedy::{Greedy, Tolerances};
use sweeping::{Sweeping, Wanted};
use tables::Tables;

use crate::limits::MAX_GAMMA_LARGE;
use crate::linear::{Banded, Order, narrow_order};
use crate::model::Mdp;

/// Most numbers that factors may take.
const MAX_FACTORS: usize = 10_000_000;

/// Finds optimal policies of one process for one weight vector after another.
///
/// For a fixed policy Q is linear in the weights, so where the policy stays optimal one product and one backup prove it.
/// Answers depend on the weights alone, but for rounding of about 1e-13 of the largest possible value: policies are
/// improved until no action gains more than that, and among actions within 100 times as much the first is taken.
#[derive(Debug, Clone)]
pub struct Solver<'a> {
    tables: Tables<'a>,
    engine: Engine,
    working: Working,
    optimum: Optimum<'a>,
}

/// How policies are evaluated.
#[derive(Debug, Clone)]
enum Engine {
    /// By factors.
    Direct(Box<Direct>),
    /// By sweeps.
    Sweeping(Box<Sweeping>),
}

/// What both engines work with.
#[derive(Debug, Clone)]
struct Working {
    rewards: Vec<f64>,
    greedy: Greedy,
    next: Vec<f64>,
}

impl<'a> Solver<'a> {
    /// A solver for `mdp`.
    pub fn new(mdp: &'a Mdp) -> Self {
        let n = mdp.n_states();
        let edges = (0..n).flat_map(|state| {
            (0..mdp.n_actions())
                .flat_map(move |action| mdp.row(state, action).0.iter().map(move |&target| (state, target as usize)))
        });
        let order = narrow_order(n, edges);
        let tables = Tables::new(mdp);
        let (engine, evaluated) = if factors_pay(mdp, &order) {
            let direct = Direct::new(&tables, order);
            let evaluated = direct.current();
            (Engine::Direct(Box::new(direct)), evaluated)
        } else {
            let sweeping = Sweeping::new(mdp);
            let evaluated = sweeping.current();
            (Engine::Sweeping(Box::new(sweeping)), evaluated)
        };
        let working = Working { rewards: vec![], greedy: Greedy::new(n), next: vec![0.0; n] };
        Self { engine, working, optimum: Optimum::new(mdp, evaluated), tables }
    }

    /// The optimum under weights `w`: k numbers. All its values are NaN where weights are not finite.
    ///
    /// # Panics
    /// When there are not k weights.
    pub fn solve(&mut self, w: &[f64]) -> &Optimum<'a> {
        self.solve_within(w, 0.0)
    }

    /// The same, but where values are found step by step that ends once no value is off by more than `error`, as
    /// [`Optimum::error_bound`] proves it; the policy is then greedy for these values. It may depend on what was asked before.
    ///
    /// # Panics
    /// When there are not k weights.
    pub fn solve_within(&mut self, w: &[f64], error: f64) -> &Optimum<'a> {
        assert_eq!(w.len(), self.tables.mdp.n_features(), "as many weights as features");
        let scale = self.tables.scale(w);
        if !scale.is_finite() {
            self.optimum.fill(f64::NAN);
            return &self.optimum;
        }
        let tolerances = Tolerances::new(self.tables.mdp.gamma(), scale);
        self.tables.rewards(w, &mut self.working.rewards);
        let Self { tables, engine, working, optimum } = self;
        if let Some(visits) = optimum.evaluated.known_visits() {
            optimum.help.near = Some(Arc::clone(visits));
        }
        optimum.evaluated = match engine {
            Engine::Direct(direct) => direct.solve(tables, w, tolerances, working, &mut optimum.values, &mut optimum.q),
            Engine::Sweeping(sweeping) => {
                let wanted = Wanted { tolerances, error };
                // Nobody else holds the chain then, and its rows are replaced in place.
                optimum.help.sweeps = None;
                let found = sweeping.solve(tables, w, wanted, working, &mut optimum.values, &mut optimum.q);
                optimum.help.sweeps = sweeping.layout_of(&found);
                found
            }
        };
        optimum.finish(tolerances.tie);
        &self.optimum
    }
}

/// Whether factors in a band cost less than sweeps, both counted in multiplications for a policy that has changed.
fn factors_pay(mdp: &Mdp, order: &Order) -> bool {
    let (n, k, transitions) = (mdp.n_states(), mdp.n_features() as f64, mdp.n_transitions() as f64);
    if mdp.gamma() > MAX_GAMMA_LARGE {
        return true;
    }
    // Factors serve about five policies; sweeps each shrink errors by γ at least, mostly by far more.
    let factors = Banded::work(n, order.bandwidth) / 5.0 + 20.0 * n as f64 * k;
    let sweeps = transitions * (10.0 + 20.0 / ((1.0 - mdp.gamma()) * mdp.n_actions() as f64));
    Banded::size(n, order.bandwidth) <= MAX_FACTORS && factors <= sweeps.max(4e6)
}
